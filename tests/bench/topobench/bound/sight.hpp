// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench::bound {

/// A set of cells, by number. All sets that meet have one size.
class CellSet {
 public:
  explicit CellSet(std::size_t cells = 0) : words_((cells + 63) / 64, 0) {}
  void insert(std::size_t cell) { words_[cell / 64] |= std::uint64_t{1} << (cell % 64); }
  [[nodiscard]] bool contains(std::size_t cell) const { return (words_[cell / 64] >> (cell % 64) & 1U) != 0; }
  CellSet& operator|=(const CellSet& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= other.words_[i];
    return *this;
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t n = 0;
    for (const std::uint64_t word : words_) n += static_cast<std::size_t>(std::popcount(word));
    return n;
  }
  /// How many of this set are not in the other.
  [[nodiscard]] std::size_t beyond(const CellSet& other) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < words_.size(); ++i)
      n += static_cast<std::size_t>(std::popcount(words_[i] & ~other.words_[i]));
    return n;
  }
  [[nodiscard]] bool meets(const CellSet& other) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if ((words_[i] & other.words_[i]) != 0) return true;
    }
    return false;
  }

 private:
  std::vector<std::uint64_t> words_;
};

/// The front scanner of the simulated robots, to all sides: a robot turns where it stands.
struct SightParams {
  double cell_m = 0.2;    ///< of the cells that are to be seen; one is seen when a beam passes through it
  int beams = 360;        ///< as fidelity "plan" has them, one a degree
  double range_m = 30.0;  ///< of a UTM-30LX
  double z_m = 0.3;       ///< its height, config/simulation.toml
};

/// What is seen from a place of a building.
class Sight {
 public:
  /// `visible`: the area that counts (sim::reachable_area). A cell counts when half of it does.
  Sight(const sim::World& world, const sim::Raster& visible, const SightParams& params);

  [[nodiscard]] CellSet from(const sim::Vector2& place) const;
  [[nodiscard]] std::size_t cells() const { return centres_.size(); }
  [[nodiscard]] const sim::Vector2& centre(std::size_t cell) const { return centres_[cell]; }
  /// Those beside a cell that count.
  [[nodiscard]] std::vector<std::size_t> beside(std::size_t cell) const;

 private:
  [[nodiscard]] int number_at(const sim::Vector2& p) const;

  const sim::World& world_;
  SightParams params_;
  sim::Raster grid_;
  std::vector<int> number_;  ///< of each cell of the grid; -1: does not count
  std::vector<sim::Vector2> centres_;
};

}  // namespace topo::bench::bound
