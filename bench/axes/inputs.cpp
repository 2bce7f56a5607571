#include "inputs.h"

#include <utility>

#include "medial/io/read.h"
#include "support/environment.h"
#include "support/generate.h"

namespace medial::bench {

namespace {

std::string coast_path(const std::string& name) {
  return (test::data_folder() / "packaged/A_gis/gshhg" / (name + ".wkt.gz")).string();
}

Input coast(const std::string& name, std::size_t vertices) {
  return {name, Family::coast, vertices, [name]() -> Result<std::vector<Ring>> {
            auto dataset = io::read_document(coast_path(name));
            if (!dataset) return dataset.error();
            std::vector<Ring> rings = std::move(dataset->items.at(0).rings);
            for (Ring& ring : rings) {  // the peers want no closing point
              if (ring.points.size() > 1 && ring.points.front() == ring.points.back()) {
                ring.points.pop_back();
              }
            }
            return rings;
          }};
}

template <class Make>
Input made(const std::string& name, Family family, std::size_t vertices, Make make) {
  return {name, family, vertices, [make]() -> Result<std::vector<Ring>> { return make(); }};
}

}  // namespace

std::vector<Input> inputs(bool quick) {
  std::vector<Input> all;
  all.push_back(coast("sao_tome", 998));
  all.push_back(coast("halmahera", 9930));
  all.push_back(coast("new_guinea", 76369));
  all.push_back(coast("eurasia", 1181098));
  for (const std::size_t n : std::vector<std::size_t>{1000, 10000, 100000, 1000000}) {
    all.push_back(
        made("blob " + std::to_string(n), Family::smooth, n, [n] { return test::blob(n); }));
  }
  all.push_back(made("regular 100000-gon", Family::regular, 100000,
                     [] { return test::regular_polygon(100000); }));
  all.push_back(
      made("comb of 25000 teeth", Family::comb, 100000, [] { return test::comb(25000); }));
  for (const std::size_t n : std::vector<std::size_t>{10000, 100000, 1000000}) {
    all.push_back(
        made("maze " + std::to_string(n), Family::maze, n, [n] { return test::maze(n); }));
  }
  for (const std::size_t k : std::vector<std::size_t>{100, 300}) {
    all.push_back(made(std::to_string(k) + " x " + std::to_string(k) + " holes", Family::holes,
                       4 * (k * k + 1), [k] { return test::hole_grid(k); }));
  }
  if (quick) std::erase_if(all, [](const Input& input) { return input.vertices > 50000; });
  return all;
}

}  // namespace medial::bench
