#!/usr/bin/env bash
# Installs the missing Debian packages of the named groups in tools/packages.txt.
#
#   tools/setup.sh [GROUP...]     without a group: build and test
#
# Works as root or through sudo, asks nothing, and touches the network only if something is missing.
set -euo pipefail
cd "$(dirname "$0")"

groups=("$@")
[ ${#groups[@]} -gt 0 ] || groups=(build test)

wanted=()
for group in "${groups[@]}"; do
  packages=$(awk -v group="$group" '$1 == group { print $2 }' packages.txt)
  [ -n "$packages" ] || { echo "setup: no group '$group' in tools/packages.txt" >&2; exit 2; }
  wanted+=($packages)
done

if ! command -v dpkg-query > /dev/null; then
  echo "setup: this is no Debian; please provide: ${wanted[*]}" >&2
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
  [[ $status == installed* ]] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || {
    echo "setup: missing: ${missing[*]}; install them as root, there is no sudo here" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
