#include "site/site.h"

namespace medial::site {

double squared_distance_to_arc(const Site& arc, Vec2 c) {
  const Vec2 d = c - arc.point;
  const ArcView view = view_of_arc(arc, c);
  const double along = dot(arc.direction, d), forward = dot(arc.normal(), view.toward);
  if (along >= 0 && forward >= 0 && 2 * along <= arc.length * (view.size + forward))
    return view.distance * view.distance;
  return std::min(squared_norm(d), squared_norm(c - arc.end()));
}

}  // namespace medial::site
