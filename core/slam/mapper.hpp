// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/slam/free_ground.hpp"
#include "core/slam/graph_links.hpp"
#include "core/slam/graph_solution.hpp"
#include "core/slam/keyframe.hpp"
#include "core/slam/loop_candidates.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/open_questions.hpp"
#include "core/slam/refine.hpp"
#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"
#include "core/slam/team_alignment.hpp"
#include "core/slam/unplaced.hpp"
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
};

/// Outcome of a join.
struct JoinVerdict {
  int placed = 0;  ///< keyframes of team-mates that entered the map
  int tied = 0;    ///< relations that entered the graph
  JoinVerdict& operator+=(const JoinVerdict& other) {
    placed += other.placed;
    tied += other.tied;
    return *this;
  }
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
  [[nodiscard]] bool has_mates_to_ask_about() const { return !unasked_.empty(); }

  /// A request to align the map of a team-mate that no relation connects to this one: made when enough
  /// keyframes have arrived, and again when the two maps together have grown.
  std::optional<AlignmentQuery> take_alignment_query();

  /// This robot's own findings from a number on: odometry, closures, and relations from relate().
  [[nodiscard]] std::span<const FoundRelation> found_since(std::uint32_t number) const;

  /// Adds accepted closures to the graph.
  LoopVerdict apply(const LoopAnswer& answer);

  /// The graph, to be solved in parallel to tracking, when edges added since the last request carry new
  /// information. Empty until adopt() or give_up_solving() after a request.
  std::optional<GraphQuery> take_graph_query();
  [[nodiscard]] bool is_solving() const { return solving_; }

  /// Poses of all current nodes according to a solution of the requested graph.
  [[nodiscard]] std::vector<types::Se2> corrected(const GraphSolution& solution) const;

  /// Continues with poses from corrected(), for all current nodes.
  void adopt(std::vector<types::Se2> poses);
  void give_up_solving();

  /// Solves the complete graph at once. A pending request becomes obsolete.
  SolveReport optimise();

  [[nodiscard]] std::span<const KeyframePtr> keyframes() const { return keyframes_; }
  [[nodiscard]] std::span<const types::Se2> poses() const { return poses_; }
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  /// Index of a keyframe in these lists; empty when it is not in the map.
  [[nodiscard]] std::optional<std::size_t> node_of(const KeyframeId& id) const;
  [[nodiscard]] const Origin& origin() const { return maker_; }
  /// Nodes of the robot's own path, in order, and of each other origin in the order of the keys.
  [[nodiscard]] std::span<const std::size_t> own_way() const { return own_; }
  [[nodiscard]] const std::map<Origin, std::vector<std::size_t>>& mates_ways() const { return mates_; }
  [[nodiscard]] Session session() const { return {keyframes_, poses_, edges_}; }
  [[nodiscard]] types::Se2 T_map_odom() const { return T_map_base_ * T_odom_base_.inverse(); }
  [[nodiscard]] const types::Se2& T_map_base() const { return T_map_base_; }
  [[nodiscard]] const types::Se2& T_odom_base() const { return T_odom_base_; }  ///< of the last scan
  [[nodiscard]] const MapperParams& params() const { return params_; }

