#pragma once

// Files as documents, images, packs (of which `-` is standard input) and meshes.
// Errors of all: unreadable, malformed, unsupported, empty, not_finite, too_large, out_of_memory.

#include "medial/load.h"
#include "medial/pack.h"
#include "medial/volume.h"
#include "medial/voronoi.h"

namespace medial::io {

struct ImageOptions {
  /// Pixels at or above this value are foreground. Nothing: half of the format's largest value (128
  /// of 8 bits, 0.5 of real numbers and of 32 bits, any set bit of 1 bit); of zeros and ones, 1.
  std::optional<double> threshold;
  bool invert = false;  ///< pixels below the threshold are foreground instead
  /// Of read_document(): a feature for each value but 0, with the attribute `value`.
  bool labels = false;
};

struct ReadOptions {
  std::string layer;  ///< name of the layer; empty: the first
  std::string where;  ///< attribute filter of OGR SQL; empty: all
  /// make_valid repairs polygons of straight edges by GEOS; all else is left to load_shapes().
  RepairRule repair = RepairRule::none;
  /// Leaves out features that cannot be read, repaired or made a shape, with a note each.
  bool skip_invalid = false;
  std::string crs;  ///< "EPSG:n" or WKT, in place of the file's own; empty: that
  /// Projects longitudes and latitudes to metres, all features alike: within 300 km of their middle
  /// by transverse Mercator (conformal: disks stay disks), else by azimuthal equal-area. Without a
  /// reference system they count as WGS 84 if they can be degrees; projected ones only get a note.
  bool project = false;
  /// Of loose curves (DXF): joins ends at most this far apart, in units of the input, and drops
  /// what stays open; infinity closes all. Nothing: 1e-6 of the bounding box's diagonal.
  std::optional<double> close;
  ImageOptions image;  ///< of images: what is foreground
  /// For planar graphs: keeps points, lines, open curves and, of SVG, shapes that are not filled. A
  /// plain text of one block is a list of points, one of several a chain or a point each.
  bool loose = false;
  bool smooth_contour = false;  ///< of images: smooth_outline() instead of pixel_outline()
};

/// Reads polygons and curved shapes, gzipped or not (docs/inputs.md); images (see is_image()) as
/// one feature, the outline of their foreground with y downwards, or placed where the file says;
/// the free cells of a ROS map (.yaml). Recognises WKT, GeoJSON, SVG, DXF, `x y` text and medial's
/// own on standard input by their first characters. Errors: also no_area, invalid_option.
Result<Document<Feature>> read_document(const std::string& path, const ReadOptions& options = {});

/// The same of a text in memory, as of standard input.
Result<Document<Feature>> read_document_text(std::string_view text,
                                             const ReadOptions& options = {});

/// The subpaths of the path data of SVG, the attribute `d`: contours of the non-zero rule, open
/// where `loose` is set and they are not closed. Errors: malformed.
Result<std::vector<Contour>> read_path_data(std::string_view text, bool loose = false);

/// The outlines of a UTF-8 text in one line, with the advances and kerning of a scalable font file
/// (TrueType, OpenType, Type 1): a feature for each character with an outline, with an em of `size`
/// (0: in font units) and the baseline at y = 0. What the font lacks is replaced, with a note.
Result<Document<Feature>> read_text(const std::string& text, const std::string& font,
                                    double size = 0);

struct SourceOptions {
  ReadOptions read;  ///< its `repair` goes for features with curves as well
  std::string text;  ///< not empty: the outlines of this text in the font `path`, see read_text()
  double font_size = 0;
  LoadOptions load;  ///< but for `repair` and `skip_invalid`
  UnitOptions units;
};

/// What a file holds, by read_document() or read_text(); of medial's .json shapes with their
/// sources. Errors: theirs, with the file; invalid_option (an option that does not apply).
Result<Document<Feature>> read_features(const std::string& path, const SourceOptions& options = {});

/// The features of a file by medial::load_shapes() or, unrepaired, load_loose(). Errors: theirs.
Result<Document<ShapeItem>> load_shapes(const std::string& path, const SourceOptions& options = {},
                                        LoadReport* report = nullptr);
Result<LoosePieces> load_loose(const std::string& path, const SourceOptions& options = {});

/// Whether the file begins like medial's own JSON; and its content.
bool is_native(const std::string& path);
Result<Document<AxisItem>> read_native(const std::string& path);
Result<Document<AxisItem>> read_native_text(std::string_view text);

struct VoronoiItem {
  Shape shape;
  VoronoiDiagram diagram;
  Attributes attributes;
};

/// Whether the file is a .json that write_voronoi() made; and its diagrams, without shapes and
/// reference system. Errors: also unsupported (a newer version), too_large (4 GiB or more).
bool is_voronoi(const std::string& path);
Result<Document<VoronoiItem>> read_voronoi(const std::string& path);
struct ImageFile : PlacedImage, DocumentInfo {};
bool is_image(const std::string& path);  ///< for read_image(), by its beginning; or false
/// The image that a ROS map names, which is read with it; empty for all other files.
std::string image_of_map(const std::string& path);

/// A binary image: PBM (set bits are the foreground) and PGM, gzipped or not, or PNG, JPEG, BMP,
/// WebP, GIF, TIFF and GeoTIFF through GDAL, or a ROS map's free cells. Of colours the luminance
/// counts (BT.601); what is transparent or without data is background. Errors: also empty.
Result<ImageFile> read_image(const std::string& path, const ImageOptions& options = {});

/// Reads a mesh by its extension and cuts polygons into triangles: .obj and .stl through Assimp, in
/// single precision; .ply and .off, gzipped or not, in double precision. Errors: also unsupported
/// (another format, faces of more than 1,024 corners, or a build without Assimp).
Result<TriangleMesh> read_mesh(const std::string& path);

enum class PackKind : std::uint8_t { axes, squares };

/// A pack: a code, and what its picture needs. docs/pack.md describes the bytes.
struct PackFile : DocumentInfo {
  PackKind kind = PackKind::axes;
  ShapeCode code;
};

/// From a file or from bytes. Takes at most 256 times the memory of the bytes, and 64 KiB. Errors:
/// malformed (any damage, a wrong checksum included), unsupported (a newer version).
Result<PackFile> read_pack(const std::string& path);
Result<PackFile> unpack_bytes(std::span<const std::uint8_t> bytes);

/// The axes of a pack, with the shapes that their disks cover. `notes` (may be null) names the
/// shapes that could not be built, which stay without points.
Result<Document<AxisItem>> native_of(const PackFile& file,
                                     std::vector<std::string>* notes = nullptr);

/// What medial::io is made of, for reports of problems.
struct BuildInfo {
  Attributes libraries;    ///< names and versions as loaded, which may be newer than when built
  std::string extensions;  ///< read without GDAL, as ".json .svg"
  /// GDAL's names of the formats that it reads as features and as images.
  std::vector<std::string> vectors, rasters;
  bool projections = false;  ///< whether PROJ finds its database, which --project needs
};
BuildInfo build_info();

}  // namespace medial::io
