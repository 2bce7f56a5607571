#include "ops/disk_lines.h"

#include <algorithm>
#include <cmath>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "medial/query.h"
#include "ops/burn.h"

namespace medial::ops {
namespace {

/// A disk of a branch, its position along the branch, and the distance by which dropped branches
/// reach beyond it.
struct Sample {
  Disk disk;
  double along = 0;
  double beyond = 0;
};

class DiskLiner {
 public:
  DiskLiner(const MedialAxis& axis, double prune, double error)
      : axis_(axis),
        prune_(prune),
        error_(error),
        junction_of_(axis.nodes.size(), no_site),
        beyond_(axis.nodes.size(), 0) {}

  DiskGraph run() {
    branches_ = branches(axis_);
    lengths_.reserve(axis_.edges.size());
    for (const Edge& edge : axis_.edges) lengths_.push_back(length(axis_, edge));
    std::vector<Fuse> fuses;
    for (const Branch& branch : branches_) {
      double total = 0;
      for (const Step& step : branch.steps) total += lengths_[step.edge];
      fuses.push_back({{branch.from, branch.to}, total});
    }
    const auto start = burn(axis_, fuses);
    // Dropped branches reach beyond the disk at their base by a distance that must be known before
    // lines are made.
    for (std::size_t i = 0; i < branches_.size(); ++i)
      kept_.push_back(kept_part(branches_[i], fuses[i].length, start[i]));
    chain();
    const std::vector<std::uint32_t> degree = degrees_of(axis_);
    for (std::size_t node = 0; node < degree.size(); ++node)
      if (degree[node] == 0) graph_.junctions.push_back(axis_.nodes[node].disk);
    return std::move(graph_);
  }

 private:
  /// The samples of a branch, by chords within a share of the error.
  std::vector<Sample> samples_of(const Branch& branch) const {
    std::vector<Sample> samples;
    double along = 0;
    for (const Step& step : branch.steps) {
      const Edge& edge = axis_.edges[step.edge];
      std::vector<Disk> disks = sample_by_chord(axis_, edge, sample_share * error_);
      if (!step.forward) std::reverse(disks.begin(), disks.end());
      const double total = lengths_[step.edge];
      if (samples.empty()) samples.push_back({disks[0], 0, 0});
      double way = 0;
      for (std::size_t k = 1; k < disks.size(); ++k) {
        way += distance(disks[k - 1].center, disks[k].center);
        samples.push_back({disks[k], way, 0});
      }
      for (std::size_t k = samples.size() - (disks.size() - 1); k < samples.size(); ++k)
        samples[k].along = along + (way > 0 ? total * (samples[k].along / way) : 0);
      along += total;
    }
    return samples;
  }

  /// The lead over the radius of a fire that starts at the samples' front at `time`. This is the
  /// distance by which the part behind the fire reaches beyond the disk.
  static double ahead(const Sample& s, double time) { return time + s.along - s.disk.radius; }

  static Sample between(const Sample& a, const Sample& b, double t) {
    return {{a.disk.center + t * (b.disk.center - a.disk.center),
             a.disk.radius + t * (b.disk.radius - a.disk.radius)},
            a.along + t * (b.along - a.along),
            0};
  }

  /// The position at which the fire from the front is `prune` ahead. Its lead never decreases.
  double reach(const std::vector<Sample>& samples, double time) const {
    std::size_t i = 0;
    while (i < samples.size() && ahead(samples[i], time) <= prune_) ++i;
    if (i == samples.size()) return samples.back().along;
    if (i == 0) return 0;
    const double low = ahead(samples[i - 1], time), high = ahead(samples[i], time);
    const double t = std::clamp((prune_ - low) / (high - low), 0.0, 1.0);
    return between(samples[i - 1], samples[i], t).along;
  }

