#!/usr/bin/env bash
# Unpacks a Debian package that conflicts with an installed one.
#
#   tools/unpack.sh PACKAGE FOLDER     does nothing if FOLDER is there already
set -euo pipefail
package=$1
folder=$2
[ ! -d "$folder" ] || exit 0

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 755 "$scratch"  # apt drops its privileges to download
fetch() { (cd "$scratch" && apt-get download -qq "$package" 2> log); }
if ! fetch; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  fetch || { cat "$scratch/log" >&2; exit 1; }
fi
mkdir -p "$(dirname "$folder")"
dpkg-deb --extract "$scratch"/*.deb "$scratch/unpacked"
mv "$scratch/unpacked" "$folder"
