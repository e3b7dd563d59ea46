// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/slam/graph_solution.hpp"
#include "core/slam/local_map.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/map_graph.hpp"
#include "core/slam/open_questions.hpp"
#include "core/slam/team_intake.hpp"
#include "core/slam/tracking.hpp"
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
  types::Se2 T_previous_base;  ///< motion since the scan before, by matching; odometry's when lost
  types::Se2 T_odom_base;
};

/// Tracks the robot against the keyframes of its recent path and keeps the pose graph (front and back end
/// without what may take long: the loop search is find_closures, the graph's solution solve_graph). Takes in
/// what team-mates saw and found: one graph holds all of it, while tracking keeps to what the robot saw
/// itself, whose frame is not in question. State of the mapping thread; not thread-safe.
class Mapper {
 public:
  /// `start`: where the map has the robot at its first scan.
  explicit Mapper(const MapperParams& params, const Origin& origin = {}, const types::Se2& start = {});

  /// Goes on with a session that was checked, from where a scan was found in its map: the scan becomes the
  /// next keyframe, hung on the nearest one. Of a new mapper only.
  void resume(const Session& session, const Arrival& arrival);

  /// Places one deskewed scan. `T_odom_base` is dead reckoning at the cloud's stamp. A keyframe takes the
  /// heights collected since the one before.
  MatchReport add(const Cloud& cloud, const types::Se2& T_odom_base, walls::ColumnCollector& columns);

  /// The question that the newest keyframe raised, once.
  [[nodiscard]] std::optional<LoopQuery> take_query();

  /// The oldest question that came to nothing when it was raised and whose keyframe has been corrected since;
  /// nothing when there is none, or when no other visit is near it now either.
  std::optional<LoopQuery> take_second_query();

  /// Takes in keyframes and relations of team-mates, in any order and with any repetition. A keyframe enters
  /// the map when relations tie it to one that is in it; what nothing ties waits. Relations passed
  /// check_relation.
  JoinVerdict join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations);

  /// A relation that this robot knows from elsewhere (where a team-mate started, where it was recognised):
  /// joined, and told as found.
  JoinVerdict relate(const RelationKey& key, const Relation& relation);

  /// Where on the robot's own way a team-mate's keyframes may have been seen, for those that came since and
  /// that nothing ties to it: at most `count_max` questions, the oldest first.
  std::vector<LoopQuery> take_mate_queries(std::size_t count_max);
  [[nodiscard]] bool has_mates_to_ask_about() const { return intake_.has_new(); }

  /// Whether a team-mate's map, of which nothing ties anything to this one, lies on it: asked when enough has
  /// come, and again when both have grown.
  std::optional<AlignmentQuery> take_alignment_query();

  /// What this robot found itself, from a number on: odometry, closures, and what relate() said.
  [[nodiscard]] std::span<const FoundRelation> found_since(std::uint32_t number) const;

  /// Puts closures into the graph.
  LoopVerdict apply(const LoopAnswer& answer);

  /// The graph, to be solved beside tracking, when what came since says something new. Not again until
  /// adopt() or give_up_solving().
  std::optional<GraphQuery> take_graph_query();
  [[nodiscard]] bool is_solving() const { return solving_.out; }

  /// Where a solution of the graph that was asked about puts all nodes that are there now.
  [[nodiscard]] std::vector<types::Se2> corrected(const GraphSolution& solution) const;

  /// Goes on from poses that corrected() gave, for all nodes that are there.
  void adopt(std::vector<types::Se2> poses);
  void give_up_solving();

  /// Solves the graph with everything in it, at once. What was asked about is no longer waited for.
  SolveReport optimise();

  [[nodiscard]] std::span<const KeyframePtr> keyframes() const { return graph_.keyframes(); }
  [[nodiscard]] std::span<const types::Se2> poses() const { return graph_.poses(); }
  [[nodiscard]] std::span<const Edge> edges() const { return graph_.edges(); }
  /// A keyframe's place in these lists; nothing when it is not in the map.
  [[nodiscard]] std::optional<std::size_t> node_of(const KeyframeId& id) const { return graph_.node_of(id); }
  [[nodiscard]] const Origin& origin() const { return origin_; }
  /// Nodes of the robot's own way, in its order, and of each other origin in the order of the keys.
  [[nodiscard]] std::span<const std::size_t> own_way() const { return graph_.own(); }
  [[nodiscard]] const std::map<Origin, std::vector<std::size_t>>& mates_ways() const {
    return graph_.mates();
  }
  [[nodiscard]] Session session() const { return graph_.session(); }
  [[nodiscard]] types::Se2 T_map_odom() const { return motion_.T_map_base * motion_.T_odom_base.inverse(); }
  [[nodiscard]] const types::Se2& T_map_base() const { return motion_.T_map_base; }
  [[nodiscard]] const types::Se2& T_odom_base() const {
    return motion_.T_odom_base;
  }  ///< of the scan placed last
  [[nodiscard]] const MapperParams& params() const { return params_; }

 private:
  /// The graph's solution beside tracking: numbers of edges.
  struct Solving {
    std::size_t asked = 0;   ///< that the newest query has
    std::size_t solved = 0;  ///< that the poses obey
    bool out = false;        ///< the query waits for its answer
  };

  void add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                    walls::ColumnCollector& columns);
  KeyframePtr keyframe_of(const Cloud& cloud, std::vector<walls::ColumnPoint> columns);
  void ask(std::size_t node);
  [[nodiscard]] LoopQuery query_about(std::size_t node) const;
  [[nodiscard]] bool is_known(const RelationKey& key) const;
  void add_found_edge(const Edge& edge);
  void note_found(const RelationKey& key, const Relation& relation);
  [[nodiscard]] bool has_something_new() const;
  [[nodiscard]] GraphQuery graph_query() const;

  MapperParams params_;
  Origin origin_;
  types::Se2 start_;
  MapGraph graph_;
  LocalMap local_map_;
  TrackedMotion motion_;
  double invalid_share_ = 0.0;  ///< of the beams of the robot's newest keyframe
  std::uint32_t next_sequence_ = 0;
  std::vector<Point> points_;  ///< scratch: the points of the scan for matching
  std::optional<LoopQuery> query_;
  OpenQuestions open_questions_;
  Solving solving_;
  std::vector<FoundRelation> found_;  ///< by this robot
  TeamIntake intake_;
};

}  // namespace topo::slam
