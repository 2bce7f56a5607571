#pragma once

#include <memory>

#include "methods/disks/contacts.h"

namespace medial::disks {

/// The contacts of disks with what lies around a planar graph, where edges stand twice, once for
/// each side. A disk that touches one side is as near to the other, and where several edges meet,
/// to all of them: it touches what faces it, on whose side and in whose range of directions its
/// centre lies.
class PlanarContacts final : public Contacts {
 public:
  using Contacts::Contacts;

  std::uint32_t owner(std::uint32_t i, Vec2 center, const Span& span) const override;
  bool faces(std::uint32_t i, Vec2 c) const override;
  std::optional<site::Site> other_side(std::uint32_t i) const override;

 private:
  Hit search(Vec2 center, double reach, const Span& span) const override {
    return context_.tree.nearest_facing(center, reach, span.right + 1, span.left - 1);
  }
  /// A point may have all directions to itself.
  bool has_narrow_wedges() const override { return false; }
};

/// The contacts of disks with a boundary.
std::unique_ptr<Contacts> contacts_with(const WalkContext& context, Statistics& statistics);

}  // namespace medial::disks