  static Sample sample_at(const std::vector<Sample>& samples, double along) {
    const auto after = std::find_if(samples.begin(), samples.end(),
                                    [along](const Sample& s) { return s.along >= along; });
    if (after == samples.begin()) return samples.front();
    if (after == samples.end()) return samples.back();
    const Sample &a = *(after - 1), &b = *after;
    return between(a, b, (along - a.along) / (b.along - a.along));
  }

  static void mirror(std::vector<Sample>& samples) {
    const double total = samples.back().along;
    std::reverse(samples.begin(), samples.end());
    for (Sample& s : samples) s.along = total - s.along;
  }

  /// Drops the samples before a place, which becomes the first one.
  void drop_front(std::vector<Sample>& samples, double along, double time) const {
    if (!(along > 0)) return;
    Sample cut = sample_at(samples, along);
    cut.beyond = std::clamp(ahead(cut, time), 0.0, prune_);
    const auto after = std::find_if(samples.begin(), samples.end(),
                                    [along](const Sample& s) { return s.along > along; });
    samples.erase(samples.begin(), after);
    samples.insert(samples.begin(), cut);
  }

  /// The kept samples of a branch of this length; empty if all of it is dropped. Records the
  /// dropped part at its base.
  std::vector<Sample> kept_part(const Branch& branch, double total,
                                const std::array<double, 2>& start) {
    const bool from = start[0] < not_burnt, to = start[1] < not_burnt;
    const std::uint32_t base = from ? branch.to : branch.from;
    const double beyond = (from ? start[0] : start[1]) + total - axis_.nodes[base].disk.radius;
    const auto drop = [&] {
      beyond_[base] = std::max(beyond_[base], beyond);
      return std::vector<Sample>();
    };
    // Most branches of a rough boundary are dropped: that needs no samples.
    if (from != to && beyond <= prune_) return drop();
    std::vector<Sample> samples = samples_of(branch);
    if (!from && !to) return samples;
    const double front = from ? reach(samples, start[0]) : 0;
    double back = 0;
    if (to) {
      mirror(samples);
      back = reach(samples, start[1]);
      mirror(samples);
    }
    if (front + back >= total) {
      if (!from || !to) return drop();
      // The disk in its middle represents the whole tree.
      const double middle = 0.5 * (start[1] + total - start[0]);
      const double low = std::min(total - back, front), high = std::max(total - back, front);
      Sample only = sample_at(samples, std::clamp(middle, low, high));
      only.along = 0;
      return {only};
    }
    if (to) {
      mirror(samples);
      drop_front(samples, back, start[1]);
      const double shift = samples.front().along;
      for (Sample& s : samples) s.along -= shift;
      mirror(samples);
    }
    if (from) drop_front(samples, front, start[0]);
    return samples;
  }

  /// Joins kept branches at nodes where two remain, and makes lines of the chains.
  void chain() {
    around_.resize(axis_.nodes.size());
    for (std::uint32_t end = 0; end < 2 * kept_.size(); ++end)
      if (!kept_[end / 2].empty() && reaches(end)) around_[node_of(end)].push_back(end);
    done_.assign(kept_.size(), false);
    for (std::uint32_t end = 0; end < 2 * kept_.size(); ++end)
      if (!kept_[end / 2].empty() && !done_[end / 2] && !goes_on(end)) walk(end);
    for (std::uint32_t i = 0; i < kept_.size(); ++i)  // cycles
      if (!kept_[i].empty() && !done_[i]) walk(2 * i);
  }

  /// The ends of branch i are 2 i and 2 i + 1.
  std::uint32_t node_of(std::uint32_t end) const {
    return end % 2 == 0 ? branches_[end / 2].from : branches_[end / 2].to;
  }
  const Disk& disk_of(std::uint32_t end) const {
    return (end % 2 == 0 ? kept_[end / 2].front() : kept_[end / 2].back()).disk;
  }
  /// Whether the kept part of a branch reaches the node at its end.
  bool reaches(std::uint32_t end) const {
    const Disk &node = axis_.nodes[node_of(end)].disk, &disk = disk_of(end);
    return node.center == disk.center && node.radius == disk.radius;
  }
  bool goes_on(std::uint32_t end) const {
    return reaches(end) && around_[node_of(end)].size() == 2;
  }

