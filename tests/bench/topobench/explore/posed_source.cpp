// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/grid/occupancy_grid.hpp"
#include "core/pipeline/odometry_buffer.hpp"
#include "core/slam/map_builder.hpp"
#include "core/walls/column_collector.hpp"
#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {
namespace {

/// The map changes no faster: each change costs a whole analysis, most of what such a run costs.
constexpr types::Duration kPublishPeriod = std::chrono::seconds(1);
constexpr double kFill_m = 0.05;         // one cell
constexpr double kSurfaceStep_m = 0.15;  // ranges of neighbouring beams that differ more are an edge
constexpr double kSurfaceSlope = 3.0;    // ... beyond what a surface seen at a flat angle does

/// Hits in base_link, with the surface between neighbouring beams drawn in cell by cell: as dense as the full
/// scan's, where the surface is one.
void dense_hits(const types::Scan& scan, const types::Se2& T_base_laser, double range_max_m,
                std::vector<slam::Point>& out) {
  std::optional<types::Vector2> before;
  double range_before = 0.0;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double range = static_cast<double>(scan.range_m[i]);
    if (!types::is_hit(scan.range_m[i]) || range > range_max_m) {
      before.reset();
      continue;
    }
    const double angle = static_cast<double>(scan.angle_rad(i));
    const types::Vector2 p = T_base_laser * types::Vector2(range * std::cos(angle), range * std::sin(angle));
    const double spacing =
        std::min(range, range_before) * static_cast<double>(scan.geometry.angle_increment_rad);
    if (before && std::abs(range - range_before) < std::max(kSurfaceStep_m, kSurfaceSlope * spacing)) {
      const int pieces = static_cast<int>(std::ceil((p - *before).norm() / kFill_m));
      for (int k = 1; k < pieces; ++k)
        out.push_back((*before + (p - *before) * (static_cast<double>(k) / pieces)).cast<float>());
    }
    out.push_back(p.cast<float>());
    before = p;
    range_before = range;
  }
}

/// Heights from coronal scans that are a hand's breadth apart: scans between them are made up where two
/// agree.
class Heights {
 public:
  explicit Heights(const slam::MapperParams& params) : collector_(params.coronal, params.columns) {}

  void add(const types::Scan& scan, const types::Se2& T_map_base) {
    if (has_before_) fill(scan, T_map_base);
    collector_.add(scan, T_map_base, T_map_base);
    before_ = scan;
    T_map_before_ = T_map_base;
    has_before_ = true;
  }
  std::vector<walls::ColumnPoint> take(const types::Se2& T_map_base) {
    return collector_.take(T_map_base.inverse());
  }

 private:
  void fill(const types::Scan& scan, const types::Se2& T_map_base) {
    const double way = (T_map_base.translation() - T_map_before_.translation()).norm();
    const int pieces = static_cast<int>(std::ceil(way / kFill_m));
    between_ = scan;
    for (int k = 1; k < pieces; ++k) {
      const double part = static_cast<double>(k) / pieces;
      for (std::size_t i = 0; i < scan.beams; ++i) {
        const float a = before_.range_m[i], b = scan.range_m[i];
        const bool one =
            types::is_hit(a) && types::is_hit(b) && std::abs(a - b) < static_cast<float>(kSurfaceStep_m);
        between_.range_m[i] = one ? a + (b - a) * static_cast<float>(part) : types::kInvalid;
      }
      const types::Se2 pose = types::interpolate(T_map_before_, T_map_base, part);
      collector_.add(between_, pose, pose);
    }
  }

  walls::ColumnCollector collector_;
  types::Scan before_, between_;
  types::Se2 T_map_before_;
  bool has_before_ = false;
};

/// A keyframe and where it is in the map.
struct PosedKeyframe {
  slam::KeyframePtr keyframe;
  types::Se2 T_map_base;
};

class PosedSource final : public SharedMapSource {
 public:
  PosedSource(const slam::MapperParams& params, std::uint16_t robot)
      : params_(params), robot_(robot), heights_(params), builder_(params.grid) {
    publish({});
  }

  void take(const Readings& readings) override {
    for (const types::BaseState& state : readings.states) odometry_.add(state.odometry);
    for (std::size_t i = 0; i < readings.poses.size(); ++i) {
      const auto T_odom_base = odometry_.at(readings.poses[i].stamp);
      if (!T_odom_base) continue;
      T_map_base_ = readings.poses[i].T_map_base;
      tracked_.T_map_odom = types::Transform2<types::Map, types::Odom>(T_map_base_ * T_odom_base->inverse());
      heights_.add(readings.coronal[i], T_map_base_);
      if (due(readings.front[i])) add_keyframe(readings.front[i]);
      publish_when_due(readings.poses[i].stamp);
      tracked_.stamp = readings.poses[i].stamp;
      tracked_.revision = snapshot_->revision;
      tracked_.matched = true;
    }
  }

