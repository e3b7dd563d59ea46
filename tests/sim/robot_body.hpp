// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"
#include "core/types/wheel_calibration.hpp"
#include "tests/sim/difficulty.hpp"
#include "tests/sim/random.hpp"
#include "tests/sim/robot_model.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

using SimTime = types::Duration;  ///< since the simulation's start

enum class ContactSide : std::uint8_t { kNone, kFront, kRear, kLeft, kRight };

/// The robot's present contact. Bit i of a bumper mask is segment i + 1; segments are counted clockwise seen
/// from above: front from left to right, rear from right to left.
struct Contact {
  ContactSide side = ContactSide::kNone;
  Vector2 point{0.0, 0.0};  ///< in the base frame
  std::uint8_t bumpers_front = 0;
  std::uint8_t bumpers_rear = 0;
  bool stall_left = false;  ///< the wheel is commanded to turn and cannot
  bool stall_right = false;
  Se2 at;  ///< T_building_base of the last step that was blocked
};

/// True differential-drive motion of one robot. Wheel speeds come from the firmware and are exact at the
/// encoders; the true motion differs (scale and track errors, slip). The wheels of a blocked robot stand. Not
/// thread-safe.
class RobotBody {
 public:
  /// Registers the robot in `world` as a movable, so that others see it; `world` must outlive it.
  RobotBody(World& world, RobotModel model, const Se2& start, const Difficulty& difficulty,
            std::uint64_t seed);
  ~RobotBody();
  RobotBody(const RobotBody&) = delete;
  RobotBody& operator=(const RobotBody&) = delete;

  /// Moves for dt_s (1 to 5 ms) with the given encoder speeds, m/s.
  void step(double dt_s, double left_mps, double right_mps);

  [[nodiscard]] const RobotModel& model() const { return model_; }
  [[nodiscard]] const Se2& truth() const { return pose_; }  ///< T_building_base
  [[nodiscard]] types::Twist2 true_twist() const { return twist_; }
  [[nodiscard]] double encoder_left_m() const { return encoder_left_m_; }
  [[nodiscard]] double encoder_right_m() const { return encoder_right_m_; }
  [[nodiscard]] double encoder_left_mps() const { return encoder_left_mps_; }  ///< 0 while blocked
  [[nodiscard]] double encoder_right_mps() const { return encoder_right_mps_; }
  [[nodiscard]] const Contact& contact() const { return contact_; }
  [[nodiscard]] std::uint64_t collisions() const { return collisions_; }  ///< contacts begun since the start
  /// What the wheels really are, against what the firmware reckons with.
  [[nodiscard]] types::WheelCalibration true_wheels() const {
    return {scale_left_, scale_right_, true_track_m_};
  }
  [[nodiscard]] bool slipping() const { return slip_left_s_ > 0.0; }
  [[nodiscard]] double path_m() const { return path_m_; }  ///< length of the true path
  [[nodiscard]] SimTime now() const { return now_; }
  [[nodiscard]] MovableId movable() const { return movable_; }
  /// True pose at a past time, at most one second ago, interpolated between the steps.
  [[nodiscard]] Se2 pose_at(SimTime time) const;
  /// Moves the robot to another pose, as if carried: the encoders do not change.
  void teleport(const Se2& pose);
  /// Sets the origin of now(), for a robot that joins a running simulation.
  void start_clock(SimTime now);

 private:
  struct Past {
    SimTime time;
    Se2 pose;
  };
  void draw_slip(double dt_s, bool driving);
  bool blocked_at(const Se2& pose);
  void note_contact(const Touch& touch, double left_mps, double right_mps);
  void leave_contact();
  void remember();
  void publish();

  World& world_;
  RobotModel model_;
  Polygon footprint_;
  Difficulty difficulty_;
  Random random_;
  double scale_left_ = 1.0, scale_right_ = 1.0, true_track_m_;
  Se2 pose_;
  types::Twist2 twist_;
  double encoder_left_m_ = 0.0, encoder_right_m_ = 0.0;
  double encoder_left_mps_ = 0.0, encoder_right_mps_ = 0.0;
  double until_slip_s_ = 0.0, slip_left_s_ = 0.0;
  double loss_left_ = 0.0, loss_right_ = 0.0;
  Contact contact_;
  Touch last_touch_;
  std::uint64_t collisions_ = 0;
  double path_m_ = 0.0;
  SimTime now_{0};
  MovableId movable_ = kNoMovable;
  std::deque<Past> past_;
};

}  // namespace topo::sim