  /// Makes a line of the chain that starts at an end of a branch.
  void walk(std::uint32_t end) {
    std::vector<Sample> samples;
    const std::uint32_t first = junction_at(end);
    for (;;) {
      const std::vector<Sample>& kept = kept_[end / 2];
      done_[end / 2] = true;
      const std::ptrdiff_t skip = samples.empty() ? 0 : 1;
      if (end % 2 == 0) {
        samples.insert(samples.end(), kept.begin() + skip, kept.end());
      } else {
        samples.insert(samples.end(), kept.rbegin() + skip, kept.rend());
      }
      end ^= 1U;  // where it arrives
      if (reaches(end))
        samples.back().beyond = std::max(samples.back().beyond, beyond_[node_of(end)]);
      if (!goes_on(end)) break;
      const std::vector<std::uint32_t>& ends = around_[node_of(end)];
      const std::uint32_t next = ends[ends[0] == end ? 1 : 0];
      if (done_[next / 2]) break;  // around a cycle
      end = next;
    }
    add_line(first, junction_at(end), samples);
  }

  /// The junction of a node, or a new one at the end of a branch that was cut.
  std::uint32_t junction_at(std::uint32_t end) {
    const auto added = static_cast<std::uint32_t>(graph_.junctions.size());
    if (!reaches(end)) {
      graph_.junctions.push_back(disk_of(end));
      return added;
    }
    std::uint32_t& junction = junction_of_[node_of(end)];
    if (junction == no_site) {
      junction = added;
      graph_.junctions.push_back(axis_.nodes[node_of(end)].disk);
    }
    return junction;
  }

  void add_line(std::uint32_t from, std::uint32_t to, const std::vector<Sample>& samples) {
    if (samples.size() == 1) {  // one disk: a junction without lines, `from`; `to` is the same
      graph_.junctions.resize(
          std::min<std::size_t>(graph_.junctions.size(), from + std::size_t{1}));
      return;
    }
    const auto excess = [&](std::uint32_t i, std::uint32_t first, std::uint32_t last) {
      const Disk &a = samples[first].disk, &b = samples[last].disk, &p = samples[i].disk;
      const Vec2 d = b.center - a.center, v = p.center - a.center;
      const double rise = b.radius - a.radius, size = squared_norm(d) + rise * rise;
      const double t =
          size > 0 ? std::clamp((dot(d, v) + rise * (p.radius - a.radius)) / size, 0.0, 1.0) : 0;
      const double off = norm(v - t * d) + std::abs(p.radius - a.radius - t * rise);
      return off + samples[i].beyond - (1 - sample_share) * error_;
    };
    DiskLine line{from, to, {}};
    const auto n = static_cast<std::uint32_t>(samples.size());
    // A closed line is cut at its farthest disk, so that no part is closed.
    for (const std::uint32_t i : simplified(n, excess)) line.disks.push_back(samples[i].disk);
    graph_.lines.push_back(std::move(line));
  }

  const MedialAxis& axis_;
  double prune_, error_;
  DiskGraph graph_;
  std::vector<double> lengths_;  ///< of edges
  std::vector<Branch> branches_;
  std::vector<std::vector<Sample>> kept_;           ///< of each branch
  std::vector<std::vector<std::uint32_t>> around_;  ///< of each node: the ends that reach it
  std::vector<bool> done_;                          ///< branches in lines
  std::vector<std::uint32_t> junction_of_;
  std::vector<double> beyond_;
};

}  // namespace

DiskGraph disk_lines(const MedialAxis& axis, double prune, double error) {
  return DiskLiner(axis, prune, error).run();
}

}  // namespace medial::ops
