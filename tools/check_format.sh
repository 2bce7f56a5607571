#!/usr/bin/env bash
# Fails, naming the places, if a source is not in the house's format (`make format` mends it).
set -euo pipefail
cd "$(dirname "$0")/.."
find include src cli papers tests bench examples -name '*.h' -o -name '*.cpp' | sort |
  xargs clang-format --dry-run -Werror
