#!/usr/bin/env bash
# tidy.sh ROOT BUILD [PATTERN]: checks that clang-tidy finds nothing in the files whose path PATTERN
# matches. BUILD is a folder that was configured by the preset asan.
set -euo pipefail

root=$(readlink -f -- "${1:?usage: tidy.sh ROOT BUILD [PATTERN]}")
build=${2:?usage: tidy.sh ROOT BUILD [PATTERN]}
pattern=${3:-.}
mapfile -t files < <(sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$build/compile_commands.json" |
  grep -F "$root/" | grep -vF "$root/build/" | grep -E -- "$pattern" | sort -u)
((${#files[@]})) || { echo "no compiled file matches '$pattern'" >&2 && exit 1; }
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p "$build" 2> >(grep -vE 'warnings? generated' >&2)
echo "clang-tidy finds nothing in ${#files[@]} files"
