#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/degrees.h"
#include "io/gis/back_to_geographic.h"
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
GlobeExtent extent_of(const Document<Feature>& dataset, double unit) {
  Direction sum;
  for_each_point(dataset, [&](Vec2 point) {
    const Direction d = direction_of(unit * point);
    sum = {sum.x + d.x, sum.y + d.y, sum.z + d.z};
  });
  const double length = std::hypot(sum.x, sum.y, sum.z);
  if (length == 0) return {0, 0, 180};
  double cosine = 1;
  for_each_point(dataset, [&](Vec2 point) {
    const Direction d = direction_of(unit * point);
    cosine = std::min(cosine, (sum.x * d.x + sum.y * d.y + sum.z * d.z) / length);
  });
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

}  // namespace

double degrees_of_unit(const std::string& crs_wkt) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  return reference.importFromWkt(crs_wkt.c_str()) == OGRERR_NONE
             ? degrees(reference.GetAngularUnits())
             : 1;
}

Status project_to_local(Document<Feature>& dataset) {
  const GdalMessages messages;
  OGRSpatialReference geographic;
  if (dataset.crs_wkt.empty()) {
    geographic.importFromEPSG(4326);
    dataset.notes.push_back(
        "no reference system is given: taken as longitude and latitude, WGS 84");
  } else if (!dataset.geographic) {
    dataset.notes.push_back("the coordinates are projected already: nothing was projected");
    return success();
  } else if (geographic.importFromWkt(dataset.crs_wkt.c_str()) != OGRERR_NONE) {
    return Error{ErrorCode::unsupported, "the reference system is not understood", {}};
  }
  const double unit = degrees(geographic.GetAngularUnits());
  if (!can_be_angles(reach_of(dataset), unit)) {
    return Error{
        ErrorCode::invalid_option,
        "the coordinates are not degrees, so they cannot be projected: leave out --project, or "
        "name their reference system by --crs EPSG:n",
        {}};
  }

  clamp_latitudes(dataset, unit);
  const GlobeExtent extent = extent_of(dataset, unit);
  const bool conformal = extent.reach <= conformal_reach;
  OGRSpatialReference local;
  bool beyond = false;
  for_each_point(dataset, [&](Vec2 p) { beyond = beyond || std::abs(unit * p.x) > 180; });
  local.SetProjCS(beyond ? beyond_name : local_name);
  local.CopyGeogCSFrom(&geographic);
  if (conformal) {
    local.SetTM(extent.latitude, extent.longitude, 1, 0, 0);
  } else {
    local.SetLAEA(extent.latitude, extent.longitude, 0, 0);
  }
  local.SetLinearUnits(SRS_UL_METER, 1);

  const Transformer transformation = transformer(geographic, local);
  const auto failed = [&messages](std::size_t feature) {
    return Error{ErrorCode::unsupported,
                 fmt::format("a point or a curve cannot be projected{}{}",
                             messages.failure().empty() ? "" : ": ", messages.failure()),
                 in_feature(feature)};
  };
  if (!transformation) return failed(0);
  // Curves' images are fitted to this share of the extent, in metres, or to what the rounding of
  // degrees and of the projection leaves.
  constexpr double relative_tolerance = 1e-12, least_tolerance = 2e-8, earth_radius = 6.371e6;
  const double tolerance =
      std::max(relative_tolerance * 2 * radians(extent.reach) * earth_radius, least_tolerance);
  for (std::size_t i = 0; i < dataset.items.size(); ++i) {
    if (!transform_feature(*transformation, tolerance, dataset.items[i]))
      return failed(dataset.index_of(i));
  }
  set_crs(local, dataset);
  dataset.notes.push_back(note_on(extent, conformal));
  return success();
}

namespace {

bool has_name(const std::string& crs_wkt, const char* name) {
  return crs_wkt.starts_with(fmt::format("PROJCRS[\"{}\"", name)) ||
         crs_wkt.starts_with(fmt::format("PROJCS[\"{}\"", name));
}

}  // namespace

bool is_local_projection(const std::string& crs_wkt) {
  return has_name(crs_wkt, local_name) || has_name(crs_wkt, beyond_name);
}

Result<BackToGeographic> BackToGeographic::make(const std::string& crs_wkt) {
  const GdalMessages messages;
  OGRSpatialReference local;
  if (!is_local_projection(crs_wkt) || local.importFromWkt(crs_wkt.c_str()) != OGRERR_NONE) {
    return Error{ErrorCode::unsupported,
                 "the reference system is not a local projection made by medial",
                 {}};
  }
  OGRSpatialReference geographic;
  geographic.CopyGeogCSFrom(&local);
  BackToGeographic back;
  back.middle_ =
      local.GetProjParm(SRS_PP_CENTRAL_MERIDIAN, local.GetProjParm(SRS_PP_LONGITUDE_OF_CENTER));
  back.within_half_turn_ = has_name(crs_wkt, local_name);
  back.transformation_ = transformer(local, geographic);
  if (!back.transformation_) {
    return Error{ErrorCode::unsupported, "the local projection cannot be undone", {}};
  }
  Document<Feature> named;
  set_crs(geographic, named);
  back.crs_wkt_ = std::move(named.crs_wkt);
  return back;
}

Status BackToGeographic::transform(std::vector<Vec2>& points) const {
  const GdalMessages messages;
  if (transform_points(*transformation_, points)) {
    // Within half a turn of the projection's middle: lines across 180 degrees go on beyond it.
    for (Vec2& p : points) p.x += 360 * std::round((middle_ - p.x) / 360);
    return success();
  }
  return Error{ErrorCode::unsupported, "a point of the axis has no longitude and latitude", {}};
}

Result<OutputCrs> output_crs_of(const std::string& crs_wkt, Unit unit) {
  if (!is_local_projection(crs_wkt)) return OutputCrs{crs_wkt, unit, nullptr};
  Result<BackToGeographic> back = BackToGeographic::make(crs_wkt);
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
