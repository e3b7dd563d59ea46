// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/relation_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

namespace topo::slam {
namespace {

constexpr double kReach_m = 1e4;  // of a relation: an untrusted one must not make cell numbers overflow

/// All numbers of a relation, for a total order.
std::array<double, 13> numbers_of(const Relation& relation) {
  std::array<double, 13> numbers{relation.robust ? 1.0 : 0.0, relation.T_from_to.x_m, relation.T_from_to.y_m,
                                 relation.T_from_to.theta_rad};
  std::copy_n(relation.information.data(), 9, numbers.begin() + 4);
  return numbers;
}

/// True when `a` is kept after both have arrived under one id.
bool comes_first(const FoundRelation& a, const FoundRelation& b) {
  return std::tuple(a.key, numbers_of(a.relation)) <= std::tuple(b.key, numbers_of(b.relation));
}

}  // namespace

bool is_lower(const Relation& a, const Relation& b) { return numbers_of(a) < numbers_of(b); }

types::Status check_relation(const FoundRelation& found) {
  const auto wrong = [&](const std::string& what) {
    return types::fail(types::Errc::kInvalidInput, "relation " + std::to_string(found.id.sequence) +
                                                       " of robot " + std::to_string(found.id.robot) + ": " +
                                                       what);
  };
  const types::Se2& T = found.relation.T_from_to;
  const Eigen::Matrix3d& information = found.relation.information;
  if (found.key.first == found.key.second) return wrong("found one keyframe twice, expected two");
  if (!(std::abs(T.x_m) <= kReach_m && std::abs(T.y_m) <= kReach_m && std::abs(T.theta_rad) <= kReach_m))
    return wrong("the pose is out of range");
  if (!information.allFinite() || information != information.transpose() ||
      information.diagonal().minCoeff() < 0.0)
    return wrong("the information is no information matrix");
  return {};
}

bool RelationSet::insert(const Key& key, const Relation& relation) {
  const auto [at, added] = relations_.try_emplace(key, relation);
  if (added) return true;
  if (!is_lower(relation, at->second)) return false;
  at->second = relation;
  return true;
}

bool RelationSet::merge(const RelationSet& other) {
  bool changed = false;
  for (const auto& [key, relation] : other.relations_) changed = insert(key, relation) || changed;
  return changed;
}

bool RelationLog::insert(const FoundRelation& found) {
  const auto [at, added] = found_.try_emplace(found.id, found);
  if (added) return true;
  if (comes_first(at->second, found)) return false;
  at->second = found;
  return true;
}

RelationSet RelationLog::relations() const {
  RelationSet set;
  for (const auto& [id, found] : found_) set.insert(found.key, found.relation);
  return set;
}

}  // namespace topo::slam
