// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/places/skeleton/thinning_state.hpp"

namespace topo::places {

/// Cells in ascending order, to which cells can be added during removal.
class Rising {
 public:
  /// Before start(), cells may be added in any order, at lower cost.
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
  /// False when no cell is left; the state is then that before start().
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

/// Cells by bucket, removed bucket by bucket.
class Buckets {
 public:
  Buckets() : heads_(kBuckets, kNone) {}

  void add(std::uint32_t cell, std::size_t bucket) {
    entries_.push_back({cell, heads_[bucket]});
    heads_[bucket] = static_cast<std::uint32_t>(entries_.size() - 1);
    end_ = std::max(end_, bucket + 1);
  }
  /// One after the last bucket that was used.
  [[nodiscard]] std::size_t end() const { return end_; }
  void take(std::size_t bucket, Rising& out) {
    for (std::uint32_t e = heads_[bucket]; e != kNone; e = entries_[e].next) out.add(entries_[e].cell);
    heads_[bucket] = kNone;
  }
  /// Call when all cells are taken.
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

}  // namespace topo::places
