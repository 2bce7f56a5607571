#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "io/degrees.h"
#include "io/gis/back_to_input.h"
#include "io/gis/gdal_support.h"
#include "io/gis/project_curves.h"
#include "io/path_builder.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "medial/io/read.h"

namespace medial::io {

namespace {

// The name by which a projection of our own is known again, in memory and in files.
constexpr const char* local_name = "medial local projection";
// The same of an input with longitudes beyond 180, which the output has alike.
constexpr const char* beyond_name = "medial local projection beyond 180 degrees";
// The same of projected coordinates, before the code of their reference system or its WKT.
constexpr const char* projected_name = "medial local projection for ";

// Beyond this distance from the middle, in degrees of the great circle (about 300 km), the
// transverse Mercator projection stretches by more than 0.11 percent.
constexpr double conformal_reach = 2.7;

using Transformer = std::unique_ptr<OGRCoordinateTransformation>;

Transformer transformer(OGRSpatialReference& from, OGRSpatialReference& to) {
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return Transformer(OGRCreateCoordinateTransformation(&from, &to));
}

bool transform_points(OGRCoordinateTransformation& transformation, std::vector<Vec2>& points) {
  if (points.empty()) return true;
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x;
    y[i] = points[i].y;
  }
  // GDAL counts points by int.
  constexpr std::size_t points_per_batch = std::size_t{1} << 20;
  for (std::size_t begin = 0; begin < points.size(); begin += points_per_batch) {
    const int count = static_cast<int>(std::min(points_per_batch, points.size() - begin));
    if (!transformation.Transform(count, x.data() + begin, y.data() + begin)) return false;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) return false;
    points[i] = {x[i], y[i]};
  }
  return true;
}

/// The image of a feature; false where a point has none. Edges stay straight between the images of
/// their ends; arcs and curves become curves within `tolerance` of their image.
bool transform_feature(OGRCoordinateTransformation& transformation, double tolerance,
                       Feature& feature) {
  const auto map = [&](std::vector<Vec2>& points) {
    return transform_points(transformation, points);
  };
  const auto has_bulges = [](const auto& line) { return !line.bulges.empty(); };
  for (const Ring& ring : feature.rings) {
    if (!has_bulges(ring)) continue;
    feature.contours.push_back(contour_of(ring.points, ring.bulges, true));
    feature.contours.back().role = ring.role;
  }
  for (const Chain& chain : feature.chains)
    if (has_bulges(chain))
      feature.contours.push_back(contour_of(chain.points, chain.bulges, chain.closed));
  std::erase_if(feature.rings, has_bulges);
  std::erase_if(feature.chains, has_bulges);
  const auto map_points = [&](auto& line) { return map(line.points); };
  return std::ranges::all_of(feature.rings, map_points) &&
         std::ranges::all_of(feature.chains, map_points) &&
         std::ranges::all_of(feature.contours, [&](Contour& contour) {
           return project_contour(map, tolerance, contour);
         });
}

struct Direction {
  double x = 0, y = 0, z = 0;
};

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }
double degrees(double radians) { return radians * (180 / std::numbers::pi); }

