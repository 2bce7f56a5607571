// Runs every polygon file of a data folder through read_document, build_shape, compute and verify,
// and prints a table. A folder can have a README.md with a table `| file | what | size | ...` whose
// third column counts the invalid features: what is valid must be verified.
//
//   medial_corpus [--save DIR] FOLDER...
//
// --save: writes the features that fail, and a smaller part of each that still fails, as WKT.
// Exit status: 0; 1 where a feature failed or a valid one was refused; 2 for a wrong call; 77 (what
// ctest takes for a skipped test) where a folder does not exist.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "medial/io/read.h"
#include "medial/medial.h"
#include "support/corpus_cases.h"
#include "support/examine.h"
#include "support/generate.h"
#include "support/wkt.h"

namespace medial::test {
namespace {

namespace fs = std::filesystem;

/// The results for a whole file, and the number of its features that its README calls invalid.
struct File {
  fs::path path;
  std::vector<Case> cases;
  std::optional<std::size_t> invalid;
};

struct Row {
  std::size_t verified = 0, refused = 0, failed = 0;
  std::map<std::string, std::size_t> codes;
  std::vector<std::string> remarks;  ///< failures
};

/// The invalid features of each file that a README speaks of, by path below its folder.
std::map<std::string, std::size_t> invalid_by_readme(const fs::path& folder) {
  std::map<std::string, std::size_t> result;
  std::ifstream readme(folder / "README.md");
  const std::regex count("([0-9]+) (?:invalid|not\\b)"), valid("\\bvalid\\b|Valid Geometry");
  for (std::string line; std::getline(readme, line);) {
    const std::vector<std::string> cells = split(line, '|');
    if (cells.size() < 4) continue;
    const auto first = cells[1].find_first_not_of(' '), last = cells[1].find_last_not_of(' ');
    if (first == std::string::npos) continue;
    const std::string file = cells[1].substr(first, last - first + 1);
    std::smatch match;
    if (std::regex_search(cells[3], match, count))
      result[file] = static_cast<std::size_t>(std::stoul(match[1]));
    else if (std::regex_search(cells[3], valid))
      result[file] = 0;
  }
  return result;
}

std::vector<File> files_below(const fs::path& folder) {
  std::vector<File> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    for (const char* ending : {".wkt", ".wkt.gz", ".geojson", ".geojson.gz", ".tsv", ".txt"})
      if (entry.is_regular_file() && name.ends_with(ending) && name != "LIST.tsv")
        files.push_back({entry.path(), {}, {}});
  }
  std::sort(files.begin(), files.end(),
            [](const File& a, const File& b) { return a.path < b.path; });
  // A README speaks for the folder it lies in.
  std::map<fs::path, std::map<std::string, std::size_t>> readmes;
  for (File& file : files) {
    for (fs::path above = file.path.parent_path();; above = above.parent_path()) {
      if (!readmes.contains(above)) readmes[above] = invalid_by_readme(above);
      const auto found = readmes[above].find(fs::relative(file.path, above).generic_string());
      if (found != readmes[above].end()) file.invalid = found->second;
      if (above == folder || above == above.parent_path()) break;
    }
  }
  return files;
}

void save(const fs::path& folder, const std::string& name, const std::vector<Ring>& rings) {
  fs::create_directories(folder);
  std::ofstream(folder / (name + ".wkt")) << to_wkt(rings) << '\n';
  const std::string kind = kind_of_failure(examine(rings, 0));
  const auto fails = [&](const std::vector<Ring>& candidate) {
    return kind_of_failure(examine(candidate, 0)) == kind;
  };
  const std::size_t budget = 40'000'000 / (vertex_count(rings) + 1000);
  std::ofstream(folder / (name + ".min.wkt")) << to_wkt(reduced(rings, fails, budget)) << '\n';
}

Row examine_file(const File& file, const std::optional<fs::path>& saved) {
  Row row;
  for (const Case& one : file.cases) {
    Outcome outcome;
    if (one.error) {
      outcome = {is_refusal(one.error->code) ? Verdict::refused : Verdict::failed,
                 one.error->code,
                 {to_string(*one.error)}};
    } else {
      outcome = examine(one.rings, 0);
    }
    const std::string reason = outcome.reasons.empty() ? "" : outcome.reasons[0];
    if (outcome.verdict == Verdict::verified) ++row.verified;
    if (outcome.verdict == Verdict::refused) {
      ++row.refused;
      ++row.codes[name_of(outcome.code)];
      if (one.valid == true) row.remarks.push_back("VALID, REFUSED " + one.name + ": " + reason);
    }
    if (outcome.verdict == Verdict::failed) {
      ++row.failed;
      row.remarks.push_back("FAILED " + one.name + ": " + reason);
      if (saved) save(*saved, file.path.stem().string() + "_" + one.name, one.rings);
    }
  }
  if (file.invalid && row.refused > *file.invalid) {
    row.remarks.push_back(std::to_string(*file.invalid) + " features are invalid, " +
                          std::to_string(row.refused) + " were refused");
  }
  return row;
}

int run(const std::vector<fs::path>& folders, const std::optional<fs::path>& saved) {
  std::printf("%-62s %8s %8s %8s %7s  %s\n", "file", "features", "verified", "refused", "FAILED",
              "refused with");
  Row all;
  std::size_t features = 0;
  for (const fs::path& folder : folders) {
    for (File& file : files_below(folder)) {
      file.cases = read_cases(file.path);
      if (file.cases.empty()) continue;
      const Row row = examine_file(file, saved);
      std::string codes;
      for (const auto& [code, count] : row.codes) codes += code + " " + std::to_string(count) + " ";
      std::printf("%-62s %8zu %8zu %8zu %7zu  %s\n",
                  fs::relative(file.path, folder).generic_string().c_str(), file.cases.size(),
                  row.verified, row.refused, row.failed, codes.c_str());
      for (const std::string& remark : row.remarks) std::printf("    %s\n", remark.c_str());
      std::fflush(stdout);
      features += file.cases.size();
      all.verified += row.verified;
      all.refused += row.refused;
      all.failed += row.failed;
      all.remarks.insert(all.remarks.end(), row.remarks.begin(), row.remarks.end());
    }
  }
  std::printf("%-62s %8zu %8zu %8zu %7zu\n", "all", features, all.verified, all.refused,
              all.failed);
  return all.remarks.empty() ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  std::vector<std::filesystem::path> folders;
  std::optional<std::filesystem::path> saved;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--save" && i + 1 < count)
      saved = arguments[++i];
    else
      folders.emplace_back(argument);
  }
  if (folders.empty()) {
    std::fprintf(stderr, "usage: medial_corpus [--save DIR] FOLDER...\n");
    return 2;
  }
  for (const auto& folder : folders) {
    if (std::filesystem::is_directory(folder)) continue;
    std::printf("%s: no such folder: skipped\n", folder.c_str());
    return 77;
  }
  return medial::test::run(folders, saved);
}
