#pragma once

// Documents as files and pictures. Functions write by the extension of `path`, or by `format` (an
// extension without its dot) in its place; `-` is standard output, but of images and distances.
// There is never a partial file: it is written beside its target, then renamed. Formats of GIS,
// .wkt and .csv get longitudes and latitudes again after ReadOptions::project; radii and lengths
// stay in metres. Errors of all: unsupported, unwritable, invalid_option, out_of_memory.

#include "medial/carve.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "medial/offset.h"

namespace medial::io {

/// A file, `-`, or a text in memory, to whose end it goes.
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
  mesh,  ///< which is read
};

std::string formats_of(DocumentKind kind);  ///< their extensions, as ".json .svg"

struct WriteOptions {
  double chord = 1e-3;       ///< chords stay within this share (> 0) of the bounding box diagonal
  std::string layer = {};    ///< of a .gpkg: the name of its first layer, and with _ of the others
  bool overwrite = false;    ///< replaces layers of the same name in a .gpkg that is there
  bool radius_as_z = false;  ///< drawings (.dxf) have the radius as z
  // pictures (.svg .pdf .png .ps)
  double width = 1024;    ///< of the picture, in pixels or points, in [16, 8000]
  int disks = 0;          ///< draw about this many maximal disks; 0: none
  bool contacts = false;  ///< draw the feet of the nodes' disks
  bool shape = true;      ///< draw the shape
  bool nodes = false;     ///< draw the nodes by kind; tables have those between two edges as well
  bool titles = false;    ///< write each item's attribute "title" below its shape
  bool chords = false;    ///< .wkt of offset curves: polygons of chords instead of exact arcs
  /// Lines of axes in tables, .wkt and graphs have few points within this distance of the curve, in
  /// units of the input; 0: chords. Their ends stay, so networks stay connected.
  double simplify = 0;
};

/// Axes: exact in .json (native, docs/format.md) and .dxf, else chords; .gpkg also has the nodes;
/// .graphml, .nodelink (JSON, as networkx reads it) and .edgelist hold the graph of branches.
Status write_axes(const Destination& target, const std::string& format,
                  const Document<AxisItem>& file, const WriteOptions& options = {});

/// Shapes. .json (native), .svg (but for the shift of its viewport), .dxf (polylines with bulges)
/// and .wkt (a geometry per line; with arcs a MULTISURFACE) are lossless, .geojson has chords.
Status write_shapes(const Destination& target, const std::string& format,
                    const Document<ShapeItem>& file, const WriteOptions& options = {});

/// Diagrams: .json is lossless; .geojson and .wkt have the faces, .geojson and .csv the edges.
Status write_voronoi(const Destination& target, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options = {});

/// What features lie in one region of a buffer, and what they have in common.
struct BufferSource {
  std::vector<std::uint32_t> features;  ///< in their order in the input
  Attributes attributes;                ///< of the first feature: those on which all agree
};

struct OffsetItem {
  Shape shape;
  Offsets offsets;
  Attributes attributes = {};
  PlanarGraph planar_graph = {};           ///< what buffers are of, where there is no shape
  std::vector<BufferSource> sources = {};  ///< of each region of a buffer; or empty
};

/// Offset curves: .json is lossless; for each clearance .wkt has a surface of exact arcs, .dxf a
/// layer of polylines with bulges; .geojson has a polygon of chords for each region.
Status write_offsets(const Destination& target, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options = {});

struct CarveItem {
  Shape shape;
  Carving carving;
  Carving clearing = {};  ///< by an end mill before, see clearing_before(); or without paths
};

struct CuttingSpeeds {
  double feed = 1000;   ///< of cutting moves, units a minute
  double plunge = 300;  ///< downwards
  double spindle = 0;   ///< turns a minute; 0: the program does not set it
};

/// What a machine needs besides the paths. Lengths in units of the document.
struct MachineOptions {
  double safe = 5;      ///< height of moves between paths, positive
  double rapid = 3000;  ///< of these moves, for the estimated time
  CuttingSpeeds carving, clearing;
  double chord = 0;     ///< of without_arcs() for .csv; 0: 1e-6 of the tool's radius at the bottom
  std::string post;     ///< "linuxcnc", "grbl", "mach3", or a template's text; empty: plain G-code
  bool shaded = false;  ///< pictures: the surface after the cut, simulated, without the paths
};
std::string post_names();  ///< of the templates that are built in

/// What a program does, as it is written.
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

/// Makes a point of the drawing the origin, and turns y up where it points down.
void place(Document<CarveItem>& file, Vec2 zero);

/// Tool paths: .nc .gcode .ngc (G-code: G0 G1 G2 G3, absolute, G20 in inches and G21 otherwise, XY
/// plane, arcs by I and J, six decimals), .csv (path, kind, x, y, z), .dxf (space polylines on a
/// layer for each kind; passes at one depth as polylines with bulges and elevation), pictures of
/// the cut. place() has been called. Errors: also invalid_option (a template without its parts).
Status write_carving(const Destination& target, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine = {},
                     const WriteOptions& options = {});

/// What a format of one table holds; .json and .gpkg hold all three.
enum class FeatureTable : std::uint8_t {
  runs,      ///< a line for each primitive
  branches,  ///< a line for each medial branch
  points,    ///< the end and branching points
};

