#include "shape/winding.h"

#include <algorithm>
#include <vector>

#include "base/predicates.h"

namespace medial {
namespace {

/// The state of a face: twice its winding number, plus one if it is inside by the even-odd rule of
/// the other rings.
using FaceState = std::int32_t;

bool is_interior(FaceState state) { return (state >> 1 != 0) != ((state & 1) != 0); }

/// Propagates face states over the arrangement from each edge to the edges at its ends.
class Winder {
 public:
  Winder(std::span<const Ring> rings, Arrangement& arrangement) : arrangement_(arrangement) {
    const std::size_t count = arrangement.points.size();
    left_.resize(count);
    right_.resize(count);
    known_.resize(count);
    winding_.resize(count);
    place_.assign(count, no_index);
    for (std::uint32_t ring = 0; ring < rings.size(); ++ring) {
      if (rings[ring].role != RingRole::winding) continue;
      for (std::uint32_t e = arrangement.begin[ring]; e < arrangement.begin[ring + 1]; ++e) {
        winding_[e] = true;
      }
    }
    previous_.resize(count);
    for (std::uint32_t e = 0; e < count; ++e) previous_[arrangement.next[e]] = e;
    place_begin_.resize(arrangement.place_count + std::size_t{1});
    for (const Touch& touch : arrangement.touches) {
      place_[touch.vertex] = touch.place;
      ++place_begin_[touch.place + 1];
    }
    for (std::size_t i = 1; i < place_begin_.size(); ++i) place_begin_[i] += place_begin_[i - 1];
  }

  std::uint64_t run() {
    for (const LeftEnd& end : arrangement_.left_ends) {
      if (known_[end.vertex]) continue;
      // No edge is to the left of this vertex, so the face below its lowest ray is the one above
      // the edge below.
      go_around(end.vertex, 0, end.below == no_index ? 0 : above(end.below));
      spread();
    }
    drop();
    return count_dropped_rings();
  }

 private:
  FaceState above(std::uint32_t edge) const {
    const bool rightward =
        lexicographic_less(arrangement_.points[edge], arrangement_.points[arrangement_.next[edge]]);
    return rightward ? left_[edge] : right_[edge];
  }

  /// The rays around a vertex, counter-clockwise from below.
  void collect(std::uint32_t vertex) {
    const Touch alone{no_index, vertex};
    std::span<const Touch> touches(&alone, 1);
    if (place_[vertex] != no_index) {
      const std::uint32_t first = place_begin_[place_[vertex]];
      touches =
          std::span(arrangement_.touches).subspan(first, place_begin_[place_[vertex] + 1] - first);
    }
    rays_around(arrangement_, touches, rays_);
  }

  /// Sets the states around a vertex, given the state clockwise of ray number `first`.
  void go_around(std::uint32_t vertex, std::size_t first, FaceState state) {
    collect(vertex);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Ray& ray = rays_[(first + i) % rays_.size()];
      const std::uint32_t e = ray.edge;
      FaceState after = state ^ 1;
      if (winding_[e]) after = ray.from_start ? state + 2 : state - 2;
      if (!known_[e]) {
        known_[e] = true;
        left_[e] = ray.from_start ? after : state;
        right_[e] = ray.from_start ? state : after;
        waiting_.push_back(e);
      }
      state = after;
    }
  }

  void spread() {
    while (!waiting_.empty()) {
      const std::uint32_t edge = waiting_.back();
      waiting_.pop_back();
      for (const bool at_start : {true, false}) {
        const std::uint32_t vertex = at_start ? edge : arrangement_.next[edge];
        if (place_[vertex] == no_index) {
          // The common case: only one other edge.
          const std::uint32_t other = at_start ? previous_[vertex] : vertex;
          if (known_[other]) continue;
          known_[other] = true;
          left_[other] = left_[edge];
          right_[other] = right_[edge];
          waiting_.push_back(other);
          continue;
        }
        if (place_done_.empty()) place_done_.resize(arrangement_.place_count);
        if (place_done_[place_[vertex]]) continue;
        place_done_[place_[vertex]] = true;
        collect(vertex);
        const auto here = std::find_if(rays_.begin(), rays_.end(), [&](const Ray& ray) {
          return ray.edge == edge && ray.from_start == at_start;
        });
        go_around(vertex, static_cast<std::size_t>(here - rays_.begin()),
                  at_start ? right_[edge] : left_[edge]);
      }
    }
  }

