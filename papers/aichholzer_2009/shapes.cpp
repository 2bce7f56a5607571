#include "papers/aichholzer_2009/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <random>

namespace medial::papers {
namespace {

constexpr double pi = std::numbers::pi;

/// A closed uniform cubic B-spline: the control polygon's first three vertices come again at its
/// end.
Contour closed_spline(std::vector<Vec2> control) {
  for (std::size_t i = 0; i < 3; ++i) control.push_back(control[i]);
  std::vector<double> knots(control.size() + 4);
  for (std::size_t i = 0; i < knots.size(); ++i) knots[i] = static_cast<double>(i);
  Contour contour;
  (void)contour.spline_to(3, knots, control);  // cannot fail: the knots increase
  return contour;
}

/// Random numbers in [-1, 1) that are the same with every standard library.
class Noise {
 public:
  double next() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1; }

 private:
  std::mt19937_64 engine_{20081125};
};

/// Appends the outline of a twig and of all twigs on it, from the right of its foot to the left.
/// A twig is 0.37 of the length of what bears it, give or take: all that grows on it stays within
/// 0.61 of its length around its tip, while the tips of neighbours, 65 degrees apart, are 1.07 of
/// it away from each other; that leaves hardly a place where they could meet, and none that is met.
void grow(std::vector<Vec2>& outline, Vec2 foot, double angle, double length, int depth,
          Noise& noise) {
  const Vec2 along{std::cos(angle), std::sin(angle)};
  const Vec2 tip = foot + length * along;
  const Vec2 aside = 0.07 * length * left_of(along);
  outline.push_back(foot + 0.2 * length * along - aside);
  if (depth == 0) {
    outline.push_back(tip - 2.0 * aside);  // a leaf: wider than its stalk
    outline.push_back(tip + 2.0 * aside);
  } else {
    outline.push_back(foot + 0.75 * length * along - aside);
    for (int side = -1; side <= 1; ++side) {
      const double turn = (65 * side + 3 * noise.next()) * pi / 180;
      grow(outline, tip, angle + turn, (0.37 + 0.01 * noise.next()) * length, depth - 1, noise);
    }
    outline.push_back(foot + 0.75 * length * along + aside);
  }
  outline.push_back(foot + 0.2 * length * along + aside);
}

/// Reads the letters below: M x y, L x y, C x y x y x y.
class Pen {
 public:
  explicit Pen(Vec2 origin) : origin_(origin) {}

  Pen& start(Vec2 p) {
    contours_.emplace_back().start_at(origin_ + p);
    return *this;
  }
  Pen& line(Vec2 p) {
    contours_.back().line_to(origin_ + p);
    return *this;
  }
  Pen& curve(Vec2 a, Vec2 b, Vec2 c) {
    contours_.back().bezier_to(std::array{origin_ + a, origin_ + b, origin_ + c});
    return *this;
  }
  void append_to(std::vector<Contour>& all) {
    std::move(contours_.begin(), contours_.end(), std::back_inserter(all));
  }

 private:
  Vec2 origin_;
  std::vector<Contour> contours_;
};

/// One word, 232 wide and 100 high.
void write_word(std::vector<Contour>& contours, Vec2 origin) {
  Pen c(origin);
  c.start({70, 100}).curve({30, 100}, {0, 80}, {0, 50}).curve({0, 20}, {30, 0}, {70, 0});
  c.line({70, 16}).curve({38, 16}, {16, 30}, {16, 50}).curve({16, 70}, {38, 84}, {70, 84});
  c.append_to(contours);
  Pen a(origin + Vec2{80, 0});
  a.start({0, 0}).curve({12, 30}, {22, 70}, {28, 100}).line({44, 100});
  a.curve({50, 70}, {60, 30}, {72, 0}).line({54, 0}).curve({52, 10}, {50, 18}, {47, 28});
  a.line({25, 28}).curve({22, 18}, {20, 10}, {18, 0});
  a.start({29, 42}).line({43, 42});
  a.curve({41, 54}, {39, 64}, {36, 76}).curve({33, 64}, {31, 54}, {29, 42});
  a.append_to(contours);
  Pen d(origin + Vec2{160, 0});
  d.start({0, 0}).line({30, 0}).curve({58, 0}, {72, 22}, {72, 50});
  d.curve({72, 78}, {58, 100}, {30, 100}).line({0, 100});
  d.start({16, 16}).line({30, 16}).curve({48, 16}, {56, 32}, {56, 50});
  d.curve({56, 68}, {48, 84}, {30, 84}).line({16, 84});
  d.append_to(contours);
}

}  // namespace

