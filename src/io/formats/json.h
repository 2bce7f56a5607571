#pragma once

// Medial's own formats in JSON (docs/format.md).

#include <string_view>

#include "io/format.h"

namespace medial::io {

/// The highest version of the native format that is read. A file is written in the lowest version
/// that holds it: 1, or 2 where there are arcs.
inline constexpr int native_version = 2;

/// Whether a text begins like medial's own JSON: an object whose first member is "medial".
bool begins_like_native(std::string_view text);
/// Whether it begins like a Voronoi diagram, whose first member is "medial_voronoi".
bool begins_like_voronoi(std::string_view text);
/// Of JSON of medial's own without a shape: what it holds, and what reads it; else null.
const char* text_without_shape(std::string_view text);

/// Reads and checks: every index is in its range, every number finite.
/// Errors: unreadable, malformed, unsupported (a newer version), too_large (4 GiB or more).
Result<Document<AxisItem>> read_native(TextSource& source);
Result<Document<VoronoiItem>> read_voronoi(TextSource& source);

/// Whether bytes begin like columns (safetensors), and the axes that these hold.
bool begins_like_safetensors(std::string_view text);
Result<Document<AxisItem>> read_safetensors(TextSource& source);

/// unit_of(), and what else a stored file may name: pixels of images, degrees.
std::optional<Unit> stored_unit(std::string_view name);

/// What files in JSON and in columns have in common: they throw Malformed.
void check_item(const AxisItem& item);
Unit unit_from(const std::string& name);
/// Throws where it is not one of Options.
double corner_angle_from(double degrees);

/// A row that reads the shapes of native files.
Format native_reading(const char* extensions);

// Without loss, except for features.
Status write_json(Target& target, const AxesOutput& output);
Status write_json(Target& target, const ShapesOutput& output);
Status write_json(Target& target, const VoronoiOutput& output);
Status write_json(Target& target, const OffsetsOutput& output);
Status write_json(Target& target, const FeaturesOutput& output);

/// The rows of a site and a node.
void put_site(OutputStream& out, const Site& site);
void put_node(OutputStream& out, const Node& node);

/// The member "unit" of a file, where one is to be named.
void put_unit(Target& target);

/// The control point of a straight edge whose radius runs evenly: files leave it out.
Disk middle_of(const Disk& a, const Disk& b);

}  // namespace medial::io
