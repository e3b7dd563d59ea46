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
/// associative and idempotent, so that neither order nor repetition of messages matters. The keyframe under a
/// key is immutable; if two differ nevertheless (a robot restarted its count without a new run number), the
/// one with the lexicographically lower bytes is kept, independent of the order of arrival. Value semantics;
/// copies share the keyframes.
class KeyframeSet {
 public:
  using Map = std::map<KeyframeId, KeyframePtr>;

  /// True when the set has changed. `keyframe` is not null.
  bool insert(KeyframePtr keyframe);
  /// Union. True when the set has changed.
  bool merge(const KeyframeSet& other);

  [[nodiscard]] bool contains(const KeyframeId& id) const { return keyframes_.contains(id); }
  /// Null when the key is not in the set.
  [[nodiscard]] KeyframePtr find(const KeyframeId& id) const;
  [[nodiscard]] std::size_t size() const { return keyframes_.size(); }
  /// In the order of their keys.
  [[nodiscard]] const Map& keyframes() const { return keyframes_; }

  /// Per origin, the length of the gap-free sequence held here: sent to other robots, which then send the
  /// rest.
  [[nodiscard]] std::vector<OriginCount> counts() const { return counts_of(keyframes_); }
  /// Keyframes held here that, by its counts, the other robot lacks; at most `count_max`, origin by origin,
  /// oldest first.
  [[nodiscard]] std::vector<KeyframePtr> missing(std::span<const OriginCount> there,
                                                 std::size_t count_max) const {
    return missing_of(keyframes_, there, count_max);
  }

 private:
  Map keyframes_;
};

/// True when the keys are equal, and the bytes under each key.
bool operator==(const KeyframeSet& a, const KeyframeSet& b);

}  // namespace topo::slam
