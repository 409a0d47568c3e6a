#!/usr/bin/env bash
# benchmark.sh PROGRAM: the benchmark program makes its table of speeds on the smallest graph, with
# every row and who it was measured against, and its tables of growth on small ones. Nothing is said
# about the times.
set -euo pipefail

program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" --benchmark_filter=nothing --duels=yes --duel_nodes=30 --repetitions=1 \
  --scaling=yes --scaling_nodes=20,40 --scaling_side=41 --large_nodes=50 --large_side=61 \
  --json="$folder/speeds.json" --report="$folder/speeds.md" >"$folder/log" 2>&1 ||
  { cat "$folder/log" && exit 1; }
for row in 'from rest, against Ceres' 'a drag of 1 % of the side, against Ceres' \
  'a hard scene from rest, against Ceres' 'from rest, against our CHOLMOD path' \
  'from rest with the transfer, against CGAL'; do
  grep -qF "\"row\": \"$row\"" "$folder/speeds.json" || { echo "no row '$row'" && exit 1; }
  grep -qF "| $row |" "$folder/speeds.md" || { echo "the report lacks '$row'" && exit 1; }
done
for key in ratio settings status steps cost ms blas ceres exponent growing large peak_bytes copy_ms; do
  grep -q "\"$key\":" "$folder/speeds.json" || { echo "no '$key' in the JSON file" && exit 1; }
done
if grep -q '"status": "failed"' "$folder/speeds.json"; then echo "a solve failed" && exit 1; fi
