#!/bin/bash
# Builds everything with clang 14, coverage and sanitizers. Lets libFuzzer search for shapes, edits and files that
# end with `internal`, are not verified, or crash, and for edits whose axis differs from that of compute(). Keeps
# the inputs that it finds in TREE/found-NAME.
# usage: tools/fuzz_coverage.sh TREE JOBS SECONDS
cd "$(dirname "$0")/.." || exit 1
tree=$1 jobs=$2 seconds=$3
set -e
CC=clang-14 CXX=clang++-14 cmake --preset asan -B "$tree" -DMEDIAL_UNITY=ON -DMEDIAL_TESTS=OFF -DMEDIAL_FUZZ=ON \
  -DMEDIAL_SANITIZE=fuzzer-no-link,address,undefined > /dev/null
cmake --build "$tree" -j "$jobs" --target medial_fuzz_shapes medial_fuzz_edits medial_fuzz_readers

# A letter for the extension, and a small file.
mkdir -p "$tree/seeds-shapes" "$tree/seeds-edits" "$tree/seeds-readers"
for file in data/*; do
  letter=$(grep -o "{'.', \"\.${file##*.}\"" fuzz/readers.cpp | cut -c3 || true)
  [ -n "$letter" ] && [ "$(stat -c %s "$file")" -lt 30000 ] || continue
  { printf %s "$letter"; cat "$file"; } > "$tree/seeds-readers/$(basename "$file")"
done
status=0
for name in shapes edits readers; do
  mkdir -p "$tree/corpus-$name" "$tree/found-$name"
  "$tree/fuzz/medial_fuzz_$name" -max_total_time="$seconds" -fork="$jobs" -ignore_crashes=1 -ignore_timeouts=1 \
    -timeout=60 -rss_limit_mb=4096 -artifact_prefix="$tree/found-$name/" "$tree/corpus-$name" "$tree/seeds-$name" \
    2> "$tree/$name.log" || true
  count=$(find "$tree/found-$name" -type f | wc -l)
  echo "$name: $(grep -c . < "$tree/$name.log") lines of log, $count inputs found: $tree/found-$name"
  [ "$count" = 0 ] || status=1
done
exit $status
