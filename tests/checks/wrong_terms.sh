#!/usr/bin/env bash
# wrong_terms.sh COMPILER ROOT FLAG...: for each mistake in wrong_term.cpp the compiler has to print
# one error, and that has to say what is wrong.
set -euo pipefail

compiler=${1:?usage: wrong_terms.sh COMPILER ROOT FLAG...} root=$2
shift 2
expected=(
  ""
  "a term needs a name"
  "a template over the scalar alone"
  "has to be const"
  "has to return Vector<T, n> with a fixed n"
  "has to return Vector<T, n> with a fixed n"
  "of one node for each argument"
  "may have kMaxResiduals residuals"
  "as many residuals as there are coordinates"
  "of the scalar T for every T"
)
status=0
for case in "${!expected[@]}"; do
  output=$("$compiler" -std=c++20 -fsyntax-only -DCASE="$case" -I"$root" "$@" \
    "$root/tests/checks/wrong_term.cpp" 2>&1) || true
  errors=$(grep -c 'error:' <<<"$output" || true)
  if [[ $errors != $((case > 0)) ]] || ! grep -qF "${expected[case]}" <<<"$output"; then
    echo "case $case: expected one error with '${expected[case]}', found $errors:" >&2
    echo "$output" >&2
    status=1
  fi
done
exit "$status"
