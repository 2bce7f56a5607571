// Rows of shapefiles, put behind the headers that GDAL has written: GDAL's features take several
// times as long.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "io/format_name.h"
#include "io/gis/rows.h"
#include "io/output.h"

namespace medial::io {

namespace {

namespace fs = std::filesystem;

Error shapefile_error(const std::string& what) {
  return {ErrorCode::unwritable, "cannot write: " + what, {}};
}

/// Appends numbers as they lie in memory, which is little-endian, or the other way round.
template <class Number>
void put(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void put_big_endian(std::string& bytes, std::uint64_t number) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<char>(number >> shift & 0xff));
}

/// A file beside another, with this extension in small or large letters; as it would be if there is
/// none.
std::string beside(const fs::path& path, const std::string& extension) {
  const std::string name = lower_case(path.stem().string() + extension);
  std::error_code problem;
  for (fs::directory_iterator entry(path.parent_path(), problem), end; !problem && entry != end;
       entry.increment(problem))
    if (lower_case(entry->path().filename().string()) == name) return entry->path().string();
  return fs::path(path).replace_extension(extension).string();
}

Result<std::string> content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  return file.bad() || bytes.empty() ? Result<std::string>(shapefile_error("a part is missing"))
                                     : bytes;
}

/// Writes bytes into a closed file in place of those there.
Status patch(const std::string& path, std::uint64_t at, const std::string& bytes) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(at));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return file ? success() : Status(shapefile_error("the disk may be full"));
}

/// The table of attributes (.dbf): records of texts of fixed widths.
class AttributeTable {
 public:
  Status open(const std::string& path) {
    path_ = path;
    auto head = content_of(path);
    if (!head) return std::move(head).error();
    head_ = std::move(*head);
    const auto byte = [this](std::size_t i) { return static_cast<unsigned char>(head_[i]); };
    if (head_.size() < record_begin) return shapefile_error("a part is damaged");
    head_.resize(std::min(head_.size(), byte(8) + std::size_t{256} * byte(9)));
    for (std::size_t at = field_begin; at + field_size <= head_.size(); at += field_size)
      fields_.push_back({head_[at + 11], byte(at + 16), byte(at + 17)});
    return begin();
  }

  Status add(const Rows& rows, std::size_t row) {
    const std::span<const Rows::Field> values = rows.fields(row);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (const std::size_t width = wanted_width(rows, values[i]); width > fields_[i].width)
        if (Status widened = widen(i, width); !widened) return widened;
    record_.assign(1, ' ');  // not deleted
    for (std::size_t i = 0; i < values.size(); ++i) put_value(fields_[i], rows, values[i]);
    out_->put(std::string_view(record_));
    ++count_;
    return success();
  }

  Status close() {
    if (Status done = finish(); !done) return done;
    std::string count;
    put(count, count_);
    return patch(path_, 4, count);
  }

 private:
  static constexpr std::size_t field_begin = 32, field_size = 32, record_begin = 32;
  static constexpr std::size_t longest_text = 254;
  struct Width {
    char kind;
    std::size_t width;
    int decimals;
  };

