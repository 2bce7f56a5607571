// The axis of every shape of a file, as a picture.
#include <medial/io/read.h>
#include <medial/io/write.h>
#include <medial/medial.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return std::puts("usage: file_to_picture SHAPES PICTURE");
  auto shapes = medial::io::load_shapes(argv[1]);
  if (!shapes) return std::puts(medial::to_string(shapes.error()).c_str());
  const auto axes = medial::compute_axes(std::move(*shapes));
  if (!axes) return std::puts(medial::to_string(axes.error()).c_str());
  const auto written = medial::io::write_axes(argv[2], "", *axes);
  if (!written) return std::puts(medial::to_string(written.error()).c_str());
}
