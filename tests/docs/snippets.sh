#!/usr/bin/env bash
# snippets.sh PROGRAM SOURCE BUILD PAGE: does what a reader of PAGE does, in a new folder that looks
# like a fresh clone in which the program has been built:
#   a ```yaml, ```cmake or ```text block whose first line is "# NAME" is written to the file NAME;
#   a ```sh block is run, command by command, and each command must succeed;
#   a ```cpp block, which the build has compiled, is run likewise.
set -euo pipefail

program=$1 source=$2 build=$3 page=$4
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build/release"
ln -s "$source/configs" "$folder/configs"
ln -s "$build/shapes" "$folder/build/release/shapes"
bash "$here/inputs.sh" "$folder"

# The program stands for the launcher, whose own commands build and test the whole project.
cat >"$folder/deformlab" <<END
#!/usr/bin/env bash
case \$1 in test | bench) exit 0 ;; esac
exec "$program" "\$@"
END
chmod +x "$folder/deformlab"

# Blocks become files: 001.sh, 002.yaml, ... in the order of the page.
mkdir "$folder/.blocks"
awk -v folder="$folder/.blocks" '
  /^ *```[a-z]+ *$/ && !file { sub(/^ *```/, ""); file = sprintf("%s/%03d.%s", folder, ++n, $1); next }
  /^ *``` *$/ { close(file); file = ""; next }
  file { print > file }' "$source/$page"

cd "$folder"
commands=0 programs=0
run() {
  echo "== $page: $*"
  "$@" >log 2>&1 || { cat log && echo "failed" && exit 1; }
}
for block in .blocks/*; do
  case $block in
    *.sh)
      cat "$block"
      run bash -euo pipefail "$block"
      commands=$((commands + 1))
      ;;
    *.cpp)
      programs=$((programs + 1))
      run "$build/tests/docs/programs/docs_${page//[\/.]/_}_$programs"
      ;;
    *.yaml | *.cmake | *.text)
      name=$(sed -n '1s/^# \([A-Za-z0-9_.-]*\)$/\1/p' "$block")
      if [[ $name ]]; then cp "$block" "$name"; fi
      ;;
  esac
done
echo "$page: $commands blocks of commands and $programs programs ran"
