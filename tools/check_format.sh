#!/usr/bin/env bash
# Fails if a source is not formatted, and lists the places (`make format` formats it).
set -euo pipefail
cd "$(dirname "$0")/.."
find include src cli papers tests bench examples -name '*.h' -o -name '*.cpp' | sort |
  xargs clang-format --dry-run -Werror
