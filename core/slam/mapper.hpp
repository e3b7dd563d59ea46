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
#include "core/slam/own_past.hpp"
#include "core/slam/team_intake.hpp"
#include "core/slam/tracking.hpp"
#include "core/walls/column_collector.hpp"

namespace topo::slam {

/// Outcome of one scan.
struct MatchReport {
  types::Stamp stamp{};
  types::Se2 T_map_base;
  Match match;
  bool matched = false;   ///< false: lost, the pose is from odometry
  bool searched = false;  ///< the correlative search was needed
  bool keyframe = false;  ///< the scan became one
  std::size_t node = 0;   ///< keyframe that the pose is relative to: apply that keyframe's correction
  types::Se2 T_node_base;
  types::Se2 T_previous_base;  ///< motion since the scan before, by matching; odometry's when lost
  types::Se2 T_odom_base;
};

/// Tracks the robot against the keyframes of its recent path and maintains the pose graph: front end and back
/// end without the slow parts (the loop search is find_closures, the solution of the graph solve_graph).
/// Accepts the keyframes and relations of team-mates: one graph holds all of them, while tracking uses only
/// the robot's own keyframes, whose frame is certain. State of the mapping thread; not thread-safe.
class Mapper {
 public:
  /// `start`: pose in map at the first scan.
  explicit Mapper(const MapperParams& params, const Origin& origin = {}, const types::Se2& start = {});

  /// Continues a checked session from the pose at which a scan was found in its map: the scan becomes the
  /// next keyframe, linked to the nearest one. Precondition: a new mapper.
  void resume(const Session& session, const Arrival& arrival);

  /// Places one deskewed scan. `T_odom_base` is dead reckoning at the cloud's stamp. A keyframe takes the
  /// heights collected since the previous one.
  MatchReport add(const Cloud& cloud, const types::Se2& T_odom_base, walls::ColumnCollector& columns);

  /// The loop closure request of the newest keyframe, once.
  [[nodiscard]] std::optional<LoopQuery> take_query();

  /// The oldest request that found no closure and whose keyframe has been corrected since; empty when there
  /// is none, or when no other visit is near the keyframe now.
  std::optional<LoopQuery> take_second_query();

  /// Adds keyframes and relations of team-mates, in any order and with any repetition. A keyframe enters the
  /// map when relations connect it to one in the map; unconnected keyframes wait. Precondition: the relations
  /// passed check_relation.
  JoinVerdict join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations);

  /// Joins a relation that this robot knows from another source (the start of a team-mate, the place where it
  /// was recognised), and adds it to its own findings.
  JoinVerdict relate(const RelationKey& key, const Relation& relation);

  /// Loop closure requests for newly added keyframes of team-mates near the robot's own path that no relation
  /// ties to it: at most `count_max`, the oldest first.
  std::vector<LoopQuery> take_mate_queries(std::size_t count_max);
  [[nodiscard]] bool has_mates_to_ask_about() const { return intake_.has_new(); }

  /// A request to align the map of a team-mate that no relation connects to this one: made when enough
  /// keyframes have arrived, and again when the two maps together have grown. Without one, a request to find
  /// the newest stretch of the own path in what was mapped before it.
  std::optional<AlignmentQuery> take_alignment_query();
  /// The same of a robot that stands: OwnPast::take_idle.
  std::optional<AlignmentQuery> take_idle_query() { return past_.take_idle(graph_, params_); }

  /// This robot's findings in this run from a number on: odometry, closures, and relations from relate().
  /// What a session holds of earlier findings is not among them: those keep their finders (Edge::finder).
  [[nodiscard]] std::span<const FoundRelation> found_since(std::uint32_t number) const;

  /// Adds accepted closures to the graph.
  LoopVerdict apply(const LoopAnswer& answer);

  /// The graph, to be solved in parallel to tracking, when edges added since the last request carry new
  /// information. Empty until adopt() or give_up_solving() after a request.
  std::optional<GraphQuery> take_graph_query();
  [[nodiscard]] bool is_solving() const { return solving_.out; }

  /// Poses of all current nodes according to a solution of the requested graph.
  [[nodiscard]] std::vector<types::Se2> corrected(const GraphSolution& solution) const;

  /// Continues with poses from corrected(), for all current nodes.
  void adopt(std::vector<types::Se2> poses);
  void give_up_solving();

  /// Solves the complete graph at once. A pending request becomes obsolete.
  SolveReport optimise();

  [[nodiscard]] std::span<const KeyframePtr> keyframes() const { return graph_.keyframes(); }
  [[nodiscard]] std::span<const types::Se2> poses() const { return graph_.poses(); }
  [[nodiscard]] std::span<const Edge> edges() const { return graph_.edges(); }
  /// Index of a keyframe in these lists; empty when it is not in the map.
  [[nodiscard]] std::optional<std::size_t> node_of(const KeyframeId& id) const { return graph_.node_of(id); }
  [[nodiscard]] const Origin& origin() const { return origin_; }
  /// Nodes of the robot's own path, in order, and of each other origin in the order of the keys.
  [[nodiscard]] std::span<const std::size_t> own_way() const { return graph_.own(); }
  [[nodiscard]] const std::map<Origin, std::vector<std::size_t>>& mates_ways() const {
    return graph_.mates();
  }
  [[nodiscard]] Session session() const { return graph_.session(); }
  [[nodiscard]] types::Se2 T_map_odom() const { return motion_.T_map_base * motion_.T_odom_base.inverse(); }
  [[nodiscard]] const types::Se2& T_map_base() const { return motion_.T_map_base; }
  /// Of the last scan.
  [[nodiscard]] const types::Se2& T_odom_base() const { return motion_.T_odom_base; }
  [[nodiscard]] const MapperParams& params() const { return params_; }

 private:
  /// The graph's solution beside tracking: numbers of edges and nodes.
  struct Solving {
    std::size_t asked = 0;   ///< that the newest query has
    std::size_t nodes = 0;   ///< that the newest one looked at
    std::size_t solved = 0;  ///< that the poses obey
    bool out = false;        ///< the query waits for its answer
  };

  void add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                    walls::ColumnCollector& columns);
  KeyframePtr keyframe_of(const Cloud& cloud, std::vector<walls::ColumnPoint> columns);
  void ask(std::size_t node);
  [[nodiscard]] LoopQuery query_about(std::size_t node) const;
  [[nodiscard]] bool is_known(const RelationKey& key) const;
  void add_found_edge(Edge edge);
  KeyframeId note_found(const RelationKey& key, const Relation& relation);
  [[nodiscard]] bool has_new_closures() const;
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
  std::vector<FoundRelation> found_;  ///< by this robot in this run
  std::uint32_t first_found_ = 0;     ///< number of the first of them
  TeamIntake intake_;
  OwnPast past_;
};

}  // namespace topo::slam
