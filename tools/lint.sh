#!/usr/bin/env bash
# clang-tidy over all sources of the libraries, the command line and papers/; a finding fails.
#
#   tools/lint.sh TREE JOBS
#
# Reads the sources of a unity build, which reads each folder's headers only a few times: it takes
# minutes instead of hours.
set -euo pipefail
tree=$1
jobs=$2
cd "$(dirname "$0")/.."
cmake --preset debug -B "$tree" -DMEDIAL_UNITY=ON > "$tree.log" || { cat "$tree.log"; exit 1; }
python3 -c '
import json, sys
for file in sorted({entry["file"] for entry in json.load(open(sys.argv[1]))}): print(file)
' "$tree/compile_commands.json" | grep -v /tests/ |
  xargs --max-args 1 --max-procs "$jobs" \
    clang-tidy --quiet --checks=-bugprone-suspicious-include -p "$tree" \
      --extra-arg=-Wno-unknown-warning-option \
    2> >(grep --invert-match 'warnings generated' >&2)
