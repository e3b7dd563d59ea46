// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/erosion.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>

#include "core/places/simple_cell.hpp"

namespace topo::places {
namespace {

// What becomes of a cell depends on what has become of its neighbours when its turn comes, and on nothing
// else. Turns are by bucket of clearance; within a bucket those beside a cell that had to stay come last (so
// the connection goes straight up the slope, and not askew in the order of the cells' numbers), otherwise by
// number. So most fates are known beforehand: a cell on a slope, all of whose earlier neighbours are gone, is
// simple and goes. Only the others are looked at one after the other, and whoever turns out other than was
// assumed has its later neighbours looked at again. What was assumed may also be the fates on an earlier map.
// Because a fate depends on earlier turns only, there is one set of fates that fits together, in whatever
// order it is found: so strips of rows are settled one after the other, each small enough for the cache,
// until nothing is in doubt.

using grid::CellState;
using grid::DenseMap;

/// A cell's bucket, an eighth of a cell of clearance wide, above its flags. A free cell's is 8 at least, so
/// that nothing else is 0; from 512 cells of clearance on there is one.
using Fate = std::uint16_t;
constexpr int kBucketShift = 4;
constexpr std::size_t kBuckets = 4096;
constexpr Fate kFlags = (1U << kBucketShift) - 1;

/// In doubt, and waiting for its turn.
constexpr Fate kQueued = 1;
constexpr Fate kOutcome = Erosion::kKept | Erosion::kDelayed;

/// When a cell's turn comes: by bucket, the delayed ones last. The shift leaves these two.
constexpr int kTurnShift = 3;
static_assert(Erosion::kDelayed == 1U << kTurnShift);

Fate fate_of(float clearance_m, float buckets_per_m) {
  const float bucket = std::min(clearance_m * buckets_per_m, static_cast<float>(kBuckets - 1));
  return static_cast<Fate>(static_cast<std::int32_t>(bucket) << kBucketShift);
}

float buckets_per_m(const DenseMap& map) { return static_cast<float>(8.0 / map.resolution_m); }

/// Unlike std::max without references, which keep the compiler from vector instructions.
float larger(float a, float b) { return a < b ? b : a; }

/// On the ridge no neighbour is much clearer: with a wall on one side clearance rises by nearly a cell a cell
/// somewhere (at least 0.92, because neighbours lie in eight directions), on the axis of a right-angled
/// corner by 0.71, in a corridor not at all. Near the boundary, where distances jump, only what is as flat as
/// a corridor counts.
bool is_ridge(float here_m, float side_m, float corner_m, float cell_m) {
  const float rise_m = larger(side_m - here_m, (corner_m - here_m) * 0.70711F);
  const float flat_m = here_m < 3.0F * cell_m ? 0.3F * cell_m : 0.8F * cell_m;
  return rise_m < flat_m;
}

/// Cells side by side that are looked at together, so that the compiler makes vector instructions of them.
constexpr std::size_t kBlock = 64;

/// Calls f(index) for what has one of the bits, in rising order; most have none.
template <class T, class F>
void for_each_with(T bits, std::span<const T> values, F&& f) {
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t) / sizeof(T);
  std::array<T, kAtOnce> masks;
  masks.fill(bits);
  const auto mask = std::bit_cast<std::uint64_t>(masks);
  std::size_t i = 0;
  const auto visit = [&](std::size_t end) {
    for (; i < end; ++i)
      if ((values[i] & bits) != 0) f(i);
  };
  for (std::uint64_t several = 0; i + kAtOnce <= values.size();) {
    std::memcpy(&several, &values[i], sizeof several);
    if ((several & mask) == 0)
      i += kAtOnce;
    else
      visit(i + kAtOnce);
  }
  visit(values.size());
}

/// First fates: everything that is not on the ridge goes when its turn comes.
class Assumption {
 public:
  Assumption(const DenseMap& map, std::span<const float> clearance_m, std::vector<Fate>& fates)
      : map_(map),
        width_(static_cast<std::size_t>(map.width())),
        clearance_m_(clearance_m),
        fates_(fates),
        buckets_per_m_(buckets_per_m(map)) {}

