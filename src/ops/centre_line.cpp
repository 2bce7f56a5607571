// A path along the axis as a line: extended to the boundary, smoothed.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "axis/curve.h"
#include "axis/sites.h"
#include "axis/steps.h"
#include "base/arc.h"
#include "base/arc_box.h"
#include "base/box_tree.h"
#include "base/numbers.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "ops/routes.h"
#include "site/boundary_tree.h"

namespace medial {
namespace {

/// Finds distances to the boundary.
class Boundary {
 public:
  explicit Boundary(const Shape& shape)
      : frame_(frame_of(bounding_box(shape))),
        sites_(site::edge_sites(shape, frame_)),
        tree_(sites_) {}

  double distance_from(Vec2 p) const {
    const auto hit = tree_.nearest(frame_.to_local(p), infinity, 0,
                                   static_cast<std::uint32_t>(sites_.size() - 1));
    return frame_.inverse * std::sqrt(hit.squared_distance);
  }

 private:
  LocalFrame frame_;
  std::vector<site::Site> sites_;
  site::BoundaryTree tree_;
};

/// The distance at which a ray from p in a unit direction first meets a site, beyond `least`.
double hit(const Site& site, Vec2 p, Vec2 direction, double least) {
  const Vec2 chord = site.end - site.start, to = site.start - p;
  double first = infinity;
  if (site.kind() == SiteKind::segment) {
    const double slope = cross(direction, chord);
    const double along = cross(to, chord) / slope, share = cross(to, direction) / slope;
    if (share >= 0 && share <= 1 && along > least) first = along;
    return first;
  }
  if (site.kind() != SiteKind::arc) return first;
  // |p + s direction - centre| = radius, and on the arc's side of its chord.
  const BulgeArc arc{site.start, site.end, site.bulge};
  const double bend = curvature(arc);
  const Vec2 centre = (1 / bend) * left_of(start_tangent(arc)) + to;  // relative to p
  const double middle = dot(centre, direction), beside = cross(direction, centre);
  const double root = std::sqrt(1 / (bend * bend) - beside * beside);
  for (const double s : {middle - root, middle + root}) {
    const Vec2 q = s * direction - to;  // relative to the start
    if (s > least && s < first && cross(chord, q) * site.bulge <= 0) first = s;
  }
  return first;
}

/// The straight edge that continues a line at its last node.
class Extension {
 public:
  explicit Extension(const MedialAxis& axis) : axis_(axis), sites_(boxes_of(axis)) {}

  /// The end of the extension from the line's node, at which the line arrives in direction `ahead`.
  struct End {
    Vec2 point;
    std::uint32_t site;  ///< on which it lies
  };
  std::optional<End> from(const Disk& disk, Vec2 ahead) const {
    constexpr double far = 2;  // radii; farther places are not straight ahead of this end
    constexpr double touching = 1 + 1e-9;
    if (!(disk.radius > axis_.tolerance) || !(norm(ahead) > 0)) return std::nullopt;
    const Vec2 direction = (1 / norm(ahead)) * ahead;
    double straight = infinity, most = -infinity;
    std::uint32_t straight_site = 0;
    std::optional<End> best;
    std::vector<std::uint32_t> near;
    const Vec2 reach = far * touching * disk.radius * Vec2{1, 1};
    sites_.find({disk.center - reach, disk.center + reach},
                [&near](std::uint32_t i) { near.push_back(i); });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t i : near) {
      const double along = hit(axis_.sites[i], disk.center, direction, 0.5 * disk.radius);
      if (along < straight) {
        straight = along;
        straight_site = i;
      }
      const Vec2 q = foot(axis_.sites[i], disk.center);
      const Vec2 d = q - disk.center;
      if (norm(d) > disk.radius * touching || !(dot(d, direction) > most)) continue;
      most = dot(d, direction);
      best = {q, i};
    }
    if (straight <= far * disk.radius)
      return End{disk.center + straight * direction, straight_site};
    return best;
  }

 private:
  static std::vector<Box> boxes_of(const MedialAxis& axis) {
    std::vector<Box> boxes;
    boxes.reserve(axis.sites.size());
    for (const Site& site : axis.sites)
      boxes.push_back(box_around({site.start, site.end, site.bulge}));
    return boxes;
  }

