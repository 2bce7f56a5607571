#!/usr/bin/env bash
# The package for JavaScript (js/) and the studio (web/), by Debian's emscripten.
#
#   tools/wasm.sh build TREE         compile the module; TREE/package is the package, TREE/studio the page
#   tools/wasm.sh serve TREE [PORT]  serve the page on 127.0.0.1
#   tools/wasm.sh test TREE          run the tests in Node and, where it is installed, in Chromium
#   tools/wasm.sh frames TREE        count frames while a vertex is dragged, in Chromium
#
# `build` and `test` exit with status 77, which counts as skipped, if emscripten is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
task=$1 tree=$2
npm="$tree/npm"

# em++ for CMake. Boost's headers are linked into a folder of their own: the system's other headers
# would shadow emscripten's.
configure() {
  mkdir -p "$tree/headers"
  ln -sfn /usr/include/boost "$tree/headers/boost"
  cmake -G Ninja -B "$tree" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG" \
    -DCMAKE_TOOLCHAIN_FILE=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake \
    -DBoost_NO_BOOST_CMAKE=ON -DBoost_INCLUDE_DIR="$(realpath -s "$tree")/headers" \
    -DMEDIAL_THREADS=ON -DMEDIAL_TBB=OFF -DMEDIAL_GMP=OFF -DMEDIAL_IO=OFF -DMEDIAL_TESTS=OFF -DMEDIAL_JS=ON \
    -DMEDIAL_UNITY="${UNITY:-ON}" > /dev/null
}

# The npm packages for the studio and the tests; both work without them if they are not available.
packages() {
  command -v npm > /dev/null || return 1
  mkdir -p "$npm"
  cmp -s web/package.json "$npm/package.json" && [ -d "$npm/node_modules" ] && return
  cp web/package.json "$npm/"
  npm install --prefix "$npm" --no-audit --no-fund --silent || { rm "$npm/package.json"; return 1; }
}

# The module imports memory that threads share; as files its parts import memory of one thread, which every
# browser has. js/lib/threads.mjs changes that where it can.
for_one_thread() {
  node --input-type=module - "$@" << 'END'
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
const [, , lib, ...paths] = process.argv;
const { with_memory } = await import(pathToFileURL(`${lib}/threads.mjs`));
for (const path of paths) writeFileSync(path, with_memory(readFileSync(path), false));
END
}

# Divides the module into the functions that js/profile.mjs calls, which a page loads first, and the rest.
divide() {
  cp "$1" "$2/medial.wasm"
  command -v wasm-split > /dev/null || { for_one_thread "$2" "$2/medial.wasm"; return; }
  wasm-split --instrument --all-features "$1" -o "$tree/instrumented.wasm"
  node "$tree/package/profile.mjs" "$tree/instrumented.wasm" "$tree/profile" data
  wasm-split --all-features "$1" --profile="$tree/profile" --export-prefix=% -o1 "$2/medial.wasm" -o2 "$2/medial-rest.wasm"
  for_one_thread "$2" "$2/medial.wasm" "$2/medial-rest.wasm"
  rm "$tree/instrumented.wasm" "$tree/profile" "$tree/package/profile.mjs"
}

build() {
  if ! command -v em++ > /dev/null; then
    echo "web: emscripten is not installed; what needs it is skipped"
    return 77
  fi
  # Where Debian keeps the packages of Node that emscripten itself needs.
  export NODE_PATH=/usr/share/nodejs
  command -v ccache > /dev/null && export EM_COMPILER_WRAPPER=ccache
  configure
  cmake --build "$tree" -j "${JOBS:-$(nproc)}" --target medial_js
  rm -rf "$tree/package"
  mkdir "$tree/package"
  cp -r js/*.mjs js/*.d.ts js/lib js/package.json js/README.md LICENSE "$tree/package/"
  divide "$tree/js/medial.wasm" "$tree/package/lib"
  if [ ! -f web/build.mjs ]; then return; fi
  if packages; then
    node web/build.mjs "$tree"
  else
    echo "web: npm's packages cannot be had; the studio is not built"
  fi
}

run_tests() {
  if [ ! -f "$tree/package/lib/medial.wasm" ]; then
    echo "web: skipped, $(cat js/test/*.test.mjs web/test/*.test.mjs | grep -c '^ *test(') tests: emscripten is not installed"
    exit 77
  fi
  rm -rf "$tree/package/test"
  cp -r js/test "$tree/package/test"
  MEDIAL_DATA=$PWD/data node --test "$tree"/package/test/
  rm -r "$tree/package/test"
  if [ -x "$npm/node_modules/.bin/tsc" ]; then
    "$npm/node_modules/.bin/tsc" --noEmit --strict --target es2022 --module nodenext \
      --moduleResolution nodenext js/*.d.ts js/types/*.mts
  else
    echo "web: the types are not checked: npm's packages cannot be had"
  fi
  if [ -f "$tree/studio/index.html" ] && command -v chromium > /dev/null; then
    MEDIAL_STUDIO=$(realpath "$tree/studio") MEDIAL_NPM=$(realpath "$npm") node --test web/test/
  elif [ -d web/test ]; then
    echo "web: $(grep -c '^test(' web/test/*.test.mjs) tests of the studio are skipped: they need npm and chromium"
  fi
}

case $task in
  build) build ;;
  serve) exec tools/serve.py "$tree/studio" "${3:-8000}" ;;
  test) run_tests ;;
  frames) exec node web/bench/frames.mjs "$tree" ;;
esac
