#pragma once

// The table of formats: what each of them reads and writes. A new format is a file in formats/ and
// a line in formats.cpp.

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "io/feature_reader.h"
#include "io/output.h"
#include "io/output_crs.h"
#include "io/text_source.h"
#include "medial/io/read.h"
#include "medial/io/write.h"

namespace medial::io {

/// A file to be read.
struct Input {
  std::string path;
  std::shared_ptr<TextSource> source;  ///< at the beginning; null for GDAL's own names
};

/// A document of one kind, on its way to a file.
template <class Item, DocumentKind own_kind>
struct DocumentOutput {
  static constexpr DocumentKind kind = own_kind;
  const Document<Item>& document;
  const WriteOptions& options;
};
using AxesOutput = DocumentOutput<AxisItem, DocumentKind::axes>;
using ShapesOutput = DocumentOutput<ShapeItem, DocumentKind::shapes>;
using VoronoiOutput = DocumentOutput<VoronoiItem, DocumentKind::voronoi>;
using OffsetsOutput = DocumentOutput<OffsetItem, DocumentKind::offsets>;
struct CarvingOutput : DocumentOutput<CarveItem, DocumentKind::carving> {
  const MachineOptions& machine;
};
struct FeaturesOutput : DocumentOutput<AxisItem, DocumentKind::features> {
  std::span<const AxisFeatures> features;
  const FeatureWriteOptions& own;
};
struct LayersOutput : DocumentOutput<Layer, DocumentKind::layers> {
  const Document<AxisItem>& background;
};
/// What is written in parts.
using PartOutput = std::variant<AxesOutput, OffsetsOutput, LayersOutput>;
struct FieldOutput {
  static constexpr DocumentKind kind = DocumentKind::field;
  std::span<const Shape> shapes;
  std::span<const PotentialField> fields;
  const FieldPictureOptions& options;
};
struct VoxelsOutput {
  static constexpr DocumentKind kind = DocumentKind::voxels;
  const VoxelAxis& axis;
  const Solid& solid;
  double width;
};
struct DistancesOutput {
  static constexpr DocumentKind kind = DocumentKind::distances;
  const DistanceMap& distances;
  const ImageFile& source;
  const DistanceFormat& format;
};
struct ImageOutput {
  static constexpr DocumentKind kind = DocumentKind::image;
  const Image& image;
  const ImageFile& source;
};

/// Which part of a document is written, and what its items are numbered from.
struct Part {
  bool begins = true, ends = true;
  std::uint64_t feature = 0, node = 0, edge = 0;
  std::uint64_t branch = 0;  ///< the first one, of a part of one axis; and the nodes' numbers there
  std::span<const std::uint32_t> nodes = {};

  /// The number of a node of an item whose first node has the number `first`.
  std::uint64_t number_of_node(std::uint64_t first, std::uint32_t i) const {
    return first + (nodes.empty() ? i : nodes[i]);
  }
  /// The number of an item in the file that it was read from, as notes and errors say it.
  std::uint64_t number_of(const DocumentInfo& document, std::size_t i) const {
    return document.indices.empty() ? feature + i : document.indices[i];
  }
};

class AttributeColumns;

/// Which tables a file holds.
enum class TableRoom : std::uint8_t {
  one,     ///< a single one: of an axis its branches
  joined,  ///< all in one list, whose rows name their layer; of an axis its branches
  several  ///< a layer each: of an axis its branches and its nodes
};

/// Where a document goes: a stream, or the path of a file that the format makes by itself.
class Target {
 public:
  Part part;
  bool arcs = false;                                ///< whether parts may have arcs
  std::shared_ptr<const AttributeColumns> columns;  ///< of all parts; null: the document is whole
  std::string format;                               ///< the extension without its dot
  TableRoom tables = TableRoom::one;                ///< of the format
  std::string name;                                 ///< of the file without its extension
  OutputStream* out = nullptr;                      ///< null: the format makes the file `path`
  std::string path;
  std::string unit;  ///< of lengths, by its name; empty: unknown, or the reference system says
  bool overwrite = false;  ///< layers of the same name
  std::string layer;       ///< see WriteOptions
  OutputCrs crs;

  /// The target of one part of the document: without a file, a stream and errors of its own.
  Target of_part(const Part& one) const {
    Target own = *this;
    own.part = one;
    own.out = nullptr;
    own.path.clear();
    own.status_ = success();
    return own;
  }
  /// Points of the document become points of the output. If one cannot be projected, writing the
  /// document fails: see status().
  template <class Points>
  void place(Points& points) {
    if (status_) status_ = crs.transform(points);
  }
  const Status& status() const { return status_; }

 private:
  Status status_ = success();
};

template <class Output>
using Writer = Status (*)(Target& target, const Output& output);
using Reader = Result<Document<Feature>> (*)(const Input& input, const ReadOptions& options);
using Opener = Result<std::unique_ptr<FeatureReader>> (*)(const Input& input,
                                                          const ReadOptions& options);
using MeshReader = Result<TriangleMesh> (*)(const Input& input);
using Sniff = bool (*)(std::string_view beginning);

/// Writes a document in parts.
class PartWriter {
 public:
  PartWriter() = default;
  PartWriter(const PartWriter&) = delete;
  PartWriter& operator=(const PartWriter&) = delete;
  virtual ~PartWriter() = default;

  /// Makes a part ready, on any thread.
  virtual Result<std::shared_ptr<void>> prepare(const PartOutput& output, const Part& part) = 0;
  /// Adds what prepare() made, in the order of parts.
  virtual Status add(void* prepared) = 0;
  virtual Status finish() = 0;
};

/// A file that other programs may have open, and its copy, which a library adds layers to: what is
/// there stays whole whatever happens.
class Addition {
 public:
  Addition() = default;
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;
  virtual ~Addition() = default;

