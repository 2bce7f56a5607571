// Silhouettes through the sampled methods and verify, as long as one likes.
//
//   medial_silhouettes [--from SEED] [--count N] [--pixels MOST] [--method NAME] [IMAGE ...]
//
// Each seed is one silhouette(), or one of the images redrawn(), as the pixels' outline and as a
// smooth one. By `potential` at three orders each must be verified. By `curve-axis`, the fit of its
// outline must be verified, or refused as unsupported or too large. One line for each failure, then
// the share of axes for each method, the slowest one, and how often each reason was given for a
// refusal. --method: potential or curve-axis alone. Exit status: 0; 1 where something failed; 2 for
// a wrong call.

#include "support/silhouettes.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "medial/io/read.h"
#include "medial/medial.h"
#include "methods/curve_axis/curve_axis.h"

namespace medial::test {
namespace {

struct Tally {
  int axes = 0, refused = 0, failed = 0;
  int named = 0;     ///< refusals that name a fit that would do
  int misnamed = 0;  ///< of these, fits that are refused as well
  double slowest = 0;
  std::map<std::string, int> reasons;  ///< of refusals

  /// Whether this is how a method may refuse a shape that it does not take.
  bool refuse(const Error& error) {
    ++refused;
    ++reasons[error.text.substr(0, error.text.find(';'))];  // before the fit that would do
    return error.code == ErrorCode::unsupported || error.code == ErrorCode::too_large;
  }
};
std::map<std::string, Tally> tallies;

/// Counts and reports one axis; whether it is as it must be.
bool judge(const std::string& name, std::uint64_t seed, const Shape& shape, const Options& options,
           bool may_refuse) {
  const auto began = std::chrono::steady_clock::now();
  const auto axis = compute(shape, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  Tally& tally = tallies[name];
  tally.slowest = std::max(tally.slowest, took.count());
  std::string reason;
  if (!axis) {
    if (tally.refuse(axis.error()) && may_refuse) return true;
    reason = axis.error().text;
  } else {
    const Certificate certificate = verify(shape, *axis);
    ++tally.axes;
    if (certificate.passed) return true;
    reason = certificate.failures.front();
  }
  ++tally.failed;
  std::printf("silhouette %llu %s: %s\n", static_cast<unsigned long long>(seed), name.c_str(),
              reason.c_str());
  return false;
}

bool try_shape(const std::string& outline, std::uint64_t seed, const Shape& shape) {
  bool good = true;
  for (const double order : {0.0, 1.0, 8.0})
    good = judge("potential, order " + std::to_string(static_cast<int>(order)) + ", " + outline,
                 seed, shape, {.method = method::Potential{.order = order}}, false) &&
           good;
  return good;
}

/// The shape within splines that outlines become. Nothing where one has too few points, or where
/// too coarse a fit crosses itself.
Result<Shape> shape_within(const std::vector<Contour>& contours, double within) {
  std::vector<Contour> curves;
  for (const Contour& contour : contours) {
    auto curve = fit_smooth_contour(contour.points, within);
    if (!curve) return std::move(curve).error();
    curves.push_back(std::move(curve).value());
  }
  const auto arcs = approximate_by_arcs(curves, {.tolerance = 1e-6});
  return arcs ? build_shape(*arcs) : Result<Shape>(arcs.error());
}

/// Whether a refusal names a fit, and whether that one is followed and verified.
void count_named_fit(Tally& tally, const std::string& text, const std::vector<Contour>& contours) {
  const std::string option = "(--fit ";
  const auto at = text.find(option);
  if (at == std::string::npos) return;
  ++tally.named;
  const double within = std::strtod(text.c_str() + at + option.size(), nullptr);
  const auto shape = shape_within(contours, within);
  const auto found = compute_curve_axis(contours, {.fit = within});
  if (!shape || !found || !verify(*shape, found->axis).passed) ++tally.misnamed;
}

/// Outlines, with their holes, as splines within a share of their size.
bool try_fit(std::uint64_t seed, const std::vector<Ring>& rings, double share) {
  const Box box = bounding_box(*build_shape(rings));
  const double within = share * distance(box.low, box.high);
  std::vector<Contour> contours;
  for (const Ring& ring : rings) contours.push_back(contour_of(ring.points, {}, true));
  const auto shape = shape_within(contours, within);
  if (!shape) return true;
  char name[40];
  std::snprintf(name, sizeof name, "curve-axis, fit %.3f", share);
  const auto began = std::chrono::steady_clock::now();
  const auto found = compute_curve_axis(contours, {.fit = within});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  Tally& tally = tallies[name];
  tally.slowest = std::max(tally.slowest, took.count());
  std::string reason;
  if (!found) {
    count_named_fit(tally, found.error().text, contours);
    if (tally.refuse(found.error())) return true;
    reason = found.error().text;
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
bool try_image(std::uint64_t seed, const Image& image, const std::string& method) {
  bool good = true;
  if (image.count() == 0) return true;
  const bool by_potential = method != "curve-axis", by_curve_axis = method != "potential";
  const auto rings = pixel_outline(image);
  const auto contours = smooth_outline(image);
  if (!rings || !contours) return false;
  const auto shape_of_pixels = build_shape(*rings);
  if (shape_of_pixels && by_potential) good = try_shape("pixels", seed, *shape_of_pixels);
  if (by_curve_axis)
    for (const double share : {0.003, 0.006, 0.012, 0.025})
      good = try_fit(seed, *rings, share) && good;
  if (!by_potential) return good;
  const auto arcs = approximate_by_arcs(*contours, {.tolerance = 1e-4});
  if (!arcs) return false;
  if (const auto shape = build_shape(*arcs)) good = try_shape("smooth", seed, *shape) && good;
  return good;
}

int run(std::uint64_t from, std::uint64_t count, std::uint32_t most, const std::string& method,
        const std::vector<std::string>& files) {
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
  for (const auto& [name, tally] : tallies) {
    std::printf("%-32s %5d axes %5d refused %5d failed, the slowest took %.2f s\n", name.c_str(),
                tally.axes, tally.refused, tally.failed, tally.slowest);
    for (const auto& [reason, times] : tally.reasons)
      std::printf("  %5d: %s\n", times, reason.c_str());
    if (name.starts_with("curve-axis") && tally.refused > 0)
      std::printf("  %5d name a fit, of which %d are not followed either\n", tally.named,
                  tally.misnamed);
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int argc, char** argv) {
  std::uint64_t from = 0, count = 200, most = 2000;
  std::string method;
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
    if (number == nullptr && argument.starts_with("--")) return 2;
    if (number == nullptr) {
      files.push_back(argument);
    } else if (++i < argc) {
      *number = std::strtoull(argv[i], nullptr, 10);
    }
  }
  return medial::test::run(from, count, static_cast<std::uint32_t>(most), method, files);
}
