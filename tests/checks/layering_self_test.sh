#!/usr/bin/env bash
# Puts includes into empty folders of the layers' names. layering.sh must accept those that go down
# and reject those that go up, a folder with too many files, and a layer without a README.md.
set -euo pipefail

check=$(dirname -- "${BASH_SOURCE[0]}")/layering.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir "$root"/{geometry,energies,solvers,deformers,render,drawing,experiments}
touch "$root"/{geometry,energies,solvers,deformers,render,drawing,experiments}/README.md

expect() {  # expect pass|reject FILE INCLUDE
  printf '#include %s\n' "$3" >"$root/$2"
  if bash "$check" "$root" >/dev/null 2>&1; then verdict=pass; else verdict=reject; fi
  rm "$root/$2"
  [[ $verdict == "$1" ]] || { echo "$2 including $3: $verdict, expected $1" && exit 1; }
}

expect pass geometry/a.h '<Eigen/Core>'
expect pass energies/a.h '"geometry/shape/shape.h"'
expect pass experiments/a.cc '"deformers/deformer.h"'
expect pass solvers/a.cc '"solvers/problem.h"'
expect reject geometry/a.h '"energies/energy.h"'
expect reject geometry/a.cc '<experiments/config/config.h>'
expect reject energies/a.cc '"../solvers/problem.h"'
expect reject solvers/a.h '  "deformers/deformer.h"'
expect pass drawing/a.cc '"render/image.h"'
expect reject render/a.h '"drawing/drawing.h"'
expect reject drawing/a.cc '"experiments/commands/results.h"'
expect reject deformers/a.cc '"experiments/config/config.h"'

mkdir "$root/geometry/core"
touch "$root"/geometry/core/{1..30}.h
expect pass geometry/a.h '<Eigen/Core>'
touch "$root"/geometry/core/31.cc
expect reject geometry/a.h '<Eigen/Core>'
rm "$root"/geometry/core/31.cc "$root/drawing/README.md"
expect reject geometry/a.h '<Eigen/Core>'
