#pragma once

#include <memory>

#include "medial/axis.h"
#include "medial/raster.h"

namespace medial {

/// Which pixels are medial for `ridge`.
enum class RidgeRule : std::uint8_t {
  /// The axis passes between the pixel and one of its four neighbours; of the two, the pixel is
  /// nearer to the axis, within one pixel. Next to the boundary: `difference`.
  crossing,
  difference,  ///< the distances to the two nearest edges differ by less than one pixel
};

/// The size of square pixels, at most 2^31 of them; both 0: 1024 along the longer side.
struct PixelGrid {
  double resolution = 0;     ///< the side of a pixel, at most the longer side of the bounding box
  std::uint32_t pixels = 0;  ///< or the number of pixels along that side
};

/// The methods, each with its own options. Exact methods return the same graph; sampled ones
/// approximate it and set MedialAxis::resolution.
namespace method {

struct Disks {};  ///< walks along the axis and searches a tree of the boundary: the fastest

/// The randomised divide and conquer of Aichholzer et al., with balanced cuts: O(n log n) expected.
struct BiarcDc {
  std::uint64_t seed = 1;  ///< the same seed gives the same result, byte for byte
  bool curves = true;      ///< false: edges stay straight until conic_of() computes them
};

/// Lee's divide and conquer: merges Voronoi diagrams. `disks` computes what double leaves open.
struct Lee {};

/// The method with the least processor time (docs/lee.md): `lee` for nearly convex polygons without
/// holes and for small smooth ones; `disks` for all others.
struct Auto {};

/// Ridge following on a grid of pixels (Volkmann and St. Clair).
struct Ridge {
  PixelGrid grid = {};
  /// Drops vertices between straight edges that turn by less than this, in degrees, in [0, 45],
  /// where the combined edge stays within a quarter of a pixel of them; 0 keeps all.
  double collinear = 5;
  /// Finds nearest edges by the report's sorted list, not a tree: slower, but the same pixels.
  bool sorted_list = false;
  RidgeRule rule = RidgeRule::crossing;
};

/// Thins the interior's pixels to lines.
struct Brushfire {
  PixelGrid grid = {};
  medial::Brushfire family = medial::Brushfire::simultaneous;
};

/// Valleys of Ahuja and Chuang's potential (docs/potential.md). Shares: of the box's longer side.
struct Potential {
  /// The order n of the force that finds points, real, in [1, 4096]; 0: chosen for each point.
  double order = 0;
  /// The order of the first force lines, in [1, 4096]; above 24, points of the exact axis replace
  /// them. 0: `order`, at most 24; on large shapes higher orders start from the exact axis.
  double base_order = 0;
  double step = 0.01;  ///< the longest step, a share in [1e-4, 0.1]
  double coarse = 0;   ///< starts on a polygon within this share, at most 0.2; whole axes only
  // As the order grows:
  double angle = 2.56;       ///< theta_min: how far the force may still turn, degrees in (0, 90]
  double movement = 0.0005;  ///< e_min: how far a point may still move, a share in (0, 0.1]
  std::optional<Vec2> from = {};   ///< only the branch to which the force leads from here
  std::optional<Box> within = {};  ///< only the part in this box, connected or not
  bool whole() const { return !from && !within; }
};

/// Traces the axis from maxima of curvature and corners: see compute_curve_axis().
struct CurveAxis {
  double step = 1e-3;  ///< largest step between points, a share of the diagonal in [1e-6, 0.1]
  /// The maximum of curvature to start from; the axis is the same for each, up to its steps.
  std::size_t first_maximum = 0;
  double fit = 0;  ///< replaces contours by splines within this distance; 0: no
};

}  // namespace method

using Method = std::variant<method::Disks, method::BiarcDc, method::Lee, method::Auto,
                            method::Ridge, method::Brushfire, method::Potential, method::CurveAxis>;

/// What the axes of a method consist of.
enum class Sampling : std::uint8_t {
  curves,  ///< exact curves
  points,  ///< points along the axis
  pixels,  ///< pixels of a grid
};

/// A method, and what it supports besides holes and arcs. compute() refuses the rest.
struct MethodInfo {
  const char *name, *summary;  ///< as on the command line and in MedialAxis::method; a few words
  Sampling sampling = Sampling::curves;
  bool exterior = false;  ///< Options::exterior
  bool part = false;      ///< computing a part of an axis
  bool contours = false;  ///< smooth contours instead of a shape
  bool threads = false;   ///< several threads
  bool exact() const { return sampling == Sampling::curves; }  ///< takes Options::exact
};

std::span<const MethodInfo> methods();  ///< in the order of Method's alternatives
const MethodInfo& info_of(const Method& method);
inline const char* name_of(const Method& method) { return info_of(method).name; }

std::optional<Method> method_from(std::string_view name);  ///< with its default options
bool is_of_pixels(std::string_view method);                ///< for MedialAxis::method

/// The generalised potential of a charged border (docs/potential.md): in each component of a shape,
/// the integral of 1 / r^order along the component's border.
class PotentialField {
 public:
  /// Replaces arcs by chords within 1e-5 of the shape's larger side. Errors: invalid_option (order
  /// outside [1, 4096]), empty, unsupported (coordinates beyond the limits of compute()).
  static Result<PotentialField> make(const Shape& shape, double order);

  struct Sample {
    double log_potential = 0;
    Vec2 direction;        ///< of the force: a unit vector, or zero if there is no force
    double clearance = 0;  ///< distance to the border
  };
  /// Nothing outside the shape or on its border. Safe to call from several threads.
  std::optional<Sample> at(Vec2 p) const;

  /// The force line from p, in at most `most_steps` steps of at most `step` (units of the input).
  std::vector<Vec2> streamline(Vec2 p, double step, std::size_t most_steps) const;

 private:
  struct Parts;
  explicit PotentialField(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace medial