  /// Of all rows; returns the cells for which that does not hold, in rising order.
  std::vector<std::uint32_t> run() {
    const auto height = static_cast<std::size_t>(map_.height());
    Row low(width_, 0), mid(width_, 0), high(width_, 0);
    for (std::size_t y = 0; y < height; ++y) {
      // Each row in its turn is the one above; what comes above the last is as empty as the border.
      low.swap(mid);
      mid.swap(high);
      if (y + 1 < height) fill(y + 1, high);
      if (y > 0 && y + 1 < height) assume_row(y, {low.data(), mid.data(), high.data()});
    }
    return std::move(doubtful_);
  }

 private:
  using Row = std::vector<std::int16_t>;  ///< buckets
  using Marks = std::array<std::uint8_t, kBlock>;
  struct Rows {
    const std::int16_t *low, *mid, *high;
  };

  [[nodiscard]] bool has_free(std::size_t first, std::size_t count) const {
    return std::memchr(&map_.cells[first], static_cast<int>(CellState::kFree), count) != nullptr;
  }
  void fill(std::size_t y, Row& row) const {
    const float per_m = buckets_per_m_;
    for (std::size_t x = 0; x < width_; x += kBlock) {
      const std::size_t count = std::min(kBlock, width_ - x);
      std::int16_t* const to = &row[x];
      const float* const from = &clearance_m_[y * width_ + x];
      if (!has_free(y * width_ + x, count)) {
        std::fill_n(to, count, std::int16_t{0});
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        to[i] = static_cast<std::int16_t>(fate_of(from[i], per_m) >> kBucketShift);
    }
  }
  void assume_row(std::size_t y, const Rows& rows) {
    for (std::size_t x = 1; x + 1 < width_; x += kBlock) {
      const std::size_t count = std::min(kBlock, width_ - 1 - x);
      if (has_free(y * width_ + x, count))
        assume(y * width_ + x, count, {rows.low + x, rows.mid + x, rows.high + x});
    }
  }
  void assume(std::size_t first, std::size_t count, const Rows& rows) {
    Marks ridge, simple;
    find_ridge(first, count, ridge);
    find_simple(rows, count, simple);
    Fate* const fate = &fates_[first];
    for (std::size_t i = 0; i < count; ++i) {
      const auto bucket = static_cast<unsigned>(rows.mid[i]);
      const auto free = static_cast<Fate>(bucket == 0 ? 0 : 0xFFFF);
      fate[i] = static_cast<Fate>((bucket << kBucketShift | ridge[i] * unsigned{Erosion::kRidge}) & free);
    }
    Marks doubtful{};
    for (std::size_t i = 0; i < count; ++i)
      doubtful[i] = static_cast<std::uint8_t>((ridge[i] | (simple[i] ^ 1U)) & (rows.mid[i] != 0 ? 1U : 0U));
    for_each_with<std::uint8_t>(
        1, doubtful, [&](std::size_t i) { doubtful_.push_back(static_cast<std::uint32_t>(first + i)); });
  }
  void find_ridge(std::size_t first, std::size_t count, Marks& ridge) const {
    const auto cell_m = static_cast<float>(map_.resolution_m);
    const float* const mid = &clearance_m_[first];
    const float *const low = mid - width_, *const high = mid + width_;
    std::array<std::int32_t, kBlock> is;
    for (std::size_t i = 0; i < count; ++i) {
      const float side = larger(larger(mid[i - 1], mid[i + 1]), larger(low[i], high[i]));
      const float corner = larger(larger(low[i - 1], low[i + 1]), larger(high[i - 1], high[i + 1]));
      is[i] = is_ridge(mid[i], side, corner, cell_m) ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i) ridge[i] = static_cast<std::uint8_t>(is[i]);
  }
  /// Of cells in one bucket the one with the greater number is still there. As is_simple, in arithmetic.
  static void find_simple(const Rows& rows, std::size_t count, Marks& simple) {
    const std::int16_t *const low = rows.low, *const mid = rows.mid, *const high = rows.high;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int16_t here = mid[i];
      const bool off_east =
          mid[i + 1]<here, north_east = high[i + 1] >= here,
                     off_north = high[i]<here, north_west = high[i - 1] >= here,
                                         off_west = mid[i - 1] <= here, south_west = low[i - 1]>
                         here,
                     off_south = low[i] <= here, south_east = low[i + 1]>
              here;
      const int number =
          (off_east & (north_east | (off_north ^ 1))) + (off_north & (north_west | (off_west ^ 1))) +
          (off_west & (south_west | (off_south ^ 1))) + (off_south & (south_east | (off_east ^ 1)));
      simple[i] = static_cast<std::uint8_t>(number == 1);
    }
  }

