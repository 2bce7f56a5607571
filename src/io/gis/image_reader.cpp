#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "io/format.h"
#include "io/gis/gdal_support.h"
#include "io/gis/rasters.h"
#include "io/guarded.h"
#include "io/image_kind.h"
#include "io/place.h"
#include "io/ros_map_keys.h"
#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

namespace {

constexpr std::size_t png_header = 4096;  // what a PNG says of itself stands before
constexpr std::size_t longest_image = std::size_t{1} << 32U;

/// What the pixels of an image hold, as far as the choice of a threshold needs it.
class Values {
 public:
  void add(double value) {
    if (value == last_ || std::isnan(value)) return;
    last_ = value;
    if (different_ < 3 &&
        std::find(some_.begin(), some_.begin() + different_, value) == some_.begin() + different_)
      some_[static_cast<std::size_t>(different_++)] = value;
    largest_ = std::max(largest_, value);
  }
  /// A mask of zeros and ones has its foreground in the ones.
  bool is_mask() const { return largest_ == 1 && different_ <= 2; }
  std::vector<std::string> notes(double threshold) const {
    if (different_ < 3) return {};
    return {
        fmt::format("the image has more than two values: pixels of at least {:g} are its "
                    "foreground; --threshold chooses another, --labels makes a feature of each "
                    "value above 0",
                    threshold)};
  }

 private:
  std::array<double, 3> some_{};
  int different_ = 0;
  double largest_ = 0;
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

/// The values of all pixels, row by row; 0 is background.
using Labels = std::vector<std::uint32_t>;

Error too_large_image(std::uint64_t width, std::uint64_t height) {
  return {ErrorCode::too_large,
          fmt::format("{} x {} pixels: the diagonal must be below 2^16 pixels", width, height),
          {}};
}

/// An image that takes memory as its rows come: a header may promise more than there is.
class GrowingImage {
 public:
  GrowingImage() = default;
  GrowingImage(std::uint64_t width, std::uint64_t height)
      : width_(static_cast<std::uint32_t>(width)), height_(static_cast<std::uint32_t>(height)) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Requires that no row further down has been set.
  void set(std::uint32_t x, std::uint32_t y) {
    while (rows_.size() <= y) rows_.emplace_back((std::size_t{width_} + 63) / 64);
    rows_[y][x / 64] |= std::uint64_t{1} << (x % 64);
  }
  Image finish() && {
    Image image(width_, height_);
    for (std::uint32_t y = 0; y < rows_.size(); ++y) {
      std::ranges::copy(rows_[y], image.row(y).begin());
      rows_[y] = {};
    }
    return image;
  }

 private:
  std::uint32_t width_ = 0, height_ = 0;
  std::vector<std::vector<std::uint64_t>> rows_;
};

/// Portable bitmaps and graymaps, plain and raw.
class PnmReader {
 public:
  PnmReader(TextSource& source, const ImageOptions& options) : source_(source), options_(options) {}

  Result<ImageFile> read(Labels& labels) {
    if (Status read = read_values(); !read) return std::move(read).error();
    ImageFile file;
    file.image = std::move(image_).finish();
    if (values_.empty()) return file;
    Values seen;
    std::ranges::for_each(values_, [&](std::uint16_t value) { seen.add(value); });
    if (!options_.threshold && seen.is_mask()) threshold_ = 1;
    if (!options_.threshold && !options_.labels) file.notes = seen.notes(threshold_);
    if (options_.labels) labels.assign(values_.begin(), values_.end());
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (options_.labels ? values_[i] > 0 : is_foreground(values_[i]))
        file.image.set(static_cast<std::uint32_t>(i % file.image.width()),
                       static_cast<std::uint32_t>(i / file.image.width()));
    return file;
  }

