#include <utility>

#include "io/formats/json.h"
#include "io/place.h"
#include "medial/io/read.h"

namespace medial::io {

namespace {

Result<Document<Feature>> read_source(const std::string& path, const SourceOptions& options) {
  const ReadOptions& read = options.read;
  if (!options.text.empty()) {
    if (!read.layer.empty() || !read.where.empty() || read.project || read.close)
      return Error{ErrorCode::invalid_option, "layer, where, project and close are not for a text",
                   in_file(path)};
    return read_text(options.text, path, options.font_size);
  }
  if (read.loose || !is_native(path)) return read_document(path, read);
  auto native = read_native(path, read);
  if (!native) return std::move(native).error();
  return features_of(std::move(native).value());
}

template <class T>
Result<T> naming_file(Result<T> result, const std::string& path) {
  if (!result && result.error().place.file.empty()) result.error().place.file = path;
  return result;
}

}  // namespace

Result<Document<Feature>> read_features(const std::string& path, const SourceOptions& options) {
  auto features = naming_file(read_source(path, options), path);
  if (!features) return features;
  if (Status done = convert_units(*features, options.units); !done)
    return naming_file<Document<Feature>>(std::move(done).error(), path);
  return features;
}

Result<Document<ShapeItem>> load_shapes(const std::string& path, const SourceOptions& options,
                                        LoadReport* report) {
  auto features = read_features(path, options);
  if (!features) return std::move(features).error();
  LoadOptions load = options.load;
  load.repair = options.read.repair;
  load.skip_invalid = options.read.skip_invalid;
  return naming_file(medial::load_shapes(std::move(features).value(), load, report), path);
}

Result<LoosePieces> load_loose(const std::string& path, const SourceOptions& options) {
  SourceOptions loose = options;
  loose.read.loose = true;
  loose.read.repair = RepairRule::none;
  auto features = read_features(path, loose);
  if (!features) return std::move(features).error();
  ArcOptions arcs = options.load.arcs;
  arcs.threads = options.load.threads;
  return naming_file(medial::load_loose(std::move(features).value(), arcs), path);
}

}  // namespace medial::io
