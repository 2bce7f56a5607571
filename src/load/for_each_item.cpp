#include <numeric>
#include <optional>

#include "base/in_flight.h"
#include "base/threads.h"
#include "load/left_out.h"
#include "medial/load.h"

namespace medial {

Status for_each_item(std::span<const double> weights, int threads, const ItemWork& work,
                     const std::atomic<bool>* cancel) {
  const std::size_t count = weights.size();
  std::vector<std::optional<Error>> errors(count);
  std::atomic<std::size_t> lowest_error = count;
  const auto run = [&](std::size_t i, int own_threads) {
    if (i > lowest_error.load()) return;
    Status status = cancel != nullptr && cancel->load()
                        ? Status(Error{ErrorCode::cancelled, "cancelled", {}})
                        : work(i, own_threads);
    if (status) return;
    errors[i] = std::move(status).error();
    errors[i]->place.feature = i;
    std::size_t seen = lowest_error.load();
    while (i < seen && !lowest_error.compare_exchange_weak(seen, i)) {
    }
  };

  const auto run_all = [&] {
    // An item is large if, on one thread, it would outlast all the others shared among the threads.
    const int available = effective_threads(threads);
    const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / available;
    std::vector<std::size_t> small;
    for (std::size_t i = 0; i < count; ++i) {
      if (available > 1 && weights[i] >= share) {
        run(i, available);
      } else {
        small.push_back(i);
      }
    }
    parallel_for(small.size(), [&](std::size_t k) { run(small[k], 1); });
  };
  try {
    on_threads(threads, run_all);
  } catch (...) {
    return error_in_flight();
  }
  if (lowest_error.load() == count) return success();
  return std::move(*errors[lowest_error.load()]);
}

bool leave_out_feature(const Error& error, std::vector<std::string>* left_out) {
  using enum ErrorCode;
  if (left_out == nullptr || error.code == cancelled || error.code == out_of_memory ||
      error.code == invalid_option || error.code == internal)
    return false;
  left_out->push_back(note_of_left_out(error));
  return true;
}

Result<std::vector<std::size_t>> for_each_feature(const DocumentInfo& file,
                                                  std::span<const double> weights, int threads,
                                                  const ItemWork& work,
                                                  std::vector<std::string>* left_out,
                                                  const std::atomic<bool>* cancel) {
  std::vector<std::vector<std::string>> notes(weights.size());
  const auto attempt = [&](std::size_t i, int own_threads) -> Status {
    Status done = work(i, own_threads);
    if (done) return done;
    done.error().place.feature = file.index_of(i);
    return leave_out_feature(done.error(), left_out ? &notes[i] : nullptr) ? success() : done;
  };
  if (Status done = for_each_item(weights, threads, attempt, cancel); !done) {
    if (auto& feature = done.error().place.feature)
      feature = file.index_of(static_cast<std::size_t>(*feature));
    return std::move(done).error();
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < notes.size(); ++i)
    if (notes[i].empty())
      kept.push_back(i);
    else
      left_out->push_back(std::move(notes[i].front()));
  return kept;
}

}  // namespace medial
