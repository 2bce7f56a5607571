#!/usr/bin/env bash
# Prepares the build of the Python package's wheels: zig from PyPI, a compiler that links to an old glibc, and
# the libraries that the wheels contain, built as static libraries from Debian's sources.
#
#   tools/wheel_libraries.sh FOLDER [GLIBC]    FOLDER/toolchain.cmake, FOLDER/prefix; done once
set -euo pipefail
folder=$(realpath -m "$1") glibc=${2:-2.17}
prefix=$folder/prefix
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
[ ! -f "$folder/done-$glibc" ] || exit 0
mkdir -p "$folder/bin" "$folder/source" "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$prefix/include"

# The compiler.
[ -x "$folder/tools/bin/python" ] || "${PYTHON:-python3}" -m venv "$folder/tools"
"$folder/tools/bin/pip" install --quiet --disable-pip-version-check ziglang
zig=$("$folder/tools/bin/python" -c 'import os, ziglang; print(os.path.join(os.path.dirname(ziglang.__file__), "zig"))')
for name in cc c++ ar ranlib; do
  target=
  case $name in c*) target="-target $(uname -m)-linux-gnu.$glibc" ;; esac
  printf '#!/bin/sh\nexec "%s" %s %s "$@"\n' "$zig" "$name" "$target" > "$folder/bin/$name"
  chmod +x "$folder/bin/$name"
done
cat > "$folder/toolchain.cmake" <<TOOLCHAIN
set(CMAKE_C_COMPILER $folder/bin/cc)
set(CMAKE_CXX_COMPILER $folder/bin/c++)
set(CMAKE_AR $folder/bin/ar)
set(CMAKE_RANLIB $folder/bin/ranlib)
set(CMAKE_PREFIX_PATH $prefix)
set(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Debian's Boost uses features that newer standard libraries have removed.
set(CMAKE_CXX_FLAGS_INIT -DBOOST_NO_CXX98_FUNCTION_BASE)
TOOLCHAIN

# Links only these headers into a folder of their own: the headers of the system's glibc would precede zig's.
for headers in boost exboost svgpp fast_float nlohmann; do ln -sfn "/usr/include/$headers" "$prefix/include/$headers"; done
mkdir -p "$prefix/lib/cmake/nlohmann_json"
cat > "$prefix/lib/cmake/nlohmann_json/nlohmann_jsonConfig.cmake" <<CONFIG
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
target_include_directories(nlohmann_json::nlohmann_json INTERFACE $prefix/include)
CONFIG

# Debian's sources of the installed release, without a change to the system's list of sources.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $release main" \
  > "$folder/apt/sources.list"
apt() {
  apt-get -qq -o Dir::Etc::sourcelist="$folder/apt/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::State::lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root "$@"
}
apt update

# Library NAME of the Debian source PACKAGE, with options of CMake.
library() {
  local package=$1
  shift
  [ ! -f "$folder/source/$package.done" ] || return 0
  rm -rf "$folder/source/$package"
  mkdir -p "$folder/source/$package"
  (cd "$folder/source/$package" && apt source --download-only "$package" > /dev/null &&
    tar xf "$(find . -name '*.orig.tar.*' ! -name '*.asc' | head -1)" --strip-components=1)
  # A file that zlib's CMakeLists.txt names, but Debian's package lacks.
  [ "$package" != zlib ] || { mkdir "$folder/source/zlib/win32" && touch "$folder/source/zlib/win32/zlib1.rc"; }
  cmake -S "$folder/source/$package" -B "$folder/source/$package/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
    -DBUILD_SHARED_LIBS=OFF -Wno-dev "$@" > "$folder/source/$package.log"
  cmake --build "$folder/source/$package/build" --target install >> "$folder/source/$package.log"
  touch "$folder/source/$package.done"
}
library zlib -DCMAKE_SHARED_LINKER_FLAGS=-Wl,--undefined-version
library onetbb -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
library fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
library simdjson -DSIMDJSON_DEVELOPER_MODE=OFF
without=
for part in CATALOG DEBUG DOCB FTP HTML HTTP ICONV ICU LEGACY LZMA MODULES PATTERN PROGRAMS PYTHON REGEXPS SCHEMAS \
  SCHEMATRON TESTS VALID XINCLUDE XPATH XPTR ZLIB READER WRITER C14N AUTOMATA MEM_DEBUG RUN_DEBUG; do
  without+=" -DLIBXML2_WITH_$part=OFF"
done
library libxml2 $without
library freetype -DFT_REQUIRE_ZLIB=ON -DFT_DISABLE_BZIP2=ON -DFT_DISABLE_PNG=ON -DFT_DISABLE_HARFBUZZ=ON -DFT_DISABLE_BROTLI=ON
rm -f "$prefix"/lib/*.so*
touch "$folder/done-$glibc"
