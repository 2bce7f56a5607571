#!/bin/bash
# Reads the sources of the core with compilers that other faces of the library need: clang 14 with its
# libc++, emscripten (32 bits, libc++ 13), and g++ for 32 bits. What is not installed is left out.
# clang reads one source at a time, so that none lacks an include; the others read eight of a folder at
# a time, as cmake/unity.cmake has it.
# usage: tools/check_portable.sh [jobs]
cd "$(dirname "$0")/.." || exit 1
jobs=${1:-$(nproc)}
folder=build/portable
mkdir -p $folder
rm -f $folder/*.cpp
ln -sfn /usr/include/boost $folder/boost  # without the rest of the system's headers
sources=$(find src -name '*.cpp' ! -path 'src/io/*' ! -path 'src/methods/exact/*' ! -name 'threads_tbb.cpp' ! -name 'threads_serial.cpp')
declare -A count
for source in $(sort <<< "$sources"); do
  name=$(dirname "$source" | tr / _)
  echo "#include \"$PWD/$source\"" >> "$folder/${name}_$((count[$name]++ / 8)).cpp"
done
status=0

# check NAME SOURCES COMMAND...: reads the sources with a compiler, if it is there and works.
check() {
  local name=$1 files=$2
  shift 2
  if ! echo '#include <vector>' | "$@" -std=c++20 -fsyntax-only -x c++ - 2> /dev/null; then
    echo "$name: not installed, left out"
  elif xargs -P "$jobs" -n 1 "$@" -std=c++20 -fsyntax-only -Iinclude -Isrc <<< "$files"; then
    echo "$name: reads the core"
  else
    echo "$name: fails"
    status=1
  fi
}

check 'clang++-14 with libc++' "$sources" clang++-14 -stdlib=libc++
check 'em++' "$(ls $folder/*.cpp)" em++ -pthread -isystem $folder
check 'g++ -m32' "$(ls $folder/*.cpp)" g++ -m32
exit $status
