#!/usr/bin/env bash
# links.sh SOURCE: every relative link of the documentation leads to a file or a heading that exists.
set -euo pipefail
cd "$1"

# The anchor that a heading gets: lower case, spaces as hyphens, without punctuation.
anchors() {
  sed -n 's/^#\{1,6\} //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

status=0
for page in README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md docs/*.md; do
  # Code is no link: what stands in fences or between backticks is left out.
  links=$(awk '/^ *```/ { code = !code; next } !code' "$page" | sed 's/`[^`]*`//g' |
    grep -o '](\([^)]*\))' | sed 's/^](//; s/)$//' || true)
  while read -r link; do
    case $link in '' | http://* | https://*) continue ;; esac
    path=${link%%#*} anchor=
    if [[ $link == *'#'* ]]; then anchor=${link#*#}; fi
    target=$page
    if [[ $path ]]; then target=$(dirname "$page")/$path; fi
    if [[ ! -e $target ]]; then
      echo "$page: the link ($link) leads to no file" && status=1
    elif [[ $anchor ]] && ! anchors "$target" | grep -qxF -- "$anchor"; then
      echo "$page: the link ($link) leads to no heading of $target" && status=1
    fi
  done <<<"$links"
done
exit "$status"