 private:
  [[nodiscard]] Prior predict(const types::Se2& motion, double seconds) const;
  [[nodiscard]] Prior going_on(double seconds) const;
  Match track(const Prior& prior, const Prior& going_on, const Point& sensor, bool& searched);
  [[nodiscard]] Match search_near(const LikelihoodPyramid& pyramid, const Prior& prior, const Prior& going_on,
                                  const Point& sensor, Match match) const;
  [[nodiscard]] std::optional<Match> find_elsewhere(const LikelihoodPyramid& pyramid,
                                                    const types::Se2& predicted, const SearchWindow& window,
                                                    const Point& sensor) const;
  [[nodiscard]] FreeGround local_ground() const;
  [[nodiscard]] bool is_apart(std::size_t node, double way_m, double turn_rad) const;
  [[nodiscard]] bool has_enough_alike() const;
  void add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                    walls::ColumnCollector& columns);
  void ask(std::size_t node);
  [[nodiscard]] bool is_known(const Edge& edge) const;
  void extend_local_map();
  void rebuild_local_map();

  std::size_t add_node(KeyframePtr keyframe, const types::Se2& pose);
  std::size_t add_own_node(KeyframePtr keyframe, const types::Se2& pose);
  std::size_t add_mates_node(KeyframePtr keyframe, const types::Se2& pose);
  [[nodiscard]] bool is_own(std::size_t node) const;
  void add_found_edge(const Edge& edge);
  void add_edge(const Edge& edge);
  [[nodiscard]] bool is_tense(const Edge& edge) const { return edge_chi2(edge, poses_) > kTensionChi2; }
  [[nodiscard]] bool is_far_off(const Edge& edge) const;
  [[nodiscard]] bool has_something_new() const;
  void relink();
  [[nodiscard]] bool is_as_sure_as_a_match(const Edge& edge) const;
  LoopGroup group_of(const LoopRun& run, Way way) const;
  LoopQuery query_about(std::size_t node) const;
  std::vector<LoopGroup> groups_of_mates(std::size_t node, std::span<const double> distances_m) const;
  [[nodiscard]] bool is_tied_to_own_way(std::size_t node) const;
  struct Joining;

  static constexpr int kClosuresBeforeSolve = 10;  ///< closures that agree with the graph are batched
  static constexpr double kTensionChi2 = 1.0;      ///< edges with a greater error trigger a solve at once

  MapperParams params_;
  Origin maker_;
  types::Se2 start_;
  std::vector<KeyframePtr> keyframes_;  ///< in the order of arrival; the first one fixes the map
  std::vector<types::Se2> poses_;       ///< of base_link at each keyframe, in map
  std::vector<Edge> edges_;
  std::uint32_t next_sequence_ = 0;
  types::Se2 T_map_base_, T_odom_base_;
  double invalid_share_ = 0.0;    ///< of the beams of the robot's newest keyframe
  types::Stamp stamp_{};          ///< of the last scan
  types::Se2 T_previous_last_;    ///< motion between the last two scans
  double previous_last_s_ = 0.0;  ///< and its duration
  SurfelMap local_map_;
  std::size_t window_first_ = 0;  ///< index in own_ of the first keyframe in the local map
  Point local_centre_ = Point::Zero();
  std::optional<LoopQuery> query_;
  OpenQuestions open_questions_;
  std::vector<Point> points_;            ///< scratch
  std::size_t edges_asked_ = 0;          ///< number of edges in the newest graph request
  std::size_t edges_solved_ = 0;         ///< number of edges that the poses satisfy
  bool solving_ = false;                 ///< a graph request is pending
  GraphLinks links_;                     ///< of the edges that the poses approximately satisfy
  std::vector<std::size_t> unlinked_;    ///< the other edges
  std::size_t resumed_at_ = 0;           ///< index in own_ of the first keyframe since resume()
  std::vector<std::size_t> neighbours_;  ///< older keyframes around it

  std::vector<std::size_t> own_;                      ///< the robot's own nodes, in the order of its path
  std::map<Origin, std::vector<std::size_t>> mates_;  ///< other origins' nodes in the order of the keys
  std::map<KeyframeId, std::size_t> nodes_;
  std::set<RelationKey> known_;       ///< relations in the graph or waiting
  std::vector<FoundRelation> found_;  ///< by this robot
  Unplaced unplaced_;
  std::deque<std::size_t> unasked_;           ///< nodes of team-mates without a loop closure request
  std::set<std::size_t> tied_;                ///< nodes of team-mates with a match-grade edge to an own node
  std::map<Origin, std::size_t> aligned_at_;  ///< keyframes, own and theirs, at the last request
};

}  // namespace topo::slam
