// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/settling.hpp"

#include <bit>

#include "core/places/skeleton/simple_cell.hpp"

namespace topo::places {
namespace {

constexpr std::size_t kStripRows = 32;  // rows whose states fit into the cache

}  // namespace

Settling::Settling(const grid::DenseMap& map, std::vector<ThinningState>& states)
    : fates_(states.data()),
      offsets_(neighbour_offsets(map)),
      strip_cells_(kStripRows * static_cast<std::size_t>(map.width())),
      doubtful_(states.size() / strip_cells_ + 1) {}

void Settling::settle_all() {
  for (bool any = true; any;) {
    any = false;
    for (std::size_t strip = 0; strip < doubtful_.size(); ++strip) any |= settle_strip(strip);
  }
}

bool Settling::settle_strip(std::size_t strip) {
  auto& cells = doubtful_[strip];
  if (cells.empty()) return false;
  first_cell_ = static_cast<std::uint32_t>(strip * strip_cells_);
  // In reverse: buckets return the newest cell first.
  for (std::size_t k = cells.size(); k-- > 0;) buckets_.add(cells[k], bucket_of(fates_[cells[k]]));
  cells.clear();
  std::uint32_t i = 0;
  for (bucket_ = 0; bucket_ < buckets_.end(); ++bucket_) {
    buckets_.take(bucket_, first_);
    first_.start();
    while (first_.next(i)) decide(i);
    last_.start();
    while (last_.next(i)) decide_last(i);
  }
  buckets_.clear();
  return true;
}

Settling::Around Settling::around(std::uint32_t i, unsigned turn) const {
  Around around;
  for (std::size_t k = 0; k < 8; ++k) {
    const unsigned state = fates_[neighbour(i, k)];
    around.kept |= (state / Erosion::kKept & 1U) << k;
    around.later |= ((state >> kTurnShift) + (k < 4 ? 1U : 0U) > turn ? 1U : 0U) << k;
    around.queued |= (state & kQueued) << k;
  }
  return around;
}

bool Settling::stays(std::uint32_t i, const Around& around) const {
  return (fates_[i] & Erosion::kRidge) != 0 || !is_simple(around.kept | around.later);
}

void Settling::decide(std::uint32_t i) {
  fates_[i] &= static_cast<ThinningState>(~kQueued);
  const Around around = this->around(i, static_cast<unsigned>(bucket_ << 1U));
  constexpr unsigned kSides = 0x55;  // the even neighbours share a side
  if ((around.kept & ~around.later & kSides) != 0) {
    queue(i, last_);
    if ((fates_[i] & Erosion::kDelayed) == 0) settle(i, around, Erosion::kDelayed, false);
  } else {
    settle(i, around, stays(i, around) ? Erosion::kKept : ThinningState{0}, false);
  }
}

void Settling::decide_last(std::uint32_t i) {
  fates_[i] &= static_cast<ThinningState>(~kQueued);
  const Around around = this->around(i, static_cast<unsigned>(bucket_ << 1U | 1U));
  settle(i, around, stays(i, around) ? kOutcome : Erosion::kDelayed, true);
}

void Settling::queue(std::uint32_t i, Rising& cells) {
  if (is_in_doubt(i)) return;
  fates_[i] |= kQueued;
  cells.add(i);
}

/// Sets a cell's outcome. When it changes, neighbours with a later turn become doubtful.
void Settling::settle(std::uint32_t i, const Around& around, ThinningState outcome, bool last) {
  if ((fates_[i] & kOutcome) == outcome) return;
  fates_[i] = static_cast<ThinningState>((fates_[i] & ~kOutcome) | outcome);
  for (unsigned doubted = around.later & ~around.queued; doubted != 0; doubted &= doubted - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(doubted));
    const std::uint32_t j = neighbour(i, k);
    const std::size_t bucket = bucket_of(fates_[j]);
    if (j - first_cell_ >= strip_cells_) {
      doubt(j);
    } else if (bucket > bucket_) {
      fates_[j] |= kQueued;
      buckets_.add(j, bucket);
    } else {
      queue(j, !last && k < 4 ? first_ : last_);
    }
  }
}

}  // namespace topo::places
