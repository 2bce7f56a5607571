#!/usr/bin/env bash
# Runs the tests of the engine and of the certificate under the thread sanitizer.
#
#   tools/tsan.sh TREE JOBS
#
# The sanitizer must see how threads synchronize, so oneTBB is built with it, too, from the source of
# Debian's package. With the installed oneTBB every task looks like a race.
set -euo pipefail
tree=$(mkdir -p "$1" && realpath "$1")
jobs=$2
tbb=$tree/onetbb

if [ ! -e "$tbb/lib" ]; then
  mkdir -p "$tbb/lists/partial" "$tbb/parts"
  sed -E 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' /etc/apt/sources.list.d/debian.sources \
    > "$tbb/parts/source.sources"
  apt=(apt-get -q -o "Dir::Etc::sourceparts=$tbb/parts" -o Dir::Etc::sourcelist=/dev/null
       -o "Dir::State::lists=$tbb/lists")
  (cd "$tbb" && "${apt[@]}" update && "${apt[@]}" source --download-only onetbb &&
   mkdir -p source && tar -xf onetbb_*.orig.tar.* --strip-components=1 -C source)
  cmake -S "$tbb/source" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS=-O1 -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF
  cmake --build "$tbb/build" -j "$jobs" --target tbb
  ln -s "$(dirname "$(find "$tbb/build" -name libtbb.so | head -1)")" "$tbb/lib"
fi

cmake --preset tsan -B "$tree" -DMEDIAL_UNITY=OFF \
  "-DMEDIAL_TEST_FILES=property;verify;compute;query;first_touch;planar_graph"
cmake --build "$tree" -j "$jobs" --target core_tests --target pool_tests
LD_LIBRARY_PATH=$tbb/lib MEDIAL_PROPERTY_COUNT=${MEDIAL_PROPERTY_COUNT:-200} \
  TSAN_OPTIONS=halt_on_error=1 "$tree/tests/core_tests" --gtest_brief=1
TSAN_OPTIONS=halt_on_error=1 "$tree/tests/pool_tests" --gtest_brief=1 --gtest_repeat=20
