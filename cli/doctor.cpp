// medial doctor: the parts of this build, and whether it works here.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "medial/compute.h"
#include "medial/io/read.h"
#include "medial/threads.h"
#include "medial/verify.h"

namespace medial::cli {
namespace {

constexpr const char* compiler =
#if defined(__clang__)
    "Clang " __clang_version__;
#elif defined(__GNUC__)
    "GCC " __VERSION__;
#else
    "an unknown compiler";
#endif

constexpr std::pair<const char*, io::DocumentKind> written_kinds[] = {
    {"axes", io::DocumentKind::axes},          {"shapes", io::DocumentKind::shapes},
    {"voronoi", io::DocumentKind::voronoi},    {"offsets", io::DocumentKind::offsets},
    {"carving", io::DocumentKind::carving},    {"features", io::DocumentKind::features},
    {"layers", io::DocumentKind::layers},      {"voxels", io::DocumentKind::voxels},
    {"distances", io::DocumentKind::distances}};

/// "works", or the error for the axis of an L, which has 9 edges.
std::string try_axis(bool exact) {
  const Ring ring{{{0, 0}, {10, 0}, {10, 3}, {3, 3}, {3, 10}, {0, 10}}, {}};
  const auto shape = build_shape({&ring, 1});
  if (!shape) return to_string(shape.error());
  Options options;
  options.exact = exact;
  const auto axis = compute(*shape, options);
  if (!axis) return axis.error().code == ErrorCode::unsupported ? "no" : to_string(axis.error());
  const bool right = axis->edges.size() == 9 && verify(*shape, *axis).passed;
  return right ? "works" : "FAILS: the axis of an L is wrong";
}

Json findings() {
  const io::BuildInfo info = io::build_info();
  Json libraries, written;
  for (const auto& [name, version] : info.libraries) libraries[name] = version;
  for (const auto& [name, kind] : written_kinds) written[name] = io::formats_of(kind);
  return {{"medial", MEDIAL_VERSION},
          {"compiler", compiler},
          {"threads", effective_threads(0)},
          {"axis", try_axis(false)},
          {"exact", try_axis(true)},
          {"projections", info.projections ? "works" : "FAILS: PROJ does not find proj.db"},
          {"libraries", libraries},
          {"read",
           {{"medial", info.extensions},
            {"GDAL, vector", fmt::format("{}", fmt::join(info.vectors, " "))},
            {"GDAL, raster", fmt::format("{}", fmt::join(info.rasters, " "))}}},
          {"written", written}};
}

std::string text_of(const Json& findings) {
  Rows rows(16);
  for (const auto& [name, value] : findings.items()) {
    if (value.is_object()) {
      rows.add("", "");
      rows.add(name, "");
      for (const auto& [part, text] : value.items()) rows.add("  " + part, text.get<std::string>());
    } else {
      rows.add(name, value.is_string() ? value.get<std::string>() : value.dump());
    }
  }
  return rows.text();
}

Result<int> run_doctor(bool json) {
  const Json found = findings();
  Status printed = json ? print(found) : print(text_of(found));
  if (!printed) return std::move(printed).error();
  return found.dump().find("FAILS") == std::string::npos ? exit_success : exit_failed_verdict;
}

}  // namespace

Command make_doctor_command(CLI::App& program) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand(
      "doctor", "Print versions and formats of this build, and whether it works here.");
  command->add_flag("--json", *json, "Print a JSON object instead of a table.");
  command->footer("Exit status 1: something fails. Add the output to a bug report.");
  return {command, [json] { return run_doctor(*json); }};
}

}  // namespace medial::cli