 private:
  /// Bitmaps into image_, graymaps into values_.
  Status read_values() {
    source_.skip();
    const char kind = static_cast<char>(source_.peek());
    source_.skip();
    const bool bits = kind == '1' || kind == '4';
    std::uint64_t width = 0, height = 0, largest = 1;
    if (!read_count(width) || !read_count(height) || (!bits && !read_count(largest)))
      return source_.error(ErrorCode::malformed, "the header is broken");
    if (width == 0 || height == 0) return source_.error(ErrorCode::malformed, "without any pixel");
    if (!fits_image(width, height)) return too_large_image(width, height);
    if (largest == 0 || largest > 65535)
      return source_.error(ErrorCode::malformed, "the largest value must be in [1, 65535]");
    threshold_ = options_.threshold.value_or(0.5 * static_cast<double>(largest + 1));
    image_ = GrowingImage(width, height);
    return kind == '1' || kind == '2' ? read_plain(bits, largest) : read_raw(bits, largest);
  }

  bool is_foreground(double value) const { return (value >= threshold_) != options_.invert; }

  void skip_space_and_comments() {
    source_.skip_space();
    while (source_.peek() == '#') {
      while (source_.peek() != -1 && source_.peek() != '\n') source_.skip();
      source_.skip_space();
    }
  }

  bool read_count(std::uint64_t& value) {
    skip_space_and_comments();
    if (source_.peek() < '0' || source_.peek() > '9') return false;
    value = 0;
    while (source_.peek() >= '0' && source_.peek() <= '9') {
      value = value * 10 + static_cast<std::uint64_t>(source_.peek() - '0');
      if (value > 1'000'000'000) return false;
      source_.skip();
    }
    return true;
  }

  Status read_plain(bool bits, std::uint64_t largest) {
    for (std::uint32_t y = 0; y < image_.height(); ++y) {
      for (std::uint32_t x = 0; x < image_.width(); ++x) {
        std::uint64_t value = 0;
        if (bits) {  // digits need nothing between them
          skip_space_and_comments();
          if (source_.peek() != '0' && source_.peek() != '1')
            return source_.error(ErrorCode::malformed,
                                 "expected 0 or 1 instead of " + source_.next_as_text());
          value = source_.peek() == '1';
          source_.skip();
        } else if (!read_count(value) || value > largest) {
          return source_.error(ErrorCode::malformed, "expected a value up to the largest one");
        }
        put(bits, static_cast<std::uint16_t>(value), x, y);
      }
    }
    return success();
  }

  void put(bool bits, std::uint16_t value, std::uint32_t x, std::uint32_t y) {
    if (!bits)
      values_.push_back(value);
    else if (is_foreground(value))
      image_.set(x, y);
  }

  Status read_raw(bool bits, std::uint64_t largest) {
    if (source_.peek() == -1)
      return source_.error(ErrorCode::malformed, "the file ends in its header");
    source_.skip();
    const std::size_t value_bytes = bits ? 0 : largest > 255 ? 2 : 1;
    const std::size_t row_bytes =
        bits ? (std::size_t{image_.width()} + 7) / 8 : value_bytes * image_.width();
    std::string bytes;
    source_.read_all(bytes, row_bytes * image_.height());
    if (source_.failure()) return *source_.failure();
    if (bytes.size() < row_bytes * image_.height())
      return source_.error(ErrorCode::malformed, "the file ends before its last pixel");
    for (std::uint32_t y = 0; y < image_.height(); ++y) {
      const auto* const row = reinterpret_cast<const unsigned char*>(bytes.data()) + y * row_bytes;
      for (std::uint32_t x = 0; x < image_.width(); ++x) {
        const unsigned value = bits               ? row[x / 8] >> (7 - x % 8) & 1U
                               : value_bytes == 1 ? row[x]
                                                  : row[2UL * x] * 256U + row[2UL * x + 1];
        put(bits, static_cast<std::uint16_t>(value), x, y);
      }
    }
    return success();
  }

  TextSource& source_;
  const ImageOptions& options_;
  double threshold_ = 0;
  GrowingImage image_;
  std::vector<std::uint16_t> values_;
};

constexpr const char* unreadable = "its pixels cannot be read";

/// The bands of a raster, and how they tell foreground.
class Bands {
 public:
  Bands(GDALDataset& dataset, const ImageOptions& options) : options_(options) {
    const int count = dataset.GetRasterCount();
    int channels = 0;
    for (int i = 1; i <= count; ++i) {
      GDALRasterBand* const band = dataset.GetRasterBand(i);
      if (band->GetColorInterpretation() == GCI_AlphaBand) {
        alpha_ = band;
        continue;
      }
      ++channels;
      if (colors_.size() < 3) colors_.push_back(band);
    }
    if (colors_.size() == 2) colors_.pop_back();
    if (colors_.empty()) return;
    if (channels != static_cast<int>(colors_.size()))
      notes_.push_back(fmt::format(
          "the image has {} channels: {}", channels,
          channels == 2 ? "the first is read" : "the first three are taken for colours"));
    if (const int pages = CSLCount(dataset.GetMetadata("SUBDATASETS")) / 2; pages > 1)
      notes_.push_back(fmt::format("the file has {} pages: the first is read", pages));
    table_ = colors_[0]->GetColorTable();
    const char* ones_are_black = dataset.GetMetadataItem("MINISWHITE", "IMAGE_STRUCTURE");
    if (ones_are_black != nullptr && EQUAL(ones_are_black, "YES") && table_ != nullptr &&
        half_range(*colors_[0]) == 1) {
      table_ = nullptr;
      notes_.emplace_back(
          "the set bits of this image of one bit are its foreground, though they are drawn black; "
          "--invert takes the others");
    }
    nodata_ = colors_[0]->GetNoDataValue(&has_nodata_);
    threshold_ = options.threshold.value_or(default_threshold());
  }

