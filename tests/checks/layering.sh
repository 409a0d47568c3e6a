#!/usr/bin/env bash
# layering.sh ROOT: checks geometry <- energies <- solvers <- deformers <- render <- drawing <-
# experiments. Prints each #include of a layer to the right of the file's own layer, each folder
# with more than 30 source files, and each layer without a README.md. Fails if it prints anything.
set -euo pipefail

root=${1:?usage: layering.sh ROOT}
layers=(geometry energies solvers deformers render drawing experiments)
most_files=30
status=0

complain() {
  echo "$@" >&2
  status=1
}

above=
for ((i = ${#layers[@]} - 1; i >= 0; i--)); do
  layer=${layers[i]}
  [[ -d $root/$layer ]] || { complain "the folder $layer/ is missing" && continue; }
  [[ -f $root/$layer/README.md ]] ||
    complain "$layer/README.md is missing; it says what belongs into the layer and what does not"
  if [[ $above ]] && grep -rnE --include='*.h' --include='*.cc' \
    "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]([^>\"]*/)?($above)/" "$root/$layer"; then
    complain "$layer/ must not include $above"
  fi
  while read -r count folder; do
    ((count <= most_files)) || complain "${folder#"$root"/}/ has $count source files, more than" \
      "$most_files; sort them into subfolders"
  done < <(find "$root/$layer" \( -name '*.h' -o -name '*.cc' \) -printf '%h\n' | sort | uniq -c)
  above=$layer${above:+|$above}
done
exit "$status"
