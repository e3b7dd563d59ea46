// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/mend.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/slam/graph_solution.hpp"

namespace topo::daemon {
namespace {

// Uncertainty of a bridge for each keyframe that it passes over, for both directions of translation and for
// the rotation: above that of any kept edge, so that a bridge yields to every later closure.
constexpr double kBridgeTrans_m = 0.1;
constexpr double kBridgeRot_rad = 0.05;

/// A session while it is mended: numbers are places among the keyframes that are left.
struct Draft {
  std::vector<std::uint64_t> numbers;  ///< in the file
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<std::optional<types::Se2>> poses;
  std::vector<slam::Edge> edges;
};

std::optional<std::size_t> place_of(const std::vector<std::uint64_t>& numbers, std::uint64_t number) {
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
  if (found == numbers.end() || *found != number) return std::nullopt;
  return static_cast<std::size_t>(found - numbers.begin());
}

/// Adds an edge when both its keyframes are left.
void add_edge(Draft& draft, slam::Edge edge) {
  const auto from = place_of(draft.numbers, edge.from), to = place_of(draft.numbers, edge.to);
  if (!from || !to || *from == *to) return;
  edge.from = *from;
  edge.to = *to;
  draft.edges.push_back(edge);
}

Draft draft_of(const SessionItems& items) {
  Draft draft;
  for (const auto& [number, keyframe] : items.keyframes) {
    draft.numbers.push_back(number);
    draft.keyframes.push_back(keyframe);
    const auto pose = items.poses.find(number);
    draft.poses.push_back(pose == items.poses.end() ? std::nullopt : std::optional(pose->second));
  }
  for (const auto& [number, edge] : items.edges) add_edge(draft, edge);
  return draft;
}

/// Places keyframes from their neighbours along the edges, the nearest first. Returns how many.
std::size_t place_along(Draft& draft, bool closures_too) {
  std::vector<std::vector<std::size_t>> edges_at(draft.keyframes.size());
  for (std::size_t i = 0; i < draft.edges.size(); ++i) {
    if (draft.edges[i].robust && !closures_too) continue;
    edges_at[draft.edges[i].from].push_back(i);
    edges_at[draft.edges[i].to].push_back(i);
  }
  std::deque<std::size_t> known;
  for (std::size_t i = 0; i < draft.poses.size(); ++i) {
    if (draft.poses[i]) known.push_back(i);
  }
  std::size_t placed = 0;
  for (; !known.empty(); known.pop_front()) {
    const std::size_t here = known.front();
    for (const std::size_t i : edges_at[here]) {
      const slam::Edge& edge = draft.edges[i];
      const std::size_t there = edge.from == here ? edge.to : edge.from;
      if (draft.poses[there]) continue;
      draft.poses[there] =
          *draft.poses[here] * (edge.from == here ? edge.T_from_to : edge.T_from_to.inverse());
      known.push_back(there);
      ++placed;
    }
  }
  return placed;
}

/// Leaves out what has no pose.
Draft with_poses_only(const Draft& draft) {
  Draft left;
  for (std::size_t i = 0; i < draft.keyframes.size(); ++i) {
    if (!draft.poses[i]) continue;
    left.numbers.push_back(i);
    left.keyframes.push_back(draft.keyframes[i]);
    left.poses.push_back(draft.poses[i]);
  }
  for (const slam::Edge& edge : draft.edges) add_edge(left, edge);
  for (std::uint64_t& number : left.numbers) number = draft.numbers[static_cast<std::size_t>(number)];
  return left;
}

slam::Session session_of(Draft draft) {
  slam::Session session;
  session.keyframes = std::move(draft.keyframes);
  for (const auto& pose : draft.poses) session.poses.push_back(*pose);
  session.edges = std::move(draft.edges);
  return session;
}

slam::Edge bridge(const Draft& draft, std::size_t to) {
  const double passed = static_cast<double>(draft.numbers[to] - draft.numbers[to - 1]);
  const double trans = 1.0 / (passed * kBridgeTrans_m * kBridgeTrans_m);
  const double rot = 1.0 / (passed * kBridgeRot_rad * kBridgeRot_rad);
  slam::Edge edge{to - 1, to, draft.poses[to - 1]->inverse() * *draft.poses[to]};
  edge.information = Eigen::Vector3d(trans, trans, rot).asDiagonal();
  return edge;
}

/// Ties each keyframe to the one before it wherever no chain of edges does. Returns the number of bridges.
std::size_t bridge_gaps(Draft& draft) {
  std::vector<std::size_t> parts(draft.keyframes.size());
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  const auto part_of = [&parts](std::size_t i) {
    while (parts[i] != i) i = parts[i] = parts[parts[i]];
    return i;
  };
  for (const slam::Edge& edge : draft.edges) parts[part_of(edge.from)] = part_of(edge.to);
  std::size_t bridged = 0;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (part_of(i - 1) == part_of(i)) continue;
    draft.edges.push_back(bridge(draft, i));
    parts[part_of(i - 1)] = part_of(i);
    ++bridged;
  }
  return bridged;
}

/// Solves the poses anew with one that was written held; they stay as they are when that gives no sound
/// session.
void solve_anew(slam::Session& session, std::size_t held) {
  if (!slam::check_session(session)) return;
  slam::Session solved = session;
  slam::GraphSolution solution = slam::solve_settled(solved.keyframes, solved.poses, solved.edges, held, {});
  if (!solution.report.solved) return;
  solved.poses = std::move(solution.poses);
  if (slam::check_session(solved)) session = std::move(solved);
}

}  // namespace

slam::Session in_order(const SessionItems& items) { return session_of(with_poses_only(draft_of(items))); }

slam::Session mend(const SessionItems& items, bool unsure, Mended& mended) {
  Draft draft = draft_of(items);
  const auto written = draft.poses;
  mended.placed = place_along(draft, false);
  mended.placed += place_along(draft, true);
  // The first one with a written pose keeps it: the map stays where it was.
  const auto first =
      std::find_if(written.begin(), written.end(), [](const auto& pose) { return pose.has_value(); });
  std::size_t held = 0;
  for (auto pose = written.begin(); pose != first; ++pose)
    held += draft.poses[static_cast<std::size_t>(pose - written.begin())].has_value() ? 1U : 0U;
  draft = with_poses_only(draft);
  mended.bridged = bridge_gaps(draft);
  mended.keyframes = std::max({number_behind(items.keyframes), items.poses_once, items.announced});
  mended.lost = mended.keyframes - draft.keyframes.size();
  slam::Session session = session_of(std::move(draft));
  if (!session.keyframes.empty() && unsure) solve_anew(session, held);
  return session;
}

}  // namespace topo::daemon