  const DenseMap& map_;
  std::size_t width_;
  std::span<const float> clearance_m_;
  std::vector<Fate>& fates_;
  float buckets_per_m_;
  std::vector<std::uint32_t> doubtful_;
};

/// Cells in rising order of their numbers, to which more may come while they are taken out.
class Rising {
 public:
  /// What is added before start() may come in any order, and costs less.
  void add(std::uint32_t cell) {
    if (!started_) {
      cells_.push_back(cell);
      return;
    }
    late_.push_back(cell);
    std::push_heap(late_.begin(), late_.end(), std::greater<>());
  }
  void start() {
    if (!std::is_sorted(cells_.begin(), cells_.end())) std::sort(cells_.begin(), cells_.end());
    started_ = true;
  }
  /// False, and all is as before start(): there is none.
  bool next(std::uint32_t& cell) {
    const bool is_late = !late_.empty() && (at_ == cells_.size() || late_.front() < cells_[at_]);
    if (is_late) {
      std::pop_heap(late_.begin(), late_.end(), std::greater<>());
      cell = late_.back();
      late_.pop_back();
      return true;
    }
    if (at_ < cells_.size()) {
      cell = cells_[at_++];
      return true;
    }
    cells_.clear();
    at_ = 0;
    return started_ = false;
  }

 private:
  std::vector<std::uint32_t> cells_, late_;
  std::size_t at_ = 0;
  bool started_ = false;
};

/// Cells by bucket, taken out bucket by bucket.
class Buckets {
 public:
  Buckets() : heads_(kBuckets, kNone) {}

  void add(std::uint32_t cell, std::size_t bucket) {
    entries_.push_back({cell, heads_[bucket]});
    heads_[bucket] = static_cast<std::uint32_t>(entries_.size() - 1);
    end_ = std::max(end_, bucket + 1);
  }
  /// After the last one that is not empty.
  [[nodiscard]] std::size_t end() const { return end_; }
  void take(std::size_t bucket, Rising& out) {
    for (std::uint32_t e = heads_[bucket]; e != kNone; e = entries_[e].next) out.add(entries_[e].cell);
    heads_[bucket] = kNone;
  }
  /// When all are taken.
  void clear() {
    entries_.clear();
    end_ = 0;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  struct Entry {
    std::uint32_t cell, next;
  };
  std::vector<std::uint32_t> heads_;  ///< the newest entry of each bucket
  std::vector<Entry> entries_;
  std::size_t end_ = 0;
};

/// Looks at cells in the order of their turns, strip by strip, until all fates are what they must be.
class Settling {
 public:
  Settling(const DenseMap& map, std::vector<Fate>& fates)
      : fates_(fates.data()),
        offsets_(neighbour_offsets(map)),
        strip_cells_(kStripRows * static_cast<std::size_t>(map.width())),
        doubtful_(fates.size() / strip_cells_ + 1) {}

  /// A free cell whose fate may not be what its neighbours' say.
  void doubt(std::uint32_t i) {
    if ((fates_[i] & kQueued) != 0) return;
    fates_[i] |= kQueued;
    doubtful_[i / strip_cells_].push_back(i);
  }
  [[nodiscard]] bool is_in_doubt(std::uint32_t i) const { return (fates_[i] & kQueued) != 0; }
  [[nodiscard]] std::size_t strips() const { return doubtful_.size(); }

