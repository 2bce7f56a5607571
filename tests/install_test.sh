#!/usr/bin/env bash
# Installs a build tree into a scratch prefix and uses it as a stranger would: by find_package, by
# pkg-config, by the command line and its manual page.
#
#   tests/install_test.sh TREE
set -euo pipefail
tree=$1
root=$(realpath "$(dirname "$0")/..")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

fail() {
  echo "install_test: $*" >&2
  exit 1
}

cmake --install "$tree" --prefix "$prefix" > "$scratch/log" || { cat "$scratch/log"; exit 1; }

# Every public header, and no other.
diff <(cd "$root/include" && find . -name '*.h' | sort) \
     <(cd "$prefix/include" && find . -type f | sort) || fail "other headers than include/"

# The ten lines of the README, by find_package. Their L has, by hand, with c = 3 sqrt(2) / (1 + sqrt(2)):
# a diagonal of length c sqrt(2) up to the deepest disk, and in each leg an arc of the parabola
# y = (x^2 + 9) / 6 over [0, 3 - c], a line of 3.5 and two diagonals of 1.5 sqrt(2).
expected="9 edges, length 20.5252, deepest disk of radius 1.7574"
cmake -S "$root/examples/consumer" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$prefix" > "$scratch/log" || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" > "$scratch/log" || { cat "$scratch/log"; exit 1; }
printed=$("$scratch/build/consumer")
[ "$printed" = "$expected" ] || fail "the consumer printed '$printed'"

# The core needs no library of formats or pictures.
readelf -d "$scratch/build/consumer" | grep NEEDED > "$scratch/needed"
[ -s "$scratch/needed" ] || fail "readelf printed nothing"
! grep -iE 'gdal|geos|cairo|proj|json|png|libz' "$scratch/needed" || fail "the core links io's libraries"

# medial::io.
"$scratch/build/file_to_picture" "$root/data/plan.wkt" "$scratch/plan.svg"
grep -q '<svg' "$scratch/plan.svg" || fail "file_to_picture drew nothing"

# The same by pkg-config.
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name medial.pc)")
libdir=$(dirname "$PKG_CONFIG_PATH")
for package in medial:main medial-io:file_to_picture; do
  name=${package%%:*}
  source=${package##*:}
  # shellcheck disable=SC2046
  "${CXX:-c++}" -std=c++20 "$root/examples/consumer/$source.cpp" -o "$scratch/$source" \
    $(pkg-config --cflags --libs "$name") -Wl,-rpath,"$libdir"
done
printed=$("$scratch/main")
[ "$printed" = "$expected" ] || fail "the consumer of pkg-config printed '$printed'"
"$scratch/file_to_picture" "$root/data/gear.wkt" "$scratch/gear.svg"
grep -q '<svg' "$scratch/gear.svg" || fail "file_to_picture of pkg-config drew nothing"

# The command line, from where it is installed, and its manual page.
printed=$(cd / && "$prefix/bin/medial" --version)
[ "$printed" = "medial $(pkg-config --modversion medial)" ] || fail "the program is '$printed'"
page=$(find "$prefix" -name medial.1)
[ -n "$page" ] || fail "no manual page"
sed 's/\\-/-/g' "$page" > "$scratch/page"

# The manual page names every command and option that --help-all lists.
for command in "" axis verify info draw; do
  # shellcheck disable=SC2086
  "$prefix/bin/medial" $command --help-all
done | grep -oE '(^|[ ,])--[a-z-]+' | tr -d ' ,' | sort -u | while read -r option; do
  grep -q -e "$option" "$scratch/page" || fail "the manual page lacks $option"
done

# Completion, where the shells look for it.
for script in bash-completion/completions/medial zsh/site-functions/_medial fish/vendor_completions.d/medial.fish; do
  grep -q centreline "$prefix/share/$script" || fail "no completion in $script"
done

echo "installed, found, built and run: $expected"
