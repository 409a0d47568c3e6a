#!/usr/bin/env bash
# Runs the fuzzer on the readers of input files, on as many at a time as there are cores.
#
#   tests/fuzz/run.sh [SECONDS] [READER…]   each reader, or these, for so many seconds (60)
#
# build/asan/readers/READER has the samples, the corpus that the fuzzer has found so far and goes on
# from, the log, and below `findings` each input that is a fault: a crash, an exception that is no
# InputError, 30 seconds without an answer, or 2 GB of memory. The exit status is 1 if there is one.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)
seconds=60
if [[ ${1-} =~ ^[0-9]+$ ]]; then seconds=$1; shift; fi

DEFORMLAB_TARGETS='fuzz_corpus fuzz_readers' "$root/deformlab" --preset asan build
programs=$root/build/asan/tests/fuzz folder=$root/build/asan/readers
TMPDIR=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)  # for the files that readers need
trap 'rm -rf "$TMPDIR"' EXIT
export TMPDIR programs folder seconds
mapfile -t known < <("$programs/fuzz_corpus" "$folder")
readers=("$@")
((${#readers[@]})) || readers=("${known[@]}")
for reader in "${readers[@]}"; do
  [[ " ${known[*]} " == *" $reader "* ]] ||
    { echo "unknown reader '$reader'; known: ${known[*]}" >&2 && exit 2; }
done

# Prints one line about a reader. The fuzzer stops at its first finding.
fuzz_reader() {
  local its=$folder/$1 runs before found
  mkdir -p "$its/corpus" "$its/findings"
  before=$(find "$its/findings" -type f | wc -l)
  DEFORMLAB_READER=$1 "$programs/fuzz_readers" "$its/corpus" "$its/samples" \
    -dict="$its/words.dict" -artifact_prefix="$its/findings/" -max_total_time="$seconds" \
    -max_len=4096 -timeout=30 -report_slow_units=1000 -rss_limit_mb=2048 -print_final_stats=1 >"$its/log" 2>&1 || true
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$its/log")
  found=$(($(find "$its/findings" -type f | wc -l) - before))
  printf '%-16s %10d runs %4d findings\n' "$1" "${runs:-0}" "$found"
  ((found == 0 && ${runs:-0} > 0)) || tail -n 30 "$its/log" | sed 's/^/    /'
  ((found == 0 && ${runs:-0} > 0))
}
export -f fuzz_reader
printf '%s\n' "${readers[@]}" | xargs -P "$(nproc)" -I{} bash -c 'fuzz_reader {}' ||
  { echo "the findings are below $folder/READER/findings" >&2 && exit 1; }
