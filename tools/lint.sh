#!/usr/bin/env bash
# clang-tidy over every source that a build tree compiles; a finding fails.
#
#   tools/lint.sh TREE JOBS
set -euo pipefail
tree=$1
jobs=$2
cd "$(dirname "$0")/.."
git ls-files 'src/*.cpp' 'cli/*.cpp' |
  xargs --max-args 1 --max-procs "$jobs" clang-tidy --quiet -p "$tree"