  bool usable() const {
    return !colors_.empty() && GDALDataTypeIsComplex(colors_[0]->GetRasterDataType()) == 0;
  }

  /// Whether the rows [y, y + count) could be read into the image.
  bool read(int y, int count, GrowingImage& image) {
    const auto width = static_cast<int>(image.width());
    const std::size_t pixels = image.width() * static_cast<std::size_t>(count);
    values_.resize(pixels);
    if (colors_.size() == 1) {
      if (!read_band(*colors_[0], y, count, width, values_)) return false;
    } else {
      std::fill(values_.begin(), values_.end(), 0);
      constexpr std::array luminance = {0.299, 0.587, 0.114};
      for (std::size_t c = 0; c < colors_.size(); ++c) {
        if (!read_band(*colors_[c], y, count, width, part_)) return false;
        for (std::size_t i = 0; i < pixels; ++i) values_[i] += luminance[c] * part_[i];
      }
    }
    if (alpha_ != nullptr && !read_band(*alpha_, y, count, width, part_)) return false;
    for (std::size_t i = 0; i < pixels; ++i) {
      if (alpha_ != nullptr && part_[i] < half_alpha()) continue;
      if (!is_nodata(values_[i])) seen_.add(luminance_of(values_[i]));
      if (!is_foreground(values_[i])) continue;
      image.set(static_cast<std::uint32_t>(i % image.width()),
                static_cast<std::uint32_t>(y) + static_cast<std::uint32_t>(i / image.width()));
    }
    return true;
  }

  /// Whether the image was a mask of zeros and ones, which must be read again.
  bool has_become_mask() {
    if (options_.threshold || options_.labels || threshold_ <= 1 || !seen_.is_mask()) return false;
    threshold_ = 1;
    return true;
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all = notes_;
    if (!options_.threshold && !options_.labels)
      std::ranges::move(seen_.notes(threshold_), std::back_inserter(all));
    if (negative_ > 0)
      all.push_back(fmt::format("{} pixel{} below 0, which count as background", negative_,
                                negative_ == 1 ? " has a value" : "s have values"));
    return all;
  }
  bool hold_labels() const { return colors_.size() == 1; }

