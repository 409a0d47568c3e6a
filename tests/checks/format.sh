#!/usr/bin/env bash
# format.sh ROOT: checks that clang-format would change no .h and no .cc file that git tracks.
set -euo pipefail

cd "${1:?usage: format.sh ROOT}"
command -v clang-format >/dev/null || {
  echo "clang-format is missing; install the Debian package clang-format" >&2
  exit 1
}
if git rev-parse --git-dir >/dev/null 2>&1; then
  mapfile -d '' files < <(git ls-files -z -- '*.h' '*.cc')
else
  mapfile -d '' files < <(find . -name build -prune -o \( -name '*.h' -o -name '*.cc' \) -print0)
fi
((${#files[@]})) || { echo "found no .h and no .cc below $PWD" >&2 && exit 1; }
clang-format --dry-run -Werror -- "${files[@]}"
echo "${#files[@]} files are formatted"
