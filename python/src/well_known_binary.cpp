// Reads polygons from well-known binary, OGC or EWKB, as rings with offsets; writes geometries.

#include <bit>
#include <cstring>

#include "many.h"

namespace medial::python {
namespace {

constexpr std::uint32_t polygon_type = 3, multi_polygon_type = 6, collection_type = 7;
constexpr int deepest = 32;  ///< nesting of collections

class Reader {
 public:
  std::vector<Vec2> points;
  std::vector<std::int64_t> ring{0}, polygon{0}, feature{0};

  FeatureErrors errors;

  /// A feature with an error is empty.
  void read(std::size_t i, std::span<const std::uint8_t> bytes) {
    rest_ = bytes;
    feature_ = i;
    const std::size_t sizes[] = {points.size(), ring.size(), polygon.size()};
    try {
      geometry(0);
    } catch (const Failure& failure) {
      errors.emplace_back(static_cast<std::int64_t>(i), failure.error());
      points.resize(sizes[0]);
      ring.resize(sizes[1]);
      polygon.resize(sizes[2]);
    }
    feature.push_back(static_cast<std::int64_t>(polygon.size()) - 1);
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const char* text) const {
    Error error{code, text, {}};
    error.place.feature = feature_;
    throw Failure(std::move(error));
  }
  template <class T>
  T number() {
    if (rest_.size() < sizeof(T)) fail(ErrorCode::malformed, "well-known binary ends too early");
    std::array<std::uint8_t, sizeof(T)> bytes;
    std::memcpy(bytes.data(), rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
    if (swapped_) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }
  /// A number of items that take at least `size` bytes each.
  std::uint32_t count(std::size_t size) {
    const auto n = number<std::uint32_t>();
    if (n > rest_.size() / size) fail(ErrorCode::malformed, "well-known binary ends too early");
    return n;
  }
  void geometry(int depth) {
    if (depth > deepest) fail(ErrorCode::malformed, "collections are nested too deeply");
    const auto order = number<std::uint8_t>();
    swapped_ = (order == 0) != (std::endian::native == std::endian::big);
    const auto type = number<std::uint32_t>();
    if ((type & 0x20000000U) != 0) number<std::uint32_t>();  // a reference system
    const std::uint32_t plain = type & 0x1FFFFFFFU, more = plain / 1000;
    const std::size_t extra = ((type & 0x80000000U) != 0 || more == 1 || more == 3 ? 1U : 0U) +
                              ((type & 0x40000000U) != 0 || more == 2 || more == 3 ? 1U : 0U);
    switch (plain % 1000) {
      case polygon_type:
        return read_polygon(extra);
      case multi_polygon_type:
      case collection_type:
        for (std::uint32_t n = count(5); n > 0; --n) geometry(depth + 1);
        return;
      default:
        fail(ErrorCode::unsupported, "the geometry is no polygon");
    }
  }
  void read_polygon(std::size_t extra) {
    const std::uint32_t rings = count(4);
    for (std::uint32_t r = 0; r < rings; ++r) {
      for (std::uint32_t n = count(8 * (2 + extra)); n > 0; --n) {
        const auto x = number<double>(), y = number<double>();
        points.push_back({x, y});
        for (std::size_t k = 0; k < extra; ++k) number<double>();
      }
      ring.push_back(static_cast<std::int64_t>(points.size()));
    }
    if (rings > 0) polygon.push_back(static_cast<std::int64_t>(ring.size()) - 1);
  }

  std::span<const std::uint8_t> rest_;
  std::size_t feature_ = 0;
  bool swapped_ = false;
};

/// The polygons of the geometries that `data` holds one after another, divided by offsets.
nb::tuple read_all(const Values<std::uint8_t>& data, const Values<std::int64_t>& offsets) {
  Reader reader;
  const auto bytes = span_of(data);
  for (std::size_t i = 0; i + 1 < offsets.shape(0); ++i) {
    const auto begin = static_cast<std::size_t>(offsets.data()[i]);
    const auto end = static_cast<std::size_t>(offsets.data()[i + 1]);
    if (begin > end || end > bytes.size())
      refuse(ErrorCode::malformed, "offsets increase up to the number of bytes");
    reader.read(i, bytes.subspan(begin, end - begin));
  }
  return nb::make_tuple(rows_of<double>(std::move(reader.points)), array_of(std::move(reader.ring)),
                        array_of(std::move(reader.polygon)), array_of(std::move(reader.feature)),
                        list_of(reader.errors));
}

/// Writes the geometries of features from rows, of which it uses x and y. The type decides the
/// number of levels of offsets: one for line strings, two for multi line strings, three for multi
/// polygons.
class Writer {
 public:
  Writer(const Values<double>& values, std::size_t columns,
         const std::vector<Values<std::int64_t>>& levels)
      : values_(values), columns_(columns), levels_(levels) {}

