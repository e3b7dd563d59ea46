// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"
#include "tests/fuzz/drive/hostile_line.hpp"
#include "tests/sim/devices/arcos_device.hpp"
#include "tests/sim/devices/scip_device.hpp"

namespace topo::fuzz {

/// A square of half a metre's third, axis-parallel, and since when it stands there.
struct Box {
  static constexpr double kHalf_m = 0.15;
  types::Vector2 centre;
  types::Stamp since{};
};

/// What the devices say against the truth.
struct Lies {
  bool frozen = false;   ///< the scanner repeats its last picture, with new stamps
  bool blind = false;    ///< it reports no return
  bool covered = false;  ///< half of its window is covered
  bool deaf = false;     ///< the base swallows what it is sent, which feeds its watchdog all the same
  /// Which lies the scanner tells; 0: none.
  [[nodiscard]] unsigned of_scanner() const {
    return (frozen ? 1U : 0U) | (blind ? 2U : 0U) | (covered ? 4U : 0U);
  }
};

/// The way of the commands to the base.
struct CommandFaults {
  types::Duration delay{};
  bool lost = false;
};

/// The truth: a P3-DX with a URG-04LX in a corridor with boxes, its devices with their own firmware
/// (tests/sim/devices), and their lines to the host. Pure: the same acts give the same bytes.
class World {
 public:
  static constexpr double kHalfWidth_m = 1.5;  ///< of the corridor, along x

  explicit World(types::Stamp begin);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void advance(types::Stamp until);
  void to_base(std::string_view bytes);
  void to_scanner(std::string_view bytes);
  /// The nearest that is fair: so far ahead that the robot at its present speed stands before it though its
  /// host falls silent, plus `more_m`.
  void add_box(double more_m);
  void reset_base() { base_.controller_reset(sim_now()); }
  void restart_scanner() { scanner_.power_cycle(sim_now()); }

  Lies lies;
  CommandFaults command_faults;
  HostileLine base_line, scan_line;

  [[nodiscard]] types::Stamp now() const { return now_; }
  [[nodiscard]] const types::Se2& pose() const { return pose_; }
  [[nodiscard]] double v_mps() const { return v_mps_; }
  [[nodiscard]] bool motors_on() const { return base_.motors_on(); }
  /// The hull at a pose touches something that stands there since `since` or longer.
  [[nodiscard]] bool touches(const types::Se2& pose, types::Stamp since) const;
  /// Times that the robot drove forwards into something.
  [[nodiscard]] int collisions() const { return collisions_; }
  /// When the base last swallowed something; zero: never.
  [[nodiscard]] types::Stamp swallowed() const { return swallowed_; }
  /// Bytes of the host that were sent to the base so far.
  [[nodiscard]] std::uint64_t base_bytes() const { return base_bytes_; }

 private:
  struct Late {
    types::Stamp due;
    std::string bytes;
  };
  [[nodiscard]] sim::SimTime sim_now() const { return now_.time_since_epoch(); }
  void step();
  void drive(double dt_s);
  void deliver_commands();
  void look();
  [[nodiscard]] double ray_m(const types::Vector2& from, double heading_rad) const;
  void picture(sim::scip::Turn& turn);
  void pump();

  types::Stamp now_;
  sim::ArcosDevice base_;
  sim::ScipDevice scanner_;
  sim::BaseInputs inputs_;
  types::Se2 pose_;
  double v_mps_ = 0.0;
  std::vector<Box> boxes_;
  std::deque<Late> commands_;
  sim::scip::Turn turn_;
  types::Stamp next_turn_, swallowed_{};
  std::uint32_t pictures_ = 0;
  std::uint64_t base_bytes_ = 0;
  int collisions_ = 0;
};

}  // namespace topo::fuzz
