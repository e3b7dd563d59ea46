// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/calibrated_robot.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "daemon/calibration/calibrated_values.hpp"
#include "daemon/calibration/recorded_drive.hpp"
#include "daemon/config/load.hpp"
#include "daemon/setup/configuration_text.hpp"
#include "daemon/setup/dialogue.hpp"
#include "tests/bench/topobench/calibrate/hand_drive.hpp"
#include "tests/bench/topobench/calibrate/standing.hpp"

namespace topo::bench {
namespace {

using Pictures = std::vector<calibration::StillPicture>;
using daemon::Ask;

constexpr const char* kFile = "robot.toml";
constexpr const char* kLevelNumber = "H0000001";
constexpr const char* kUprightNumber = "H0000002";

daemon::Found devices(bool swapped) {
  daemon::FoundScanner level{"serial:/dev/ttyACM0", "UTM-30LX", kLevelNumber};
  daemon::FoundScanner upright{"serial:/dev/ttyACM1", "UTM-30LX", kUprightNumber};
  if (swapped) {
    std::swap(level.address, upright.address);
    std::swap(level, upright);
  }
  return {{level, upright}, {{"serial:/dev/ttyUSB0", "robot", "p3dx-sh", "1", "p3dx", 2000}}, {}};
}

std::string place_text(double x_m, double y_m, double z_m) { return fmt::format("{} {} {}", x_m, y_m, z_m); }

/// To what a tape measure answers; Enter to the rest.
std::string answer_to(Ask ask) {
  const TapeMeasured tape;
  if (ask == Ask::kFront) return place_text(tape.T_base_laser.x_m, tape.T_base_laser.y_m, kLevelHeight_m);
  if (ask == Ask::kCoronal) return place_text(tape.coronal.x_m, tape.coronal.y_m, tape.coronal.z_m);
  return {};
}

/// A person who is asked to stand 1 m before the robot or to its left stands about there.
std::vector<sim::Vector2> people_at(Ask ask) {
  if (ask == Ask::kAhead) return {{1.25, 0.05}};
  if (ask == Ask::kLeft) return {{0.1, 1.1}};
  return {};
}

Standing standing_of(const TrueRobot& truth, std::uint64_t seed) {
  Standing out;
  out.level = {truth.T_base_laser.x_m,       truth.T_base_laser.y_m, kLevelHeight_m,
               truth.T_base_laser.theta_rad, sim::ScanPlane::kLevel, 0.0};
  const walls::CoronalMount& up = truth.coronal;
  out.upright = {up.x_m, up.y_m, up.z_m, 0.0, sim::ScanPlane::kCoronal, up.roll_rad};
  out.seed = seed;
  return out;
}

/// The text of the configuration that the drive led to, read again.
types::Result<daemon::Configuration> written(const daemon::Configuration& before,
                                             const std::vector<daemon::CalibratedValue>& values) {
  const std::string text =
      daemon::configuration_text(daemon::first_configuration(before.robot.model), before);
  auto loaded = daemon::parse_configuration(daemon::edited(text, daemon::edits_of(values)), kFile);
  if (!loaded.faults.empty()) return types::fail(types::Errc::kInvalidInput, daemon::faults_text(loaded));
  return std::move(loaded.values);
}

}  // namespace

types::Result<SetUp> set_up(const TrueRobot& truth, bool swapped, std::uint64_t seed) {
  const Standing standing = standing_of(truth, seed);
  daemon::SetupState state = daemon::begin_setup(devices(swapped), kFile, std::nullopt);
  while (!state.end) {
    Pictures pictures;
    if (daemon::question(state).looks) {
      pictures = standing.both(people_at(state.ask));
      if (swapped) std::swap(pictures[0], pictures[1]);
    }
    const Ask ask = state.ask;
    state = daemon::answered(std::move(state), answer_to(ask), pictures);
  }
  if (state.end != daemon::SetupEnd::kAgreed)
    return types::fail(types::Errc::kInvalidInput, "setup: " + state.remark);
  return SetUp{state.values, state.answers, state.values.front.serial_number == kLevelNumber};
}

types::Result<CalibratedRobot> calibrated_robot(std::uint64_t seed) {
  CalibratedRobot out;
  auto made = set_up(out.truth, seed % 2 == 1, seed);
  if (!made) return tl::unexpected(made.error());
  out.set_up = std::move(*made);
  auto driven = drive_by_hand({}, out.truth, seed);
  if (!driven) return tl::unexpected(driven.error());
  out.true_wheels = driven->true_wheels;
  const calibration::Assumed before = daemon::assumed(out.set_up.configuration, driven->log.model_track_m());
  calibration::CalibrationParams params;
  params.mapper = daemon::mapper_params(out.set_up.configuration);
  out.found = calibration::calibrate(driven->log, before, params);
  if (!out.found.believable())
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("seed {}: the calibration is not believable", seed));
  auto configuration = written(out.set_up.configuration, daemon::calibrated_values(out.found, before));
  if (!configuration) return tl::unexpected(configuration.error());
  out.configuration = std::move(*configuration);
  return out;
}

daemon::Configuration right_configuration(const CalibratedRobot& robot) {
  daemon::Configuration right = robot.set_up.configuration;
  const TrueRobot& truth = robot.truth;
  right.base.wheels = robot.true_wheels;
  right.base.status_delay_s = truth.delay_s;
  right.front.x_m = truth.T_base_laser.x_m;
  right.front.y_m = truth.T_base_laser.y_m;
  right.front.yaw_rad = truth.T_base_laser.theta_rad;
  right.coronal.x_m = truth.coronal.x_m;
  right.coronal.y_m = truth.coronal.y_m;
  right.coronal.z_m = truth.coronal.z_m;
  right.coronal.roll_rad = truth.coronal.roll_rad;
  return right;
}

}  // namespace topo::bench
