#!/usr/bin/env bash
# extract_programs.sh PAGE NAME FOLDER: writes the n-th ```cpp block of PAGE to FOLDER/NAME_<n>.cc.
# A file that has not changed is not touched, so that nothing is compiled again.
set -euo pipefail

page=$1 name=$2 folder=$3
mkdir -p "$folder"
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT
awk -v stem="$new/$name" '
  /^```cpp$/ { file = stem "_" ++n ".cc"; next }
  /^```$/ { if (file) close(file); file = ""; next }
  file { print > file }' "$page"
for old in "$folder/$name"_*.cc; do
  if [[ -e $old && ! -e $new/$(basename "$old") ]]; then rm "$old"; fi
done
for program in "$new"/*.cc; do
  if [[ -e $program ]] && ! cmp -s "$program" "$folder/$(basename "$program")"; then
    cp "$program" "$folder/"
  fi
done
