#!/usr/bin/env bash
# installed_package.sh CMAKE BUILD CONSUMER [SANITIZERS]: installs the library into a new folder,
# and builds and runs the project CONSUMER, which finds the library only by find_package(deformlab).
set -euo pipefail

cmake=$1 build=$2 consumer=$3 sanitizers=${4-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$cmake" --install "$build" --prefix "$folder/prefix" >"$folder/install.log" ||
  { cat "$folder/install.log" && exit 1; }
"$cmake" -G Ninja -S "$consumer" -B "$folder/build" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_FLAGS="${sanitizers:+-fsanitize=$sanitizers}"
"$cmake" --build "$folder/build"
"$folder/build/consumer"
