// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/regions.hpp"

#include <algorithm>
#include <bit>
#include <numbers>

#include "core/grid/free_runs.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// One observation that two regions have something between them; sorted and summed up later.
struct Pair {
  std::uint64_t key;  ///< the smaller region above the greater
  std::uint32_t upright, level;
  float wall_m;
  float clearance_m;
};

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

void extend_by_disc(types::Rectangle& box, const types::Vector2& centre, double radius_m) {
  box.extend(centre - types::Vector2(radius_m, radius_m));
  box.extend(centre + types::Vector2(radius_m, radius_m));
}

/// Sums per region, and pairs of labels across borders.
class CellPass {
 public:
  CellPass(const DenseMap& map, std::span<const float> clearance_m, const FirstLabels& first,
           const CompassFrame& frame)
      : map_(map),
        clearance_m_(clearance_m),
        labels_(first.labels),
        numbers_(first, map.cells.size()),
        frame_(frame),
        regions(first.pieces.size()) {}

  void run() {
    const std::uint32_t* const labels = labels_.data();
    grid::for_each_free_run(map_, [&](const grid::FreeRun& run) {
      for (std::size_t i = run.first; i < run.end;) {
        const std::size_t begin = i;
        const std::uint32_t label = labels[i];
        while (i < run.end && labels[i] == label) ++i;
        if (label == 0) continue;
        const auto x = run.cell.x + static_cast<std::int32_t>(begin - run.first);
        add_run({x, run.cell.y}, begin, i - begin);
      }
    });
    pad_boxes();
  }
  [[nodiscard]] const PieceNumbers& numbers() const { return numbers_; }
  void add_cores(std::span<const std::uint32_t> axis) {
    const double compass_rad = std::atan2(frame_.sin, frame_.cos),
                 step_rad = std::numbers::pi / 2.0 / (kTurns + 1);
    std::vector<CompassFrame> turns;
    for (std::size_t k = 0; k < kTurns; ++k)
      turns.emplace_back(compass_rad + static_cast<double>(k + 1) * step_rad);
    for (const std::uint32_t i : axis) {
      if (labels_[i] == 0) continue;
      Region& region = regions[numbers_.of(labels_[i])];
      const types::Vector2 centre = map_.centre_of(map_.cell(i));
      const double r = static_cast<double>(clearance_m_[i]) - 0.5 * map_.resolution_m;
      extend_by_disc(region.core, frame_.from_map(centre), r);
      for (std::size_t k = 0; k < kTurns; ++k) extend_by_disc(region.turned[k], turns[k].from_map(centre), r);
    }
    for (Region& region : regions) {
      region.core.min = region.core.min.cwiseMax(region.box.min);
      region.core.max = region.core.max.cwiseMin(region.box.max);
    }
  }

 private:
  /// Cells with one label side by side.
  void add_run(grid::CellIndex cell, std::size_t first, std::size_t count) {
    Region& region = regions[numbers_.of(labels_[first])];
    const types::Vector2 a = map_.centre_of(cell);
    const types::Vector2 b = a + types::Vector2(static_cast<double>(count - 1) * map_.resolution_m, 0.0);
    region.box.extend(frame_.from_map(a));
    region.box.extend(frame_.from_map(b));
    region.sum += 0.5 * static_cast<double>(count) * (a + b);
    region.cells += static_cast<std::uint32_t>(count);
    region.first = std::min(region.first, static_cast<std::uint32_t>(first));
    region.clearance_m = std::max(region.clearance_m, clearest(first, count));
    note_above(first, count);
    note(labels_[first], labels_[first + count],
         {0, 1, 0, 0.0F, std::min(clearance_m_[first + count - 1], clearance_m_[first + count])});
  }
  /// Floats that are not negative are in the order of their bits, and of whole numbers the compiler makes
  /// vector instructions.
  [[nodiscard]] float clearest(std::size_t first, std::size_t count) const {
    std::int32_t most = 0;
    for (const float& clearance_m : clearance_m_.subspan(first, count))
      most = std::max(most, std::bit_cast<std::int32_t>(clearance_m));
    return std::bit_cast<float>(most);
  }
  /// What lies above a run, each label side by side once.
  void note_above(std::size_t first, std::size_t count) {
    const auto width = static_cast<std::size_t>(map_.width());
    const std::uint32_t label = labels_[first];
    const std::uint32_t* const above = &labels_[first + width];
    for (std::size_t i = 0; i < count;) {
      const std::uint32_t other = above[i];
      if (other == label || other == 0) {
        ++i;
        continue;
      }
      Pair pair{0, 0, 0, 0.0F, 0.0F};
      for (; i < count && above[i] == other; ++i) {
        ++pair.level;
        pair.clearance_m =
            std::max(pair.clearance_m, std::min(clearance_m_[first + i], clearance_m_[first + i + width]));
      }
      note(label, other, pair);
    }
  }
  void note(std::uint32_t label, std::uint32_t other, Pair pair) {
    if (other == 0 || other == label) return;
    pair.key = key_of(numbers_.of(label), numbers_.of(other));
    pairs.push_back(pair);
  }
  /// From the centres of cells to their sides.
  void pad_boxes() {
    const double half = 0.5 * map_.resolution_m * (std::abs(frame_.cos) + std::abs(frame_.sin));
    for (Region& region : regions) {
      region.box.min -= types::Vector2(half, half);
      region.box.max += types::Vector2(half, half);
    }
  }