struct FeatureWriteOptions {
  FeatureTable table = FeatureTable::runs;
  WriteOptions write;  ///< chords, and how pictures are
  bool names = true;   ///< pictures: write the names beside the longest runs
};

/// One of `features` for each of `axes`, with attributes in tables and .json: docs/features.md.
Status write_features(const Destination& target, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options = {});

enum class LayerKind : std::uint8_t {
  disks,     ///< points; the first value is the radius
  lines,     ///< one part: the points of the line
  polygons,  ///< the parts are rings, the outer one first
  profile,   ///< one part: the centre of a disk and its two feet; .csv holds one such layer
};

/// A geometry with values: what measuring a shape gives besides axes.
struct LayerFeature {
  std::uint32_t feature = 0;             ///< of the input, whose attributes it gets
  std::vector<std::vector<Vec2>> parts;  ///< as the layer's kind says
  std::vector<double> values;            ///< one for each field of the layer
};

struct Layer {
  std::string name;
  LayerKind kind = LayerKind::lines;
  std::vector<std::string> fields;
  std::vector<LayerFeature> features;
  std::optional<std::size_t> label = {};  ///< the field that pictures write beside each feature
};

/// Layers of measurements: .geojson and .wkt (all layers one after another, .geojson with a member
/// "layer"), .gpkg (a layer each), .shp and .fgb (one layer only), pictures drawn over the shapes
/// and axes of `background`, whose items are the features of the input.
Status write_layers(const Destination& target, const std::string& format,
                    const Document<Layer>& layers, const Document<AxisItem>& background,
                    const WriteOptions& options = {});

/// Layers, and the features that they are of.
using MeasuredItems = std::pair<Document<Layer>, Document<AxisItem>>;
/// What is made of a file's features.
using StreamItems = std::variant<Document<AxisItem>, Document<OffsetItem>, MeasuredItems>;

struct StreamOptions {
  SourceOptions source;
  WriteOptions write;
  int threads = 0;   ///< see Options
  StreamItems none;  ///< of the kind that compute() makes, without features
  /// What becomes of some shapes of the file; called for several parts of it at once.
  std::function<Result<StreamItems>(Document<ShapeItem> shapes, int threads, AxesReport& report)>
      compute;
  std::function<void(const StreamItems& part)> visit;  ///< in order, before writing; may be empty
  /// Gets the share that is done, in [0, 1], and the number of features; may be empty.
  std::function<void(double share, std::uint64_t features)> progress;
  std::uint64_t least_bytes = std::uint64_t{1} << 20;  ///< of a file; smaller ones are read whole
};

struct StreamReport {
  LoadReport load;
  AxesReport axes;
  DocumentInfo document;  ///< what held for all, and the notes
};

/// What load_shapes(), options.compute and a writer make of a file, with the same bytes, part by
/// part; the file is read twice. Without a target's name nothing is written. Returns nothing where
/// the input is no .wkt or GDAL's vector format, the output no table, .wkt, .csv or .json, or an
/// option needs all features (repair, project, units, contours). A .fgb has no spatial index.
Result<std::optional<StreamReport>> stream(const std::string& path, const Destination& target,
                                           const std::string& format, const StreamOptions& options);

struct FieldPictureOptions {
  double width = 800;      ///< of the picture, in pixels or points, in [16, 8000]
  int lines = 40;          ///< along the longer side of the grid where force lines start; 0: none
  bool brightness = true;  ///< the lower the potential, by its logarithm, the brighter a point
  bool y_down = false;     ///< the y axis points down
  Unit unit = Unit::unknown;
};

/// Pictures of shapes with the potentials of their borders, sampled once for each pixel.
Status write_field(const std::string& path, const std::string& format,
                   std::span<const Shape> shapes, std::span<const PotentialField> fields,
                   const FieldPictureOptions& options = {});

/// An axis of voxels, or its surface where it has one: .ply (binary), .vtk (legacy, text) and .glb
/// (single precision) with radii, .obj; .png three views of solid and axis, `width` pixels wide.
Status write_voxels(const std::string& path, const std::string& format, const VoxelAxis& axis,
                    const Solid& solid, double width = 1536);

/// An image as .png, .tif (bytes 0 and 255) or .pbm, placed as `source`.
Status write_image(const std::string& path, const std::string& format, const Image& image,
                   const ImageFile& source);

struct DistanceFormat {
  bool squared = false;  ///< the squared distance, exactly, instead of the distance
  double scale = 1;      ///< what is written is this times the value
};

/// Distances: in 32 bits in .tif (real, or squared whole numbers), placed as `source`; in 16
/// bits in .png and .pgm. Errors: also invalid_option (more than 16 bits hold; no background).
Status write_distances(const std::string& path, const DistanceMap& distances,
                       const ImageFile& source, const DistanceFormat& format = {});

/// The bytes of a pack, which write_pack() writes; compressed by zstd. Errors: internal.
Result<std::vector<std::uint8_t>> pack_bytes(const PackFile& file);
Status write_pack(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// The number of bytes of a text or of a code compressed by zstd, at the level of packs.
std::size_t compressed_size(std::span<const std::uint8_t> bytes);
std::size_t compressed_size(const ShapeCode& code);

Status write_text(const std::string& path, const std::string& text);

/// Removes temporary files of writes under way; safe to call from a signal handler.
void remove_partial_files() noexcept;

}  // namespace medial::io