  /// Appends the values of the first band. Returns what is wrong, or null.
  const char* append_labels(int y, int count, int width, Labels& labels) {
    if (!read_band(*colors_[0], y, count, width, part_)) return unreadable;
    for (const double value : part_) {
      const bool nothing = is_nodata(value) || value <= 0;
      if (!nothing && !(value == std::floor(value) && value < 4294967296.0))
        return "labels are whole numbers below 2^32, and a pixel has another value";
      negative_ += value < 0 && !is_nodata(value) ? 1 : 0;
      labels.push_back(nothing ? 0 : static_cast<std::uint32_t>(value));
    }
    return nullptr;
  }

 private:
  static bool read_band(GDALRasterBand& band, int y, int count, int width,
                        std::vector<double>& values) {
    values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(count));
    return band.RasterIO(GF_Read, 0, y, width, count, values.data(), width, count, GDT_Float64, 0,
                         0, nullptr) == CE_None;
  }

  /// Half of one more than the largest value of a type.
  static double half_range(GDALRasterBand& band) {
    if (const char* bits = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE"))
      return std::ldexp(0.5, std::clamp(std::atoi(bits), 1, 32));
    switch (band.GetRasterDataType()) {
      case GDT_Byte:
        return 128;
      case GDT_UInt16:
      case GDT_Int16:
        return 32768 / (band.GetRasterDataType() == GDT_Int16 ? 2.0 : 1.0);
      default:
        return 0.5;
    }
  }
  double default_threshold() const { return table_ != nullptr ? 128 : half_range(*colors_[0]); }
  double half_alpha() const { return half_range(*alpha_); }

  bool is_nodata(double value) const {
    if (has_nodata_ != 0 && value == nodata_ && table_ == nullptr) return true;
    return std::isnan(value);
  }
  /// The luminance of a value, by the table of colours if there is one; NaN where transparent.
  double luminance_of(double value) const {
    if (table_ == nullptr) return value;
    const GDALColorEntry* entry = value >= 0 && value < table_->GetColorEntryCount()
                                      ? table_->GetColorEntry(static_cast<int>(value))
                                      : nullptr;
    if (entry == nullptr || entry->c4 < 128) return std::numeric_limits<double>::quiet_NaN();
    return 0.299 * entry->c1 + 0.587 * entry->c2 + 0.114 * entry->c3;
  }
  bool is_foreground(double value) const {
    if (is_nodata(value)) return false;
    if (options_.labels) return value > 0;
    value = luminance_of(value);
    return !std::isnan(value) && (value >= threshold_) != options_.invert;
  }

  const ImageOptions& options_;
  std::vector<GDALRasterBand*> colors_;
  GDALRasterBand* alpha_ = nullptr;
  const GDALColorTable* table_ = nullptr;
  double nodata_ = 0;
  int has_nodata_ = 0;
  double threshold_ = 0;
  Values seen_;
  std::uint64_t negative_ = 0;  ///< labels
  std::vector<std::string> notes_;
  std::vector<double> values_, part_;
};

/// What a PNG says of its resolution, before its first pixels (the chunk pHYs).
double dots_per_inch_of_png(std::string_view bytes) {
  using namespace std::string_view_literals;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  constexpr std::size_t signature = 8, frame = 12, header = 8, size = 9;
  constexpr double inches_per_metre = 1 / 0.0254;
  if (!bytes.starts_with("\x89PNG"sv)) return 0;
  for (std::size_t at = signature; at + header + size <= bytes.size(); at += frame + number(at)) {
    const std::string_view name = bytes.substr(at + 4, 4), data = bytes.substr(at + header);
    if (name == "IDAT") break;
    if (name != "pHYs" || data[size - 1] != 1) continue;
    const std::uint32_t across = number(at + header), down = number(at + header + 4);
    return across == down ? across / inches_per_metre : 0;
  }
  return 0;
}

/// How many of the lengths that ImageJ names in the description of a TIFF are in an inch.
double per_inch_of_imagej(std::string_view description) {
  const auto begin = description.find("\nunit=");
  if (!description.starts_with("ImageJ=") || begin == std::string_view::npos) return 0;
  std::string name(description.substr(begin + 6, description.find('\n', begin + 1) - begin - 6));
  if (name == "micron" || name == "\\u00B5m" || name == "\xc2\xb5m" || name == "\xb5m") name = "um";
  if (name == "inch") name = "in";
  const auto unit = unit_of(name == "nm" ? "um" : name);
  if (!unit || *unit == Unit::css_pixel) return 0;
  return millimetres(Unit::inch) / millimetres(*unit) * (name == "nm" ? 1000 : 1);
}

/// What a TIFF says of its resolution.
double dots_per_inch_of(GDALDataset& dataset) {
  const auto item = [&dataset](const char* name) {
    const char* text = dataset.GetMetadataItem(name);
    return std::string(text == nullptr ? "" : text);
  };
  const std::string across = item("TIFFTAG_XRESOLUTION"), unit = item("TIFFTAG_RESOLUTIONUNIT");
  if (across.empty() || unit.empty() || across != item("TIFFTAG_YRESOLUTION")) return 0;
  const double dots = CPLAtof(across.c_str());
  constexpr double centimetres_per_inch = 2.54;
  if (unit[0] == '2') return dots;
  if (unit[0] == '3') return dots * centimetres_per_inch;
  return dots * per_inch_of_imagej(item("TIFFTAG_IMAGEDESCRIPTION"));
}

/// Reads all rows into the image and, if asked for, the labels. Returns what is wrong, or null.
const char* read_rows(Bands& bands, const ImageOptions& options, GrowingImage& image,
                      Labels& labels) {
  constexpr int rows_at_once = 64;
  const auto width = static_cast<int>(image.width()), height = static_cast<int>(image.height());
  for (int y = 0; y < height; y += rows_at_once) {
    const int count = std::min(rows_at_once, height - y);
    if (!bands.read(y, count, image)) return unreadable;
    if (!options.labels) continue;
    if (const char* problem = bands.append_labels(y, count, width, labels)) return problem;
  }
  return nullptr;
}

Result<ImageFile> read_raster(const std::string& name, const ImageOptions& options,
                              Labels& labels) {
  register_gdal();
  const GdalMessages messages;
  const auto failure = [&messages](const char* otherwise) {
    return messages.failure().empty() ? std::string(otherwise) : messages.failure();
  };
  const char* const drivers[] = {"PNG", "GTiff", "JPEG", "BMP", "WEBP", "GIF", nullptr};
  const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(
      name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, drivers));
  if (!dataset) return Error{ErrorCode::malformed, failure("this is not an image"), {}};
  const auto width = static_cast<std::uint64_t>(dataset->GetRasterXSize());
  const auto height = static_cast<std::uint64_t>(dataset->GetRasterYSize());
  if (!fits_image(width, height)) return too_large_image(width, height);
  ImageFile file;
  Bands bands(*dataset, options);
  if (!bands.usable()) return Error{ErrorCode::unsupported, "its pixels are not numbers", {}};
  if (options.labels && !bands.hold_labels())
    return Error{
        ErrorCode::unsupported, "labels need an image of one channel; this one has colours", {}};
  do {
    GrowingImage image(width, height);
    const char* problem = read_rows(bands, options, image, labels);
    if (problem != nullptr || !messages.failure().empty())
      return Error{ErrorCode::malformed, failure(problem), {}};
    file.image = std::move(image).finish();
  } while (bands.has_become_mask());
  PixelPlacement placement = unplaced;
  if (dataset->GetGeoTransform(placement.data()) == CE_None) {
    if (!std::ranges::all_of(placement, [](double t) { return std::isfinite(t); }) ||
        placement[1] * placement[5] == placement[2] * placement[4])
      return Error{ErrorCode::malformed, "the placement of its pixels is degenerate", {}};
    file.placement = placement;
  }
  if (const OGRSpatialReference* reference = dataset->GetSpatialRef()) {
    Document<Feature> described;
    set_crs(*reference, described);
    file.crs_wkt = std::move(described.crs_wkt);
    file.geographic = described.geographic;
  }
  file.dots_per_inch = dots_per_inch_of(*dataset);
  file.notes = messages.warnings();
  std::ranges::move(bands.notes(), std::back_inserter(file.notes));
  return file;
}

Result<ImageFile> read_pixels(const Input& input, const ImageOptions& options, Labels& labels) {
  TextSource& source = *input.source;
  const std::string_view beginning = source.lookahead(image_sniffed);
  if (source.failure()) return *source.failure();
  if (begins_like_pnm(beginning)) return PnmReader(source, options).read(labels);
  if (beginning.empty()) return Error{ErrorCode::empty, "there is nothing to read", {}};
  if (!begins_like_raster(beginning))
    return Error{
        ErrorCode::unsupported, "this is not a PNG, JPEG, BMP, WebP, GIF, TIFF, PBM or PGM", {}};
  const double dots = dots_per_inch_of_png(source.lookahead(png_header));
  const auto read = [&](const std::string& name) {
    Result<ImageFile> file = read_raster(name, options, labels);
    if (file && dots > 0) file->dots_per_inch = dots;
    return file;
  };
  if (!source.is_stream()) return read(input.path);
  std::string bytes;
  source.read_all(bytes, longest_image);
  if (bytes.size() > longest_image)
    return Error{ErrorCode::too_large, "more than 4 GiB in a stream", {}};
  const MemoryFile file(bytes);
  if (file.name().empty()) return Error{ErrorCode::unreadable, "cannot be kept in memory", {}};
  return read(file.name());
}

/// Whether most pixels at the edge of the image are foreground, as around a dark shape.
bool surrounds(const Image& image) {
  const std::int64_t width = image.width(), height = image.height();
  std::int64_t inside = 0;
  for (std::int64_t x = 0; x < width; ++x) inside += image.at(x, 0) + image.at(x, height - 1);
  for (std::int64_t y = 0; y < height; ++y) inside += image.at(0, y) + image.at(width - 1, y);
  return inside > width + height;
}

/// An image with a foreground.
Result<ImageFile> read_foreground(const Input& input, const ImageOptions& options, Labels& labels) {
  return guarded(input.path, [&]() -> Result<ImageFile> {
    Result<ImageFile> file = read_pixels(input, options, labels);
    if (file && file->image.count() == 0)
      return Error{ErrorCode::empty,
                   options.invert ? "no pixel is below the threshold, so there is no foreground"
                                  : "no pixel reaches the threshold, so there is no foreground; "
                                    "--threshold chooses another, --invert takes dark pixels, "
                                    "--labels makes a feature of each value above 0",
                   {}};
    const bool chosen = options.threshold || options.invert || options.labels;
    if (file && !chosen && surrounds(file->image))
      file->notes.emplace_back(
          "most pixels at the edge of the image are foreground; if the shape is the rest, add "
          "--invert");
    return file;
  });
}

Result<Document<Feature>> read_outline(const Input& input, const ReadOptions& options) {
  if (options.repair != RepairRule::none)
    return Error{ErrorCode::invalid_option, "--repair is not for images", in_file(input.path)};
  Labels labels;
  Result<ImageFile> file = read_foreground(input, options.image, labels);
  if (!file) return file.error();
  return outline_document(std::move(*file), labels, options);
}

}  // namespace

Format image_format() {
  Format format;
  format.read = read_outline;
  format.reads_images = true;
  return format;
}

Result<ImageFile> read_image(const std::string& path, const ImageOptions& options) {
  const TextSource::Reading reading(path);
  Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  if (!source) return source.error();
  if (options.labels)
    return Error{ErrorCode::invalid_option, "labels make features, not one image", in_file(path)};
  if (is_ros_map(path)) return read_ros_image(path, **source, options);
  Labels none;
  return read_foreground({path, *source}, options, none);
}

}  // namespace medial::io
