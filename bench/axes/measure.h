#pragma once

// One measurement, in a child process of its own: its memory is its own, and nothing it does can
// hang or stop the run.

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "inputs.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "peers.h"

namespace medial::bench {

/// Plain values only: this is what a child sends to its parent through a pipe.
struct MedialFigures {
  std::size_t vertices = 0;    ///< of the shape
  double shape_seconds = 0;    ///< build_shape(), processor time
  double seconds = 0;          ///< compute() on one thread, processor time
  double one_thread_wall = 0;  ///< the same by the clock on the wall
  double two_threads_wall = 0;
  double two_copies_wall = 0;  ///< two runs on one thread each, at once: what the machine allows
  double peak_bytes = 0;       ///< of build_shape() and compute(), above the input
  double queries_per_site = 0;
  double precision_retries = 0;
  double largest_residual = 0;  ///< relative to the diagonal
};

struct PeerFigures {
  double seconds = 0;  ///< the median
  double left_out = 0;
};

/// Runs build_shape() and compute() `rounds` times; medians. Nothing where the input is absent, the
/// child died or took longer than `limit` seconds; then `why` says so.
std::optional<MedialFigures> measure_medial(const Input& input, const Method& method, int rounds,
                                            double limit, std::string& why);
std::optional<PeerFigures> measure_peer(const Input& input,
                                        const std::function<PeerRun(std::span<const Ring>)>& peer,
                                        int rounds, double limit, std::string& why);

}  // namespace medial::bench
