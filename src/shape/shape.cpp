#include "medial/shape.h"

#include <algorithm>
#include <cmath>

namespace medial {

std::size_t Shape::component_count() const { return loop_count() - hole_count(); }

std::size_t Shape::hole_count() const {
  return static_cast<std::size_t>(std::count(hole.begin(), hole.end(), true));
}

Box bounding_box(const Shape& shape) {
  if (shape.points.empty()) return {};
  Box box{shape.points[0], shape.points[0]};
  for (const Vec2 point : shape.points) {
    box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
    box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
  }
  if(!shape.bulges.empty()) for(std::size_t l=0;l<shape.loop_count();++l){ auto lp=shape.loop(l); for(std::size_t i=0;i<lp.size();++i){ double b=shape.bulge(shape.loop_begin[l]+i); if(b==0)continue; Vec2 p=lp[i],q=lp[(i+1)%lp.size()]; int n=64; double h=2*std::atan(b); Vec2 e=q-p; double R=norm(e)/(2*std::sin(h)); Vec2 m=0.5*(p+q)+ (R*std::cos(h)/norm(e))*left_of(e); for(int k=1;k<n;++k){ double a=2*h*k/n; Vec2 d=p-m; Vec2 x=m+Vec2{std::cos(a)*d.x-std::sin(a)*d.y,std::sin(a)*d.x+std::cos(a)*d.y}; box.low={std::min(box.low.x,x.x),std::min(box.low.y,x.y)}; box.high={std::max(box.high.x,x.x),std::max(box.high.y,x.y)}; } } }
  return box;
}

double diagonal(const Box& box) {
  return std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

double area(const Shape& shape) {
  double sum = 0;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    // Relative to a vertex of the loop, or far from the origin the digits cancel.
    const std::span<const Vec2> loop = shape.loop(i);
    double twice = 0;
    for (std::size_t k = 2; k < loop.size(); ++k) {
      twice += cross(loop[k - 1] - loop[0], loop[k] - loop[0]);
    }
    sum += twice / 2;
  }
  return sum;
}

}  // namespace medial
