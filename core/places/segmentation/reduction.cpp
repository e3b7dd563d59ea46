// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

namespace topo::places {
namespace {

types::Rectangle united(types::Rectangle a, const types::Rectangle& b) {
  a.extend(b.min);
  a.extend(b.max);
  return a;
}

/// A possible merge, valid while both regions are unchanged.
struct Proposal {
  int density = 0;  ///< in DensityParams::steps
  std::uint32_t cells = 0;
  std::uint32_t first_a = 0, first_b = 0;  ///< lowest cells, so that geometry decides between equals
  std::uint32_t a = 0, b = 0;
  std::uint32_t version_a = 0, version_b = 0;

  friend bool operator<(const Proposal& l, const Proposal& r) {
    return std::tie(l.density, l.cells, r.first_a, r.first_b) <
           std::tie(r.density, r.cells, l.first_a, l.first_b);
  }
};

/// The largest density of the union in frames that are turned against the compass: a wing or a corridor at an
/// angle to the rest of the building is as dense in its own frame. The area of the box outside the union is
/// not examined; its weight lies between those of occupied cells and of cells elsewhere.
double turned_density(const Region& a, const Region& b, double resolution_m, const PlaceParams& params) {
  const double own_m2 = (a.cells + b.cells) * resolution_m * resolution_m;
  double best = 0.0;
  for (std::size_t k = 0; k < kTurns; ++k) {
    const types::Rectangle box = united(a.turned[k], b.turned[k]);
    const types::Vector2 side = box.max - box.min;
    const double beside_m2 = std::max(0.0, side.x() * side.y() - own_m2);
    best = std::max(best, own_m2 / (own_m2 + params.density.turned_weight * beside_m2));
  }
  return best;
}

class Reduction {
 public:
  Reduction(std::vector<Region>& regions, const BoxCounts& counts, double resolution_m,
            const PlaceParams& params)
      : regions_(regions),
        counts_(counts),
        resolution_m_(resolution_m),
        params_(params),
        parent_(regions.size()) {
    for (std::uint32_t r = 0; r < parent_.size(); ++r) parent_[r] = r;
  }

  std::vector<std::uint32_t> run() {
    for (std::uint32_t r = 0; r < regions_.size(); ++r) propose_all(r, true);
    do {
      merge_proposed();
    } while (give_away_small());
    for (auto& root : parent_) root = find(root);
    return std::move(parent_);
  }

 private:
  [[nodiscard]] std::optional<double> merged_density(const Region& a, const Region& b,
                                                     const Contact& c) const {
    if (c.upright + c.level == 0 || !no_wall_between(c, resolution_m_, params_) ||
        !no_narrows(a, b, c, resolution_m_, params_) || !similar_width(a, b, c, resolution_m_, params_))
      return std::nullopt;
    const double level = density(united(a.core, b.core), a.cells + b.cells, counts_, resolution_m_, params_);
    const double dense = std::max(level, turned_density(a, b, resolution_m_, params_));
    return dense >= params_.density.min ? std::optional(dense) : std::nullopt;
  }

  void propose_all(std::uint32_t r, bool upwards_only) {
    for (const Contact& c : regions_[r].contacts) {
      if (upwards_only && c.other < r) continue;
      const std::uint32_t a = r, b = c.other;
      const auto dense = merged_density(regions_[a], regions_[b], c);
      if (!dense) continue;
      const auto [low, high] = std::minmax(regions_[a].first, regions_[b].first);
      proposals_.push({static_cast<int>(std::lround(*dense * params_.density.steps)),
                       regions_[a].cells + regions_[b].cells, low, high, a, b, regions_[a].version,
                       regions_[b].version});
    }
  }

  void merge_proposed() {
    while (!proposals_.empty()) {
      const Proposal best = proposals_.top();
      proposals_.pop();
      const Region &a = regions_[best.a], &b = regions_[best.b];
      if (a.cells == 0 || b.cells == 0 || a.version != best.version_a || b.version != best.version_b)
        continue;
      merge(best.a, best.b, true);
    }
  }

  void merge(std::uint32_t a, std::uint32_t b, bool equals) {
    // The region with more contacts keeps its index: the same result with less to move.
    if (equals && regions_[a].contacts.size() < regions_[b].contacts.size()) std::swap(a, b);
    absorb(regions_, a, b, equals);
    parent_[b] = a;
    propose_all(a, false);
  }

