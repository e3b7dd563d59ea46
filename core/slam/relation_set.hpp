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

/// A constraint between two keyframes: odometry, a match, a closure, or known starts.
struct Relation {
  types::Se2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< as in Edge
  bool robust = false;
};

/// True when `a` is the one that is kept of two relations under one key.
[[nodiscard]] bool is_lower(const Relation& a, const Relation& b);

/// The keyframes of a relation: from, to.
using RelationKey = std::pair<KeyframeId, KeyframeId>;

/// A relation as its finder sends it to team-mates.
struct FoundRelation {
  KeyframeId id;  ///< the finder and its number there
  RelationKey key;
  Relation relation;
};

/// Checks a relation from outside: two distinct keyframes, finite and within reach, a symmetric information
/// without negative diagonal entries. kInvalidInput names the fault.
[[nodiscard]] types::Status check_relation(const FoundRelation& found);

/// The grow-only set of relations, keyed (from, to), beside that of keyframes. Of two relations under one
/// key, as with keyframes, the lexicographically lower one is kept. All numbers are finite (check_relation).
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

/// The grow-only set of all robots' findings, keyed by finder and number as keyframes are by origin and
/// sequence: robots exchange them until all have the complete log.
class RelationLog {
 public:
  /// True when the log has changed.
  bool insert(const FoundRelation& found);
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] std::vector<OriginCount> counts() const { return counts_of(found_); }
  /// Relations held here that, by its counts, the other robot lacks; at most `count_max`, finder by finder,
  /// oldest first.
  [[nodiscard]] std::vector<FoundRelation> missing(std::span<const OriginCount> there,
                                                   std::size_t count_max) const {
    return missing_of(found_, there, count_max);
  }
  /// The relations by their keys, from which a map is built.
  [[nodiscard]] RelationSet relations() const;

 private:
  std::map<KeyframeId, FoundRelation> found_;
};

}  // namespace topo::slam
