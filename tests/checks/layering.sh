#!/usr/bin/env bash
# layering.sh ROOT: geometry <- energies <- solvers <- deformers <- render <- drawing <- experiments.
# Fails and names each #include of a layer to the right of the file's own.
set -euo pipefail

root=${1:?usage: layering.sh ROOT}
layers=(geometry energies solvers deformers render drawing experiments)
status=0
above=
for ((i = ${#layers[@]} - 1; i >= 0; i--)); do
  if [[ $above && -d $root/${layers[i]} ]] &&
    grep -rnE --include='*.h' --include='*.cc' \
      "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]([^>\"]*/)?($above)/" "$root/${layers[i]}"; then
    echo "${layers[i]}/ must not include $above" >&2
    status=1
  fi
  above=${layers[i]}${above:+|$above}
done
exit "$status"
