// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/regions.hpp"

#include <algorithm>

namespace topo::places {
namespace {

void add_contact(Region& region, const Contact& contact) {
  for (Contact& known : region.contacts) {
    if (known.other != contact.other) continue;
    known.upright += contact.upright;
    known.level += contact.level;
    known.wall_m += contact.wall_m;
    known.open += contact.open;
    known.clearance_m = std::max(known.clearance_m, contact.clearance_m);
    return;
  }
  region.contacts.push_back(contact);
}

/// A path that continues through a passage is no wider than the passage.
void narrow_to(Contact& contact, const Contact& passage) {
  contact.clearance_m = std::min(contact.clearance_m, passage.clearance_m);
  contact.open = std::min(contact.open, passage.open);
}

/// The same for all contacts of region `of`, except with region `but`.
void narrow_contacts(std::vector<Region>& regions, std::uint32_t of, std::uint32_t but,
                     const Contact& passage) {
  for (Contact& contact : regions[of].contacts) {
    if (contact.other == but) continue;
    narrow_to(contact, passage);
    for (Contact& back : regions[contact.other].contacts) {
      if (back.other == of) narrow_to(back, passage);
    }
  }
}

void extend_by(types::Rectangle& box, const types::Rectangle& more) {
  box.extend(more.min);
  box.extend(more.max);
}

Contact* contact_with(Region& region, std::uint32_t other) {
  const auto found = std::find_if(region.contacts.begin(), region.contacts.end(),
                                  [&](const Contact& c) { return c.other == other; });
  return found == region.contacts.end() ? nullptr : &*found;
}

/// When the opening in a wall joins one of the wall's two sides, the wall across the opening then lies
/// between that side and the other, as it does beside the opening.
bool hand_on_straddled(std::vector<Region>& regions, std::uint32_t opening, std::uint32_t side) {
  const float straddled_m = regions[opening].straddled_m;
  if (straddled_m <= 0.0F) return false;
  bool handed = false;
  for (Contact& beyond : regions[opening].contacts) {
    const Contact* wall = contact_with(regions[side], beyond.other);
    if (wall == nullptr || wall->wall_m <= 0.0F) continue;
    beyond.wall_m += straddled_m;
    if (Contact* back = contact_with(regions[beyond.other], opening)) back->wall_m += straddled_m;
    handed = true;
  }
  return handed;
}

void drop_contact(Region& region, std::uint32_t other) {
  std::erase_if(region.contacts, [&](const Contact& c) { return c.other == other; });
}

}  // namespace

void absorb(std::vector<Region>& regions, std::uint32_t into, std::uint32_t from, bool grows_core) {
  Region &a = regions[into], &b = regions[from];
  const float left_a_m = hand_on_straddled(regions, into, from) ? 0.0F : a.straddled_m;
  const float left_b_m = hand_on_straddled(regions, from, into) ? 0.0F : b.straddled_m;
  a.straddled_m = left_a_m + left_b_m;
  extend_by(a.box, b.box);
  if (grows_core) {
    extend_by(a.core, b.core);
    for (std::size_t k = 0; k < kTurns; ++k) extend_by(a.turned[k], b.turned[k]);
  }
  const bool a_clearest = a.clearance_m >= b.clearance_m;
  a.sum += b.sum;
  a.cells += b.cells;
  a.first = std::min(a.first, b.first);
  a.clearance_m = std::max(a.clearance_m, b.clearance_m);
  ++a.version;
  b.cells = 0;
  // A path from the clearest point of one side to the other leads through their common border.
  const Contact* met = contact_with(a, from);
  const Contact passage = met == nullptr ? Contact{} : *met;
  if (!a_clearest) narrow_contacts(regions, into, from, passage);
  drop_contact(a, from);
  for (Contact contact : b.contacts) {
    if (contact.other == into) continue;
    if (a_clearest) narrow_to(contact, passage);
    add_contact(a, contact);
    Region& third = regions[contact.other];
    drop_contact(third, from);
    contact.other = into;
    add_contact(third, contact);
  }
  b.contacts.clear();
}

}  // namespace topo::places
