#pragma once

namespace medial {

/// The largest number of threads that options accept.
constexpr int most_threads = 1024;

/// How many threads a request means: 0 asks for all of the machine, and at most most_threads are
/// given. 1 where the library is built without threads (MEDIAL_THREADS=OFF).
int effective_threads(int requested);

/// For programs whose address space or number of processes is limited: tries out how many threads
/// the system starts, up to effective_threads(requested), and allows the library no more until the
/// program ends. oneTBB would end the process, or never return, where it is refused a thread.
void allow_startable_threads(int requested);

}  // namespace medial