  [[nodiscard]] const pipeline::MapSnapshot& map() const override { return *snapshot_; }
  [[nodiscard]] const pipeline::TrackedPose& tracked() const override { return tracked_; }

  void join(const TeamNews& news) override {
    for (const slam::KeyframePtr& theirs : news.keyframes) {
      const PosedKeyframe keyframe{theirs, theirs->T_odom_base};
      add(keyframe);
      ways_[theirs->id.robot].push_back(station(keyframe));
    }
  }
  TeamNews take_new() override { return {std::exchange(new_, {}), {}}; }
  [[nodiscard]] const types::Se2& T_map_base() const override { return T_map_base_; }
  [[nodiscard]] const types::Se2* find_pose(const slam::KeyframeId& id) const override {
    const auto at = places_.find(id);
    return at == places_.end() ? nullptr : &poses_[at->second];
  }
  [[nodiscard]] std::optional<types::Se2> T_map_mates(std::uint16_t /*robot*/) const override {
    return types::Se2{};
  }

 private:
  static types::KeyframePose station(const PosedKeyframe& k) {
    return {k.keyframe->stamp, types::Transform2<types::Map, types::Base>(k.T_map_base)};
  }

  /// As slam::Mapper.
  [[nodiscard]] bool due(const types::Scan& scan) const {
    if (own_.empty()) return true;
    if (slam::invalid_share(scan) < invalid_share_ - params_.keyframe.unveiled_share) return true;
    const types::Se2 moved = own_.back().T_map_base.se2().inverse() * T_map_base_;
    return moved.translation().norm() >= params_.keyframe.travel_m ||
           std::abs(moved.theta_rad) >= params_.keyframe.turn_rad;
  }

  void add_keyframe(const types::Scan& scan) {
    auto keyframe = std::make_shared<slam::Keyframe>();
    keyframe->id = {robot_, static_cast<std::uint32_t>(own_.size())};
    keyframe->stamp = scan.first_beam;
    keyframe->T_odom_base = T_map_base_;  // what mates get of its place
    invalid_share_ = slam::invalid_share(scan);
    keyframe->sensor = params_.T_base_laser.translation().cast<float>();
    slam::KeyframeContent content;
    dense_hits(scan, params_.T_base_laser, params_.cloud.range_max_m, content.hits);
    content.columns = heights_.take(T_map_base_);
    keyframe->content = slam::CodedContent(std::move(content));
    const PosedKeyframe posed{keyframe, T_map_base_};
    new_.push_back(std::move(keyframe));
    add(posed);
    own_.push_back(station(posed));
  }

  void add(const PosedKeyframe& keyframe) {
    places_[keyframe.keyframe->id] = keyframes_.size();
    keyframes_.push_back(keyframe.keyframe);
    poses_.push_back(keyframe.T_map_base);
  }

  void publish_when_due(types::Stamp now) {
    if (snapshot_->revision == keyframes_.size()) return;
    if (own_.size() > 1 && now - snapshot_->stamp < kPublishPeriod) return;
    builder_.update(keyframes_, poses_);
    publish(now);
  }

  void publish(types::Stamp stamp) {
    if (snapshot_ != nullptr) changed_cells_ += grid::differing_cells(snapshot_->grid, builder_.grid());
    snapshot_ = std::make_unique<pipeline::MapSnapshot>(
        pipeline::MapSnapshot{keyframes_.size(),
                              changed_cells_,
                              stamp,
                              tracked_.T_map_odom,
                              types::Transform2<types::Map, types::Base>(T_map_base_),
                              builder_.grid(),
                              builder_.walls(),
                              own_,
                              {}});
    for (const auto& [robot, way] : ways_) snapshot_->mates.push_back(way);
  }

  slam::MapperParams params_;
  std::uint16_t robot_;
  Heights heights_;
  pipeline::OdometryBuffer odometry_;
  slam::MapBuilder builder_;
  std::uint64_t changed_cells_ = 0;
  std::vector<slam::KeyframePtr> keyframes_;
  std::vector<types::Se2> poses_;
  std::map<slam::KeyframeId, std::size_t> places_;  ///< in these lists
  std::vector<slam::KeyframePtr> new_;
  std::vector<types::KeyframePose> own_;
  std::map<std::uint16_t, std::vector<types::KeyframePose>> ways_;  ///< of team-mates
  types::Se2 T_map_base_;
  double invalid_share_ = 0.0;  ///< of the beams of the newest keyframe
  pipeline::TrackedPose tracked_;
  std::unique_ptr<pipeline::MapSnapshot> snapshot_;  // after builder_: it must go first
};

}  // namespace

std::unique_ptr<SharedMapSource> make_posed_source(const slam::MapperParams& params, std::uint16_t robot) {
  return std::make_unique<PosedSource>(params, robot);
}

}  // namespace topo::bench
