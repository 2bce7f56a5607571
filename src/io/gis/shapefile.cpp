// Rows of shapefiles, which shapelib adds to the files that GDAL has made: GDAL's features take
// several times as long.

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <shapefil.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "io/format_name.h"
#include "io/gis/gdal_support.h"
#include "io/gis/rows.h"

namespace medial::io {

namespace {

namespace fs = std::filesystem;

Error shapefile_error(const std::string& what) {
  return {ErrorCode::unwritable, "cannot write: " + what, {}};
}

/// The file of this name in small or large letters; the name if there is none.
std::string spelled(const char* name) {
  const fs::path path = name;
  const std::string wanted = lower_case(path.filename().string());
  std::error_code problem;
  for (fs::directory_iterator entry(path.parent_path(), problem), end; !problem && entry != end;
       entry.increment(problem))
    if (lower_case(entry->path().filename().string()) == wanted) return entry->path().string();
  return name;
}

VSILFILE* file_of(SAFile file) { return reinterpret_cast<VSILFILE*>(file); }

int reported(bool fine) {
  if (!fine) CPLError(CE_Failure, CPLE_FileIO, "%s", std::strerror(errno));
  return fine ? 0 : -1;
}

/// Files as GDAL opens them, which passes over a move to where it is. What fails is an error of
/// GDAL's, because shapelib does not look at everything that these return.
SAHooks files_of_gdal() {
  SAHooks hooks{};
  SASetupDefaultHooks(&hooks);
  hooks.FOpen = [](const char* name, const char* access) {
    return reinterpret_cast<SAFile>(VSIFOpenL(spelled(name).c_str(), access));
  };
  hooks.FRead = [](void* bytes, SAOffset size, SAOffset count, SAFile file) -> SAOffset {
    return VSIFReadL(bytes, size, count, file_of(file));
  };
  hooks.FWrite = [](void* bytes, SAOffset size, SAOffset count, SAFile file) -> SAOffset {
    const std::size_t written = VSIFWriteL(bytes, size, count, file_of(file));
    reported(written == count);
    return written;
  };
  hooks.FSeek = [](SAFile file, SAOffset offset, int whence) {
    return static_cast<SAOffset>(reported(VSIFSeekL(file_of(file), offset, whence) == 0));
  };
  hooks.FTell = [](SAFile file) { return static_cast<SAOffset>(VSIFTellL(file_of(file))); };
  hooks.FFlush = [](SAFile file) { return reported(VSIFFlushL(file_of(file)) == 0); };
  hooks.FClose = [](SAFile file) { return reported(VSIFCloseL(file_of(file)) == 0); };
  hooks.Error = [](const char* text) { CPLError(CE_Failure, CPLE_FileIO, "%s", text); };
  return hooks;
}

class ShapefileRows final : public RowFile {
 public:
  ~ShapefileRows() override {
    const GdalMessages unheard;
    shapes_.reset();
    table_.reset();
  }
  Status open(const std::string& path) {
    SAHooks hooks = files_of_gdal();
    shapes_.reset(SHPOpenLL(path.c_str(), "rb+", &hooks));
    table_.reset(DBFOpenLL(path.c_str(), "rb+", &hooks));
    if (!shapes_ || !table_) return shapefile_error("a part is missing or damaged");
    columns_.resize(static_cast<std::size_t>(DBFGetFieldCount(table_.get())));
    for (int i = 0; Column & column : columns_) {
      DBFGetFieldInfo(table_.get(), i, column.name.data(), &column.width, &column.decimals);
      column.type = DBFGetNativeFieldType(table_.get(), i++);
    }
    DBFSetWriteEndOfFileChar(table_.get(), 0);  // after each row: shapelib then goes back over it
    return success();
  }

  Status add(const Rows& rows) override {
    if (Status widened = widen(rows); !widened) return widened;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (Status added = add_geometry(rows, row); !added) return added;
      if (!add_attributes(rows, row)) return shapefile_error("a row cannot be added");
    }
    return success();
  }

  Status close() override {
    DBFSetWriteEndOfFileChar(table_.get(), 1);
    shapes_.reset();
    table_.reset();
    return success();
  }

 private:
  static constexpr std::size_t longest_text = 254;
  static constexpr int longest_row = 65535;
  struct Close {
    void operator()(SHPInfo* shapes) const { SHPClose(shapes); }
    void operator()(DBFInfo* table) const { DBFClose(table); }
  };

  struct Column {
    std::array<char, XBASE_FLDNAME_LEN_READ + 1> name;
    char type;
    int width, decimals;
  };

  Status add_geometry(const Rows& rows, std::size_t row) {
    starts_.clear();
    x_.clear();
    y_.clear();
    for (std::size_t i = 0; i < rows.ring_count(row); ++i) {
      starts_.push_back(static_cast<int>(x_.size()));
      put_ring(rows.ring(row, i), i == 0);
    }
    constexpr std::uint64_t most = std::uint64_t{std::numeric_limits<std::int32_t>::max()} * 2;
    if (shapes_->nFileSize + 52 + 4 * starts_.size() + 16 * x_.size() > most)
      return shapefile_error("a shapefile has 4 GB at most; .gpkg and .fgb have no such limit");
    zeros_.resize(x_.size());
    SHPObject shape{};
    shape.nSHPType = shapes_->nShapeType;
    shape.nParts = static_cast<int>(starts_.size());
    shape.panPartStart = starts_.data();
    shape.nVertices = static_cast<int>(x_.size());
    shape.padfX = x_.data();
    shape.padfY = y_.data();
    shape.padfZ = shape.padfM = zeros_.data();
    SHPComputeExtents(&shape);
    return SHPWriteObject(shapes_.get(), -1, &shape) >= 0
               ? success()
               : Status(shapefile_error("a shape cannot be added"));
  }