  /// The header, as the fields are now.
  Status begin() {
    std::size_t record = 1;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      record += fields_[i].width;
      head_[field_begin + field_size * i + 16] = static_cast<char>(fields_[i].width);
    }
    if (record > std::numeric_limits<std::uint16_t>::max())
      return shapefile_error("a row of a shapefile has 65,535 bytes at most");
    head_[10] = static_cast<char>(record & 0xff);
    head_[11] = static_cast<char>(record >> 8);
    auto out = OutputStream::open(path_);
    if (!out) return std::move(out).error();
    out_.emplace(std::move(*out));
    out_->put(std::string_view(head_));
    return success();
  }
  Status finish() {
    out_->put('\x1a');
    return out_->finish();
  }

  /// A wider column: what is there is written again.
  Status widen(std::size_t field, std::size_t width) {
    if (Status done = finish(); !done) return done;
    std::ifstream file(path_, std::ios::binary);
    std::error_code problem;
    if (!fs::remove(path_, problem))
      return shapefile_error(problem.message());  // it stays readable
    std::size_t begin = 1, size = 1;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (i == field) begin = size;
      size += fields_[i].width;
    }
    const std::size_t end = begin + fields_[field].width, more = width - fields_[field].width;
    const bool is_text = fields_[field].kind == 'C';
    fields_[field].width = width;
    if (Status begun = this->begin(); !begun) return begun;
    file.seekg(static_cast<std::streamoff>(head_.size()));
    std::string record(size, ' ');
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!file.read(record.data(), static_cast<std::streamsize>(size)))
        return shapefile_error("a part cannot be read again");
      const bool is_nothing = !is_text && record[begin] == '*';
      const std::string filling(more, is_nothing ? '*' : ' ');
      const std::string_view all = record;
      out_->put(all.substr(0, is_text ? end : begin));
      out_->put(std::string_view(filling));
      out_->put(all.substr(is_text ? end : begin));
    }
    return success();
  }

  /// How much room a value needs; numbers with decimals get what there is.
  static std::size_t wanted_width(const Rows& rows, const Rows::Field& value) {
    if (value.kind == Rows::Kind::text) return length_of(rows.text(value));
    if (value.kind != Rows::Kind::whole || std::abs(value.whole) < 100'000'000'000'000'000)
      return 0;
    return std::to_string(value.whole).size();
  }
  /// The bytes of a text that fit, without a part of a character.
  static std::size_t length_of(const char* text) {
    std::size_t length = std::strlen(text);
    if (length <= longest_text) return length;
    length = longest_text;
    while (length > 0 && (text[length] & 0xc0) == 0x80) --length;
    return length;
  }

  void put_value(const Width& field, const Rows& rows, const Rows::Field& value) {
    std::array<char, 512> digits{};
    std::string_view text;
    bool is_nothing = value.kind == Rows::Kind::nothing;
    if (value.kind == Rows::Kind::text) {
      const char* words = rows.text(value);
      text = {words, length_of(words)};
    } else if (value.kind == Rows::Kind::whole) {
      text = up_to(digits, std::to_chars(digits.begin(), digits.end(), value.whole).ptr);
    } else if (value.kind == Rows::Kind::real) {
      is_nothing = !std::isfinite(value.real);
      text = up_to(digits, std::to_chars(digits.begin(), digits.end(), value.real,
                                         std::chars_format::fixed, field.decimals)
                               .ptr)
                 .substr(0, field.width);
    }
    const bool is_number = field.kind != 'C';
    if (is_nothing) {
      record_.append(field.width, is_number ? '*' : ' ');
      return;
    }
    const std::size_t room = field.width - text.size();
    if (is_number) record_.append(room, ' ');
    record_.append(text);
    if (!is_number) record_.append(room, ' ');
  }
  static std::string_view up_to(const std::array<char, 512>& digits, const char* end) {
    return {digits.data(), static_cast<std::size_t>(end - digits.data())};
  }

  std::string path_, head_, record_;
  std::vector<Width> fields_;
  std::optional<OutputStream> out_;
  std::uint32_t count_ = 0;
};

/// The geometries (.shp) and where each of them begins (.shx).
class GeometryFile {
 public:
  Status open(const std::string& path, const std::string& index_path) {
    for (auto [file, name] : {std::pair(&shapes_, &path), std::pair(&index_, &index_path)}) {
      file->path = *name;
      auto head = content_of(*name);
      if (!head) return std::move(head).error();
      if (head->size() != head_size) return shapefile_error("a part is damaged");
      auto out = OutputStream::open(*name);
      if (!out) return std::move(out).error();
      file->out.emplace(std::move(*out));
      file->out->put(std::string_view(*head));
    }
    return success();
  }

  Status add(GeometryKind kind, const Rows& rows, std::size_t row) {
    make(kind, rows, row);
    constexpr std::uint64_t most = std::uint64_t{std::numeric_limits<std::int32_t>::max()} * 2;
    if (shapes_.size + content_.size() + 8 > most)
      return shapefile_error("a shapefile has 4 GB at most; .gpkg and .fgb have no such limit");
    head_.clear();
    put_big_endian(head_, shapes_.size / 2);
    put_big_endian(head_, content_.size() / 2);
    index_.put(head_);
    head_.clear();
    put_big_endian(head_, ++count_);
    put_big_endian(head_, content_.size() / 2);
    shapes_.put(head_);
    shapes_.put(content_);
    return success();
  }

  Status close() {
    for (Part* file : {&shapes_, &index_}) {
      if (Status done = file->out->finish(); !done) return done;
      if (count_ == 0) continue;
      std::string size, extent;
      put_big_endian(size, file->size / 2);
      for (const double bound : {extent_.low.x, extent_.low.y, extent_.high.x, extent_.high.y})
        put(extent, bound);
      if (Status told = patch(file->path, 24, size); !told) return told;
      if (Status told = patch(file->path, 36, extent); !told) return told;
    }
    return success();
  }

