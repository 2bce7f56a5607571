#include "cli/loose.h"

#include <fmt/format.h>

#include <utility>

#include "cli/terminal.h"
#include "medial/io/read.h"

namespace medial::cli {

Result<LooseFile> load_chains(const InputOptions& input, int threads) {
  io::ReadOptions read = input.read;
  read.loose = true;
  read.repair = io::RepairRule::none;
  const Activity shown("reading", input.path);
  auto dataset = input.text.empty() ? io::read_dataset(input.path, read)
                                    : io::read_text(input.text, input.path);
  if (!dataset) return std::move(dataset).error();
  LooseFile file;
  file.crs_wkt = dataset->crs_wkt;
  file.y_down = dataset->y_down;
  file.notes = std::move(dataset->notes);
  ArcOptions arcs = input.arcs;
  arcs.threads = threads;
  for (std::uint32_t i = 0; i < dataset->items.size(); ++i) {
    auto chains = io::chains_of(dataset->items[i], arcs);
    if (!chains) return at_feature(std::move(chains).error(), input.path, i);
    for (Chain& chain : *chains) {
      file.chains.push_back(std::move(chain));
      file.feature.push_back(i);
    }
    file.attributes.push_back(std::move(dataset->items[i].attributes));
  }
  return file;
}

void print_notes(const LooseFile& file, const InputOptions& input, const CommonOptions& common) {
  if (common.quiet) return;
  for (const std::string& note : file.notes) say("medial: {}: {}\n", input.path, note);
}

Result<PlanarGraph> planar_graph_of(const LooseFile& file, const InputOptions& input,
                                    double reach) {
  auto planar_graph = build_planar_graph(
      file.chains, {.node_crossings = input.read.repair != io::RepairRule::none, .reach = reach});
  if (!planar_graph) return in_terms_of(file, std::move(planar_graph).error(), input.path);
  return planar_graph;
}

bool is_too_close(const Error& error) {
  return error.code == ErrorCode::unsupported && error.place.ring && error.place.point;
}

void tell_touching(double reach, const InputOptions& input, const CommonOptions& common) {
  if (!common.quiet)
    say("medial: {}: note: points and edges within {:.2g} of each other touch, as rounding "
        "does not tell them apart\n",
        input.path, reach);
}

Error in_terms_of(const LooseFile& file, Error error, const std::string& path) {
  if (error.place.file.empty()) error.place.file = path;
  if (!error.place.ring || *error.place.ring >= file.feature.size()) return error;
  const std::uint64_t chain = *error.place.ring;
  error.place.feature = file.feature[chain];
  std::uint64_t first = chain;
  while (first > 0 && file.feature[first - 1] == file.feature[chain]) --first;
  error.place.ring = chain - first;
  return error;
}

}  // namespace medial::cli
