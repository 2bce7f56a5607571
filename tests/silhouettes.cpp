// Silhouettes through every method and verify, as long as one likes.
//
//   medial_silhouettes [--from SEED] [--count N] [--pixels MOST] [--method NAME] [--table FILE]
//                      [IMAGE ...]
//
// Each seed is one silhouette(), or one of the images redrawn(), as the pixels' outline and as a
// smooth one. Each axis must be verified; `potential` alone goes three orders. By `curve-axis`, the
// fit of the outline is followed. `lee`, `biarc-dc` and `curve-axis` may refuse a shape as
// unsupported or too large; a refusal by `curve-axis` must name a fit, which must be followed.
// Where the grid of `ridge` or `brushfire` is too coarse, the number of pixels that the note names
// must do. One line for each failure, then a table of methods, also to a file, and how often each
// reason was given for a refusal. --method: one method alone. Exit status: 0; 1 where something
// failed; 2 for a wrong call.

#include "support/silhouettes.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "curve/fit.h"
#include "medial/io/read.h"
#include "medial/medial.h"
#include "methods/curve_axis/curve_axis.h"
#include "methods/raster/finer_grid.h"

namespace medial::test {
namespace {

struct Tally {
  int axes = 0, refused = 0, failed = 0;
  int unresolved = 0;  ///< parts or holes are too fine for the grid of pixels, as the axis says
  int named = 0;       ///< refusals that name a fit, and notes a number of pixels, that would do
  int misnamed = 0;    ///< of these, fits that are refused as well
  double all = 0, slowest = 0;  ///< seconds
  std::uint64_t slowest_seed = 0;
  std::map<std::string, int> reasons;  ///< of refusals

