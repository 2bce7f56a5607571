#pragma once

// Writes documents as files and pictures. The extension of `path`, or `format` (an extension
// without its dot), selects the format; `-` is standard output, except for images and distances.
// Never leaves a partial file: writes a temporary one, then renames it. After ReadOptions::project,
// GIS formats, .wkt and .csv get longitudes and latitudes again; radii and lengths stay in metres.
// Common errors: unsupported, unwritable, invalid_option, out_of_memory.

#include "medial/carve.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "medial/offset.h"

namespace medial::io {

/// A file, `-`, or a text in memory to append to.
struct Destination {
  Destination(std::string file) : path(std::move(file)) {}       // NOLINT: implicit
  Destination(const char* file) : path(file) {}                  // NOLINT: implicit
  Destination(std::string* end_of) : path("-"), text(end_of) {}  // NOLINT: implicit
  std::string path;
  std::string* text = nullptr;
};

enum class DocumentKind : std::uint8_t {
  axes,
  shapes,
  voronoi,
  offsets,
  carving,
  features,
  layers,
  field,
  voxels,
  distances,
  image,
  mesh,  ///< only read
};

std::string formats_of(DocumentKind kind, bool growing = false);  ///< such as ".json .svg"

struct WriteOptions {
  double chord = 1e-3;       ///< chords stay within this share (> 0) of the bounding box diagonal
  std::string layer = {};    ///< .gpkg: name of the first layer, and prefix (with _) of the others
  bool overwrite = false;    ///< .gpkg: replaces layers of the same name in an existing file
  bool radius_as_z = false;  ///< .dxf: the radius becomes z
  // pictures (.svg .pdf .png .ps)
  double width = 1024;    ///< of the picture, in pixels or points, in [16, 8000]
  int disks = 0;          ///< draw about this many maximal disks; 0: none
  bool contacts = false;  ///< draw the foot points of the nodes' disks
  bool shape = true;      ///< draw the shape
  bool nodes = false;     ///< draw the nodes by kind; tables also get nodes of two edges
  bool titles = false;    ///< write each item's attribute "title" below its shape
  bool chords = false;    ///< .wkt of offset curves: polygons of chords instead of exact arcs
  /// Simplifies lines of axes in tables, .wkt and graphs within this distance of the curve, in
  /// units of the input; 0: uses `chord`. Keeps their ends, so networks stay connected.
  double simplify = 0;
};

/// Axes: exact in .json (native, docs/format.md) and .dxf, else as chords. .gpkg also gets nodes;
/// .graphml, .nodelink (JSON for networkx) and .edgelist hold the graph of branches.
Status write_axes(const Destination& target, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options = {});

/// Gets parts of axes, with each shape's number; where the first one's begins, all before are void.
using PartVisitor = std::function<void(std::size_t shape, std::uint64_t number, const AxisPart&)>;
/// compute_axes(), written as the axes grow; without a name nowhere. No report, and `shapes` as it
/// was, where the format (formats_of(axes, true)) or a native file's axis has no parts.
Result<std::optional<AxesReport>> write_in_parts(
    const Destination& target, const std::string& format, Document<ShapeItem>&& shapes,
    const AxesOptions& options, const WriteOptions& write = {}, const PartVisitor& visit = {});

/// Shapes: .json (native), .svg (up to the shift of its viewport), .dxf (polylines with bulges) and
/// .wkt (one geometry per line; with arcs a MULTISURFACE) are lossless; .geojson has chords.
Status write_shapes(const Destination& target, const std::string& format,
                    const Document<ShapeItem>& file, const WriteOptions& options = {});

/// Diagrams: .json is lossless; .geojson and .wkt have the faces, .geojson and .csv the edges.
Status write_voronoi(const Destination& target, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options = {});

/// The features in one region of a buffer, and their common attributes.
struct BufferSource {
  std::vector<std::uint32_t> features;  ///< in the order of the input
  Attributes attributes;                ///< those of the first feature on which all agree
};

struct OffsetItem {
  Shape shape;
  Offsets offsets;
  Attributes attributes = {};
  PlanarGraph planar_graph = {};           ///< what buffers surround, if there is no shape
  std::vector<BufferSource> sources = {};  ///< of each region of a buffer; or empty
};

/// Offset curves: .json is lossless. Per clearance, .wkt has a surface of exact arcs, .dxf a layer
/// of polylines with bulges; per region, .geojson has a polygon of chords.
Status write_offsets(const Destination& target, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options = {});

struct CarveItem {
  Shape shape;
  Carving carving;
  Carving clearing = {};  ///< by an end mill that cuts first (clearing_before()); or empty
};

struct CuttingSpeeds {
  double feed = 1000;   ///< of cutting moves, units per minute
  double plunge = 300;  ///< downwards, units per minute
  double spindle = 0;   ///< revolutions per minute; 0: the program does not set it
};

/// What a machine needs besides the paths. Lengths in units of the document.
struct MachineOptions {
  double safe = 5;      ///< height of moves between paths, positive
  double rapid = 3000;  ///< of these moves, for the estimated time
  CuttingSpeeds carving, clearing;
  double chord = 0;     ///< of without_arcs() for .csv; 0: 1e-6 of the tool's bottom radius
  std::string post;     ///< "linuxcnc", "grbl", "mach3", or a template's text; empty: plain G-code
  bool shaded = false;  ///< pictures: the simulated surface after the cut, without paths
};
std::string post_names();  ///< names of the built-in templates

/// Measures of a program, as written.
struct CutReport {
  double own = 0;     ///< length of all passes in the plane, see Carving::own_length
  double cut = 0;     ///< length of all moves in the material or at its depth
  double travel = 0;  ///< in the plane, of lifted moves
  double seconds = 0;
  std::uint64_t moves = 0;
  Box box;            ///< of the tool's centre
  double lowest = 0;  ///< z
};
CutReport report_of(const Document<CarveItem>& file, const MachineOptions& machine);

void place(Document<CarveItem>& file, Vec2 zero);  ///< moves `zero` to the origin, y upwards

/// Tool paths: .nc .gcode .ngc (G-code: G0 G1 G2 G3, absolute, G20 in inches and G21 otherwise, XY
/// plane, arcs by I and J, six decimals), .csv (path, kind, x, y, z), .dxf (space polylines on a
/// layer per kind; passes at one depth as polylines with bulges and elevation), pictures of the
/// cut. Call place() first. Errors: also invalid_option (a template lacks a part).
Status write_carving(const Destination& target, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine = {},
                     const WriteOptions& options = {});

/// The content of formats that hold one table; .json and .gpkg hold all three.
enum class FeatureTable : std::uint8_t {
  runs,      ///< one line per primitive
  branches,  ///< one line per medial branch
  points,    ///< the end and branching points
};

struct FeatureWriteOptions {
  FeatureTable table = FeatureTable::runs;
  WriteOptions write;  ///< for chords and pictures
  bool names = true;   ///< pictures: write the names beside the longest runs
};

/// Writes one of `features` for each of `axes` (docs/features.md); tables and .json get attributes.
Status write_features(const Destination& target, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options = {});

enum class LayerKind : std::uint8_t {
  disks,     ///< points; the first value is the radius
  lines,     ///< one part: the points of the line
  polygons,  ///< the parts are rings, outer ring first
  profile,   ///< one part: the centre of a disk and its two feet; .csv holds one such layer
};

/// A geometry with values, from measuring a shape.
struct LayerFeature {
  std::uint32_t feature = 0;             ///< of the input; its attributes are copied
  std::vector<std::vector<Vec2>> parts;  ///< see the layer's kind
  std::vector<double> values;            ///< one per field of the layer
};

struct Layer {
  std::string name;
  LayerKind kind = LayerKind::lines;
  std::vector<std::string> fields;
  std::vector<LayerFeature> features;
  std::optional<std::size_t> label = {};  ///< field that pictures print beside each feature
};

/// Layers of measurements: .geojson and .wkt (all layers in sequence, .geojson with a member
/// "layer"), .gpkg (separate layers), .shp and .fgb (a single layer), and pictures over the shapes
/// and axes of `background`, whose items are the features of the input.
Status write_layers(const Destination& target, const std::string& format,
                    const Document<Layer>& layers, const Document<AxisItem>& background,
                    const WriteOptions& options = {});

/// Layers, and the features that they belong to.
using MeasuredItems = std::pair<Document<Layer>, Document<AxisItem>>;
using StreamItems = std::variant<Document<AxisItem>, Document<OffsetItem>, MeasuredItems>;

struct StreamOptions {
  SourceOptions source;
  WriteOptions write;
  int threads = 0;   ///< see Options
  StreamItems none;  ///< an empty document of the kind that compute() returns
  /// Computes the result for some shapes of the file; called for several parts at once.
  std::function<Result<StreamItems>(Document<ShapeItem> shapes, int threads, AxesReport& report)>
      compute;
  std::function<void(const StreamItems& part)> visit;  ///< in order, before writing; may be empty
  std::function<void(double share, std::uint64_t features)> progress;  ///< may be empty
  std::uint64_t least_bytes = std::uint64_t{1} << 20;  ///< of a file; smaller ones are read whole
  std::uint64_t most_points = ~std::uint64_t{0};       ///< of a feature; otherwise nothing is done
};

struct StreamReport {
  LoadReport load;
  AxesReport axes;
  DocumentInfo document;  ///< common properties, and notes
};

/// Does load_shapes(), options.compute and the writing part by part, with the same bytes as a
/// whole; reads the file twice. Without a target's name, writes nothing. Returns nothing unless the
/// input is .wkt or a vector format of GDAL, the output a table, .wkt, .csv or .json, and no option
/// needs all features (repair, project, units, contours). A .fgb gets no spatial index.
Result<std::optional<StreamReport>> stream(const std::string& path, const Destination& target,
                                           const std::string& format, const StreamOptions& options);

struct FieldPictureOptions {
  double width = 800;      ///< of the picture, in pixels or points, in [16, 8000]
  int lines = 40;          ///< force lines along the grid's longer side; 0: none
  bool brightness = true;  ///< brighter for a lower logarithm of the potential
  bool y_down = false;     ///< the y axis points down
  Unit unit = Unit::unknown;
};

/// Pictures of shapes with the potentials of their borders, sampled once per pixel.
Status write_field(const std::string& path, const std::string& format,
                   std::span<const Shape> shapes, std::span<const PotentialField> fields,
                   const FieldPictureOptions& options = {});

/// An axis of voxels, or its surface if it has one: .ply (binary), .vtk (legacy, text) and .glb
/// (single precision) with radii, .obj; .png: three views of solid and axis, `width` pixels wide.
Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width = 1536);

/// An image as .png, .tif (bytes 0 and 255) or .pbm, georeferenced like `source`.
Status write_image(const std::string& path, const std::string& format, const Image& image,
                   const ImageFile& source);

struct DistanceFormat {
  bool squared = false;  ///< the squared distance, exactly, instead of the distance
  double scale = 1;      ///< factor for the values written
};

/// Distances: in 32 bits in .tif (real, or squared integers), georeferenced like `source`; in 16
/// bits in .png and .pgm. Errors: also invalid_option (a value exceeds 16 bits; no background).
Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format = {});

/// The bytes of a pack for write_pack(), compressed by zstd. Errors: internal.
Result<std::vector<std::uint8_t>> pack_bytes(const PackFile& file);
Status write_pack(const std::string& path, const std::vector<std::uint8_t>& bytes);
/// The size in bytes of a text or code compressed by zstd, at the level of packs.
std::size_t compressed_size(std::span<const std::uint8_t> bytes);
std::size_t compressed_size(const ShapeCode& code);
Status write_text(const std::string& path, const std::string& text);
/// Removes temporary files of unfinished writes; safe to call from a signal handler.
void remove_partial_files() noexcept;

}  // namespace medial::io
