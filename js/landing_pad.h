#pragma once

// Before every source of the module. Code that catches exceptions passes what it looks for in
// `__wasm_lpad_context`. libunwind has one for each thread; clang 14 takes it for one that all
// threads share, unless a variable of that name is declared already. The linker replaces this one
// by libunwind's.
extern "C" {
struct MedialLandingPad {
  unsigned index;
  const void* table;
  unsigned selector;
};
[[gnu::weak, gnu::used]] __thread MedialLandingPad __wasm_lpad_context = {0, nullptr, 0};
}
