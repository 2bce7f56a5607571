// Pixels as .png. For each row, Cairo would choose one of the filters that photographs need: that
// takes longer than most axes, and files of lines on paper become larger.

#include <png.h>

#include <csetjmp>
#include <vector>

#include "io/pictures/viewport.h"

namespace medial::io {

namespace {

void put(png_structp png, png_bytep bytes, std::size_t count) {
  auto* out = static_cast<OutputStream*>(png_get_io_ptr(png));
  out->put(std::string_view(reinterpret_cast<const char*>(bytes), count));
  if (out->failed()) png_error(png, "no room");
}

/// libpng would print otherwise.
[[noreturn]] void fail(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void be_silent(png_structp, png_const_charp) {}

/// Whether the rows of an image could be written.
bool put_rows(png_structp png, png_infop info, cairo_surface_t* surface, png_bytep row) {
  // libpng jumps back here from an error: nothing that has to be destroyed is made below.
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const int columns = cairo_image_surface_get_width(surface);
  const int rows = cairo_image_surface_get_height(surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
  const unsigned char* const pixels = cairo_image_surface_get_data(surface);
  png_set_IHDR(png, info, static_cast<png_uint_32>(columns), static_cast<png_uint_32>(rows), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_write_info(png, info);
  for (int y = 0; y < rows; ++y) {
    const auto* from = reinterpret_cast<const std::uint32_t*>(pixels + y * stride);
    for (int x = 0; x < columns; ++x)
      for (int k = 0; k < 3; ++k) row[3 * x + k] = static_cast<png_byte>(from[x] >> (16 - 8 * k));
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

Status write_png(OutputStream& out, cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  std::vector<png_byte> row(3 * static_cast<std::size_t>(cairo_image_surface_get_width(surface)));
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, be_silent);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (png != nullptr) png_set_write_fn(png, &out, put, nullptr);
  const bool done = info != nullptr && put_rows(png, info, surface, row.data());
  png_destroy_write_struct(&png, &info);
  if (done || out.failed()) return success();
  return Error{ErrorCode::unwritable, "cannot write the picture", {}};
}

}  // namespace medial::io
