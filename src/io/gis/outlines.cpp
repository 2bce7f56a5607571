// From images to features: the outline of a foreground, or of the pixels of each label.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "io/gis/rasters.h"
#include "medial/raster.h"

namespace medial::io {

namespace {

void move_by(std::vector<Vec2>& points, Vec2 offset) {
  for (Vec2& p : points) p = p + offset;
}

/// The outline of an image's foreground, moved by an offset.
Result<Feature> outline_of(const Image& image, Vec2 offset, bool smooth) {
  Feature feature;
  if (smooth) {
    Result<std::vector<Contour>> contours = smooth_outline(image);
    if (!contours) return contours.error();
    feature.contours = std::move(*contours);
    for (Contour& contour : feature.contours) move_by(contour.points, offset);
  } else {
    Result<std::vector<Ring>> rings = pixel_outline(image);
    if (!rings) return rings.error();
    feature.rings = std::move(*rings);
    for (Ring& ring : feature.rings) move_by(ring.points, offset);
  }
  return feature;
}

/// Pixels [begin, end) of a row with one label.
struct Run {
  std::uint32_t label, y, begin, end;
};

/// Row by row from the left; label 0 is background.
std::vector<Run> runs_of(std::span<const std::uint32_t> labels, std::uint32_t width) {
  std::vector<Run> runs;
  const auto height = static_cast<std::uint32_t>(labels.size() / width);
  for (std::uint32_t y = 0; y < height; ++y) {
    const auto row = labels.subspan(std::size_t{y} * width, width);
    for (std::uint32_t x = 0; x < width;) {
      const std::uint32_t begin = x, label = row[x];
      while (x < width && row[x] == label) ++x;
      if (label != 0) runs.push_back({label, y, begin, x});
    }
  }
  return runs;
}

/// The first run of each run's component: pixels of a label that touch, also in a corner.
std::vector<std::uint32_t> components_of(std::span<const Run> runs) {
  std::vector<std::uint32_t> first(runs.size());
  std::iota(first.begin(), first.end(), 0U);
  const auto find = [&first](std::uint32_t i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  std::size_t above = 0;  // the first run that may touch from above
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const auto is_before = [&run](const Run& other) {
      return other.y + 1 < run.y || (other.y + 1 == run.y && other.end < run.begin);
    };
    while (is_before(runs[above])) ++above;
    for (std::size_t k = above; runs[k].y < run.y && runs[k].begin <= run.end; ++k) {
      if (runs[k].label != run.label) continue;
      const std::uint32_t a = find(static_cast<std::uint32_t>(i)),
                          b = find(static_cast<std::uint32_t>(k));
      first[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = find(static_cast<std::uint32_t>(i));
  return first;
}

/// A ring of a label, or its contour, in the order in which pixel_outline() would find it in the
/// whole image: by its highest crack, the leftmost one of these, with which a ring ends.
struct LabelOutline {
  Vec2 begin;
  Ring ring;
  Contour contour;
};

/// Outlines of the component of some runs, in an image of its own.
Status add_component(std::span<const Run> runs, std::span<const std::uint32_t> members, bool smooth,
                     std::vector<LabelOutline>& outlines) {
  std::uint32_t left = std::numeric_limits<std::uint32_t>::max(), right = 0;
  const std::uint32_t top = runs[members.front()].y, bottom = runs[members.back()].y;
  for (const std::uint32_t i : members) {
    left = std::min(left, runs[i].begin);
    right = std::max(right, runs[i].end);
  }
  Image part(right - left, bottom - top + 1);
  for (const std::uint32_t i : members)
    for (std::uint32_t x = runs[i].begin; x < runs[i].end; ++x) part.set(x - left, runs[i].y - top);
  const Vec2 corner{static_cast<double>(left), static_cast<double>(top)};
  auto exact = outline_of(part, corner, false);
  if (!exact) return std::move(exact).error();
  auto curved = smooth ? outline_of(part, corner, true) : Feature{};
  if (!curved) return std::move(curved).error();
  for (std::size_t k = 0; k < exact->rings.size(); ++k) {
    LabelOutline& outline = outlines.emplace_back();
    outline.begin = exact->rings[k].points.back();
    if (smooth)
      outline.contour = std::move(curved->contours[k]);
    else
      outline.ring = std::move(exact->rings[k]);
  }
  return success();
}

/// The feature of one label.
Result<Feature> feature_of(std::span<const Run> runs, std::span<const std::uint32_t> members,
                           std::span<const std::uint32_t> component, bool smooth) {
  std::vector<LabelOutline> outlines;
  for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
    while (end < members.size() && component[members[end]] == component[members[begin]]) ++end;
    Status added = add_component(runs, members.subspan(begin, end - begin), smooth, outlines);
    if (!added) return std::move(added).error();
  }
  std::ranges::sort(outlines, {}, [](const LabelOutline& outline) {
    return std::pair(outline.begin.y, outline.begin.x);
  });
  Feature feature;
  for (LabelOutline& outline : outlines) {
    if (smooth)
      feature.contours.push_back(std::move(outline.contour));
    else
      feature.rings.push_back(std::move(outline.ring));
  }
  const std::uint32_t label = runs[members.front()].label;
  feature.id = label;
  feature.attributes = {{"value", std::to_string(label)}};
  return feature;
}

/// A feature for each label. Takes time for the pixels and for the boxes of connected parts: those
/// of labels may each be the whole image.
Status add_labelled(std::span<const std::uint32_t> labels, std::uint32_t width, bool smooth,
                    std::vector<Feature>& features) {
  const std::vector<Run> runs = runs_of(labels, width);
  const std::vector<std::uint32_t> component = components_of(runs);
  std::vector<std::uint32_t> order(runs.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {},
                    [&](std::uint32_t i) { return std::tuple(runs[i].label, component[i], i); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && runs[order[end]].label == runs[order[begin]].label) ++end;
    auto feature =
        feature_of(runs, std::span(order).subspan(begin, end - begin), component, smooth);
    if (!feature) return std::move(feature).error();
    features.push_back(std::move(*feature));
  }
  return success();
}

}  // namespace

Result<Document<Feature>> outline_document(ImageFile file, std::span<const std::uint32_t> labels,
                                           const ReadOptions& options) {
  const PixelPlacement& t = file.placement;
  Document<Feature> dataset{static_cast<DocumentInfo&&>(file), {}};
  dataset.y_down = !file.placed();
  if (!file.placed()) dataset.unit = Unit::pixel;
  if (!labels.empty()) {
    Status added = add_labelled(labels, file.image.width(), options.smooth_contour, dataset.items);
    if (!added) return std::move(added).error();
  } else {
    auto feature = outline_of(file.image, {0, 0}, options.smooth_contour);
    if (!feature) return std::move(feature).error();
    dataset.items.push_back(std::move(*feature));
  }
  const auto place = [&t](std::vector<Vec2>& points) {
    for (Vec2& p : points) p = {t[0] + p.x * t[1] + p.y * t[2], t[3] + p.x * t[4] + p.y * t[5]};
  };
  if (file.placed())
    for (Feature& feature : dataset.items) {
      for (Contour& contour : feature.contours) place(contour.points);
      for (Ring& ring : feature.rings) place(ring.points);
    }
  const bool square =
      t[1] * t[1] + t[4] * t[4] == t[2] * t[2] + t[5] * t[5] && t[1] * t[2] + t[4] * t[5] == 0;
  if (square && !options.project) dataset.pixel = std::hypot(t[1], t[4]);
  return dataset;
}

}  // namespace medial::io