  /// Gives small regions away in ascending order of size, so that the result does not depend on their
  /// numbers. True when one was given away.
  bool give_away_small() {
    std::vector<std::uint32_t> small;
    for (std::uint32_t r = 0; r < regions_.size(); ++r) {
      if (is_small(regions_[r])) small.push_back(r);
    }
    std::sort(small.begin(), small.end(), [&](std::uint32_t l, std::uint32_t r) {
      return std::tie(regions_[l].cells, regions_[l].first) < std::tie(regions_[r].cells, regions_[r].first);
    });
    bool any = false;
    for (const std::uint32_t r : small) {
      if (!is_small(regions_[r])) continue;
      const Contact* best = nullptr;
      for (const Contact& c : regions_[r].contacts) {
        if (c.upright + c.level == 0) continue;
        if (best == nullptr || std::make_tuple(c.border(), regions_[best->other].first) >
                                   std::make_tuple(best->border(), regions_[c.other].first))
          best = &c;
      }
      if (best == nullptr) continue;
      merge(best->other, r, false);
      any = true;
    }
    return any;
  }
  [[nodiscard]] bool is_small(const Region& region) const {
    return region.cells != 0 && region.cells * resolution_m_ * resolution_m_ < params_.small_m2;
  }

  std::uint32_t find(std::uint32_t r) {
    while (parent_[r] != r) r = parent_[r] = parent_[parent_[r]];
    return r;
  }

  std::vector<Region>& regions_;
  const BoxCounts& counts_;
  double resolution_m_;
  const PlaceParams& params_;
  std::vector<std::uint32_t> parent_;
  std::priority_queue<Proposal> proposals_;
};

}  // namespace

double density(const types::Rectangle& box, std::uint32_t own_cells, const BoxCounts& counts,
               double resolution_m, const PlaceParams& params) {
  const types::Vector2 side = (box.max - box.min) / resolution_m;
  const double occupied = counts.occupied_in(box);
  const double own = own_cells;
  const double elsewhere = std::max(0.0, side.x() * side.y() - own - occupied);
  return own / (own + occupied + params.density.elsewhere_weight * elsewhere);
}

double narrow_side(const Region& region) {
  const types::Vector2 side = region.core.max - region.core.min;
  return std::min(side.x(), side.y());
}

bool is_corridor(const Region& region, const CorridorParams& params) {
  const types::Vector2 side = region.core.max - region.core.min;
  const double width = narrow_side(region);
  return std::max(side.x(), side.y()) > params.length_ratio * width &&
         static_cast<double>(region.clearance_m) < params.clearance_ratio * width;
}

bool no_wall_between(const Contact& contact, double resolution_m, const PlaceParams& params) {
  return static_cast<double>(contact.wall_m) <= params.wall_share_max * contact.border() * resolution_m;
}

bool no_narrows(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                const PlaceParams& params) {
  const auto [narrower, wider] = std::minmax(a.clearance_m, b.clearance_m);
  // For a border in several parts, around furniture, the sum counts as well.
  const double passage_m = std::max(2.0 * static_cast<double>(contact.clearance_m),
                                    params.parallel_share * static_cast<double>(contact.open) * resolution_m);
  const double ratio = static_cast<double>(wider) / std::max(static_cast<double>(narrower), resolution_m);
  return passage_m >=
         params.narrow_ratio * 2.0 * static_cast<double>(narrower) * std::pow(ratio, params.wider_power);
}

bool similar_width(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                   const PlaceParams& params) {
  const bool a_narrower = a.clearance_m < b.clearance_m;
  const Region &narrower = a_narrower ? a : b, &wider = a_narrower ? b : a;
  // A region that lies alongside is not a corridor that leads into the other one, but the edge of the same
  // room.
  if (!is_corridor(narrower, params.corridor) ||
      contact.border() * resolution_m > params.corridor.alongside_ratio * narrow_side(narrower))
    return true;
  return static_cast<double>(wider.clearance_m) <=
         params.width_ratio_max * static_cast<double>(narrower.clearance_m);
}

std::vector<std::uint32_t> reduce(std::vector<Region>& regions, const BoxCounts& counts, double resolution_m,
                                  const PlaceParams& params) {
  return Reduction(regions, counts, resolution_m, params).run();
}

}  // namespace topo::places
