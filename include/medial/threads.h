#pragma once

namespace medial {

constexpr int most_threads = 1024;  ///< that options accept

/// The number of threads for a request: 0 means all of the machine. 1 in a build without threads.
int effective_threads(int requested);

/// For programs whose address space or number of processes is limited: tries how many threads the
/// system starts, up to effective_threads(requested), and limits the library to them until the
/// program ends. oneTBB ends the process, or never returns, where the system refuses a thread.
void allow_startable_threads(int requested);

}  // namespace medial
