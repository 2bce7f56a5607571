#pragma once

// Before every source of the module. Code that catches exceptions passes what it looks for in
// `__wasm_lpad_context`. libunwind has one for each thread; clang 14 alone would take it for one
// that all threads share. It asks whether there is a variable of that name already, so that this
// one, which the linker replaces by libunwind's, tells it.
extern "C" {
struct MedialLandingPad {
  unsigned index;
  const void* table;
  unsigned selector;
};
[[gnu::weak, gnu::used]] __thread MedialLandingPad __wasm_lpad_context = {0, nullptr, 0};
}
