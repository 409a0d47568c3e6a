#!/usr/bin/env bash
# headers.sh ROOT BUILD: checks that every header of the layers compiles by itself. BUILD is a
# folder that was configured by the preset asan; its compile commands name the folders of the
# libraries.
set -euo pipefail

root=${1:?usage: headers.sh ROOT BUILD} build=${2:?usage: headers.sh ROOT BUILD}
compiler=${CXX:-clang++-14}
mapfile -t flags < <(grep -oE '(-I|-isystem )/[^ "]+' "$build/compile_commands.json" |
  sort -u | sed 's/^-isystem /-isystem/')
cd "$root"
mapfile -t headers < <(git ls-files -- '*.h' | grep -E \
  '^(geometry|energies|solvers|deformers|render|drawing|experiments)/')
((${#headers[@]})) || { echo "found no header below $PWD" >&2 && exit 1; }
printf '%s\0' "${headers[@]}" | xargs -0 -n 1 -P "$(nproc)" \
  "$compiler" -std=c++20 -fsyntax-only -Werror -Wno-pragma-once-outside-header \
  -Wno-unused-command-line-argument "${flags[@]}" -x c++
echo "${#headers[@]} headers compile by themselves"
