// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/bench/topobench/explore/plant.hpp"
#include "tests/bench/topobench/explore/virtual_base.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo::bench {
namespace {

constexpr sim::SimTime kScanPeriod = std::chrono::milliseconds(200);
constexpr std::uint16_t kBeams = 270;
constexpr double kRangeMax_m = 30.0;
constexpr double kRangeMin_m = 0.023;

/// Error of a pose that a good mapper makes: slow, bounded, another one for every seed.
class PoseNoise {
 public:
  explicit PoseNoise(std::uint64_t seed) {
    sim::Random random(seed);
    for (Wave& wave : waves_) {
      wave.rate_radps = 2.0 * std::numbers::pi / random.uniform(15.0, 60.0);
      wave.phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
  [[nodiscard]] sim::Se2 at(double t_s) const {
    constexpr double kOffset_m = 0.02 / std::numbers::sqrt2, kTurn_rad = 0.3 * types::kDegree_rad;
    return {kOffset_m * waves_[0].at(t_s), kOffset_m * waves_[1].at(t_s), kTurn_rad * waves_[2].at(t_s)};
  }

 private:
  struct Wave {
    double rate_radps = 0.0, phase_rad = 0.0;
    [[nodiscard]] double at(double t_s) const { return std::sin(rate_radps * t_s + phase_rad); }
  };
  std::array<Wave, 3> waves_;
};

class SparsePlant final : public Plant {
 public:
  SparsePlant(std::shared_ptr<sim::World> world, const PlantSetup& setup)
      : setup_(setup),
        world_(std::move(world)),
        body_(*world_, sim::RobotModel::p3dx(), setup.start, setup.difficulty,
              sim::derive_seed(setup.seed, 1)),
        base_(setup.limits, setup.firmware_watchdog),
        feed_(feed_setup(setup)),
        noise_(sim::derive_seed(setup.seed, 3)),
        sonar_random_(sim::derive_seed(setup.seed, 2)),
        glass_random_(sim::derive_seed(setup.seed, 4)) {}

  void tick(Readings& out) override {
    const sim::WheelSpeeds speeds = base_.wheel_speeds(now_, kTick, body_);
    body_.step(types::to_seconds(kTick), speeds.left_mps, speeds.right_mps);
    now_ += kTick;
    if (now_ % sim::kSonarCycle == sim::SimTime{0}) listen();
    feed_.sample(body_);
    while (const auto odometry = feed_.next_odometry())
      out.states.push_back(base_.status(*odometry, odometry->stamp, body_));
    if (now_ % kScanPeriod == sim::SimTime{0}) look(out);
  }

  void command(const types::BaseCommand& command) override { base_.command(command, now_); }
  [[nodiscard]] sim::SimTime now() const override { return now_; }
  [[nodiscard]] const sim::World& world() const override { return *world_; }
  [[nodiscard]] sim::RobotBody& body() override { return body_; }

 private:
  static sim::RobotSetup feed_setup(const PlantSetup& setup) {
    sim::RobotSetup robot;
    robot.start = setup.start;
    return robot;  // no lasers: the feed makes the dead reckoning alone
  }

  void listen() {
    for (const int index : {sonar_turn_, sonar_turn_ + 8}) {
      base_.on_sonar(measure_sonar(*world_, body_.model(), body_.truth(), index, now_, setup_.difficulty,
                                   sonar_random_, body_.movable()));
    }
    sonar_turn_ = (sonar_turn_ + 1) % 8;
  }

  void look(Readings& out) {
    const walls::CoronalMount& coronal = setup_.mapping.coronal;
    const types::Se2& front = setup_.mapping.T_base_laser;
    scan(body_.truth() * front, kFrontHeight_m, false, out.front.emplace_back());
    scan(body_.truth() * types::Se2{coronal.x_m, coronal.y_m, 0.0}, coronal.z_m, true,
         out.coronal.emplace_back());
    const sim::Se2& origin = setup_.T_building_map ? *setup_.T_building_map : setup_.start;
    const types::Se2 T_map_base = origin.inverse() * body_.truth();
    out.poses.push_back({types::Stamp{now_}, T_map_base * noise_.at(types::to_seconds(now_))});
  }

  void scan(const sim::Se2& at, double z_m, bool coronal, types::Scan& out) {
    out.first_beam = out.arrival = types::Stamp{now_};
    out.sequence = static_cast<std::uint64_t>(now_ / kScanPeriod);
    // A period just below a fifth of a second: control calls longer ones a fault.
    out.geometry = {static_cast<float>(-0.5 * (kBeams - 1) * types::kDegree_rad),
                    static_cast<float>(types::kDegree_rad),
                    0.0F,
                    0.199F,
                    static_cast<float>(kRangeMin_m),
                    static_cast<float>(kRangeMax_m)};
    out.beams = kBeams;
    sim::RayOptions options;
    options.range_max_m = kRangeMax_m;
    options.exclude = body_.movable();
    for (std::uint16_t i = 0; i < kBeams; ++i) {
      const double angle = static_cast<double>(out.angle_rad(i)), yaw = at.theta_rad;
      sim::Ray ray{at.x_m, at.y_m, z_m, std::cos(yaw + angle), std::sin(yaw + angle), 0.0};
      if (coronal) {
        const double left = std::sin(angle);
        ray = {at.x_m, at.y_m, z_m, -std::sin(yaw) * left, std::cos(yaw) * left, std::cos(angle)};
      }
      // One beam stands for four of the full scan's: it sees glass when one of the four would.
      options.glass_draw = std::sqrt(std::sqrt(glass_random_.uniform()));
      const double range = world_->cast(ray, options).range_m;
      out.range_m[i] = range < kRangeMin_m ? types::kTooNear : static_cast<float>(range);
    }
  }

  PlantSetup setup_;
  std::shared_ptr<sim::World> world_;
  sim::RobotBody body_;
  VirtualBase base_;
  sim::ValueFeed feed_;
  PoseNoise noise_;
  sim::Random sonar_random_, glass_random_;
  int sonar_turn_ = 0;
  sim::SimTime now_{0};
};

}  // namespace

types::Result<std::unique_ptr<Plant>> make_sparse_plant(std::shared_ptr<sim::World> world,
                                                        const PlantSetup& setup) {
  const sim::RobotModel model = sim::RobotModel::p3dx();
  if (world->structure().at(setup.start.translation()) == 0 ||
      world->touch(model.footprint(), setup.start, model.clearance_m, model.height_m).touching) {
    return types::fail(
        types::Errc::kInvalidInput,
        "world '" + world->name() + "': the robot would stand in something; expected a free start");
  }
  return std::unique_ptr<Plant>(std::make_unique<SparsePlant>(std::move(world), setup));
}

}  // namespace topo::bench