  /// Settles one strip as the others are, which may come to be in doubt. True when there was something to do.
  bool settle_strip(std::size_t strip) {
    auto& cells = doubtful_[strip];
    if (cells.empty()) return false;
    first_cell_ = static_cast<std::uint32_t>(strip * strip_cells_);
    // Backwards, and out again in rising order.
    for (std::size_t k = cells.size(); k-- > 0;)
      buckets_.add(cells[k], static_cast<std::size_t>(fates_[cells[k]] >> kBucketShift));
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
  void settle_all() {
    for (bool any = true; any;) {
      any = false;
      for (std::size_t strip = 0; strip < strips(); ++strip) any |= settle_strip(strip);
    }
  }

 private:
  /// A cell's neighbours as they are at a turn: bit k of each for neighbour k.
  struct Around {
    unsigned kept = 0;
    unsigned later = 0;  ///< its turn comes after that one, or is the same and its number is greater
    unsigned queued = 0;
  };

  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }
  [[nodiscard]] Around around(std::uint32_t i, unsigned turn) const {
    Around around;
    for (std::size_t k = 0; k < 8; ++k) {
      const unsigned fate = fates_[neighbour(i, k)];
      around.kept |= (fate / Erosion::kKept & 1U) << k;
      around.later |= ((fate >> kTurnShift) + (k < 4 ? 1U : 0U) > turn ? 1U : 0U) << k;
      around.queued |= (fate & kQueued) << k;
    }
    return around;
  }
  [[nodiscard]] bool stays(std::uint32_t i, const Around& around) const {
    return (fates_[i] & Erosion::kRidge) != 0 || !is_simple(around.kept | around.later);
  }

  void decide(std::uint32_t i) {
    fates_[i] &= static_cast<Fate>(~kQueued);
    const Around around = this->around(i, static_cast<unsigned>(bucket_ << 1U));
    constexpr unsigned kSides = 0x55;
    if ((around.kept & ~around.later & kSides) != 0) {
      queue(i, last_);
      if ((fates_[i] & Erosion::kDelayed) == 0) settle(i, around, Erosion::kDelayed, false);
    } else {
      settle(i, around, stays(i, around) ? Erosion::kKept : Fate{0}, false);
    }
  }
  void decide_last(std::uint32_t i) {
    fates_[i] &= static_cast<Fate>(~kQueued);
    const Around around = this->around(i, static_cast<unsigned>(bucket_ << 1U | 1U));
    settle(i, around, stays(i, around) ? kOutcome : Erosion::kDelayed, true);
  }

  void queue(std::uint32_t i, Rising& cells) {
    if ((fates_[i] & kQueued) != 0) return;
    fates_[i] |= kQueued;
    cells.add(i);
  }

  /// A cell's fate; if it is not what it was, neighbours with a later turn doubt theirs.
  void settle(std::uint32_t i, const Around& around, Fate outcome, bool last) {
    if ((fates_[i] & kOutcome) == outcome) return;
    fates_[i] = static_cast<Fate>((fates_[i] & ~kOutcome) | outcome);
    for (unsigned doubted = around.later & ~around.queued; doubted != 0; doubted &= doubted - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(doubted));
      const std::uint32_t j = neighbour(i, k);
      const auto bucket = static_cast<std::size_t>(fates_[j] >> kBucketShift);
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

  static constexpr std::size_t kStripRows = 32;

  Fate* fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::size_t strip_cells_;
  std::vector<std::vector<std::uint32_t>> doubtful_;  ///< of each strip
  // Of the strip at hand.
  std::uint32_t first_cell_ = 0;
  std::size_t bucket_ = 0;
  Buckets buckets_;
  Rising first_, last_;
};

/// Changes some cells' clearances under fates that were settled.
class Change {
 public:
  Change(const DenseMap& map, std::span<const float> clearance_m, std::vector<Fate>& fates)
      : map_(map),
        clearance_m_(clearance_m),
        fates_(fates),
        offsets_(neighbour_offsets(map)),
        buckets_per_m_(buckets_per_m(map)) {}

