// Threads, by emscripten's pthreads without its JavaScript: this file and js/lib/threads.mjs
// replace it. A thread is a worker with an instance of the module on the same memory.

#include "src/base/threads.h"

#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include "binding.h"

#define MEDIAL_FROM_JS(name) extern "C" __attribute__((import_module("medial"), import_name(#name)))

MEDIAL_FROM_JS(can_wait) int medial_can_wait();
/// Returns 0, or an error number.
MEDIAL_FROM_JS(start_thread)
int medial_start_thread(pthread_t thread, void* stack, void* (*begin)(void*), void* given);

// Symbols that emscripten's libraries define and need.
extern "C" {
void _emscripten_thread_init(pthread_t thread, int in_page, int first, int can_wait, int profiled);
void _emscripten_thread_free_data(pthread_t thread);
void __wasm_call_ctors();
void __wasm_init_tls(void* storage);
}

namespace {

/// Makes this instance's thread a thread of emscripten, with variables of its own.
void become(pthread_t thread, bool first, bool can_wait) {
  const bool in_page = !can_wait;
  _emscripten_thread_init(thread, in_page, first, can_wait, 0);
  __wasm_init_tls(std::aligned_alloc(__builtin_wasm_tls_align(), __builtin_wasm_tls_size()));
}

}  // namespace

extern "C" {
void __emscripten_init_main_thread_js(pthread_t thread) {
  become(thread, true, medial_can_wait() != 0);
}
int __pthread_create_js(pthread_t thread, const pthread_attr_t* /*attributes*/,
                        void* (*begin)(void*), void* given) {
  pthread_attr_t attributes;
  void* lowest = nullptr;
  std::size_t size = 0;
  pthread_getattr_np(thread, &attributes);
  pthread_attr_getstack(&attributes, &lowest, &size);
  int error = EAGAIN;  // no memory for its stack
  if (lowest != nullptr)
    error = medial_start_thread(thread, static_cast<char*>(lowest) + size, begin, given);
  if (error != 0) _emscripten_thread_free_data(thread);
  return error;
}
int _emscripten_default_pthread_stack_size() { return 4 << 20; }
int emscripten_num_logical_cores() { return 1; }  // until medial_start_threads()
void emscripten_check_blocking_allowed() {}
void __emscripten_thread_cleanup(pthread_t /*thread*/) {}
void emscripten_unwind_to_js_event_loop() { __builtin_trap(); }
}

namespace medial::js {

/// Call it before all other functions, in the first instance.
MEDIAL_JS void _initialize() { __wasm_call_ctors(); }

/// Call it in a new worker, which has set its instance's stack.
MEDIAL_JS void medial_run_thread(pthread_t thread, void* (*begin)(void*), void* given) {
  become(thread, false, true);
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE,
                         nullptr);  // otherwise it would wake ten times a second
  begin(given);
}

MEDIAL_JS void medial_start_threads(int count) { allow_startable_threads(count); }
MEDIAL_JS int medial_threads() { return effective_threads(0); }

/// For the tests: the number of `count` tasks that catch their own exception by its type; 0 if an
/// exception of another task does not propagate.
MEDIAL_JS int medial_tasks_that_catch(int count) {
  std::atomic<int> right{0};
  parallel_for(static_cast<std::size_t>(count), [&](std::size_t i) {
    try {
      if (i % 2 == 0) throw std::bad_alloc();
      refuse(ErrorCode::internal, std::to_string(i));
    } catch (const Failure& failure) {
      right += failure.error.text == std::to_string(i) ? 1 : 0;
    } catch (const std::bad_alloc&) {
      right += i % 2 == 0 ? 1 : 0;
    }
  });
  try {
    in_parallel([] {}, [] { throw std::out_of_range("of a task"); });
  } catch (const std::out_of_range&) {
    return right;
  }
  return 0;
}

}  // namespace medial::js
