#include "methods/disks/pose.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/predicates.h"

namespace medial::disks {
namespace {

/// A loop's image from its lowest vertex on, with the interior on the left.
class LoopImage {
 public:
  LoopImage(const Shape& shape, const QuarterMap& map, std::uint32_t loop)
      : shape_(&shape), map_(map), loop_(loop), begin_(shape.loop_begin[loop]) {
    size_ = shape.loop_begin[loop + 1] - begin_;
    Vec2 lowest = image(start_);
    for (std::uint32_t i = 1; i < size_; ++i) {
      const Vec2 p = image(i);
      if (lexicographic_less(lowest, p)) continue;
      if (lowest == p && !is_before(*this, i, *this, start_)) continue;
      start_ = i;
      lowest = p;
    }
  }

  std::uint32_t loop() const { return loop_; }
  /// Calls use(point, edge after it), both the shape's, in the image's order.
  template <class Use>
  void for_each(Use&& use) const {
    for (std::uint32_t step = 0, i = start_; step < size_; ++step, i = i + 1 < size_ ? i + 1 : 0)
      use(point(i), edge(i));
  }

  friend bool operator<(const LoopImage& a, const LoopImage& b) {
    return is_before(a, a.start_, b, b.start_);
  }

 private:
  /// The shape's point i of the loop, where the image goes around it, and the edge after it.
  std::uint32_t point(std::uint32_t i) const {
    return begin_ + (map_.mirrors() ? size_ - 1 - i : i);
  }
  std::uint32_t edge(std::uint32_t i) const {
    return map_.mirrors() ? point(i + 1 < size_ ? i + 1 : 0) : point(i);
  }
  Vec2 image(std::uint32_t i) const { return map_.to_image(shape_->points[point(i)]); }

  /// Whether one loop from a point on is before another one, as sequences of points and bulges.
  static bool is_before(const LoopImage& a, std::uint32_t i, const LoopImage& b, std::uint32_t j) {
    for (std::uint32_t step = 0; step < std::min(a.size_, b.size_); ++step) {
      const Vec2 p = a.image(i), q = b.image(j);
      const double s = a.shape_->bulge(a.edge(i)), t = b.shape_->bulge(b.edge(j));
      if (p != q || s != t) return std::tie(p.x, p.y, s) < std::tie(q.x, q.y, t);
      i = i + 1 < a.size_ ? i + 1 : 0;
      j = j + 1 < b.size_ ? j + 1 : 0;
    }
    return a.size_ < b.size_;
  }

  const Shape* shape_;
  QuarterMap map_;
  std::uint32_t loop_, begin_, size_ = 0, start_ = 0;
};

/// The images of all loops in order: by components, each with its outer loop first.
std::vector<LoopImage> loop_images(const Shape& shape, const QuarterMap& map) {
  std::vector<LoopImage> loops;
  for (std::uint32_t i = 0; i < shape.loop_count(); ++i) loops.emplace_back(shape, map, i);
  std::sort(loops.begin(), loops.end());
  std::vector<std::uint32_t> rank(shape.component_count());
  std::uint32_t components = 0;
  for (const LoopImage& loop : loops)
    if (!shape.hole[loop.loop()]) rank[shape.component[loop.loop()]] = components++;
  const auto place = [&](const LoopImage& loop) {
    return std::pair(rank[shape.component[loop.loop()]], shape.hole[loop.loop()] ? 1 : 0);
  };
  std::stable_sort(loops.begin(), loops.end(),
                   [&](const LoopImage& a, const LoopImage& b) { return place(a) < place(b); });
  return loops;
}

bool is_before(const Shape& a, const Shape& b) {
  const auto less = std::lexicographical_compare(a.points.begin(), a.points.end(), b.points.begin(),
                                                 b.points.end(), lexicographic_less);
  return less || (a.points == b.points && a.bulges < b.bulges);
}

}  // namespace

Pose::Pose(const Shape& shape, const QuarterMap& map) : map_(map) {
  const std::size_t count = shape.points.size();
  point_.reserve(count);
  edge_.reserve(count);
  image_.points.reserve(count);
  image_.sources.reserve(count);
  image_.bulges.reserve(count);
  image_.loop_begin.push_back(0);
  for (const LoopImage& loop : loop_images(shape, map)) {
    loop.for_each([&](std::uint32_t point, std::uint32_t edge) {
      point_.push_back(point);
      edge_.push_back(edge);
      image_.points.push_back(map.to_image(shape.points[point]));
      image_.sources.push_back(shape.sources[point]);
      image_.bulges.push_back(shape.bulge(edge));
    });
    image_.loop_begin.push_back(static_cast<std::uint32_t>(image_.points.size()));
    image_.hole.push_back(shape.hole[loop.loop()]);
    if (!image_.hole.back()) component_.push_back(shape.component[loop.loop()]);
    image_.component.push_back(static_cast<std::uint32_t>(component_.size() - 1));
  }
}

Pose::Pose(const Shape& shape) {
  for (const QuarterMap& map : best_maps(shape.points)) {
    Pose next(shape, map);
    if (point_.empty() || is_before(next.image_, image_)) *this = std::move(next);
  }
}

site::SiteNumbers Pose::to_image(const site::SiteNumbers& numbers) const {
  site::SiteNumbers image;
  image.edge.resize(point_.size());
  image.joints.reserve(point_.size());
  for (const std::uint32_t point : point_) image.joints.push_back(numbers.joints[point]);
  site::count_sites(image_, image);
  return image;
}

template <class E>
void Pose::to_input(const Problem& problem, const site::SiteNumbers& numbers, MedialAxis& axis,
                    std::vector<E>& edges) const {
  const site::SiteNumbers& own = problem.numbers();
  std::vector<std::uint32_t> site(numbers.count);
  for (std::size_t loop = 0; loop < image_.loop_count(); ++loop) {
    const std::size_t begin = image_.loop_begin[loop], end = image_.loop_begin[loop + 1];
    for (std::size_t i = begin; i < end; ++i) {
      if (numbers.is_site(i)) site[numbers.edge[i] - 1] = own.edge[point_[i]] - 1;
      if (end - begin > 1) site[numbers.edge[i]] = own.edge[edge_[i]];  // a lone point has none
    }
  }
  for (Node& node : axis.nodes) {
    node.disk.center = map_.to_input(node.disk.center);
    node.component = component_[node.component];
  }
  for (E& edge : edges) {
    edge.control.center = map_.to_input(edge.control.center);
    edge.site = {site[edge.site[0]], site[edge.site[1]]};
    if (map_.mirrors()) std::swap(edge.site[0], edge.site[1]);
  }
  if (!axis.sites.empty()) axis.sites = problem.result_sites();
}

template void Pose::to_input(const Problem&, const site::SiteNumbers&, MedialAxis&,
                             std::vector<Edge>&) const;
template void Pose::to_input(const Problem&, const site::SiteNumbers&, MedialAxis&,
                             std::vector<VoronoiEdge>&) const;

Error Pose::to_input(Error error) const {
  if (error.place.point) error.place.point = map_.to_input(*error.place.point);
  return error;
}

}  // namespace medial::disks