  /// A cell with another clearance; whether its neighbours are on the ridge may have changed as well.
  void apply(std::uint32_t i, Settling& settling) {
    renew(i, settling);
    for (const std::ptrdiff_t offset : offsets_)
      renew(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset), settling);
  }

 private:
  void renew(std::uint32_t i, Settling& settling) {
    if (map_.cells[i] != CellState::kFree) {
      fates_[i] = 0;
      return;
    }
    if (settling.is_in_doubt(i)) return;  // as a neighbour of another one
    const auto bucket = fate_of(clearance_m_[i], buckets_per_m_);
    const auto kept = static_cast<Fate>(fates_[i] & kFlags & ~Erosion::kRidge);
    fates_[i] = static_cast<Fate>(bucket | kept | (on_ridge(i) ? Erosion::kRidge : 0));
    settling.doubt(i);
  }
  [[nodiscard]] bool on_ridge(std::uint32_t i) const {
    const auto at = [&](std::size_t k) {
      return clearance_m_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k])];
    };
    const float side = larger(larger(at(0), at(4)), larger(at(2), at(6)));
    const float corner = larger(larger(at(1), at(3)), larger(at(5), at(7)));
    return is_ridge(clearance_m_[i], side, corner, static_cast<float>(map_.resolution_m));
  }

  const DenseMap& map_;
  std::span<const float> clearance_m_;
  std::vector<Fate>& fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  float buckets_per_m_;
};

/// Fates in the array of a map whose box holds the other's.
std::vector<Fate> moved(const Erosion& before, const DenseMap& map) {
  if (before.box == map.box) return before.fates;
  std::vector<Fate> fates(map.cells.size(), 0);
  const auto width = static_cast<std::size_t>(before.box.width());
  for (std::int32_t y = before.box.min.y; y <= before.box.max.y; ++y) {
    const auto row = before.fates.begin() + static_cast<std::ptrdiff_t>(width) * (y - before.box.min.y);
    std::copy_n(row, width, fates.begin() + static_cast<std::ptrdiff_t>(map.index({before.box.min.x, y})));
  }
  return fates;
}

/// Cells that are kept, in the order of their turns: within one by number.
std::vector<std::uint32_t> kept_in_order(std::span<const Fate> fates) {
  std::vector<std::uint32_t> cells, ends((kBuckets << 1U) + 1, 0);
  const auto turn = [&](std::uint32_t i) { return static_cast<std::size_t>(fates[i] >> kTurnShift); };
  for_each_with(Erosion::kKept, fates,
                [&](std::size_t i) { cells.push_back(static_cast<std::uint32_t>(i)); });
  for (const std::uint32_t cell : cells) ++ends[turn(cell) + 1];
  for (std::size_t t = 0; t + 1 < ends.size(); ++t) ends[t + 1] += ends[t];
  std::vector<std::uint32_t> kept(cells.size());
  // What was a turn's beginning is its end when it is full.
  for (const std::uint32_t cell : cells) kept[ends[turn(cell)]++] = cell;
  return kept;
}

}  // namespace

std::array<std::ptrdiff_t, 8> neighbour_offsets(const DenseMap& map) {
  const std::ptrdiff_t up = map.width();
  return {1, up + 1, up, up - 1, -1, -up - 1, -up, -up + 1};
}

Erosion erode(const DenseMap& map, std::span<const float> clearance_m) {
  Erosion erosion{map.box, std::vector<Fate>(map.cells.size(), 0), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.fates);
  for (const std::uint32_t i : Assumption(map, clearance_m, erosion.fates).run()) settling.doubt(i);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.fates);
  return erosion;
}

Erosion erode_again(const DenseMap& map, std::span<const float> clearance_m, const Erosion& before,
                    std::span<const std::uint32_t> changed) {
  Erosion erosion{map.box, moved(before, map), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.fates);
  Change change(map, clearance_m, erosion.fates);
  for (const std::uint32_t i : changed) change.apply(i, settling);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.fates);
  return erosion;
}

}  // namespace topo::places