Direction direction_of(Vec2 position) {
  const double longitude = radians(position.x);
  const double latitude = radians(position.y);
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

/// The middle of all vertices on the globe (so the date line does no harm), and the angle to the
/// farthest vertex.
struct GlobeExtent {
  double longitude = 0;
  double latitude = 0;
  double reach = 0;
};

/// Coordinates have this unit, in degrees.
GlobeExtent extent_of(const std::vector<Vec2>& points, double unit) {
  Direction sum;
  for (const Vec2 point : points) {
    const Direction d = direction_of(unit * point);
    sum = {sum.x + d.x, sum.y + d.y, sum.z + d.z};
  }
  const double length = std::hypot(sum.x, sum.y, sum.z);
  if (length == 0) return {0, 0, 180};
  double cosine = 1;
  for (const Vec2 point : points) {
    const Direction d = direction_of(unit * point);
    cosine = std::min(cosine, (sum.x * d.x + sum.y * d.y + sum.z * d.z) / length);
  }
  return {degrees(std::atan2(sum.y, sum.x)),
          degrees(std::asin(std::clamp(sum.z / length, -1.0, 1.0))),
          degrees(std::acos(std::clamp(cosine, -1.0, 1.0)))};
}

/// Puts points that rounding moved beyond a pole back onto it.
void clamp_latitudes(Document<Feature>& dataset, double unit) {
  const double most = pole / unit;
  const auto clamp = [most](auto& lines) {
    for (auto& line : lines)
      for (Vec2& point : line.points) point.y = std::clamp(point.y, -most, most);
  };
  for (Feature& feature : dataset.items) {
    clamp(feature.rings);
    clamp(feature.contours);
    clamp(feature.chains);
  }
}

std::string note_on(const GlobeExtent& extent, bool conformal) {
  std::string note = fmt::format("projected to metres by the {} projection at {:.4f}, {:.4f}",
                                 conformal ? "transverse Mercator" : "azimuthal equal-area",
                                 extent.longitude, extent.latitude);
  // Lengths across the way to the middle grow as those along it shrink.
  constexpr double most = 179;
  if (!conformal)
    note += fmt::format("; far from there, lengths are off by up to {:.2g} %",
                        100 * (1 / std::cos(0.5 * radians(std::min(extent.reach, most))) - 1));
  return note;
}

/// The farthest that lengths in a projected reference system are off.
struct Stretch {
  double factor = 1;  ///< of lengths on the ground
  Vec2 place;         ///< longitude and latitude

  bool matters() const { return std::abs(std::log(factor)) > 0.01; }
};

/// How lengths are off around a point, in the direction where they are it most. `factor` is 1 where
/// that is not known.
Stretch stretch_at(Vec2 point, const OGRSpatialReference& projected,
                   OGRCoordinateTransformation& to_geographic, double unit) {
  const double arm = 10 / projected.GetLinearUnits();  // ten metres of the plane
  std::vector<Vec2> cross{point, point + Vec2{arm, 0}, point - Vec2{arm, 0}, point + Vec2{0, arm},
                          point - Vec2{0, arm}};
  if (!transform_points(to_geographic, cross)) return {};
  const Vec2 place = unit * cross[0];
  if (std::abs(place.y) > 89.99) return {};  // longitudes say little there
  const double sine = std::sin(radians(place.y)), flat = projected.GetSquaredEccentricity();
  const double across = projected.GetSemiMajor() / std::sqrt(1 - flat * sine * sine);
  const double along = across * (1 - flat) / (1 - flat * sine * sine);
  const double metres = 2 * arm * projected.GetLinearUnits();
  const auto on_ground = [&](Vec2 from, Vec2 to) {
    const Vec2 way = unit * (to - from);
    return (1 / metres) *
           Vec2{radians(std::remainder(way.x, 360.0)) * across * std::cos(radians(place.y)),
                radians(way.y) * along};
  };
  // The axes of the ellipse on the ground that a unit circle of the plane is.
  const Vec2 x = on_ground(cross[2], cross[1]), y = on_ground(cross[4], cross[3]);
  const double sum = std::hypot(x.x + y.y, x.y - y.x), rest = std::hypot(x.x - y.y, x.y + y.x);
  const double longest = (sum + rest) / 2, shortest = std::abs(sum - rest) / 2;
  if (!(shortest > 0) || !std::isfinite(longest)) return {};
  return {longest * shortest < 1 ? 1 / shortest : 1 / longest, place};
}

/// The largest stretch at the outermost points of coordinates in this reference system.
Stretch stretch_of(const Extremes& extremes, OGRSpatialReference projected) {
  Stretch worst;
  if (!projected.IsProjected() || !extremes.points) return worst;
  OGRSpatialReference geographic;
  geographic.CopyGeogCSFrom(&projected);
  const Transformer to_geographic = transformer(projected, geographic);
  if (!to_geographic) return worst;
  for (const Vec2 point : *extremes.points) {
    const Stretch here =
        stretch_at(point, projected, *to_geographic, degrees(geographic.GetAngularUnits()));
    if (std::abs(std::log(here.factor)) > std::abs(std::log(worst.factor))) worst = here;
  }
  return worst;
}

/// A name by which SetFromUserInput() finds a reference system.
std::string lasting_name(const OGRSpatialReference& reference) {
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  if (authority != nullptr && code != nullptr) return fmt::format("{}:{}", authority, code);
  Document<Feature> described;
  set_crs(reference, described);
  return described.crs_wkt;
}

/// Whether points of the input come back from its local projection.
bool comes_back(std::vector<Vec2> points, OGRCoordinateTransformation& to_local,
                const std::string& local_wkt) {
  const std::vector<Vec2> before = points;
  const Result<BackToInput> back = BackToInput::make(local_wkt);
  if (!back || !transform_points(to_local, points) || !back->transform(points)) return false;
  constexpr double rounding = 0.1;  // metres or feet, where the stretch is large
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!(distance(points[i], before[i]) < rounding)) return false;
  return true;
}

}  // namespace

double degrees_of_unit(const std::string& crs_wkt) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  return reference.importFromWkt(crs_wkt.c_str()) == OGRERR_NONE
             ? degrees(reference.GetAngularUnits())
             : 1;
}

