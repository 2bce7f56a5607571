// medial_edits: many random edits of 20 shapes by medial::Editor, of vertices, of loops and of
// arcs, compared with what compute() makes of the edited shape: of small shapes after every edit,
// of large ones after every thousandth. Random moves let a shape grow without end: once it is a
// hundred times as large as in the beginning, the first shape is taken again. Times are
// processor times.
//
//   medial_edits [EDITS] [FIRST] [COUNT] [KINDS] [SEED]
//
// Default: 100000 edits of each of the 20 shapes and of all three kinds (0, 1 and 2; -1), seed 0.
//
// Prints Markdown. Exit status 1 where an axis differs, or where an edit fails by a fault of ours.

#include "support/edits.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "medial/editor.h"
#include "support/generate.h"

namespace {

using namespace medial;

struct Case {
  const char* name;
  test::Rings rings;
};

Case shape_of_case(std::uint64_t i) {
  test::Random random(i);
  switch (i) {
    case 0:
      return {"triangle", test::triangle({0, 0}, {40, 0}, {10, 30})};
    case 1:
      return {"rectangle", test::rectangle(40, 20)};
    case 2:
      return {"cross", test::cross_shape(10)};
    case 3:
      return {"comb", test::comb(12)};
    case 4:
      return {"blob", test::blob(40)};
    case 5:
      return {"jagged star", test::jagged_star(40)};
    case 6:
      return {"maze", test::maze(60)};
    case 7:
      return {"square holes", test::hole_grid(3)};
    case 8:
      return {"nested squares", test::nested_squares(4)};
    case 9:
      return {"spiral", test::spiral(60)};
    case 10:
      return {"star with holes", test::star_with_holes(random, 30, 2)};
    case 11:
      return {"regular polygon", test::regular_polygon(30, 10)};
    case 12:
      return {"comb", test::comb(2500)};
    case 13:
      return {"blob", test::blob(10000)};
    case 14:
      return {"jagged star", test::jagged_star(10000)};
    case 15:
      return {"maze", test::maze(10000)};
    case 16:
      return {"square holes", test::hole_grid(50)};
    case 17:
      return {"spiral", test::spiral(10000)};
    case 18:
      return {"star with holes", test::star_with_holes(random, 10000, 10)};
    default:
      return {"maze", test::maze(100000)};
  }
}

/// The milliseconds that this share of the edits takes at most.
double milliseconds_at(std::vector<std::clock_t>& ticks, double share) {
  const auto at =
      ticks.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(ticks.size() - 1));
  std::nth_element(ticks.begin(), at, ticks.end());
  return 1e3 * static_cast<double>(*at) / CLOCKS_PER_SEC;
}

/// Whether all went well.
bool run(std::uint64_t number, int count, test::EditKinds kinds, std::uint64_t seed) {
  const Case one = shape_of_case(number);
  const auto shape = build_shape(one.rings);
  auto editor = shape ? Editor::make(*shape) : Result<Editor>(shape.error());
  if (!editor) {
    std::printf("%s: %s\n", one.name, to_string(editor.error()).c_str());
    return false;
  }
  constexpr std::size_t small = 200;
  constexpr int seldom = 1000;
  const int interval = shape->points.size() <= small ? 1 : seldom;
  constexpr double growth = 100;
  const double largest = growth * diagonal(bounding_box(*shape));
  test::Edits edits(seed + number + 1, kinds);
  const auto first_vertices = static_cast<std::uint32_t>(shape->points.size());
  std::uint32_t vertices = first_vertices;
  int repaired = 0, whole = 0, refused = 0, compared = 0, restarts = 0;
  std::string fault;
  std::vector<std::clock_t> ticks;
  for (int i = 1; i <= count && fault.empty(); ++i) {
    const std::clock_t begin = std::clock();
    const auto change = edits.next(*editor, vertices);
    ticks.push_back(std::clock() - begin);
    if (!change && change.error().code == ErrorCode::internal) fault = to_string(change.error());
    ++(!change ? refused : change->everything ? whole : repaired);
    if ((change || interval > 1) && (i % interval == 0 || i == count) && fault.empty()) {
      fault = test::fault_of(*editor);
      ++compared;
    }
    if (i % interval == 0 && diagonal(bounding_box(editor->shape())) > largest) {
      editor = Editor::make(*shape);
      vertices = first_vertices;
      ++restarts;
    }
    if (!fault.empty()) fault = "edit " + std::to_string(i) + ": " + fault;
  }
  constexpr const char* names[] = {"vertices", "loops", "arcs"};
  std::printf("| %s | %s | %zu | %d | %d | %d | %d | %d | %.3f | %.3f | %s |\n", one.name,
              names[static_cast<std::size_t>(kinds)], shape->points.size(), repaired, whole,
              refused, compared, restarts, milliseconds_at(ticks, 0.5),
              milliseconds_at(ticks, 0.99), fault.empty() ? "none" : fault.c_str());
  std::fflush(stdout);
  return fault.empty();
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int shapes = 20;
  const auto number = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  const int count = number(1, 100000), first = number(2, 0), last = first + number(3, shapes);
  std::printf(
      "| shape | edits of | vertices | repaired | all computed | refused | compared | restarts | "
      "median, ms | 99 %% | differences |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|---|\n");
  bool is_right = true;
  const int only = number(4, -1);
  const auto seed = static_cast<std::uint64_t>(number(5, 0));
  for (int kinds = std::max(only, 0); kinds <= (only < 0 ? 2 : only); ++kinds)
    for (int i = first; i < last && i < shapes; ++i)
      is_right =
          run(static_cast<std::uint64_t>(i), count, static_cast<test::EditKinds>(kinds), seed) &&
          is_right;
  return is_right ? 0 : 1;
}