 private:
  static constexpr std::size_t head_size = 100;
  struct Part {
    std::string path;
    std::optional<OutputStream> out;
    std::uint64_t size = head_size;

    void put(const std::string& bytes) {
      out->put(std::string_view(bytes));
      size += bytes.size();
    }
  };

  void make(GeometryKind kind, const Rows& rows, std::size_t row) {
    content_.clear();
    const std::size_t rings = rows.ring_count(row);
    Box box = Box::nothing();
    for (std::size_t i = 0; i < rings; ++i)
      for (const OGRRawPoint& p : rows.ring(row, i)) box.add(Vec2{p.x, p.y});
    extent_.add(box);
    put(content_, std::uint32_t{kind == GeometryKind::point  ? 1U
                                : kind == GeometryKind::line ? 3U
                                                             : 5U});
    if (kind == GeometryKind::point) return put_points(rows.ring(row, 0).first(1));
    for (const double bound : {box.low.x, box.low.y, box.high.x, box.high.y}) put(content_, bound);
    put(content_, static_cast<std::uint32_t>(rings));
    const bool closes = kind == GeometryKind::polygon;
    const auto size_of = [&](std::size_t i) {
      const auto ring = rows.ring(row, i);
      return ring.size() + (closes && is_open(ring) ? 1 : 0);
    };
    std::size_t points = 0;
    for (std::size_t i = 0; i < rings; ++i) points += size_of(i);
    put(content_, static_cast<std::uint32_t>(points));
    points = 0;
    for (std::size_t i = 0; i < rings; ++i) {
      put(content_, static_cast<std::uint32_t>(points));
      points += size_of(i);
    }
    for (std::size_t i = 0; i < rings; ++i) {
      if (closes)
        put_ring(rows.ring(row, i), i == 0);
      else
        put_points(rows.ring(row, i));
    }
  }

  void put_points(std::span<const OGRRawPoint> points) {
    static_assert(sizeof(OGRRawPoint) == 16);
    content_.append(reinterpret_cast<const char*>(points.data()), points.size_bytes());
  }
  /// Outer rings run clockwise, holes the other way.
  void put_ring(std::span<const OGRRawPoint> ring, bool is_outer) {
    const double area = twice_area(ring);
    const std::size_t begin = content_.size();
    put_points(ring);
    if (is_open(ring)) put_points(ring.first(1));
    if (is_outer ? area <= 0 : area >= 0) return;
    auto* first = reinterpret_cast<std::array<char, 16>*>(content_.data() + begin);
    std::reverse(first, first + (content_.size() - begin) / 16);
  }
  static bool is_open(std::span<const OGRRawPoint> ring) {
    return ring.size() > 1 && (ring.front().x != ring.back().x || ring.front().y != ring.back().y);
  }
  static double twice_area(std::span<const OGRRawPoint> ring) {
    double sum = 0;
    const OGRRawPoint& o = ring[0];
    for (std::size_t i = 2; i < ring.size(); ++i)
      sum += (ring[i - 1].x - o.x) * (ring[i].y - o.y) - (ring[i].x - o.x) * (ring[i - 1].y - o.y);
    return sum;
  }

  Part shapes_, index_;
  std::string content_, head_;
  Box extent_ = Box::nothing();
  std::uint32_t count_ = 0;
};

class ShapefileRows final : public RowFile {
 public:
  Status open(const std::string& path, GeometryKind kind) {
    kind_ = kind;
    Status opened = geometries_.open(beside(path, ".shp"), beside(path, ".shx"));
    return opened ? attributes_.open(beside(path, ".dbf")) : opened;
  }
  Status add(const Rows& rows) override {
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (Status added = geometries_.add(kind_, rows, row); !added) return added;
      if (Status added = attributes_.add(rows, row); !added) return added;
    }
    return success();
  }
  Status close() override {
    Status closed = geometries_.close();
    return closed ? attributes_.close() : closed;
  }

 private:
  GeometryKind kind_ = GeometryKind::point;
  GeometryFile geometries_;
  AttributeTable attributes_;
};

}  // namespace

Result<std::unique_ptr<RowFile>> rows_of_shapefile(const std::string& path, GeometryKind kind) {
  auto file = std::make_unique<ShapefileRows>();
  if (Status opened = file->open(path, kind); !opened) return std::move(opened).error();
  return std::unique_ptr<RowFile>(std::move(file));
}

}  // namespace medial::io
