// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/split_run.hpp"

#include <algorithm>
#include <utility>

#include "core/slam/known_starts.hpp"
#include "core/slam/team_alignment.hpp"
#include "tests/bench/topobench/log_run.hpp"

namespace topo::bench {
namespace {

constexpr std::size_t kExchangeScans = 20;
constexpr std::size_t kStandingScans = 600;  ///< at most, at the end
constexpr double kStandingPeriod_s = 1.0;

/// One half of the log with its mapper.
class Half {
 public:
  Half(const CarmenLog& log, std::uint16_t robot, std::size_t first, std::size_t last,
       const types::Se2& start, std::vector<std::string>& alignments)
      : log_(log),
        next_(first),
        last_(last),
        first_(first),
        start_(start),
        state_(params_for(log), {robot, 0}, start),
        lock_step_(state_) {
    lock_step_.on_alignment = [&alignments](const slam::Alignment& alignment) {
      alignments.push_back(slam::describe(alignment));
    };
  }

  [[nodiscard]] bool is_over() const { return next_ == last_; }
  [[nodiscard]] double share() const {
    return static_cast<double>(next_ - first_) / static_cast<double>(last_ - first_);
  }
  [[nodiscard]] const slam::Mapper& mapper() const { return state_.mapper(); }
  [[nodiscard]] const types::Se2& start() const { return start_; }

  void step() {
    if (is_over()) return;
    step(log_.scans[next_], log_.scans[next_].stamp_s);
    ++next_;
  }

  /// The last scan once more, a while later.
  void stand() {
    ++stood_;
    step(log_.scans[last_ - 1], log_.scans[last_ - 1].stamp_s + kStandingPeriod_s * stood_);
  }
  [[nodiscard]] bool has_open_questions() const { return mapper().has_mates_to_ask_about(); }

  void tell(Half& other) {
    std::vector<slam::KeyframePtr> keyframes;
    const auto way = mapper().own_way().subspan(keyframes_told_);
    for (const std::size_t node : way) keyframes.push_back(mapper().keyframes()[node]);
    const auto found = mapper().found_since(relations_told_);
    other.state_.join(keyframes, found);
    keyframes_told_ += way.size();
    relations_told_ += static_cast<std::uint32_t>(found.size());
  }

  void relate(const std::pair<slam::RelationKey, slam::Relation>& known) {
    state_.relate(known.first, known.second);
  }
  MappingRun finish() { return lock_step_.finish(); }

 private:
  void step(const CarmenScan& from, double stamp_s) {
    fill_scan(from, stamp_s, sequence_++, scan_);
    const types::Odometry odometry{
        scan_.arrival, types::Transform2<types::Odom, types::Base>(from.robot_odom), {}};
    lock_step_.step({{&odometry, 1}, &scan_, nullptr});
  }

  const CarmenLog& log_;
  std::size_t next_, last_, first_;
  types::Se2 start_;
  pipeline::MappingState state_;
  LockStep lock_step_;
  types::Scan scan_;
  std::uint64_t sequence_ = 0;
  int stood_ = 0;
  std::size_t keyframes_told_ = 0;
  std::uint32_t relations_told_ = 0;
};

/// A half's scans where the map of `mapper` has the keyframes that they hang on.
void add_trajectory(const MappingRun& run, const Half& half, const slam::Mapper& mapper, SplitRun& out) {
  for (std::size_t i = 0; i < run.hung.size(); ++i) {
    const auto node = mapper.node_of(half.mapper().keyframes()[run.hung[i].node]->id);
    if (!node) continue;
    out.trajectory.push_back({run.live[i].stamp_s, mapper.poses()[*node] * run.hung[i].T_node_base});
  }
}

int count_ties(const slam::Mapper& mapper) {
  return static_cast<int>(
      std::count_if(mapper.edges().begin(), mapper.edges().end(), [&](const slam::Edge& e) {
        return mapper.keyframes()[e.from]->id.robot != mapper.keyframes()[e.to]->id.robot;
      }));
}

}  // namespace

SplitRun run_split(const CarmenLog& log, const std::optional<types::Se2>& second_start) {
  SplitRun out;
  const std::size_t middle = log.scans.size() / 2;
  Half first(log, 0, 0, middle, {}, out.alignments);
  Half second(log, 1, middle, log.scans.size(), second_start.value_or(types::Se2{}), out.alignments);
  const auto exchange = [&] {
    first.tell(second);
    second.tell(first);
    if (!out.joined_share && !first.mapper().mates_ways().empty()) out.joined_share = second.share();
  };
  bool related = false;
  for (std::size_t scans = 1; !first.is_over() || !second.is_over(); ++scans) {
    first.step();
    second.step();
    if (second_start && !related && !first.mapper().own_way().empty() && !second.mapper().own_way().empty()) {
      const auto known = slam::known_starts({0, 0}, first.start(), {1, 0}, second.start());
      first.relate(known);
      second.relate(known);
      related = true;
    }
    if (scans % kExchangeScans == 0) exchange();
  }
  exchange();
  for (std::size_t scans = 0; scans < kStandingScans; ++scans) {
    first.stand();
    second.stand();
    exchange();
    if (scans > 2 && !first.has_open_questions() && !second.has_open_questions()) break;
  }
  const MappingRun second_run = second.finish();
  exchange();
  const MappingRun first_run = first.finish();
  add_trajectory(first_run, first, first.mapper(), out);
  add_trajectory(second_run, second, first.mapper(), out);
  out.keyframes = first.mapper().keyframes().size();
  out.mates_keyframes = out.keyframes - first.mapper().own_way().size();
  out.ties = count_ties(first.mapper());
  return out;
}

}  // namespace topo::bench
