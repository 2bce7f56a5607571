#pragma once

// Shared by functions of many features: their rings, their errors, blocks of them.

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "binding.h"

namespace medial::python {

constexpr std::size_t block = 256;  ///< number of features that one thread computes at a time

/// Features as rings of coordinates with offsets, in the format of shapely.to_ragged_array().
struct Features {
  std::span<const Vec2> points;
  std::span<const std::int64_t> ring, polygon, feature;  ///< feature: empty if each polygon is one
  std::span<const double> bulges;  ///< of the edge after each point; empty: straight

  std::size_t count() const { return feature.empty() ? polygon.size() - 1 : feature.size() - 1; }
  std::pair<std::size_t, std::size_t> polygons(std::size_t i) const {
    if (feature.empty()) return {i, i + 1};
    return {static_cast<std::size_t>(feature[i]), static_cast<std::size_t>(feature[i + 1])};
  }
  double weight(std::size_t first, std::size_t last) const {
    const std::size_t from = polygons(first).first, to = polygons(last - 1).second;
    return static_cast<double>(ring[static_cast<std::size_t>(polygon[to])] -
                               ring[static_cast<std::size_t>(polygon[from])]);
  }
  /// The rings of a feature; reuses the memory of `rings`.
  void rings(std::size_t i, std::vector<Ring>& rings) const {
    std::size_t used = 0;
    const auto [from, to] = polygons(i);
    for (std::size_t p = from; p < to; ++p) {
      for (auto r = static_cast<std::size_t>(polygon[p]);
           r < static_cast<std::size_t>(polygon[p + 1]); ++r) {
        if (used == rings.size()) rings.emplace_back();
        Ring& ring_to = rings[used++];
        const auto begin = static_cast<std::size_t>(ring[r]);
        const auto size = static_cast<std::size_t>(ring[r + 1]) - begin;
        const auto part = points.subspan(begin, size);
        ring_to.points.assign(part.begin(), part.end());
        ring_to.bulges.clear();
        if (!bulges.empty() && has_arcs(bulges.subspan(begin, size)))
          ring_to.bulges.assign(&bulges[begin], &bulges[begin] + size);
        ring_to.role =
            static_cast<std::int64_t>(r) == polygon[p] ? RingRole::outer : RingRole::hole;
      }
    }
    rings.resize(used);
  }

 private:
  static bool has_arcs(std::span<const double> some) {
    return std::ranges::any_of(some, [](double bulge) { return bulge != 0; });
  }
};

inline void check_offsets(std::span<const std::int64_t> offsets, std::size_t end) {
  if (offsets.empty() || offsets.front() != 0 || !std::ranges::is_sorted(offsets) ||
      static_cast<std::size_t>(offsets.back()) > end)
    refuse(ErrorCode::malformed,
           "offsets begin with 0 and increase up to the number of what they divide");
}

inline Features features_of(const Coordinates& coordinates, const Values<std::int64_t>& ring,
                            const Values<std::int64_t>& polygon,
                            const std::optional<Values<std::int64_t>>& feature,
                            const std::optional<Values<double>>& bulges) {
  Features all{points_of(coordinates), span_of(ring), span_of(polygon), {}, {}};
  if (bulges) all.bulges = span_of(*bulges);
  if (bulges && all.bulges.size() != all.points.size())
    refuse(ErrorCode::malformed, "bulges go with coordinates");
  check_offsets(all.ring, all.points.size());
  check_offsets(all.polygon, all.ring.size() - 1);
  if (!feature) return all;
  check_offsets(span_of(*feature), all.polygon.size() - 1);
  all.feature = span_of(*feature);
  return all;
}

/// Features, and the errors that occurred.
using FeatureErrors = std::vector<std::pair<std::int64_t, Error>>;

inline nb::list list_of(const FeatureErrors& errors) {
  nb::list list;
  const auto number = [](const auto& value) { return value ? nb::cast(*value) : nb::none(); };
  for (const auto& [feature, error] : errors) {
    nb::object point = nb::none();
    if (error.place.point) point = nb::make_tuple(error.place.point->x, error.place.point->y);
    list.append(nb::make_tuple(error.text, name_of(error.code), feature, number(error.place.ring),
                               number(error.place.vertex), point));
  }
  return list;
}

/// Calls work(first, last, options) for all blocks of features, with the number of threads for the
/// block; in order if there is one thread. Reports the number of finished features.
template <class Work>
void for_each_block(const Features& features, const Options& options, const nb::object& progress,
                    const Work& work) {
  const std::size_t count = features.count(), blocks = (count + block - 1) / block;
  std::vector<double> weights;
  for (std::size_t b = 0; b < blocks; ++b)
    weights.push_back(features.weight(b * block, std::min(count, (b + 1) * block)) + 1);
  const bool reports = !progress.is_none();
  std::optional<nb::python_error> raised;  // by `progress`; ends the work
  std::atomic<bool> failed{false};
  // One thread at a time calls `progress`, also in Python without a lock. The others do not wait:
  // `progress` may compute, too, and a thread of that work may get here.
  std::atomic<std::size_t> unreported{0};
  std::atomic_flag busy;
  const auto report = [&](std::size_t done) -> Status {
    unreported += done;
    while (unreported > 0 && !busy.test_and_set()) {
      if (const std::size_t more = unreported.exchange(0); more > 0 && !failed) {
        const nb::gil_scoped_acquire held;
        try {
          progress(more);
        } catch (const nb::python_error& error) {
          raised.emplace(error);
          failed = true;
        }
      }
      busy.clear();
    }
    return failed ? Status(Error{ErrorCode::cancelled, "progress failed", {}}) : success();
  };
  Status done = run(features.points.size(), [&](const std::atomic<bool>* cancel) {
    const auto one_block = [&](std::size_t b, int threads) -> Status {
      Options own = options;
      own.threads = threads;
      own.cancel = cancel;
      const std::size_t last = std::min(count, (b + 1) * block);
      work(b * block, last, own);
      return reports ? report(last - b * block) : success();
    };
    return for_each_item(weights, options.threads, one_block, cancel);
  });
  if (raised) throw nb::python_error(*raised);
  value_of(std::move(done));
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& part) {
  to.insert(to.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  std::vector<T>().swap(part);
}
inline void append_offsets(std::vector<std::int64_t>& to, const std::vector<std::int64_t>& part) {
  const std::int64_t shift = to.back();
  for (std::size_t i = 1; i < part.size(); ++i) to.push_back(part[i] + shift);
}

}  // namespace medial::python
