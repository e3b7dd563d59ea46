// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/carmen/fields.hpp"

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;
using types::Se2;
using types::Status;

namespace {

Result<Relation> read_relation(const Fields& f) {
  if (auto s = f.expect_count(8, "t1 t2 x y z roll pitch yaw"); !s.has_value())
    return tl::unexpected(s.error());
  const auto t1 = f.stamp(0, "t1");
  if (!t1.has_value()) return tl::unexpected(t1.error());
  const auto t2 = f.stamp(1, "t2");
  if (!t2.has_value()) return tl::unexpected(t2.error());
  double values[6] = {};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto v = f.number(2 + i, i < 3 ? "translation" : "rotation", -1e6, 1e6);
    if (!v.has_value()) return tl::unexpected(v.error());
    values[i] = *v;
  }
  return Relation{*t1, *t2, Se2{values[0], values[1], values[5]}};
}

/// The pose nearest in time, the earlier of two equally near; nullptr when none is within the tolerance.
const TimedPose* nearest(std::span<const TimedPose> trajectory, double stamp_s, double tolerance_s) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp_s,
                                      [](const TimedPose& p, double t) { return p.stamp_s < t; });
  const TimedPose* best = nullptr;
  if (after != trajectory.begin()) best = &*(after - 1);
  if (after != trajectory.end() &&
      (best == nullptr || std::abs(after->stamp_s - stamp_s) < std::abs(best->stamp_s - stamp_s))) {
    best = &*after;
  }
  if (best != nullptr && std::abs(best->stamp_s - stamp_s) > tolerance_s) return nullptr;
  return best;
}

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
  double max = 0.0;
};

Moments moments(const std::vector<double>& values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) {
    m.mean += v / n;
    m.max = std::max(m.max, v);
  }
  for (const double v : values) m.deviation += (v - m.mean) * (v - m.mean) / n;
  m.deviation = std::sqrt(m.deviation);
  return m;
}

}  // namespace

Result<std::vector<Relation>> read_relations(const std::string& path) {
  auto source = LineSource::open(path);
  if (!source.has_value()) return tl::unexpected(source.error());
  std::vector<Relation> relations;
  const auto whole = read_lines(*source, [&relations](const Fields& f) -> Status {
    if (f.is_comment()) return {};
    const auto relation = read_relation(f);
    if (!relation.has_value()) return tl::unexpected(relation.error());
    relations.push_back(*relation);
    return {};
  });
  if (!whole.has_value()) return tl::unexpected(whole.error());
  if (relations.empty()) {
    return fail(Errc::kInvalidInput,
                fmt::format("{}: found no relation, expected lines t1 t2 x y z roll pitch yaw", path));
  }
  return relations;
}

RelationErrors evaluate_relations(std::span<const Relation> relations, std::span<const TimedPose> trajectory,
                                  double tolerance_s) {
  RelationErrors errors;
  std::vector<double> trans_m, rot_rad;
  for (const Relation& r : relations) {
    const TimedPose* a = nearest(trajectory, r.t1_s, tolerance_s);
    const TimedPose* b = nearest(trajectory, r.t2_s, tolerance_s);
    if (a == nullptr || b == nullptr) {
      ++errors.skipped;
      continue;
    }
    const Se2 moved = a->pose.inverse() * b->pose;
    trans_m.push_back(distance_m(moved, r.relative));
    rot_rad.push_back(std::abs(types::wrap_angle(moved.theta_rad - r.relative.theta_rad)));
  }
  errors.used = static_cast<int>(trans_m.size());
  if (errors.used == 0) return errors;
  const Moments t = moments(trans_m), rot = moments(rot_rad);
  errors.trans_mean_m = t.mean;
  errors.trans_std_m = t.deviation;
  errors.trans_max_m = t.max;
  errors.rot_mean_rad = rot.mean;
  errors.rot_std_rad = rot.deviation;
  errors.rot_max_rad = rot.max;
  return errors;
}

}  // namespace topo::bench
