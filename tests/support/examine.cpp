#include "support/examine.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <utility>

#include "medial/medial.h"

namespace medial::test {

bool is_refusal(ErrorCode code) {
  switch (code) {
    case ErrorCode::not_finite:
    case ErrorCode::too_few_points:
    case ErrorCode::no_area:
    case ErrorCode::crossing:
    case ErrorCode::overlap:
    case ErrorCode::hole_outside:
    case ErrorCode::nested_outer:
    case ErrorCode::open_surface:
    case ErrorCode::non_manifold:
    case ErrorCode::too_large:
    case ErrorCode::empty:
    case ErrorCode::unreadable:
    case ErrorCode::malformed:
    case ErrorCode::unsupported:
      return true;
    case ErrorCode::unwritable:
    case ErrorCode::invalid_option:
    case ErrorCode::cancelled:
    case ErrorCode::out_of_memory:
    case ErrorCode::internal:
      return false;
  }
  return false;
}

Outcome examine(std::span<const Ring> rings, int threads) {
  const auto not_made = [](const Error& error) {
    // build_shape() has made the shape that compute() calls malformed.
    const bool refusal = is_refusal(error.code) && error.code != ErrorCode::malformed;
    return Outcome{refusal ? Verdict::refused : Verdict::failed, error.code, {to_string(error)}};
  };
  const auto shape = build_shape(rings);
  if (!shape) return not_made(shape.error());
  const auto axis = compute(*shape, {.threads = threads});
  if (!axis) return not_made(axis.error());
  Certificate certificate = verify(*shape, *axis, {.threads = threads});
  if (certificate.passed) return {};
  if (certificate.failures.empty()) certificate.failures = {"not passed, without a reason"};
  return {Verdict::failed, ErrorCode::internal, std::move(certificate.failures)};
}

std::string kind_of_failure(const Outcome& outcome) {
  if (outcome.verdict != Verdict::failed || outcome.reasons.empty()) return {};
  std::string kind;
  for (const char c : outcome.reasons[0])
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) kind += c;
  constexpr std::size_t opening = 24;
  return kind.substr(0, opening);
}

namespace {

using Rings = std::vector<Ring>;

/// Leaves out runs of items, long ones first, as long as `still_fails` takes what remains.
template <class Item, class StillFails>
bool thin_out(std::vector<Item> items, std::size_t fewest, StillFails still_fails) {
  bool thinner = false;
  for (std::size_t run = std::max<std::size_t>(items.size() / 2, 1);; run /= 2) {
    for (std::size_t i = 0; i < items.size() && items.size() > fewest;) {
      const std::size_t end = std::min({items.size(), i + run, i + items.size() - fewest});
      std::vector<Item> fewer(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i));
      fewer.insert(fewer.end(), items.begin() + static_cast<std::ptrdiff_t>(end), items.end());
      if (still_fails(fewer)) {
        items = std::move(fewer);
        thinner = true;
      } else {
        i = end;
      }
    }
    if (run == 1) return thinner;
  }
}

double rounded(double value, double step) { return std::round(value / step) * step; }

}  // namespace

Rings reduced(Rings rings, const std::function<bool(const Rings&)>& fails, std::size_t budget) {
  const auto accept = [&](const Rings& candidate) {
    if (budget == 0) return false;
    --budget;
    if (!fails(candidate)) return false;
    rings = candidate;
    return true;
  };
  for (bool smaller = true; smaller && budget > 0;) {
    smaller = thin_out(rings, 1, accept);
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (!rings[i].bulges.empty()) continue;  // bulges belong to their points
      smaller |= thin_out(rings[i].points, 3, [&](const std::vector<Vec2>& points) {
        Rings candidate = rings;
        candidate[i].points = points;
        return accept(candidate);
      });
    }
  }
  for (double step = 1e6; step >= 1e-15; step /= 10) {
    Rings candidate = rings;
    for (Ring& ring : candidate)
      for (Vec2& point : ring.points) point = {rounded(point.x, step), rounded(point.y, step)};
    if (accept(candidate)) break;
  }
  return rings;
}

}  // namespace medial::test
