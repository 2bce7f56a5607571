#!/usr/bin/env bash
# Builds the documentation as a static site, and runs the notebooks of its gallery.
#
#   tools/docs.sh gallery FOLDER    run the notebooks with the environment's Python: out/docs/gallery
#   tools/docs.sh site FOLDER       the whole site: out/docs
set -euo pipefail
cd "$(dirname "$0")/.."
task=$1 folder=$2
run="$folder/bin/python"
"$run" -m pip install --quiet --disable-pip-version-check mkdocs mkdocs-material mkdocstrings-python nbclient \
  ipykernel ruff
"$run" python/docs/gallery.py out/gallery
[ "$task" = gallery ] && exit 0
"$run" python/docs/pages.py out/gallery out/pages
"$run" -m mkdocs build --quiet --strict --config-file out/pages/mkdocs.yml --site-dir "$PWD/out/docs"
echo "out/docs/index.html"
