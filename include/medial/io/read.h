#pragma once

// Reads documents, images, packs and meshes from files; `-` is standard input, except for meshes.
// Common errors: unreadable, malformed, unsupported, empty, not_finite, too_large, out_of_memory.

#include "medial/load.h"
#include "medial/pack.h"
#include "medial/volume.h"
#include "medial/voronoi.h"

namespace medial::io {

struct ImageOptions {
  /// Pixels at or above this value are foreground. By default half of the format's largest value
  /// (128 for 8 bits, 0.5 for real numbers and 32 bits, any set bit for 1 bit); for 0 and 1, 1.
  std::optional<double> threshold;
  bool invert = false;  ///< pixels below the threshold are foreground instead
  bool labels = false;  ///< read_document(): makes a feature of each `value` (attribute) but 0
};

struct ReadOptions {
  std::string layer;  ///< name of the layer; empty: the first
  std::string where;  ///< attribute filter of OGR SQL; empty: all
  /// make_valid repairs polygons of straight edges by GEOS; load_shapes() repairs the rest.
  RepairRule repair = RepairRule::none;
  bool skip_invalid = false;  ///< leaves out what cannot be read, repaired, or made a shape
  std::string crs;            ///< "EPSG:n" or WKT; overrides the file's own; empty: the file's
  /// Projects degrees, and plane coordinates whose lengths are off by 1 %, to metres, all alike: up
  /// to 300 km from their middle by transverse Mercator (conformal: disks stay disks), else by
  /// azimuthal equal-area. Without a reference system, what can be degrees counts as WGS 84.
  bool project = false;
  /// For loose curves (DXF): joins ends at most this far apart, in units of the input, and drops
  /// chains that stay open; infinity closes all. By default 1e-6 of the bounding box's diagonal.
  std::optional<double> close;
  ImageOptions image;  ///< for images: what is foreground
  /// For planar graphs: keeps points, lines, open curves and, in SVG, shapes that are not filled. A
  /// single block of plain text is a list of points; of several, each is a chain or a point.
  bool loose = false;
  bool smooth_contour = false;  ///< for images: smooth_outline() instead of pixel_outline()
};

/// Reads polygons and curved shapes, gzipped or not (docs/inputs.md); images (see is_image()) as
/// one feature, the outline of their foreground with y downwards, or placed as the file says; the
/// free cells of a ROS map (.yaml). On standard input, recognises WKT, GeoJSON, SVG, DXF, `x y`
/// text and medial's own format by their first characters. Errors: also no_area, invalid_option.
Result<Document<Feature>> read_document(const std::string& path, const ReadOptions& options = {});
/// The same for a text in memory, like standard input.
Result<Document<Feature>> read_document_text(std::string_view text,
                                             const ReadOptions& options = {});

/// The subpaths of SVG path data (the attribute `d`) as contours of the non-zero rule; if `loose`,
/// those that are not closed stay open. Errors: malformed.
Result<std::vector<Contour>> read_path_data(std::string_view text, bool loose = false);
/// The outlines of one line of UTF-8 text, with the advances and kerning of a scalable font file
/// (TrueType, OpenType, Type 1): one feature per character with an outline, with an em of `size`
/// (0: font units) and the baseline at y = 0. Replaces characters that the font lacks, with a note.
Result<Document<Feature>> read_text(const std::string& text, const std::string& font,
                                    double size = 0);

struct SourceOptions {
  ReadOptions read;  ///< `repair` applies to features with curves, too
  std::string text;  ///< if not empty, its outlines in the font `path`: see read_text()
  double font_size = 0;
  LoadOptions load;  ///< except `repair` and `skip_invalid`
  UnitOptions units;
};

/// The features of a file, by read_document(), read_native() or read_text(). Errors: theirs.
Result<Document<Feature>> read_features(const std::string& path, const SourceOptions& options = {});
/// Passes read_features() to medial::load_shapes() or, unrepaired, load_loose(). Errors: theirs.
Result<Document<ShapeItem>> load_shapes(const std::string& path, const SourceOptions& options = {},
                                        LoadReport* report = nullptr);
Result<LoosePieces> load_loose(const std::string& path, const SourceOptions& options = {});

/// Whether the file begins like medial's own format; and its content. Errors: also invalid_option.
bool is_native(const std::string& path);
Result<Document<AxisItem>> read_native(const std::string& path, const ReadOptions& options = {});
Result<Document<AxisItem>> read_native_text(std::string_view text);
Document<Feature> features_of(Document<AxisItem> file);  ///< its shapes, with their sources

struct VoronoiItem {
  Shape shape;
  VoronoiDiagram diagram;
  Attributes attributes;
  LoosePieces pieces = {};  ///< of a planar graph; Site::ring is a chain. Chains may be missing
};

/// Whether write_voronoi() made the .json; and its bare diagrams. Errors: unsupported, too_large.
bool is_voronoi(const std::string& path);
Result<Document<VoronoiItem>> read_voronoi(const std::string& path);
struct ImageFile : PlacedImage, DocumentInfo {};
bool is_image(const std::string& path);  ///< whether read_image() reads it, by its first bytes
std::string image_of_map(const std::string& path);  ///< that a ROS map refers to; or empty

/// A binary image: PBM (set bits are the foreground) and PGM, gzipped or not, or PNG, JPEG, BMP,
/// WebP, GIF, TIFF and GeoTIFF through GDAL, or a ROS map's free cells. Colours count by luminance
/// (BT.601); pixels that are transparent or without data are background. Errors: also empty.
Result<ImageFile> read_image(const std::string& path, const ImageOptions& options = {});

/// Reads a mesh and cuts polygons into triangles: .obj and .stl through Assimp, in single
/// precision; .ply and .off, gzipped or not, in double precision. Errors: also unsupported (another
/// format, faces of more than 1,024 corners, or a build without Assimp).
Result<TriangleMesh> read_mesh(const std::string& path);

enum class PackKind : std::uint8_t { axes, squares };

/// A pack: a code, and what its picture needs. docs/pack.md describes the bytes.
struct PackFile : DocumentInfo {
  PackKind kind = PackKind::axes;
  ShapeCode code;
};

/// From a file or from bytes. Uses at most 256 times the memory of the bytes, plus 64 KiB. Errors:
/// malformed (any damage, a wrong checksum included), unsupported (a newer version).
Result<PackFile> read_pack(const std::string& path);
Result<PackFile> unpack_bytes(std::span<const std::uint8_t> bytes);

/// With the shapes that their disks cover; `notes` (may be null) names those that have no points.
Result<Document<AxisItem>> native_of(const PackFile& file,
                                     std::vector<std::string>* notes = nullptr);

/// The parts of medial::io, for bug reports.
struct BuildInfo {
  Attributes libraries;    ///< names and versions loaded, which may be newer than at build time
  std::string extensions;  ///< read without GDAL, such as ".json .svg"
  std::vector<std::string> vectors, rasters;  ///< GDAL's names of what it reads: features, images
  bool projections = false;  ///< whether PROJ finds its database, which --project needs
};
BuildInfo build_info();

}  // namespace medial::io
