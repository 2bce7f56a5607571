#!/usr/bin/env bash
# Runs the tests of several build trees as one run with one summary.
#
#   tools/test.sh JOBS TREE...
set -euo pipefail
jobs=$1
shift

# ctest reads this file where a build tree would have its own.
together=$(dirname "$(realpath "$1")")/together
mkdir -p "$together"
printf 'subdirs("%s")\n' "$@" > "$together/CTestTestfile.cmake"
exec ctest --test-dir "$together" --output-on-failure --no-tests=error --parallel "$jobs"
