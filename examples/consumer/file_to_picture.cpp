// The axis of every polygon of a file, as a picture.
#include <medial/io/read.h>
#include <medial/io/write.h>
#include <medial/medial.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return std::puts("usage: file_to_picture POLYGONS PICTURE");
  const auto dataset = medial::io::read_dataset(argv[1]);
  if (!dataset) return std::puts(medial::to_string(dataset.error()).c_str());
  medial::Document<medial::AxisItem> axes;
  for (const medial::Feature& feature : dataset->items) {
    const auto shape = medial::build_shape(feature.rings);
    if (!shape) return std::puts(medial::to_string(shape.error()).c_str());
    const auto axis = medial::compute(*shape);
    if (!axis) return std::puts(medial::to_string(axis.error()).c_str());
    axes.items.push_back({*shape, *axis, feature.attributes});
  }
  const auto written = medial::io::write_axes(argv[2], "", axes);
  if (!written) return std::puts(medial::to_string(written.error()).c_str());
}