  /// Those of polygons are closed; outer ones run clockwise, holes the other way.
  void put_ring(std::span<const Vec2> ring, bool is_outer) {
    const auto begin = static_cast<std::ptrdiff_t>(x_.size());
    for (const Vec2 p : ring) {
      x_.push_back(p.x);
      y_.push_back(p.y);
    }
    if (shapes_->nShapeType != SHPT_POLYGON) return;
    if (ring.front() != ring.back()) {
      x_.push_back(ring.front().x);
      y_.push_back(ring.front().y);
    }
    if (const double area = twice_area(ring); is_outer ? area <= 0 : area >= 0) return;
    std::reverse(x_.begin() + begin, x_.end());
    std::reverse(y_.begin() + begin, y_.end());
  }
  static double twice_area(std::span<const Vec2> ring) {
    double sum = 0;
    const Vec2 o = ring[0];
    for (std::size_t i = 2; i < ring.size(); ++i) sum += cross(ring[i - 1] - o, ring[i] - o);
    return sum;
  }

  /// Makes room in the columns for the longest texts and whole numbers; numbers with decimals get
  /// what there is.
  Status widen(const Rows& rows) {
    std::vector<int> wanted(columns_.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t i = 0; const Rows::Field& value : rows.fields(row)) {
        wanted[i] = std::max(wanted[i], wanted_width(rows, value));
        ++i;
      }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      Column& column = columns_[i];
      if (wanted[i] <= column.width) continue;
      if (table_->nRecordLength + wanted[i] - column.width > longest_row)
        return shapefile_error("a row of a shapefile has 65,535 bytes at most");
      column.width = wanted[i];
      if (!DBFAlterFieldDefn(table_.get(), static_cast<int>(i), column.name.data(), column.type,
                             column.width, column.decimals))
        return shapefile_error("a column cannot be widened");
    }
    return success();
  }
  static int wanted_width(const Rows& rows, const Rows::Field& value) {
    if (value.kind == Rows::Kind::text) return static_cast<int>(cut(rows.text(value)).size());
    if (value.kind == Rows::Kind::whole)
      return static_cast<int>(fmt::formatted_size("{}", value.whole));
    return 0;
  }
  /// As much of a text as fits, without a part of a character.
  static std::string_view cut(std::string_view text) {
    std::size_t length = std::min(text.size(), longest_text);
    while (length > 0 && length < text.size() && (text[length] & 0xc0) == 0x80) --length;
    return text.substr(0, length);
  }

  bool add_attributes(const Rows& rows, std::size_t row) {
    const int record = DBFGetRecordCount(table_.get());
    for (int i = 0; const Rows::Field& value : rows.fields(row)) {
      const bool is_nothing = value.kind == Rows::Kind::nothing ||
                              (value.kind == Rows::Kind::real && !std::isfinite(value.real));
      if (!is_nothing) set_text(columns_[static_cast<std::size_t>(i)], rows, value);
      if (!(is_nothing ? DBFWriteNULLAttribute(table_.get(), record, i)
                       : DBFWriteAttributeDirectly(table_.get(), record, i, text_.data())))
        return false;
      ++i;
    }
    return true;
  }
  /// shapelib itself would print whole numbers as doubles.
  void set_text(const Column& column, const Rows& rows, const Rows::Field& value) {
    std::array<char, 512> digits;
    const auto put = [&](auto... number) {
      text_.assign(digits.data(), std::to_chars(digits.begin(), digits.end(), number...).ptr);
    };
    if (value.kind == Rows::Kind::text)
      text_ = cut(rows.text(value));
    else if (value.kind == Rows::Kind::whole)
      put(value.whole);
    else
      put(value.real, std::chars_format::fixed, column.decimals);
    const auto width = static_cast<std::size_t>(column.width);
    text_.resize(std::min(text_.size(), width));
    if (column.type != 'C') text_.insert(0, width - text_.size(), ' ');
  }

  std::unique_ptr<SHPInfo, Close> shapes_;
  std::unique_ptr<DBFInfo, Close> table_;
  std::vector<Column> columns_;
  std::vector<int> starts_;  ///< of rings
  std::vector<double> x_, y_, zeros_;
  std::string text_;
};

}  // namespace

Result<std::unique_ptr<RowFile>> rows_of_shapefile(const std::string& path,
                                                   std::span<const EmptyLayer>, bool) {
  auto file = std::make_unique<ShapefileRows>();
  if (Status opened = file->open(path); !opened) return std::move(opened).error();
  return std::unique_ptr<RowFile>(std::move(file));
}

}  // namespace medial::io