  /// Makes the file what the copy is now, all at once. Errors: unwritable, also if the file has
  /// changed since it was copied.
  virtual Status commit() = 0;
};

class AxisWriter;
struct GrowingFrame;

/// What is written of an axis while it grows (docs/parts.md).
enum class Growing : std::uint8_t {
  none,
  edges,     ///< one after another
  branches,  ///< once each is whole
  graph      ///< with all nodes and sites, by Format::grow
};

/// What the command line loads when something needs it (modules.h).
enum class Module : std::uint8_t { drawing, gis };

struct Format {
  std::string_view extensions;  ///< each with its dot, apart by blanks

  // Reading.
  std::string_view also_read = "";  ///< extensions that are not written
  Reader read = nullptr;
  Opener open = nullptr;  ///< of formats that can be read feature by feature
  MeshReader read_mesh = nullptr;
  Sniff sniff = nullptr;    ///< whether a text without a name begins like this format
  Sniff accepts = nullptr;  ///< what a file of this extension must begin like; GDAL reads others
  bool has_layers = false;
  bool has_filters = false;
  bool has_loose_curves = false;
  bool reads_images = false;  ///< see begins_like_image()
  bool reads_others = false;  ///< what no other row reads
  bool gdal_chooses = false;  ///< GDAL reads it instead where layers or attributes choose

  // Writing.
  bool geographic = false;  ///< longitudes and latitudes instead of a local projection
  TableRoom tables = TableRoom::one;
  bool own_files = false;  ///< a library makes the file, maybe with companions
  /// Of formats that add layers to a file that is there; `own_files` then.
  Result<std::unique_ptr<Addition>> (*begin_addition)(const std::string& path,
                                                      const std::string& copy) = nullptr;
  std::tuple<Writer<AxesOutput>, Writer<ShapesOutput>, Writer<VoronoiOutput>, Writer<OffsetsOutput>,
             Writer<CarvingOutput>, Writer<FeaturesOutput>, Writer<LayersOutput>,
             Writer<FieldOutput>, Writer<VoxelsOutput>, Writer<DistancesOutput>,
             Writer<ImageOutput>>
      writers{};
  /// In parts: by the writer of all where it is null and `in_parts` is set, which must write a
  /// comma in front of each row but those of the first part. `none` is a document without items.
  Result<std::unique_ptr<PartWriter>> (*write_parts)(Target& target,
                                                     const PartOutput& none) = nullptr;
  bool in_parts = false;
  Growing growing = Growing::none;
  std::unique_ptr<AxisWriter> (*grow)(Target& target, const GrowingFrame& frame) = nullptr;
  unsigned kinds = 0;  ///< of documents that are written, a bit each
  /// Those that the row of this name in each Module writes.
  std::array<std::uint16_t, 2> announced{};

  /// Adds writers: functions of (Target&, const SomeOutput&).
  template <class... Outputs>
  Format writes(Writer<Outputs>... each) const {
    Format result = *this;
    ((std::get<Writer<Outputs>>(result.writers) = each), ...);
    ((result.kinds |= 1U << static_cast<unsigned>(Outputs::kind)), ...);
    return result;
  }
  /// Announces kinds of documents.
  Format announces(Module module, std::initializer_list<DocumentKind> each) const {
    Format result = *this;
    for (const DocumentKind kind : each)
      result.announced[static_cast<std::size_t>(module)] |=
          static_cast<std::uint16_t>(1U << static_cast<unsigned>(kind));
    return result;
  }
  bool holds(DocumentKind kind) const {
    return kind == DocumentKind::mesh ? read_mesh != nullptr
                                      : (kinds >> static_cast<unsigned>(kind) & 1U) != 0;
  }
  bool is_announced(Module module, DocumentKind kind) const {
    return (announced[static_cast<std::size_t>(module)] >> static_cast<unsigned>(kind) & 1U) != 0;
  }
  bool is_known_to_hold(DocumentKind kind) const {
    return holds(kind) || is_announced(Module::drawing, kind) || is_announced(Module::gis, kind);
  }
};

/// The rows as far as their libraries are loaded with the program; what others do is announced.
const std::vector<Format>& formats_at_hand();
/// The rows with what a module does; the same in a library that links all. Errors: unsupported, if
/// the module cannot be loaded.
Result<const std::vector<Format>*> formats_in(Module module);

/// Whether a list of extensions has one (without its dot).
bool lists_extension(std::string_view extensions, std::string_view extension);

/// The row that has an extension (without its dot) and holds a kind of document; null: none.
/// Errors: those of formats_in().
Result<const Format*> find_format(std::string_view extension, DocumentKind kind);

// The rows of the table, each in its own file.
Format json_format();
Format safetensors_format();
Format geojson_format();
Format gpkg_format();
Format shp_format();
Format fgb_format();
Format wkt_format();
Format csv_format();
Format xy_format();
Format graphml_format();
Format nodelink_format();
Format edgelist_format();
Format gcode_format();
Format dxf_format();
Format svg_format();
Format png_format();
Format ply_format();
Format vtk_format();
Format obj_format();
Format glb_format();
Format off_format();
Format tif_format();
Format pgm_format();
Format pbm_format();
Format gdal_format();   ///< whatever else GDAL reads
Format image_format();  ///< images, by their first bytes
Format ros_map_format();
/// The row, with pictures by Cairo of every kind of document that it does not write and but voxels.
Format with_pictures(Format format);
/// The row, with distances and images that GDAL writes.
Format with_rasters(Format format);
/// The row, with meshes that Assimp reads.
Format with_meshes(Format format);

}  // namespace medial::io
