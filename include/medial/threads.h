#pragma once

namespace medial {

constexpr int most_threads = 1024;  ///< the largest number that options accept

/// The number of threads for a request: 0 means all of the machine. 1 in a build without threads.
int effective_threads(int requested);

/// For programs with a limited address space or number of processes: tests how many threads the
/// system can start, up to effective_threads(requested), and limits the library to them until the
/// program ends. If the system refuses a thread, oneTBB ends the process or never returns.
void allow_startable_threads(int requested);

}  // namespace medial
