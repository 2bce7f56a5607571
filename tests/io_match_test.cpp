// Likeness of real shapes: does the same kind rank first? Letters of different fonts, and
// silhouettes of the data folder turned, mirrored, made smaller and noisy, digitised again.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "medial/compute.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "medial/raster.h"
#include "support/environment.h"
#include "support/generate.h"

namespace medial {
namespace {

namespace fs = std::filesystem;

struct Sample {
  std::string kind;
  std::string name;
  ShapeSignature signature;
};

/// The share of samples whose nearest other sample is of their kind.
double first_ranks(const std::vector<Sample>& samples, const std::string& what) {
  std::size_t right = 0;
  std::string wrong;
  for (const Sample& asked : samples) {
    const Sample* best = nullptr;
    double least = 0;
    for (const Sample& other : samples) {
      if (&other == &asked) continue;
      const double d = dissimilarity(asked.signature, other.signature);
      if (best != nullptr && !(d < least)) continue;
      best = &other;
      least = d;
    }
    if (best->kind == asked.kind) {
      ++right;
    } else {
      wrong += " " + asked.name + "->" + best->name;
    }
  }
  std::cout << what << ": the same kind ranks first for " << right << " of " << samples.size()
            << "; not for" << wrong << "\n";
  return static_cast<double>(right) / static_cast<double>(samples.size());
}

/// The signature of a feature; nothing where it has no valid shape.
std::optional<ShapeSignature> sign(const Feature& feature) {
  std::vector<Ring> rings = feature.rings;
  if (!feature.contours.empty()) {
    auto arcs = approximate_by_arcs(feature.contours, {.tolerance = 1e-4});
    if (!arcs) return std::nullopt;
    std::move(arcs->begin(), arcs->end(), std::back_inserter(rings));
  }
  const auto shape = build_shape(rings, {.node_crossings = !feature.contours.empty()});
  if (!shape) return std::nullopt;
  const auto axis = compute(without_specks(*shape));
  if (!axis) return std::nullopt;
  return signature_of(*axis, describe(*axis));
}

TEST(MatchKinds, LettersOfDifferentFonts) {
  const std::string folder = "/usr/share/fonts/truetype/dejavu/";
  const std::string letters = "ABCDEFGHJKLPQRSTUXY";  // no two of them images of each other
  std::vector<Sample> samples;
  for (const std::string font : {"DejaVuSans", "DejaVuSans-Bold", "DejaVuSansMono",
                                 "DejaVuSansMono-Bold", "DejaVuSerif", "DejaVuSerif-Bold"}) {
    const std::string path = folder + font + ".ttf";
    if (!fs::exists(path)) continue;
    const auto text = io::read_text(letters, path);
    ASSERT_TRUE(text.ok());
    ASSERT_EQ(text->items.size(), letters.size());
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const auto signature = sign(text->items[i]);
      ASSERT_TRUE(signature.has_value()) << letters[i] << " " << font;
      samples.push_back(
          {letters.substr(i, 1), letters.substr(i, 1) + "(" + font + ")", *signature});
    }
  }
  if (samples.size() < 2 * letters.size()) GTEST_SKIP() << "no fonts";
  EXPECT_GE(first_ranks(samples, "letters"), 0.7);
}

/// The image turned by an angle, mirrored or not, at a scale: the pixels whose centres come from
/// foreground pixels; each pixel at the edge flipped with a probability.
Image image_of(const Image& image, double angle, bool mirror, double scale, double noise) {
  test::Random random(1);
  const double c = std::cos(angle), s = std::sin(angle);
  const double w = image.width(), h = image.height();
  const double size = scale * std::hypot(w, h) + 4;
  const auto side = static_cast<std::uint32_t>(size);
  Image out(side, side);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const double u = (x + 0.5 - 0.5 * side) / scale, v = (y + 0.5 - 0.5 * side) / scale;
      double px = c * u + s * v;
      const double py = -s * u + c * v;
      if (mirror) px = -px;
      const auto at = [&](double dx, double dy) {
        return image.at(static_cast<std::int64_t>(std::floor(px + dx + 0.5 * w)),
                        static_cast<std::int64_t>(std::floor(py + dy + 0.5 * h)));
      };
      bool value = at(0, 0);
      const double step = 1 / scale;
      const bool edge = at(step, 0) != value || at(-step, 0) != value || at(0, step) != value ||
                        at(0, -step) != value;
      if (edge && random.chance(noise)) value = !value;
      if (value) out.set(x, y);
    }
  return out;
}

TEST(MatchKinds, Silhouettes) {
  const fs::path folder = test::data_folder() / "packaged/C_images";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data folder";
  std::vector<Sample> samples;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& path : files) {
    if (path.extension() != ".png") continue;
    const std::string name = path.stem().string();
    // Silhouettes: the others are texts, coins, sketches.
    const bool numbered = name.starts_with("opencv_") && std::isdigit(name[7]) != 0;
    if (!numbered && name != "skimage_horse") continue;
    const auto file = io::read_image(path.string());
    ASSERT_TRUE(file.ok());
    struct Way {
      const char* name;
      double angle, scale, noise;
      bool mirror;
    };
    for (const Way& way : {Way{"", 0, 0.5, 0, false}, Way{" turned", 0.6, 0.5, 0, false},
                           Way{" half", 2, 0.5, 0, false}, Way{" mirrored", 1.2, 0.8, 0, true},
                           Way{" noisy", 4, 0.45, 0.1, true}}) {
      const Image image = image_of(file->image, way.angle, way.mirror, way.scale, way.noise);
      auto outline = smooth_outline(image);
      ASSERT_TRUE(outline.ok());
      Feature feature;
      feature.contours = std::move(outline).value();
      const auto signature = sign(feature);
      ASSERT_TRUE(signature.has_value()) << name << way.name;
      // The noisy T is a T.
      samples.push_back({name == "opencv_14_T_noisy" ? "opencv_13_T" : name,
                         name.substr(name.find_last_of('_') + 1) + way.name, *signature});
    }
  }
  ASSERT_GT(samples.size(), 40U);
  EXPECT_GE(first_ranks(samples, "silhouettes"), 0.9);
}

}  // namespace
}  // namespace medial
