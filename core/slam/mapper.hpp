// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/refine.hpp"
#include "core/slam/session.hpp"
#include "core/walls/column_collector.hpp"

namespace topo::slam {

/// What became of one scan.
struct MatchReport {
  types::Stamp stamp{};
  types::Se2 T_map_base;
  Match match;
  bool matched = false;   ///< false: lost, the pose is odometry's
  bool searched = false;  ///< the correlative search was needed
  bool keyframe = false;  ///< the scan became one
  std::size_t node = 0;   ///< keyframe that the pose hangs on: correct it with that keyframe's correction
  types::Se2 T_node_base;
};

/// Tracks the robot against the keyframes of its recent path and keeps the pose graph (front and back end
/// without the loop search, which is find_closures). State of the mapping thread; not thread-safe.
class Mapper {
 public:
  explicit Mapper(const MapperParams& params, std::uint16_t robot = 0);

  /// Goes on with a session that was checked, from where a scan was found in its map: the scan becomes the
  /// next keyframe, hung on the nearest one. Of a new mapper only.
  void resume(const Session& session, const Arrival& arrival);

  /// Places one deskewed scan. `T_odom_base` is dead reckoning at the cloud's stamp. A keyframe takes the
  /// heights collected since the one before.
  MatchReport add(const Cloud& cloud, const types::Se2& T_odom_base, walls::ColumnCollector& columns);

  /// The question that the newest keyframe raised, once.
  [[nodiscard]] std::optional<LoopQuery> take_query();

  /// Puts closures into the graph and solves it when they say something new.
  LoopVerdict apply(const LoopAnswer& answer);

  /// Solves the graph with everything in it.
  SolveReport optimise();

  [[nodiscard]] std::span<const KeyframePtr> keyframes() const { return keyframes_; }
  [[nodiscard]] std::span<const types::Se2> poses() const { return poses_; }
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  [[nodiscard]] Session session() const { return {keyframes_, poses_, edges_}; }
  [[nodiscard]] types::Se2 T_map_odom() const { return T_map_base_ * T_odom_base_.inverse(); }
  [[nodiscard]] const types::Se2& T_map_base() const { return T_map_base_; }
  [[nodiscard]] const types::Se2& T_odom_base() const { return T_odom_base_; }  ///< of the scan placed last
  [[nodiscard]] const MapperParams& params() const { return params_; }

 private:
  Match track(const types::Se2& predicted, const Prior& prior, const Point& sensor, bool& searched);
  bool due(const types::Se2& T_map_base) const;
  void add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                    walls::ColumnCollector& columns);
  void ask(std::size_t node);
  void extend_local_map();
  void rebuild_local_map();

  MapperParams params_;
  std::uint16_t robot_;
  std::vector<KeyframePtr> keyframes_;
  std::vector<types::Se2> poses_;  ///< of base_link at each keyframe, in map
  std::vector<Edge> edges_;
  std::uint32_t next_sequence_ = 0;
  types::Se2 T_map_base_, T_odom_base_;
  SurfelMap local_map_;
  std::size_t window_first_ = 0;  ///< first keyframe in the local map
  Point local_centre_ = Point::Zero();
  std::optional<LoopQuery> query_;
  std::vector<Point> points_;  ///< scratch
  int closures_since_solve_ = 0;
  std::size_t resumed_at_ = 0;           ///< first keyframe since resume()
  std::vector<std::size_t> neighbours_;  ///< older keyframes around it
};

}  // namespace topo::slam
