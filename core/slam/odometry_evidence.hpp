// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// True of two keyframes of one run with none between them.
[[nodiscard]] bool are_successive(const KeyframeId& a, const KeyframeId& b);

/// What odometry says of the motion that a match between successive keyframes of one run measures, where it
/// contradicts the match: by more than OdometryEvidenceParams::doubted_chi2. Empty where it agrees (the
/// match's information then holds it already), where it was reset, and where it reports no motion at all:
/// a robot that is pushed. Keyframes carry their dead reckoning, so that this is a function of the
/// sets from which the canonical map is made, and nothing more is sent or stored.
[[nodiscard]] std::optional<Edge> contradicting_odometry(const Edge& match, const Keyframe& from,
                                                         const Keyframe& to,
                                                         const OdometryEvidenceParams& params);

/// Covariance of what an edge measures: a match that odometry contradicts may be as far off as odometry says.
[[nodiscard]] Eigen::Matrix3d believed_covariance(const Edge& edge, std::span<const KeyframePtr> keyframes,
                                                  const OdometryEvidenceParams& params);

/// The edges of a graph as they are solved: beside each match that odometry contradicts stands odometry's own
/// edge, with the closures' loss, and the match is `doubted`: later closures may overrule it. Without such a
/// match the edges are as they were.
[[nodiscard]] std::vector<Edge> with_odometry(std::span<const KeyframePtr> keyframes,
                                              std::span<const Edge> edges,
                                              const OdometryEvidenceParams& params);

}  // namespace topo::slam
