// Paths of SVG, and the row of what a path alone is.

#include "io/formats/svg_path.h"

#include <cmath>
#include <numbers>

// The grammar is compiled in svg_grammars.cpp; svgpp names this namespace all the same.
namespace boost::spirit::qi {}
#define SVGPP_USE_EXTERNAL_PATH_DATA_PARSER
#include <svgpp/parser/path_data.hpp>
#include <svgpp/utility/arc_endpoint_to_center.hpp>

#include "io/guarded.h"
#include "medial/io/read.h"

namespace medial::io {

/// By SVG 1.1, F.6.2.
void SvgPath::arc_to(Vec2 radii, double degrees, bool large, bool sweep, Vec2 to) {
  const Vec2 from = std::exchange(last_, to);
  if (to == from) return;
  const double rx = std::fabs(radii.x), ry = std::fabs(radii.y);
  if (!(rx > 0) || !(ry > 0)) {
    steps_.push_back({StepKind::line, {to}, {}});
    return;
  }
  const double phi = degrees * (std::numbers::pi / 180);
  Vec2 center;
  double wide = rx, high = ry;
  double begin = 0;
  double end = 0;
  svgpp::arc_endpoint_to_center(from.x, from.y, to.x, to.y, wide, high, phi, large, sweep, center.x,
                                center.y, begin, end);
  if (sweep && end < begin) end += 2 * std::numbers::pi;
  if (!sweep && end > begin) end -= 2 * std::numbers::pi;
  const Vec2 axis{std::cos(phi), std::sin(phi)};
  steps_.push_back({StepKind::arc, {to}, {center, wide * axis, high * left_of(axis), begin, end}});
}

std::vector<Contour> SvgPath::contours(const Affine& map, RingRole role, bool loose,
                                       bool stroked) const {
  std::vector<Contour> result;
  Contour contour;
  contour.role = role;
  Vec2 start;
  bool closed = false;
  const auto finish = [&] {
    const bool drawn = loose ? !contour.pieces.empty() : !is_degenerate(contour);
    contour.open = stroked && !closed;
    if (drawn) result.push_back(std::move(contour));
    contour = {};
    closed = false;
    contour.role = role;
  };
  for (const Step& step : steps_) {
    if (step.kind != StepKind::start && step.kind != StepKind::close && contour.points.empty()) {
      contour.start_at(start);
    }
    const auto at = [&](std::size_t i) { return map(step.points[i]); };
    switch (step.kind) {
      case StepKind::start:
        finish();
        start = at(0);
        break;
      case StepKind::close:
        closed = true;
        finish();
        break;
      case StepKind::line:
        contour.line_to(at(0));
        break;
      case StepKind::quadratic:
        contour.bezier_to(std::array{at(0), at(1)});
        break;
      case StepKind::cubic:
        contour.bezier_to(std::array{at(0), at(1), at(2)});
        break;
      case StepKind::arc:
        add_arc(contour, transformed(map, step.arc), at(0));
        break;
    }
  }
  finish();
  return result;
}

namespace {

struct PathErrors {
  template <class... Arguments>
  static bool parse_failed(const Arguments&...) {
    return false;
  }
};

}  // namespace

Result<std::vector<Contour>> read_path_data(std::string_view text, bool loose) {
  return guarded({}, [&]() -> Result<std::vector<Contour>> {
    SvgPath path;
    using Parser =
        svgpp::value_parser<svgpp::tag::type::path_data, svgpp::error_policy<PathErrors>>;
    const bool read =
        Parser::parse(svgpp::tag::attribute::d(), path,
                      boost::iterator_range<const char*>(text.data(), text.data() + text.size()),
                      svgpp::tag::source::attribute());
    if (!read) return Error{ErrorCode::malformed, "this is not SVG path data", {}};
    return path.contours({}, RingRole::winding, loose, loose);
  });
}

}  // namespace medial::io
