// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/corners.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/places/segmentation/reduction.hpp"

namespace topo::places {
namespace {

/// The members of places while corner pieces move between them.
class Corners {
 public:
  Corners(const std::vector<Region>& pieces, std::vector<std::uint32_t>& places, double resolution_m,
          const PlaceParams& params)
      : pieces_(pieces),
        places_(places),
        resolution_m_(resolution_m),
        params_(params),
        members_(pieces.size()),
        wholes_(pieces.size()),
        is_left_(pieces.size(), false) {
    for (std::uint32_t p = 0; p < pieces.size(); ++p) members_[places[p]].push_back(p);
  }

  /// Terminates: the receiving place is larger than the rest of the giving place, so that every move
  /// increases the sum of the squares of the places' sizes.
  bool settle() {
    bool any = false;
    for (bool moved = true; moved;) {
      moved = false;
      for (const std::uint32_t p : at_borders()) moved = settle_piece(p) || moved;
      any = any || moved;
    }
    return any;
  }

 private:
  /// Pieces that touch another place, from the lowest in the map upwards.
  [[nodiscard]] std::vector<std::uint32_t> at_borders() const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      const auto& contacts = pieces_[p].contacts;
      if (members_[places_[p]].size() > 1 &&
          std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return leaves_place(p, c); }))
        found.push_back(p);
    }
    std::sort(found.begin(), found.end(),
              [&](std::uint32_t a, std::uint32_t b) { return pieces_[a].first < pieces_[b].first; });
    return found;
  }

  /// True when an open border of the piece leads to another place.
  [[nodiscard]] bool leaves_place(std::uint32_t p, const Contact& c) const {
    return places_[c.other] != places_[p] && c.upright + c.level != 0;
  }

  /// True when the piece alone could move to a corridor beside its place. This necessary condition is false
  /// for most pieces: with its spurs a piece has no less clearance, for which the passage is relatively
  /// narrower.
  bool opens_onto_corridor(std::uint32_t p) {
    const auto& contacts = pieces_[p].contacts;
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
      return leaves_place(p, c) && is_open_to(pieces_[p], whole(places_[c.other]), c);
    });
  }
  [[nodiscard]] bool is_open_to(const Region& moved, const Region& beside, const Contact& c) const {
    return is_corridor(beside, params_.corridor) && no_wall_between(c, resolution_m_, params_) &&
           no_narrows(moved, beside, c, resolution_m_, params_);
  }

  bool settle_piece(std::uint32_t p) {
    if (!opens_onto_corridor(p)) return false;
    const std::uint32_t own = places_[p];
    const std::vector<std::uint32_t> corner = with_its_spurs(p);
    const Region moved = together(corner), rest = together(others(own, corner));
    if (!is_corridor(rest, params_.corridor) || moved.cells > params_.corner.spurs_ratio * pieces_[p].cells)
      return false;
    for (const Contact& c : pieces_[p].contacts) {
      if (!leaves_place(p, c)) continue;
      const std::uint32_t other = places_[c.other];
      const Region& beside = whole(other);
      if (beside.cells <= rest.cells || !is_open_to(moved, beside, c)) continue;
      if (!is_in_line(rest, moved) || !is_in_line(beside, moved)) continue;
      for (const std::uint32_t piece : corner) {
        std::erase(members_[own], piece);
        members_[other].push_back(piece);
        places_[piece] = other;
      }
      wholes_[own].reset();
      wholes_[other].reset();
      return true;
    }
    return false;
  }

  /// The piece, and the pieces of its place that are connected to the rest only through it: all parts that
  /// remain without it, except the largest.
  [[nodiscard]] std::vector<std::uint32_t> with_its_spurs(std::uint32_t p) {
    std::vector<std::uint32_t> members = members_[places_[p]];
    std::sort(members.begin(), members.end());
    for (const std::uint32_t member : members) is_left_[member] = member != p;
    std::vector<std::uint32_t> spurs{p}, largest;
    std::uint32_t most = 0;
    for (const std::uint32_t seed : members) {
      if (!is_left_[seed]) continue;
      is_left_[seed] = false;
      std::vector<std::uint32_t> part{seed};
      for (std::size_t next = 0; next < part.size(); ++next) {
        for (const Contact& c : pieces_[part[next]].contacts) {
          if (c.upright + c.level == 0 || !is_left_[c.other]) continue;
          is_left_[c.other] = false;
          part.push_back(c.other);
        }
      }
      const std::uint32_t cells = together(part).cells;
      if (cells > most) {
        most = cells;
        std::swap(part, largest);
      }
      spurs.insert(spurs.end(), part.begin(), part.end());
    }
    return spurs;
  }

  [[nodiscard]] std::vector<std::uint32_t> others(std::uint32_t place,
                                                  const std::vector<std::uint32_t>& without) const {
    std::vector<std::uint32_t> rest;
    std::copy_if(
        members_[place].begin(), members_[place].end(), std::back_inserter(rest),
        [&](std::uint32_t p) { return std::find(without.begin(), without.end(), p) == without.end(); });
    return rest;
  }

  /// True when most of the piece lies in the strip in which the corridor runs.
  [[nodiscard]] bool is_in_line(const Region& corridor, const Region& piece) const {
    const types::Vector2 side = corridor.core.max - corridor.core.min;
    const int across = side.x() < side.y() ? 0 : 1;
    const double from = std::max(corridor.core.min[across], piece.core.min[across]);
    const double to = std::min(corridor.core.max[across], piece.core.max[across]);
    return to - from >= params_.corner.in_line_min * (piece.core.max[across] - piece.core.min[across]);
  }

  const Region& whole(std::uint32_t place) {
    std::optional<Region>& known = wholes_[place];
    if (!known) known = together(members_[place]);
    return *known;
  }

  [[nodiscard]] Region together(const std::vector<std::uint32_t>& members) const {
    Region all;
    for (const std::uint32_t p : members) {
      all.cells += pieces_[p].cells;
      all.core.extend(pieces_[p].core.min);
      all.core.extend(pieces_[p].core.max);
      all.clearance_m = std::max(all.clearance_m, pieces_[p].clearance_m);
    }
    return all;
  }

  const std::vector<Region>& pieces_;
  std::vector<std::uint32_t>& places_;
  double resolution_m_;
  const PlaceParams& params_;
  std::vector<std::vector<std::uint32_t>> members_;  ///< by the number of the place
  std::vector<std::optional<Region>> wholes_;        ///< cache of the joined members of a place
  std::vector<bool> is_left_;  ///< of a place's pieces, during the search for connected parts
};

}  // namespace

bool settle_corners(const std::vector<Region>& pieces, std::vector<std::uint32_t>& places,
                    double resolution_m, const PlaceParams& params) {
  return Corners(pieces, places, resolution_m, params).settle();
}

std::vector<Region> joined(const std::vector<Region>& pieces, const std::vector<std::uint32_t>& places) {
  std::vector<Region> regions(pieces.size());
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    const Region& piece = pieces[p];
    Region& region = regions[places[p]];
    region.box.extend(piece.box.min);
    region.box.extend(piece.box.max);
    region.sum += piece.sum;
    region.cells += piece.cells;
    region.first = std::min(region.first, piece.first);
    region.clearance_m = std::max(region.clearance_m, piece.clearance_m);
    for (const Contact& c : piece.contacts) {
      const std::uint32_t other = places[c.other];
      if (other == places[p]) continue;
      auto known = std::find_if(region.contacts.begin(), region.contacts.end(),
                                [&](const Contact& k) { return k.other == other; });
      if (known == region.contacts.end())
        known = region.contacts.insert(known, {other, 0, 0, 0.0F, 0.0F, 0.0F});
      known->upright += c.upright;
      known->level += c.level;
    }
  }
  return regions;
}

}  // namespace topo::places
