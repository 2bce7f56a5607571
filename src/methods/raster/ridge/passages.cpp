#include "methods/raster/ridge/passages.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

namespace medial::ridge {
namespace {

using raster::Pixel;

class Builder {
 public:
  Builder(const EdgeOutline& outline, const LocalGrid& local, const InteriorSets& sets,
          NearestEdges& search, Follower& follower)
      : outline_(outline), local_(local), sets_(sets), search_(search), follower_(follower) {}

  /// Where the nearest edge changes to another place of the boundary along a gate; where it does
  /// not, along the gate and a pixel more on both sides, as far as the shape goes; else its middle.
  Passages::Point point_in(const Necks::Gate& gate);
  /// The medial pixel that stands for interior pixels at a meeting.
  Pixel pixel_at(const std::vector<Pixel>& corners);

 private:
  Vec2 place(const Necks::Gate& gate, double at) const {
    const raster::Grid& grid = local_.grid;
    return grid.origin +
           grid.step * (gate.on_row ? Vec2{at, double(gate.line)} : Vec2{double(gate.line), at});
  }
  bool is_medial(Pixel p) const { return follower_.map().medial.at(p); }

  const EdgeOutline& outline_;
  const LocalGrid& local_;
  const InteriorSets& sets_;
  NearestEdges& search_;
  Follower& follower_;
};

Passages::Point Builder::point_in(const Necks::Gate& gate) {
  constexpr int halvings = 12;  // a gate is a pixel long at most
  struct Probe {
    double at;
    Near near;
  };
  const auto probe = [&](double at, std::uint32_t hint) {
    return Probe{at, search_.nearest(place(gate, at), hint)};
  };
  const auto differ = [&](const Probe& a, const Probe& b) {
    return a.near.edge != b.near.edge &&
           !outline_.are_one({a.near.edge, place(gate, a.at)}, {b.near.edge, place(gate, b.at)},
                             std::max(a.near.distance, b.near.distance));
  };
  Probe low = probe(gate.low, no_edge), high = probe(gate.high, low.near.edge);
  Probe middle = probe(0.5 * (gate.low + gate.high), low.near.edge);
  for (int i = 0; i < halvings && differ(low, high); ++i) {
    middle = probe(0.5 * (low.at + high.at), low.near.edge);
    if (differ(middle, high))
      low = middle;
    else if (differ(low, middle))
      high = middle;
    else
      break;
  }
  return {place(gate, middle.at), middle.near.distance, middle.near.edge,
          middle.near.edge == low.near.edge ? high.near.edge : low.near.edge};
}

Pixel Builder::pixel_at(const std::vector<Pixel>& corners) {
  MedialMap& map = follower_.map();
  for (const Pixel p : corners)
    if (is_medial(p)) {
      map.pin(p);
      return p;
    }
  // The way over interior pixels side by side to the nearest one beside a medial one.
  std::deque<Pixel> queue{corners.front()};
  std::unordered_map<std::uint64_t, Pixel> from{
      {local_.grid.index(corners.front()), corners.front()}};
  Pixel last = corners.front();
  while (!queue.empty()) {
    const Pixel p = queue.front();
    queue.pop_front();
    bool arrived = false;
    for (int direction = 0; direction < 8; direction += 2) {
      const Pixel q = neighbour(p, direction);
      if (!sets_.inside.at(q)) continue;
      arrived = arrived || is_medial(q);
      if (from.try_emplace(local_.grid.index(q), p).second) queue.push_back(q);
    }
    if (!arrived) continue;
    last = p;
    break;
  }
  for (Pixel p = last;; p = from.at(local_.grid.index(p))) {
    map.add(follower_.measured(p));
    if (p == corners.front()) break;
  }
  map.pin(corners.front());
  return corners.front();
}

}  // namespace

Passages pass_necks(const Necks& necks, const EdgeOutline& outline, const LocalGrid& local,
                    const InteriorSets& sets, NearestEdges& search, Follower& follower) {
  Builder builder(outline, local, sets, search, follower);
  Passages passages;
  passages.points.reserve(necks.gates.size());
  for (const Necks::Gate& gate : necks.gates) passages.points.push_back(builder.point_in(gate));
  for (const Necks::Meeting& meeting : necks.meetings) {
    std::vector<Passages::End> ends;
    for (const auto& corners : meeting.corners)
      ends.push_back({Passages::End::none, builder.pixel_at(corners)});
    for (const std::uint32_t gate : meeting.gates) ends.push_back({gate, {}});
    for (std::size_t i = 1; i < ends.size(); ++i) passages.links.push_back({ends[0], ends[i]});
  }
  return passages;
}

}  // namespace medial::ridge