  /// Drops the edges inside, and finds for each an edge that stays and borders the same face.
  void drop() {
    const auto count = static_cast<std::uint32_t>(left_.size());
    bool any = false;
    std::vector<bool> dropped(count);
    for (std::uint32_t e = 0; e < count; ++e) {
      arrangement_.interior_left[e] = is_interior(left_[e]);
      dropped[e] = is_interior(left_[e]) == is_interior(right_[e]);
      any = any || dropped[e];
    }
    if (!any) return;
    arrangement_.dropped = std::move(dropped);
    std::vector<std::uint32_t>& stands = arrangement_.stands_for;
    stands.assign(count, no_index);
    std::vector<std::uint32_t> group;
    std::vector<bool> seen(count);
    for (const LeftEnd& end : arrangement_.left_ends) {
      for (const std::uint32_t first : {end.vertex, previous_[end.vertex]}) {
        if (!arrangement_.dropped[first] || seen[first]) continue;
        fill(first, end.below, seen, group);
      }
    }
    // Dropped edges without a left end depend on others.
    for (std::uint32_t e = 0; e < count; ++e) {
      if (arrangement_.dropped[e] && !seen[e]) fill(e, no_index, seen, group);
    }
  }

  /// Collects the dropped edges in one face, beginning with `first`, and sets their `stands_for` to
  /// a kept edge of the face; if there is none, to that of the edge below them.
  void fill(std::uint32_t first, std::uint32_t below, std::vector<bool>& seen,
            std::vector<std::uint32_t>& group) {
    group.assign(1, first);
    seen[first] = true;
    std::uint32_t kept = no_index;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::uint32_t edge = group[i];
      for (const bool at_start : {true, false}) {
        const std::uint32_t vertex = at_start ? edge : arrangement_.next[edge];
        if (place_[vertex] == no_index) {
          // Nothing touches here: the other edge of the ring lies between the same faces.
          const std::uint32_t other = at_start ? previous_[vertex] : vertex;
          if (seen[other]) continue;
          seen[other] = true;
          group.push_back(other);
          continue;
        }
        collect(vertex);
        const auto here = std::find_if(rays_.begin(), rays_.end(), [&](const Ray& ray) {
          return ray.edge == edge && ray.from_start == at_start;
        });
        const std::size_t start = static_cast<std::size_t>(here - rays_.begin());
        // Go counter-clockwise to the next kept edge.
        for (std::size_t k = 1; k < rays_.size(); ++k) {
          const std::uint32_t other = rays_[(start + k) % rays_.size()].edge;
          if (!arrangement_.dropped[other]) {
            kept = other;
            break;
          }
          if (!seen[other]) {
            seen[other] = true;
            group.push_back(other);
          }
        }
      }
    }
    if (kept == no_index && below != no_index) {
      kept = arrangement_.dropped[below] ? arrangement_.stands_for[below] : below;
    }
    for (const std::uint32_t edge : group) arrangement_.stands_for[edge] = kept;
  }

  std::uint64_t count_dropped_rings() const {
    if (arrangement_.dropped.empty()) return 0;
    std::uint64_t rings = 0;
    for (std::size_t ring = 0; ring + 1 < arrangement_.begin.size(); ++ring) {
      bool all = true;
      for (std::uint32_t e = arrangement_.begin[ring]; e < arrangement_.begin[ring + 1]; ++e) {
        all = all && arrangement_.dropped[e];
      }
      rings += all ? 1 : 0;
    }
    return rings;
  }

  Arrangement& arrangement_;
  std::vector<FaceState> left_;
  std::vector<FaceState> right_;
  std::vector<bool> known_;
  std::vector<bool> winding_;  ///< of each edge: its ring has the role
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> place_;  ///< of each vertex; no_index: nothing touches there
  std::vector<std::uint32_t> place_begin_;
  std::vector<bool> place_done_;
  std::vector<std::uint32_t> waiting_;
  std::vector<Ray> rays_;
};

}  // namespace

std::uint64_t apply_winding(std::span<const Ring> rings, Arrangement& arrangement) {
  const bool any = std::any_of(rings.begin(), rings.end(),
                               [](const Ring& ring) { return ring.role == RingRole::winding; });
  return any ? Winder(rings, arrangement).run() : 0;
}

}  // namespace medial
