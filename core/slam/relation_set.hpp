// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/slam/numbered.hpp"
#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::slam {

/// What ties two keyframes: odometry, a match, a closure, or starts that are known.
struct Relation {
  types::Se2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< as Edge has it
  bool robust = false;
};

/// Which keyframes a relation ties: from, to.
using RelationKey = std::pair<KeyframeId, KeyframeId>;

/// A relation as its finder tells it to others.
struct FoundRelation {
  KeyframeId id;  ///< who found it, and as which of his
  RelationKey key;
  Relation relation;
};

/// Whether a relation from outside is one: between two keyframes, finite, within reach, of an information
/// that is symmetric and of no negative diagonal. kInvalidInput names the fault.
[[nodiscard]] types::Status check_relation(const FoundRelation& found);

/// The grow-only set of relations, keyed (from, to), beside the keyframes'. Two under one key are joined as
/// keyframes are: the one whose numbers come first stays. All numbers are finite (check_relation).
class RelationSet {
 public:
  using Key = RelationKey;

  /// True when the set has changed.
  bool insert(const Key& key, const Relation& relation);
  /// Union. True when the set has changed.
  bool merge(const RelationSet& other);
  /// In the order of their keys.
  [[nodiscard]] const std::map<Key, Relation>& relations() const { return relations_; }

 private:
  std::map<Key, Relation> relations_;
};

/// The grow-only set of what everybody found, keyed by finder and number as keyframes are by origin and
/// sequence: what robots send one another until all have all of it.
class RelationLog {
 public:
  /// True when the log has changed.
  bool insert(const FoundRelation& found);
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] std::vector<OriginCount> counts() const { return counts_of(found_); }
  /// What is here and, by its counts, not there; at most `count_max`, finder by finder, oldest first.
  [[nodiscard]] std::vector<FoundRelation> missing(std::span<const OriginCount> there,
                                                   std::size_t count_max) const {
    return missing_of(found_, there, count_max);
  }
  /// By their keys: what a map is made of.
  [[nodiscard]] RelationSet relations() const;

 private:
  std::map<KeyframeId, FoundRelation> found_;
};

}  // namespace topo::slam
