#!/usr/bin/env bash
# agree.sh PROGRAM: runs an example and checks that it prints one cost for Gauss-Newton and one for
# Ceres, that both have decreased, and that they agree to nine digits. It also has to fail where its
# output cannot be written.
set -euo pipefail

if "$1" >/dev/full; then echo "a full standard output was no error" && exit 1; fi
output=$("$1")
echo "$output"
awk '
  /^(gauss_newton|ceres): cost / {
    cost[$1] = $3; sub(",.*", "", cost[$1])
    for (i = 1; i < NF; ++i) if ($i == "from") { start = $(i + 1); sub("[;,]", "", start) }
    if (!($3 + 0 < start + 0)) { print "the cost did not decrease"; exit 1 }
    n++
  }
  END {
    if (n != 2) { print "expected two costs, found " n + 0; exit 1 }
    a = cost["gauss_newton:"]; b = cost["ceres:"]
    d = a > b ? a - b : b - a
    if (d > 1e-9 * a) { print "the costs differ: " a " and " b; exit 1 }
  }' <<<"$output"