  std::vector<std::uint8_t> bytes;
  std::vector<std::int64_t> offsets{0};

  void write() {
    const std::size_t top = levels_.size() - 1;
    for (std::size_t i = 0; i + 1 < levels_[top].shape(0); ++i) {
      write(top, i);
      offsets.push_back(static_cast<std::int64_t>(bytes.size()));
    }
  }

 private:
  template <class T>
  void add(T number) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(number);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  }
  void head(std::uint32_t type) {
    add(static_cast<std::uint8_t>(std::endian::native == std::endian::little));
    add(type);
  }
  std::pair<std::size_t, std::size_t> parts(std::size_t level, std::size_t i) const {
    const std::int64_t* const begin = levels_[level].data() + i;
    return {static_cast<std::size_t>(begin[0]), static_cast<std::size_t>(begin[1])};
  }
  void count(std::size_t level, std::size_t i) {
    const auto [from, to] = parts(level, i);
    add(static_cast<std::uint32_t>(to - from));
  }
  void rows(std::size_t i) {
    count(0, i);
    const auto [from, to] = parts(0, i);
    for (std::size_t row = from; row < to; ++row)
      for (std::size_t k = 0; k < 2; ++k) add(values_.data()[row * columns_ + k]);
  }
  void line(std::size_t i) {
    head(2);
    rows(i);
  }
  void polygon(std::size_t i) {
    head(polygon_type);
    count(1, i);
    const auto [from, to] = parts(1, i);
    for (std::size_t ring = from; ring < to; ++ring) rows(ring);
  }
  void write(std::size_t top, std::size_t i) {
    if (top == 0) return line(i);
    head(top == 1 ? 5 : multi_polygon_type);
    count(top, i);
    const auto [from, to] = parts(top, i);
    for (std::size_t part = from; part < to; ++part) top == 1 ? line(part) : polygon(part);
  }

  const Values<double>& values_;
  std::size_t columns_;
  const std::vector<Values<std::int64_t>>& levels_;
};

/// Line strings, multi line strings or multi polygons as well-known binary: bytes and offsets.
nb::tuple write_all(const Values<double>& values, std::size_t columns,
                    const std::vector<Values<std::int64_t>>& levels) {
  std::size_t below = columns < 2 ? 0 : values.shape(0) / columns;
  bool fits = columns >= 2 && !levels.empty() && levels.size() <= 3;
  for (const auto& level : levels) {
    const auto begin = span_of(level);
    fits = fits && !begin.empty() && begin.front() >= 0 && std::ranges::is_sorted(begin) &&
           static_cast<std::size_t>(begin.back()) <= below;
    below = level.shape(0) - 1;
  }
  if (!fits) refuse(ErrorCode::malformed, "the offsets do not fit the rows");
  Writer writer(values, columns, levels);
  without_lock([&] {
    writer.write();
    return 0;
  });
  return nb::make_tuple(array_of(std::move(writer.bytes)), array_of(std::move(writer.offsets)));
}

}  // namespace

void bind_well_known_binary(nb::module_& module) {
  module.def("read_wkb", &read_all);
  module.def("write_wkb", &write_all);
}

}  // namespace medial::python
