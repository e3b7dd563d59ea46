// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/slam/numbered.hpp"

namespace topo::slam {

/// The grow-only set of keyframes keyed (robot, run, sequence) that several robots share (DESIGN "Team"): a
/// join-semilattice (Shapiro et al., Conflict-free Replicated Data Types, 2011). Union is commutative,
/// associative and idempotent, so that neither order nor repetition of messages matters. Under one key the
/// keyframe is frozen; should two differ after all (a robot that began to count anew and did not say so), the
/// one whose bytes come first stays, in whatever order they came. A value; copies share the keyframes.
class KeyframeSet {
 public:
  using Map = std::map<KeyframeId, KeyframePtr>;

  /// True when the set has changed. `keyframe` is not null.
  bool insert(KeyframePtr keyframe);
  /// Union. True when the set has changed.
  bool merge(const KeyframeSet& other);

  [[nodiscard]] bool contains(const KeyframeId& id) const { return keyframes_.contains(id); }
  /// Null when it is not there.
  [[nodiscard]] KeyframePtr find(const KeyframeId& id) const;
  [[nodiscard]] std::size_t size() const { return keyframes_.size(); }
  /// In the order of their keys.
  [[nodiscard]] const Map& keyframes() const { return keyframes_; }

  /// What is here without a gap, by origin: what a robot tells another, so that it sends the rest.
  [[nodiscard]] std::vector<OriginCount> counts() const { return counts_of(keyframes_); }
  /// What is here and, by its counts, not there; at most `count_max`, origin by origin, oldest first.
  [[nodiscard]] std::vector<KeyframePtr> missing(std::span<const OriginCount> there,
                                                 std::size_t count_max) const {
    return missing_of(keyframes_, there, count_max);
  }

 private:
  Map keyframes_;
};

/// Equal keys, and equal bytes under each.
bool operator==(const KeyframeSet& a, const KeyframeSet& b);

}  // namespace topo::slam