  const MedialAxis& axis_;
  BoxTree sites_;
};

/// The direction in which a line arrives at its last node, from the point one radius before it.
Vec2 ahead_of(const MedialAxis& line, bool at_end) {
  const std::size_t count = line.edges.size();
  const auto edge_at = [&](std::size_t i) -> const Edge& {
    return line.edges[at_end ? count - 1 - i : i];
  };
  const Disk& last = line.nodes[edge_at(0).node[at_end ? 1 : 0]].disk;
  double left = last.radius;
  Vec2 back = last.center;
  for (std::size_t i = 0; i < count; ++i) {
    const Curve curve = curve_of(line, edge_at(i));
    const double all = curve.length();
    back = line.nodes[edge_at(i).node[at_end ? 0 : 1]].disk.center;
    if (all >= left) {
      back = curve.at(curve.at_length(at_end ? all - left : left)).center;
      break;
    }
    left -= all;
  }
  return last.center - back;
}

void extend(const Extension& extension, MedialAxis& line) {
  const std::uint32_t first = line.edges.front().node[0], last = line.edges.back().node[1];
  const auto begin = extension.from(line.nodes[first].disk, ahead_of(line, false));
  const auto end = extension.from(line.nodes[last].disk, ahead_of(line, true));
  const auto add_node = [&](Vec2 p, std::uint32_t neighbour) {
    line.nodes[neighbour].kind = NodeKind::site_change;
    line.nodes.push_back({{p, 0}, line.nodes[neighbour].component, NodeKind::leaf});
    return static_cast<std::uint32_t>(line.nodes.size() - 1);
  };
  if (begin) {
    const std::uint32_t node = add_node(begin->point, first);
    line.edges.insert(line.edges.begin(), straight_edge(line, node, first, begin->site));
  }
  if (end) {
    const std::uint32_t node = add_node(end->point, last);
    line.edges.push_back(straight_edge(line, last, node, end->site));
  }
}

/// Samples of a line. Each step is at most a quarter of the radius, but not shorter than a share of
/// the whole, so that a straight step between two points in the inner halves of their disks stays
/// in one of the disks.
std::vector<Disk> sample_line(const MedialAxis& line) {
  constexpr double steps_a_radius = 4, most_steps = 20000;
  const double shortest = total_length(line) / most_steps;
  std::vector<Disk> samples{line.nodes[line.edges.front().node[0]].disk};
  for (const Edge& edge : line.edges) {
    const Curve curve = curve_of(line, edge);
    const double all = curve.length();
    for (double s = 0; s < all;) {
      s += std::max(samples.back().radius / steps_a_radius, shortest);
      samples.push_back(curve.at(s < all ? curve.at_length(s) : 1));
    }
  }
  return samples;
}

/// A sampled line, for averages along it.
class SampledLine {
 public:
  SampledLine(std::vector<Disk> samples, bool closed)
      : samples_(std::move(samples)), at_(samples_.size(), 0), closed_(closed) {
    for (std::size_t i = 1; i < at_.size(); ++i)
      at_[i] = at_[i - 1] + distance(samples_[i - 1].center, samples_[i].center);
    whole_ = at_.back() + distance(samples_.back().center, samples_.front().center);
  }
  /// The total length.
  double whole() const { return whole_; }
  const std::vector<Disk>& samples() const { return samples_; }

  /// The vector from a sample to the Gaussian mean of the line around it.
  Vec2 to_mean(std::size_t i, double deviation) const {
    constexpr double reach = 3;  // standard deviations
    Vec2 sum;
    double weights = 0;
    const auto add = [&](std::ptrdiff_t k) {
      const Place other = place(k);
      const double before = place(k - 1).at, after = place(k + 1).at;
      const double z = (other.at - at_[i]) / deviation;
      if (!(std::abs(z) <= reach)) return false;
      const double weight = std::exp(-0.5 * z * z) * std::max(after - before, 0.0);
      sum = sum + weight * (other.center - samples_[i].center);
      weights += weight;
      return true;
    };
    const auto n = static_cast<std::ptrdiff_t>(samples_.size());
    const auto here = static_cast<std::ptrdiff_t>(i);
    for (std::ptrdiff_t k = here; deviation > 0 && k > here - n && add(k);) --k;
    for (std::ptrdiff_t k = here + 1; deviation > 0 && k < here + n && add(k);) ++k;
    return weights > 0 ? (1 / weights) * sum : Vec2{};
  }