namespace {

std::vector<Vec2> points_of(const Document<Feature>& dataset) {
  std::vector<Vec2> points;
  for_each_point(dataset, [&points](Vec2 point) { points.push_back(point); });
  return points;
}

/// A projection around points with these longitudes and latitudes.
OGRSpatialReference local_projection(const std::string& name, const OGRSpatialReference& given,
                                     const GlobeExtent& extent) {
  OGRSpatialReference local;
  local.SetProjCS(name.c_str());
  local.CopyGeogCSFrom(&given);
  if (extent.reach <= conformal_reach) {
    local.SetTM(extent.latitude, extent.longitude, 1, 0, 0);
  } else {
    local.SetLAEA(extent.latitude, extent.longitude, 0, 0);
  }
  local.SetLinearUnits(SRS_UL_METER, 1);
  return local;
}

Error cannot_project(const GdalMessages& messages, std::size_t feature) {
  return Error{ErrorCode::unsupported,
               fmt::format("a point or a curve cannot be projected{}{}",
                           messages.failure().empty() ? "" : ": ", messages.failure()),
               in_feature(feature)};
}

/// Projects coordinates in a reference system that is geographic or projected.
Status project_from(OGRSpatialReference& given, Document<Feature>& dataset) {
  const GdalMessages messages;
  const bool projected = given.IsProjected() != 0;
  const double unit = degrees(given.GetAngularUnits());
  if (!projected) clamp_latitudes(dataset, unit);
  std::vector<Vec2> points = points_of(dataset);
  const bool beyond =
      !projected && std::ranges::any_of(points, [&](Vec2 p) { return std::abs(unit * p.x) > 180; });
  std::string name = beyond ? beyond_name : local_name;
  if (projected) {
    name = projected_name + lasting_name(given);
    OGRSpatialReference geographic;
    geographic.CopyGeogCSFrom(&given);
    const Transformer to_geographic = transformer(given, geographic);
    if (!to_geographic || !transform_points(*to_geographic, points))
      return cannot_project(messages, 0);
  }
  const GlobeExtent extent = extent_of(points, unit);
  OGRSpatialReference local = local_projection(name, given, extent);
  const Transformer transformation = transformer(given, local);
  if (!transformation) return cannot_project(messages, 0);
  points = projected ? points_of(dataset) : std::vector<Vec2>();
  // Curves' images are fitted to this share of the extent, in metres, or to what the rounding of
  // degrees and of the projection leaves.
  constexpr double relative_tolerance = 1e-12, least_tolerance = 2e-8, earth_radius = 6.371e6;
  const double tolerance =
      std::max(relative_tolerance * 2 * radians(extent.reach) * earth_radius, least_tolerance);
  for (std::size_t i = 0; i < dataset.items.size(); ++i) {
    if (!transform_feature(*transformation, tolerance, dataset.items[i]))
      return cannot_project(messages, dataset.index_of(i));
  }
  set_crs(local, dataset);
  if (projected && !comes_back(std::move(points), *transformation, dataset.crs_wkt))
    return Error{ErrorCode::unsupported,
                 "some coordinates lie beyond the end of their reference system, so they cannot be "
                 "projected",
                 {}};
  dataset.notes.push_back(note_on(extent, extent.reach <= conformal_reach));
  return success();
}

}  // namespace

Status project_to_local(Document<Feature>& dataset) {
  const GdalMessages messages;
  OGRSpatialReference given;
  if (dataset.crs_wkt.empty()) {
    if (dataset.unit != Unit::unknown && dataset.unit != Unit::degree)
      return Error{ErrorCode::invalid_option,
                   fmt::format("the unit of the coordinates is '{}': --project is for longitudes "
                               "and latitudes; leave it out",
                               name_of(dataset.unit)),
                   {}};
    given.importFromEPSG(4326);
    dataset.notes.push_back(
        "no reference system is given: taken as longitude and latitude, WGS 84");
  } else {
    const bool understood = given.importFromWkt(dataset.crs_wkt.c_str()) == OGRERR_NONE;
    if (!dataset.geographic &&
        (!understood || !stretch_of(extremes_of(dataset), given).matters())) {
      dataset.notes.push_back("the coordinates are projected already: nothing was projected");
      return success();
    }
    if (!understood)
      return Error{ErrorCode::unsupported, "the reference system is not understood", {}};
  }
  if (given.IsProjected() == 0 &&
      !can_be_angles(extremes_of(dataset).reach(), degrees(given.GetAngularUnits()))) {
    return Error{
        ErrorCode::invalid_option,
        "the coordinates are not degrees, so they cannot be projected: leave out --project, or "
        "name their reference system by --crs EPSG:n",
        {}};
  }
  return project_from(given, dataset);
}