std::vector<Contour> tree(int depth) {
  std::vector<Vec2> outline;
  Noise noise;
  grow(outline, {0, 0}, pi / 2, 100, depth, noise);
  return {closed_spline(std::move(outline))};
}

std::vector<Contour> snowflake(int order) {
  std::vector<Vec2> polygon;
  for (int i = 0; i < 3; ++i) {
    polygon.push_back({100 * std::cos(2 * pi * i / 3), 100 * std::sin(2 * pi * i / 3)});
  }
  for (int level = 0; level < order; ++level) {
    std::vector<Vec2> finer;
    finer.reserve(4 * polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 from = polygon[i], way = polygon[(i + 1) % polygon.size()] - from;
      const Vec2 peak = from + 0.5 * way - (std::sqrt(3) / 6) * left_of(way);
      finer.insert(finer.end(), {from, from + (1.0 / 3) * way, peak, from + (2.0 / 3) * way});
    }
    polygon = std::move(finer);
  }
  return {closed_spline(std::move(polygon))};
}

std::vector<Contour> lettering(int lines) {
  std::vector<Contour> contours;
  for (int line = 0; line < lines; ++line) {
    for (int word = 0; word < lines; ++word) write_word(contours, {280.0 * word, 150.0 * line});
  }
  return contours;
}

std::vector<Contour> border(int level) {
  constexpr std::size_t corners = 8;
  std::vector<double> radius(corners, 100);
  Noise noise;
  double displacement = 25;
  while (radius.size() < (std::size_t{1} << level)) {
    std::vector<double> finer;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      const double middle = 0.5 * (radius[i] + radius[(i + 1) % radius.size()]);
      finer.insert(finer.end(), {radius[i], middle + displacement * noise.next()});
    }
    radius = std::move(finer);
    displacement *= 0.55;
  }
  const std::size_t count = radius.size(), part = count / corners;
  const auto point = [&](std::size_t i) {
    const double angle = 2 * pi * static_cast<double>(i % count) / static_cast<double>(count);
    return radius[i % count] * Vec2{std::cos(angle), std::sin(angle)};
  };
  Contour contour;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    std::vector<Vec2> control;
    for (std::size_t i = corner * part; i <= (corner + 1) * part; ++i) control.push_back(point(i));
    const std::size_t spans = control.size() - 3;
    std::vector<double> knots;
    for (std::size_t i = 0; i < control.size() + 4; ++i) {
      knots.push_back(static_cast<double>(std::clamp<std::size_t>(i, 3, 3 + spans) - 3));
    }
    (void)contour.spline_to(3, knots, control);  // cannot fail: the knots increase
  }
  return {contour};
}

std::string svg_document(const std::vector<Contour>& contours) {
  Box box = Box::nothing();
  std::string path;
  for (const Contour& contour : contours) {
    for (const Vec2 p : contour.points) box.add(p);
    fmt::format_to(std::back_inserter(path), "M{} {}", contour.points[0].x, contour.points[0].y);
    for (const CurvePiece& piece : contour.pieces) {
      path += piece.degree == 1 ? 'L' : 'C';
      for (std::uint32_t i = 1; i <= piece.degree; ++i) {
        const Vec2 p = contour.points[piece.first + i];
        fmt::format_to(std::back_inserter(path), "{}{} {}", i == 1 ? "" : " ", p.x, p.y);
      }
    }
    path += "Z\n";
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\">\n"
      "<path fill-rule=\"evenodd\" d=\"{}\"/>\n</svg>\n",
      box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y, path);
}

}  // namespace medial::papers
