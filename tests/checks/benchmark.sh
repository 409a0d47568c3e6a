#!/usr/bin/env bash
# benchmark.sh PROGRAM: the benchmark program measures every scenario on the smallest graph, and the
# growth on small planes. The report and the JSON file must have every row, what it was compared
# with, and the environment. Times may have any value.
set -euo pipefail

program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" --benchmark_filter=nothing --scenarios=all --sizes=30 --repetitions=1 \
  --scaling=yes --scaling_nodes=20,40 --scaling_side=41 --large_nodes=50 --large_side=61 \
  --out="$folder" >"$folder/log" 2>&1 || { cat "$folder/log" && exit 1; }
ceres=(
  'sparse_normal_cholesky, suite_sparse, levenberg_marquardt, one block for each column'
  'sparse_normal_cholesky, suite_sparse, dogleg, one block for each column'
  'sparse_normal_cholesky, suite_sparse, levenberg_marquardt, one block for each node'
  'sparse_normal_cholesky, suite_sparse, dogleg, one block for each node'
  'cgnr, suite_sparse, levenberg_marquardt, one block for each node'
  'cgnr, suite_sparse, levenberg_marquardt, one block for each column'
  'iterative_schur, suite_sparse, levenberg_marquardt, one block for each node'
  'sparse_schur, suite_sparse, levenberg_marquardt, one block for each node'
  'sparse_schur, suite_sparse, levenberg_marquardt, one block for each column'
  'sparse_normal_cholesky, eigen_sparse, levenberg_marquardt, one block for each column'
  'sparse_normal_cholesky, cx_sparse, levenberg_marquardt, one block for each column'
)
for row in 'from rest, against Ceres' 'a drag of 1 % of the side, against Ceres' \
  'a hard scene from rest, against Ceres' 'from rest, against our CHOLMOD path' \
  'from rest with the transfer, against CGAL' 'an update of a drawing, against an iteration of CGAL' \
  "a registration of a drawing, against CGAL's preprocessing" \
  "a compilation of a drawing, against CGAL's preprocessing" \
  'a handle of a drawing added or removed, against a full compilation' \
  'a drag of the armadillo with the transfer, against Ceres and the same transfer' \
  "${ceres[@]/#/a step of CHOLMOD, against ceres }"; do
  grep -qF "| $row |" "$folder/benchmarks.md" || { echo "the report lacks '$row'" && exit 1; }
  grep -qF "\"scenario\": \"${row%%, against *}\"" "$folder/benchmarks.json" ||
    { echo "the JSON file lacks '$row'" && exit 1; }
done
for key in commit blas threads cxx_flags processor ceres ratio ratio_least ratio_most settings \
  alone_ms status steps cost ms 'whole solve' 'step one' fit 'step two' exponent growing large \
  peak_bytes copy_ms; do
  grep -q "\"$key\":" "$folder/benchmarks.json" || { echo "no '$key' in the JSON file" && exit 1; }
done
if grep -q -- '-dirty"' "$folder/benchmarks.json" &&
  ! grep -q 'The code was changed' "$folder/benchmarks.md"; then
  echo "the report does not say that the tree was dirty" && exit 1
fi
if grep -q '"status": "failed"' "$folder/benchmarks.json"; then echo "a solve failed" && exit 1; fi
if "$program" --benchmark_filter=nothing --scenarios=nonsense >"$folder/log" 2>&1 ||
  ! grep -q 'nonsense' "$folder/log"; then
  echo "an unknown scenario was accepted" && exit 1
fi

# The standard output is full, closed, or read by nobody.
list=(--benchmark_list_tests --scenarios=none --scaling=no)
status=0
"$program" "${list[@]}" >/dev/full 2>"$folder/log" || status=$?
if ((status != 2)) || ! grep -q 'standard output: No space left on device' "$folder/log"; then
  echo "a full standard output was no error (status $status)" && cat "$folder/log" && exit 1
fi
"$program" "${list[@]}" <&- >&- 2>&- || { echo "closed streams were an error" && exit 1; }
status=0
{ sleep 0.2 && "$program" "${list[@]}" 2>"$folder/log"; } | true || status=$?
if ((status != 141)) || [[ -s $folder/log ]]; then
  echo "a broken pipe gave the status $status and a message" && cat "$folder/log" && exit 1
fi