void note_stretch(DocumentInfo& document, const Extremes& extremes) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (document.crs_wkt.empty() || document.geographic ||
      reference.importFromWkt(document.crs_wkt.c_str()) != OGRERR_NONE)
    return;
  const Stretch stretch = stretch_of(extremes, reference);
  if (stretch.matters())
    document.notes.push_back(fmt::format(
        "lengths in this reference system are {:.2f} times those on the ground at {:.4f}, {:.4f}; "
        "--project measures in metres",
        stretch.factor, stretch.place.x, stretch.place.y));
}

bool is_local_projection(const std::string& crs_wkt) {
  // All its names begin alike.
  return crs_wkt.starts_with(fmt::format("PROJCRS[\"{}", local_name)) ||
         crs_wkt.starts_with(fmt::format("PROJCS[\"{}", local_name));
}

Result<BackToInput> BackToInput::make(const std::string& crs_wkt) {
  const GdalMessages messages;
  OGRSpatialReference local;
  if (!is_local_projection(crs_wkt) || local.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE) {
    return Error{ErrorCode::unsupported,
                 "the reference system is not a local projection made by medial",
                 {}};
  }
  OGRSpatialReference geographic;
  geographic.CopyGeogCSFrom(&local);
  BackToInput back;
  const std::string name = local.GetName();
  OGRSpatialReference projected;
  if (name.starts_with(projected_name) &&
      projected.SetFromUserInput(name.c_str() + std::strlen(projected_name),
                                 OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) !=
          OGRERR_NONE)
    return Error{ErrorCode::unsupported, "the projection before the local one is not known", {}};
  back.middle_ =
      local.GetProjParm(SRS_PP_CENTRAL_MERIDIAN, local.GetProjParm(SRS_PP_LONGITUDE_OF_CENTER));
  back.within_half_turn_ = name == local_name;
  back.to_geographic_ = transformer(local, geographic);
  if (!projected.IsEmpty()) back.to_projected_ = transformer(geographic, projected);
  if (!back.to_geographic_ || (!projected.IsEmpty() && !back.to_projected_)) {
    return Error{ErrorCode::unsupported, "the local projection cannot be undone", {}};
  }
  Document<Feature> named;
  set_crs(projected.IsEmpty() ? geographic : projected, named);
  back.crs_wkt_ = std::move(named.crs_wkt);
  return back;
}

Status BackToInput::transform(std::vector<Vec2>& points) const {
  const GdalMessages messages;
  if (!transform_points(*to_geographic_, points))
    return Error{ErrorCode::unsupported, "a point of the axis has no longitude and latitude", {}};
  // Within half a turn of the projection's middle: lines across 180 degrees go on beyond it.
  for (Vec2& p : points) p.x += 360 * std::round((middle_ - p.x) / 360);
  if (to_projected_ && !transform_points(*to_projected_, points))
    return Error{ErrorCode::unsupported,
                 "a point of the axis is not in the reference system of the input",
                 {}};
  return success();
}

Result<OutputCrs> output_crs_of(const std::string& crs_wkt, Unit unit) {
  if (!is_local_projection(crs_wkt)) {
    const GdalMessages messages;
    OGRSpatialReference reference;
    if (crs_wkt.empty() || reference.importFromWkt(crs_wkt.c_str()) == OGRERR_NONE)
      return OutputCrs{crs_wkt, unit, nullptr};
    if (!find_crs(crs_wkt, reference))
      return Error{ErrorCode::malformed,
                   fmt::format("the input's reference system, '{}', is not understood; use EPSG:n "
                               "or WKT",
                               crs_wkt.substr(0, 40)),
                   {}};
    Document<Feature> named;
    set_crs(reference, named);
    return OutputCrs{std::move(named.crs_wkt), unit, nullptr};
  }
  Result<BackToInput> back = BackToInput::make(crs_wkt);
  if (!back) return std::move(back).error();
  const bool within_half_turn = back->within_half_turn();
  return OutputCrs{
      back->crs_wkt(), unit,
      [back = std::move(*back)](std::vector<Vec2>& points) { return back.transform(points); },
      within_half_turn};
}

std::string urn_of_crs(const std::string& crs_wkt) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (crs_wkt.empty() || reference.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE) return {};
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (reference.GetAuthorityCode(nullptr) == nullptr) reference.AutoIdentifyEPSG();
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  if (authority == nullptr || code == nullptr) return {};
  // Coordinates are longitude before latitude.
  if (EQUAL(authority, "EPSG") && EQUAL(code, "4326")) return "urn:ogc:def:crs:OGC:1.3:CRS84";
  return fmt::format("urn:ogc:def:crs:{}::{}", authority, code);
}

}  // namespace medial::io