  /// Whether this is how a method may refuse a shape that it does not take.
  bool refuse(const Error& error) {
    ++refused;
    ++reasons[error.text.substr(0, error.text.find(';'))];  // before the fit that would do
    return error.code == ErrorCode::unsupported || error.code == ErrorCode::too_large;
  }
  void took(double seconds, std::uint64_t seed) {
    all += seconds;
    if (seconds > slowest) slowest = seconds, slowest_seed = seed;
  }
};
std::map<std::string, Tally> tallies;

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Whether the number of pixels that would do is named, and does.
bool count_named_pixels(Tally& tally, const Shape& shape, Method method, const MedialAxis& axis) {
  ++tally.unresolved;
  const std::uint32_t pixels = raster::pixels_that_do(shape, axis.method, axis.resolution);
  if (pixels == 0) return false;
  ++tally.named;
  std::visit(
      [&](auto& own) {
        if constexpr (requires { own.grid; }) own.grid = {.pixels = pixels};
      },
      method);
  const auto finer = compute(shape, {.method = method});
  if (finer && verify(shape, *finer).passed) return true;
  ++tally.misnamed;
  return false;
}

/// Counts and reports one axis; whether it is as it must be.
bool judge(const std::string& name, std::uint64_t seed, const Shape& shape, const Method& method) {
  const auto began = std::clock();
  const auto axis = compute(shape, {.method = method});
  Tally& tally = tallies[name];
  tally.took(seconds_since(began), seed);
  const std::string_view plain = name_of(method);
  std::string reason;
  if (!axis) {
    if (tally.refuse(axis.error()) && (plain == "lee" || plain == "biarc-dc")) return true;
    reason = axis.error().text;
  } else {
    const Certificate certificate = verify(shape, *axis);
    if (certificate.passed) return ++tally.axes, true;
    if (is_of_pixels(plain) && certificate.unresolved == certificate.failures.size() &&
        count_named_pixels(tally, shape, method, *axis))
      return true;
    reason = certificate.failures.front();
  }
  ++tally.failed;
  std::printf("silhouette %llu %s: %s\n", static_cast<unsigned long long>(seed), name.c_str(),
              reason.c_str());
  return false;
}

/// By every method that takes shapes, or by the one of this name.
bool try_shape(const std::string& outline, std::uint64_t seed, const Shape& shape,
               const std::string& only) {
  bool good = true;
  for (const MethodInfo& info : methods()) {
    const std::string name = info.name;
    if (name == "curve-axis" || (!only.empty() && name != only)) continue;
    if (name != "potential") {
      good = judge(name + ", " + outline, seed, shape, *method_from(name)) && good;
      continue;
    }
    for (const int order : {0, 1, 8}) {
      if (order > 0 && only.empty()) break;  // low orders take long
      good = judge(name + (order == 0 ? "" : ", order " + std::to_string(order)) + ", " + outline,
                   seed, shape, method::Potential{.order = static_cast<double>(order)}) &&
             good;
    }
  }
  return good;
}

/// The shape within splines that outlines become. Nothing where one has too few points, or where
/// too coarse a fit crosses itself.
Result<Shape> shape_within(const std::vector<Contour>& contours, double within) {
  std::vector<std::vector<Vec2>> polygons;
  for (const Contour& contour : contours) polygons.push_back(contour.points);
  const auto curves = curve::fit_loops(polygons, within);
  if (!curves) return curves.error();
  const auto arcs = approximate_by_arcs(*curves, {.tolerance = 1e-6});
  return arcs ? build_shape(*arcs) : Result<Shape>(arcs.error());
}

/// Whether a refusal names a fit that is followed and verified; counts it.
bool count_named_fit(Tally& tally, const std::string& text, const std::vector<Contour>& contours) {
  const std::string option = "; --fit ";
  const auto at = text.find(option);
  if (at == std::string::npos) return false;
  ++tally.named;
  const double within = std::strtod(text.c_str() + at + option.size(), nullptr);
  const auto shape = shape_within(contours, within);
  const auto found = compute_curve_axis(contours, {.fit = within});
  if (shape && found && verify(*shape, found->axis).passed) return true;
  ++tally.misnamed;
  return false;
}

/// Outlines, with their holes, as splines within a share of their size.
bool try_fit(std::uint64_t seed, const std::vector<Ring>& rings, double share) {
  const Box box = bounding_box(*build_shape(rings));
  const double within = share * distance(box.low, box.high);
  std::vector<Contour> contours;
  for (const Ring& ring : rings) contours.push_back(contour_of(ring.points, {}, true));
  const auto shape = shape_within(contours, within);
  char name[40];
  std::snprintf(name, sizeof name, "curve-axis, fit %.3f", share);
  const auto began = std::clock();
  const auto found = compute_curve_axis(contours, {.fit = within});
  Tally& tally = tallies[name];
  tally.took(seconds_since(began), seed);
  std::string reason;
  if (!found || !shape) {
    const bool may = !found && tally.refuse(found.error());
    if (may && count_named_fit(tally, found.error().text, contours)) return true;
    reason = found ? "followed, though the fit makes no shape" : found.error().text;
  } else {
    const Certificate certificate = verify(*shape, found->axis);
    if (certificate.passed) {
      ++tally.axes;
      return true;
    }
    reason = certificate.failures.front();
  }
  ++tally.failed;
  std::printf("silhouette %llu %s: %s\n", static_cast<unsigned long long>(seed), name,
              reason.c_str());
  return false;
}

/// By all methods, or by the one of this name.
bool try_image(std::uint64_t seed, const Image& image, const std::string& only) {
  bool good = true;
  if (image.count() == 0) return true;
  const auto rings = pixel_outline(image);
  const auto contours = smooth_outline(image);
  if (!rings || !contours) return false;
  if (only.empty() || only == "curve-axis")
    for (const double share : {0.003, 0.006, 0.012, 0.025})
      good = try_fit(seed, *rings, share) && good;
  if (only == "curve-axis") return good;
  if (const auto shape = build_shape(*rings))
    good = try_shape("pixels", seed, *shape, only) && good;
  const auto arcs = approximate_by_arcs(*contours, {.tolerance = 1e-4});
  if (!arcs) return false;
  if (const auto shape = build_shape(*arcs)) good = try_shape("smooth", seed, *shape, only) && good;
  return good;
}

std::string table() {
  std::string text =
      "| method | verified | refused | grid too coarse | wrong | fits or pixels named, and "
      "followed "
      "| s in all | the slowest | its seed |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const auto& [name, tally] : tallies) {
    std::array<char, 40> fits{};
    std::array<char, 400> line{};
    if (tally.named > 0 || (name.starts_with("curve-axis") && tally.refused > 0))
      std::snprintf(fits.data(), fits.size(), "%d, %d", tally.named, tally.named - tally.misnamed);
    std::snprintf(line.data(), line.size(),
                  "| %s | %d | %d | %d | %d | %s | %.1f | %.2f | %llu |\n", name.c_str(),
                  tally.axes, tally.refused, tally.unresolved, tally.failed, fits.data(), tally.all,
                  tally.slowest, static_cast<unsigned long long>(tally.slowest_seed));
    text += line.data();
  }
  return text;
}

int run(std::uint64_t from, std::uint64_t count, std::uint32_t most, const std::string& method,
        const std::string& table_file, const std::vector<std::string>& files) {
  std::vector<Image> images;
  for (const std::string& file : files) {
    auto read = io::read_image(file);
    if (!read) {
      std::printf("%s: %s\n", file.c_str(), read.error().text.c_str());
      return 2;
    }
    images.push_back(std::move(read->image));
  }
  bool good = true;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    const std::uint32_t pixels = silhouette_size(seed, most);
    const bool own = images.empty() || seed % 2 == 0;
    const Image image = own ? silhouette(seed, pixels).image
                            : redrawn(images[seed / 2 % images.size()], seed, pixels);
    good = try_image(seed, image, method) && good;
  }
  std::fputs(table().c_str(), stdout);
  for (const auto& [name, tally] : tallies)
    for (const auto& [reason, times] : tally.reasons)
      std::printf("%s: %d times: %s\n", name.c_str(), times, reason.c_str());
  if (!table_file.empty())
    std::ofstream(table_file) << count << " silhouettes from seed " << from << " on, 50 to " << most
                              << " pixels; seconds of processor time.\n\n"
                              << table();
  return good ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int argc, char** argv) {
  std::uint64_t from = 0, count = 200, most = 2000;
  std::string method, table_file;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    std::uint64_t* number = argument == "--from"     ? &from
                            : argument == "--count"  ? &count
                            : argument == "--pixels" ? &most
                                                     : nullptr;
    if (argument == "--method" && i + 1 < argc) {
      method = argv[++i];
      continue;
    }
    if (argument == "--table" && i + 1 < argc) {
      table_file = argv[++i];
      continue;
    }
    if (number == nullptr && argument.starts_with("--")) return 2;
    if (number == nullptr) {
      files.push_back(argument);
    } else if (++i < argc) {
      *number = std::strtoull(argv[i], nullptr, 10);
    }
  }
  return medial::test::run(from, count, static_cast<std::uint32_t>(most), method, table_file,
                           files);
}
