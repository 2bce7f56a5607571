#!/bin/bash
# Parses the sources of the core with the compilers of other builds: clang 14 with its libc++, emscripten
# (32 bits, libc++ 13), and g++ for 32 bits. Skips compilers that are not installed. clang reads each source
# alone, which finds missing includes; the others read eight sources of a folder at a time, like unity builds
# (cmake/unity.cmake).
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

# check NAME SOURCES COMMAND...: parses the sources with a compiler, if it is installed and works.
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