  const DenseMap& map_;
  std::span<const float> clearance_m_;
  const std::vector<std::uint32_t>& labels_;
  PieceNumbers numbers_;
  const CompassFrame& frame_;

 public:
  std::vector<Region> regions;
  std::vector<Pair> pairs;
};

/// First label met from `p` on in the given direction: beyond the wall's thickness there is what it bounds.
std::uint32_t label_beside(const DenseMap& map, const std::vector<std::uint32_t>& labels,
                           const types::Vector2& p, const types::Vector2& direction) {
  constexpr double kReachM = 0.40;
  for (double d = 0.5 * map.resolution_m; d <= kReachM; d += map.resolution_m) {
    const grid::CellIndex cell = map.cell_at(p + d * direction);
    if (!map.contains(cell)) return 0;
    if (const std::uint32_t label = labels[map.index(cell)]; label != 0) return label;
  }
  return 0;
}

void note_walls(const DenseMap& map, const std::vector<std::uint32_t>& labels, const PieceNumbers& numbers,
                std::span<const types::Segment> walls, std::vector<Region>& regions,
                std::vector<Pair>& pairs) {
  constexpr double kStepM = 0.10;
  for (const types::Segment& wall : walls) {
    const double length_m = wall.length_m();
    if (!(length_m > 0.0) || !std::isfinite(length_m)) continue;
    const types::Vector2 along = (wall.b - wall.a) / length_m, across(-along.y(), along.x());
    for (double d = 0.5 * kStepM; d < length_m; d += kStepM) {
      const types::Vector2 p = wall.a + d * along;
      const std::uint32_t a = label_beside(map, labels, p, across), b = label_beside(map, labels, p, -across);
      if (a == 0 || b == 0) continue;
      if (a == b)
        regions[numbers.of(a)].straddled_m += static_cast<float>(kStepM);
      else
        pairs.push_back({key_of(numbers.of(a), numbers.of(b)), 0, 0, static_cast<float>(kStepM), 0.0F});
    }
  }
}

void add_contacts(std::vector<Pair>& pairs, std::vector<Region>& regions) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.key < b.key; });
  for (std::size_t k = 0; k < pairs.size();) {
    Contact contact;
    const std::uint64_t key = pairs[k].key;
    for (; k < pairs.size() && pairs[k].key == key; ++k) {
      contact.upright += pairs[k].upright;
      contact.level += pairs[k].level;
      contact.wall_m += pairs[k].wall_m;
      contact.clearance_m = std::max(contact.clearance_m, pairs[k].clearance_m);
    }
    contact.open = static_cast<float>(contact.border());
    const auto a = static_cast<std::uint32_t>(key >> 32U), b = static_cast<std::uint32_t>(key);
    contact.other = b;
    regions[a].contacts.push_back(contact);
    contact.other = a;
    regions[b].contacts.push_back(contact);
  }
}

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

/// What leads on through a passage is no wider than that.
void narrow_to(Contact& contact, const Contact& passage) {
  contact.clearance_m = std::min(contact.clearance_m, passage.clearance_m);
  contact.open = std::min(contact.open, passage.open);
}

/// The same of all that leads on from region `of`, but to region `but`.
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

/// The opening of a wall goes to one of the wall's two sides: the wall across it then lies between that side
/// and the other, as it does beside the opening.
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

std::vector<Region> regions_of(const DenseMap& map, std::span<const float> clearance_m,
                               const FirstLabels& first, std::span<const std::uint32_t> axis,
                               std::span<const types::Segment> walls, const CompassFrame& frame) {
  CellPass pass(map, clearance_m, first, frame);
  pass.run();
  pass.add_cores(axis);
  note_walls(map, first.labels, pass.numbers(), walls, pass.regions, pass.pairs);
  add_contacts(pass.pairs, pass.regions);
  return std::move(pass.regions);
}

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
  // Who comes from the clearest point of the one side to the other has to go through where they met.
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
