// Images: thinning, distances, outlines.

#include <bit>
#include <cmath>

#include "binding.h"

namespace medial::python {
namespace {

using Pixels = nb::ndarray<const std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

void check_size(std::size_t rows, std::size_t columns) {
  if (!fits_image(columns, rows))
    refuse(ErrorCode::too_large, "the diagonal of the image is 65,535 pixels or more");
}

Image image_of(const Pixels& pixels) {
  const std::size_t rows = pixels.shape(0), columns = pixels.shape(1);
  check_size(rows, columns);
  Image image(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  for (std::size_t y = 0; y < rows; ++y) {
    const std::uint8_t* const from = pixels.data() + y * columns;
    const auto row = image.row(static_cast<std::uint32_t>(y));
    for (std::size_t x = 0; x < columns; ++x)
      row[x / 64] |= std::uint64_t{from[x] != 0} << (x % 64);
  }
  return image;
}

Array<std::uint8_t, 2> array_of_image(const Image& image) {
  const std::size_t columns = image.width(), rows = image.height();
  const auto [pixels, owner] = owned(std::vector<std::uint8_t>(rows * columns));
  for (std::size_t y = 0; y < rows; ++y) {
    const auto row = image.row(static_cast<std::uint32_t>(y));
    std::uint8_t* const to = pixels.data() + y * columns;
    for (std::size_t x = 0; x < columns; ++x) to[x] = row[x / 64] >> (x % 64) & 1;
  }
  return {pixels.data(), {rows, columns}, owner};
}

Array<std::uint8_t, 2> thinned(const Pixels& pixels, const std::string& family) {
  const auto found = brushfire_from(family);
  if (!found) refuse(ErrorCode::invalid_option, "there is no such family of brushfires");
  auto result = run(pixels.size(), [&](const std::atomic<bool>* cancel) {
    BrushfireOptions options;
    options.family = *found;
    options.cancel = cancel;
    return thin(image_of(pixels), options);
  });
  return array_of_image(value_of(std::move(result)));
}

/// Distances in pixels, or their squares.
Array<double, 2> distances(const Pixels& pixels, bool cracks, bool frame, bool squared,
                           int threads) {
  const DistanceOptions options{cracks ? DistanceTo::cracks : DistanceTo::pixels, frame, threads};
  std::vector<double> values;
  const Status done = run(pixels.size(), [&](const std::atomic<bool>*) -> Status {
    auto map = distance_transform(image_of(pixels), options);
    if (!map) return std::move(map).error();
    values.resize(map->squared.size());
    const double scale = cracks ? 0.5 : 1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double square = scale * scale * static_cast<double>(map->squared[i]);
      values[i] = map->squared[i] == DistanceMap::unbounded
                      ? std::numeric_limits<double>::infinity()
                      : (squared ? square : std::sqrt(square));
    }
    return success();
  });
  value_of(Status(done));
  const auto [all, owner] = owned(std::move(values));
  return {all.data(), {pixels.shape(0), pixels.shape(1)}, owner};
}

/// The outline of the foreground: points, and the first point of each ring.
nb::tuple outline_of(const Pixels& pixels, double neck) {
  const std::vector<Ring> rings =
      value_of(without_lock([&] { return pixel_outline(image_of(pixels), neck); }));
  std::vector<Vec2> points;
  std::vector<std::int64_t> begin{0};
  for (const Ring& ring : rings) {
    points.insert(points.end(), ring.points.begin(), ring.points.end());
    begin.push_back(static_cast<std::int64_t>(points.size()));
  }
  return nb::make_tuple(rows_of<double>(std::move(points)), array_of(std::move(begin)));
}

nb::tuple disk_image(const AxisOf& self, std::uint32_t pixels, bool y_down) {
  const PlacedImage from =
      value_of(without_lock([&] { return rebuild_image(self.axis, pixels, y_down); }));
  const PixelPlacement& t = from.placement;
  const double low = y_down ? t[3] : t[3] + t[5] * from.image.height();
  return nb::make_tuple(array_of_image(from.image), t[1], nb::make_tuple(t[0], low));
}

/// The streams of a code of squares, the number of squares, and the number of pixels that none
/// covers.
nb::tuple packed_image(const Pixels& pixels, std::uint32_t error) {
  SquareReport report;
  const ShapeCode code =
      without_lock([&] { return encode_squares(image_of(pixels), error, &report); });
  return nb::make_tuple(streams_of(code), report.squares, report.missing);
}

}  // namespace

void bind_images(nb::module_& module) {
  module.def("thinned", &thinned);
  module.def("distances", &distances);
  module.def("pixel_outline", &outline_of);
  module.def("smooth_outline", [](const Pixels& pixels, std::array<double, 2> spacing,
                                  std::array<double, 2> origin) {
    auto contours = value_of(without_lock([&] { return smooth_outline(image_of(pixels)); }));
    for (Contour& contour : contours)
      for (Vec2& p : contour.points)
        p = {origin[0] + spacing[0] * p.x, origin[1] + spacing[1] * p.y};
    return contours;
  });
  module.def("topology", [](const Pixels& pixels) {
    const Topology of = without_lock([&] { return topology(image_of(pixels)); });
    return std::pair{of.components, of.holes};
  });
  module.def("disk_image", &disk_image);
  module.def("packed_image", &packed_image);
  module.def("unpacked_image", [](const std::vector<nb::bytes>& streams) {
    return array_of_image(value_of(decode_squares(code_of(streams))));
  });
}

}  // namespace medial::python
