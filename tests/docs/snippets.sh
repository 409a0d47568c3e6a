#!/usr/bin/env bash
# snippets.sh PROGRAM SOURCE BUILD PAGE: does what a reader of PAGE does, in a new folder that looks
# like a fresh clone in which the program has been built. The blocks of the page are taken in order:
#   ```yaml   begins with a line "# NAME" and is written to the file NAME;
#   ```sh     is run, and each of its commands must succeed;
#   ```cpp    has been compiled by the build and is run likewise;
#   ```cmake  must consist of lines of tests/consumer/CMakeLists.txt, which another test builds;
#   ```text and ```bibtex are only read.
# So no snippet can become outdated.
set -euo pipefail

program=$1 source=$2 build=$3 page=$4
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build/release"
ln -s "$source/configs" "$folder/configs"
ln -s "$build/shapes" "$folder/build/release/shapes"
bash "$here/inputs.sh" "$folder"

# The program stands for the launcher, whose commands `test` and `bench` build the whole project.
cat >"$folder/deformlab" <<END
#!/usr/bin/env bash
case \$1 in test | bench) exit 0 ;; esac
exec "$program" "\$@"
END
chmod +x "$folder/deformlab"

# Blocks become files: 001.sh, 002.yaml, and so on.
mkdir "$folder/.blocks"
awk -v folder="$folder/.blocks" '
  /^```[a-z]*$/ && !file { file = sprintf("%s/%03d.%s", folder, ++n, substr($0, 4)); next }
  /^```$/ { close(file); file = ""; next }
  file { print > file }' "$source/$page"

cd "$folder" && shopt -s nullglob
fail() { echo "$page: $*" && exit 1; }
run() {
  echo "== $*"
  "$@" >log 2>&1 || { cat log && fail "a command failed: $*"; }
}
commands=0 programs=0
for block in .blocks/*; do
  case $block in
    *.sh)
      cat "$block"
      run bash -euo pipefail "$block"
      commands=$((commands + 1))
      ;;
    *.cpp)
      programs=$((programs + 1))
      run "$build/tests/docs/programs/docs_${page//[\/.]/_}_$programs"
      ;;
    *.yaml)
      name=$(sed -n '1s/^# \([A-Za-z0-9_.-]*\)$/\1/p' "$block")
      if [[ ! $name ]]; then fail "a yaml block does not begin with '# NAME': $(cat "$block")"; fi
      cp "$block" "$name"
      ;;
    *.cmake)
      if grep -vxFf "$source/tests/consumer/CMakeLists.txt" "$block"; then
        fail "these lines are not in tests/consumer/CMakeLists.txt"
      fi
      ;;
    *.text | *.bibtex) ;;
    *) fail "a block has no language that this test knows: $block" ;;
  esac
done
echo "$page: $commands blocks of commands and $programs programs ran"
