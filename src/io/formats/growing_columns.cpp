// Columns of axes that are written while they grow. Rows of nodes and edges wait in a file until
// all are there, since their columns stand one after another; all others follow from the shapes.

#include <limits>
#include <optional>

#include "io/formats/columns.h"
#include "io/spill.h"
#include "methods/problem.h"

namespace medial::io::columns {

namespace {

/// Calls visit(place, column) for the columns that are not of points.
template <class Visit>
void visit_axis_columns(const Visit& visit) {
  std::size_t place = 0;
  const auto one = [&](const auto& column) {
    if (column.begins != &Tables::points && column.begins != &Tables::bulges)
      visit(place++, column);
  };
  visit_wide_columns(one);
  visit_columns(one);
}
constexpr std::size_t axis_columns = 11;

using Some = std::array<AxisItem, 1>;  ///< rows of one axis

/// Calls use(some) with all sites of a shape.
template <class Use>
void for_some_sites(const Shape& shape, const site::SiteNumbers& numbers, const Use& use) {
  constexpr std::size_t points = 4096;
  const std::size_t count = shape.points.size();
  Some some;
  for (std::size_t first = 0; first < count; first += points) {
    some[0].axis.sites = site::result_sites(shape, numbers, first, std::min(first + points, count));
    use(some);
  }
}

class GrowingColumns final : public AxisWriter {
 public:
  GrowingColumns(Target& target, const GrowingFrame& frame)
      : target_(target), frame_(frame), spill_(frame.folder, axis_columns) {}

  Status begin() override {
    numbers_.reset();
    latest_ = {};
    counts_ = {};
    return success();
  }

  Status add(AxisPart&& part) override {
    take_whole_numbers(part);
    latest_[0].axis = std::move(part.axis);
    latest_[0].axis.sites.clear();
    counts_.nodes += latest_[0].axis.nodes.size();
    counts_.edges += latest_[0].axis.edges.size();
    add_rows(latest_, [&](std::size_t place, std::string_view bytes) { spill_.put(place, bytes); });
    return spill_.status();
  }

  Status end(const Statistics&) override {
    const std::size_t i = tables_.tolerance.size();
    const Shape& shape = frame_.shapes.items[i].shape;
    counts_.sites = numbers_of(i).count;
    for_some_sites(shape, numbers_of(i),
                   [&](const Some& sites) { add_rows(sites, [](std::size_t, auto) {}); });
    add_item(tables_, shape, latest_[0].axis, counts_, false);
    return success();
  }

  Status finish() override {
    add_attributes(tables_, frame_.shapes.items);
    return write_columns(target_, frame_.shapes, tables_, *this);
  }

  template <class C>
  std::optional<std::uint32_t> checksum(const C& column) const {
    if constexpr (is_of_shape<C>) return checksum_of(frame_.shapes.items, column);
    return finite_ ? std::optional(checksums_[place_of(column)]) : std::nullopt;
  }
  template <class C>
  Status put(OutputStream& out, const C& column) {
    const auto put = [&](std::string_view bytes) { out.put(bytes); };
    if constexpr (is_of_shape<C>) {
      use_bytes(frame_.shapes.items, column, put);
    } else if (column.begins != &Tables::sites) {
      return spill_.read(place_of(column), put);
    } else {
      for (std::size_t i = 0; i < frame_.shapes.items.size(); ++i)
        for_some_sites(frame_.shapes.items[i].shape, numbers_of(i),
                       [&](const Some& sites) { use_bytes(sites, column, put); });
    }
    return success();
  }

 private:
  template <class C>
  static constexpr bool is_of_shape = std::is_invocable_v<decltype(C::rows), const ShapeItem&>;

  template <class C>
  static std::size_t place_of(const C& column) {
    std::size_t found = 0;
    visit_axis_columns([&](std::size_t place, const auto& other) {
      if (std::string_view(other.name) == column.name) found = place;
    });
    return found;
  }

  /// Adds rows to the checksums, and calls use(place, bytes).
  template <class Use>
  void add_rows(const Some& some, const Use& use) {
    visit_axis_columns([&](std::size_t place, const auto& column) {
      const bool finite = use_bytes(some, column, [&](std::string_view bytes) {
        add_to_checksum(checksums_[place], bytes);
        use(place, bytes);
      });
      finite_ = finite_ && finite;
    });
  }

  const site::SiteNumbers& numbers_of(std::size_t i) {
    if (!numbers_ || numbers_->first != i)
      numbers_.emplace(i, Problem(frame_.shapes.items[i].shape, frame_.options).numbers());
    return numbers_->second;
  }

  Target& target_;
  GrowingFrame frame_;
  Spill spill_;
  std::optional<std::pair<std::size_t, site::SiteNumbers>> numbers_;  ///< of the latest shape
  Some latest_;                                                       ///< part
  std::array<std::uint32_t, axis_columns> checksums_{};
  RowCounts counts_{};
  Tables tables_;
  bool finite_ = true;
};

}  // namespace

std::unique_ptr<AxisWriter> grow(Target& target, const GrowingFrame& frame) {
  return std::make_unique<GrowingColumns>(target, frame);
}

}  // namespace medial::io::columns
