#!/usr/bin/env bash
# inputs.sh FOLDER: makes the files that the pages' examples call the reader's own.
set -euo pipefail
cd "$1"

# shape.obj: a plate of 41 by 21 vertices over [0, 2] x [0, 1].
awk 'BEGIN {
  for (j = 0; j < 21; ++j) for (i = 0; i < 41; ++i) print "v", i / 20, j / 20, 0.02 * sin(i) * sin(j)
  for (j = 0; j < 20; ++j) for (i = 1; i < 41; ++i) {
    a = j * 41 + i; print "f", a, a + 1, a + 42, a + 41 }
}' >shape.obj

# horse-000.obj ... horse-005.obj: a tube along x that bends more with each frame.
for frame in 0 1 2 3 4 5; do
  awk -v f="$frame" 'BEGIN {
    for (i = 0; i < 720; ++i) {
      x = int(i / 12) / 12; a = i % 12 * 0.5235987756
      print "v", x, cos(a), sin(a) + 0.01 * f * x * x }
    for (i = 0; i < 708; ++i) {
      n = i % 12 == 11 ? i - 11 : i + 1; print "f", i + 1, n + 1, n + 13, i + 13 }
  }' >"$(printf 'horse-%03d.obj' "$frame")"
done

# cache.csv: particles that fly along x; each lives for ten frames.
awk 'BEGIN {
  print "frame,id,x,y,z"
  for (f = 0; f < 20; ++f) for (id = f < 9 ? 0 : f - 9; id <= f; ++id)
    printf "%d,%d,%.9g,%.9g,%.9g\n", f, id, 0.5 * (f - id), 0.1 * sin(id), 0.1 * cos(id)
}' >cache.csv

# path.csv: a cursor that goes round; moves.csv: two handles that were recorded at once.
awk 'BEGIN {
  print "time,x,y"
  for (i = 0; i <= 12; ++i) { a = i * 0.5235987756
    printf "%.3f,%.3f,%.3f\n", i / 12, 200 + 100 * cos(a), 230 + 80 * sin(a) }
}' >path.csv
awk 'BEGIN {
  print "time,handle,x,y,angle"
  for (i = 0; i <= 6; ++i) { a = i * 0.5235987756
    printf "%.3f,hand,%.3f,%.3f,\n", i / 12, 350 + 20 * sin(a), 193 - 80 * sin(a)
    printf "%.3f,head,200,80,%.3f\n", i / 12, 20 * sin(a) }
}' >moves.csv
