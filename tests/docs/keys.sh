#!/usr/bin/env bash
# keys.sh PROGRAM SOURCE: docs/keys.md is what the program prints about its own keys.
set -euo pipefail

if "$1" help --markdown | diff -u "$2/docs/keys.md" -; then exit 0; fi
echo "docs/keys.md is out of date; make it again: ./deformlab help --markdown >docs/keys.md"
exit 1
