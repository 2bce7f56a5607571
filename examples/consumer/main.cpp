#include <medial/medial.h>

#include <cstdio>

int main() {
  const medial::Ring ring{{{0, 0}, {8, 0}, {8, 3}, {3, 3}, {3, 8}, {0, 8}}};
  const auto shape = medial::build_shape({&ring, 1});
  if (!shape) return std::puts(medial::to_string(shape.error()).c_str());
  const auto axis = medial::compute(*shape);
  if (!axis) return std::puts(medial::to_string(axis.error()).c_str());
  const medial::Disk deepest = medial::deepest_disk(*axis);
  std::printf("%zu edges, length %.4f, deepest disk of radius %.4f\n", axis->edges.size(),
              medial::total_length(*axis), deepest.radius);
}