 private:
  struct Place {
    Vec2 center;
    double at;
  };
  /// Sample k of the line continued around a cycle, or by point reflection in its ends, so that
  /// ends do not move.
  Place place(std::ptrdiff_t k) const {
    const auto n = static_cast<std::ptrdiff_t>(samples_.size());
    if (k >= 0 && k < n)
      return {samples_[static_cast<std::size_t>(k)].center, at_[static_cast<std::size_t>(k)]};
    if (closed_) {
      const auto i = static_cast<std::size_t>((k % n + n) % n);
      return {samples_[i].center, at_[i] + (k < 0 ? -whole_ : whole_)};
    }
    const auto end = static_cast<std::size_t>(k < 0 ? 0 : n - 1);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(k < 0 ? -k : 2 * (n - 1) - k, 0, n - 1));
    return {2 * samples_[end].center - samples_[i].center, 2 * at_[end] - at_[i]};
  }

  std::vector<Disk> samples_;
  std::vector<double> at_;
  bool closed_;
  double whole_ = 0;
};

MedialAxis smoothed(const Boundary& boundary, const MedialAxis& line, double radii, bool closed) {
  std::vector<Disk> disks = sample_line(line);
  if (closed) disks.pop_back();
  const SampledLine sampled(std::move(disks), closed);
  const std::vector<Disk>& samples = sampled.samples();
  const std::size_t count = samples.size();
  double mean_radius = 0;
  for (const Disk& disk : samples) mean_radius += disk.radius / static_cast<double>(count);
  MedialAxis out;
  out.method = line.method;
  out.tolerance = line.tolerance;
  out.resolution = sampled.whole() / static_cast<double>(count);
  const std::uint32_t component = line.nodes.front().component;
  for (std::size_t i = 0; i < count; ++i) {
    const Disk& here = samples[i];
    // In thin places, the line may move less, so it is averaged over a shorter length.
    Vec2 move = sampled.to_mean(i, radii * std::min(mean_radius, 2 * here.radius));
    if (!closed && (i == 0 || i == count - 1)) move = {};
    const double most = 0.5 * here.radius;
    if (norm(move) > most) move = (most / norm(move)) * move;
    const Vec2 center = here.center + move;
    const double radius = move == Vec2{} ? here.radius : boundary.distance_from(center);
    out.nodes.push_back({{center, radius}, component, NodeKind::site_change});
  }
  for (std::uint32_t i = 0; i + 1 < count; ++i) out.edges.push_back(straight_edge(out, i, i + 1));
  if (closed) {
    out.edges.push_back(straight_edge(out, static_cast<std::uint32_t>(count - 1), 0));
  } else {
    out.nodes.front().kind = out.nodes.back().kind = NodeKind::leaf;
  }
  return out;
}

/// Adds a line to others.
void append(MedialAxis& all, const MedialAxis& line) {
  const auto shift = static_cast<std::uint32_t>(all.nodes.size());
  all.nodes.insert(all.nodes.end(), line.nodes.begin(), line.nodes.end());
  for (Edge edge : line.edges) {
    for (std::uint32_t& node : edge.node) node += shift;
    all.edges.push_back(edge);
  }
  all.resolution = std::max(all.resolution, line.resolution);
}

}  // namespace

MedialAxis centre_lines(const Shape& shape, const MedialAxis& axis, std::span<const AxisPath> paths,
                        const CentreLineOptions& options) {
  ops::PartMaker parts(axis);
  std::optional<Extension> extension;
  if (options.extend) extension.emplace(axis);
  std::optional<Boundary> boundary;
  if (options.smooth > 0 && !paths.empty()) boundary.emplace(shape);
  MedialAxis all = parts.part({});
  if (!paths.empty()) all.resolution = 0;
  for (const AxisPath& path : paths) {
    MedialAxis line = parts.part(path.pieces);
    if (!line.edges.empty()) {
      if (extension && !path.closed) extend(*extension, line);
      if (boundary) line = smoothed(*boundary, line, options.smooth, path.closed);
    }
    append(all, line);
  }
  all.sites = axis.sites;
  return all;
}

MedialAxis centre_line(const Shape& shape, const MedialAxis& axis, const AxisPath& path,
                       const CentreLineOptions& options) {
  return centre_lines(shape, axis, {&path, 1}, options);
}

}  // namespace medial
