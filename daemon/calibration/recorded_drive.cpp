// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/calibration/recorded_drive.hpp"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "daemon/app/connection_configs.hpp"
#include "daemon/recording/replay.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

constexpr types::Duration kStep = std::chrono::milliseconds(100);  ///< of recorded time
constexpr types::Duration kGate = std::chrono::milliseconds(200);

bool has_speed(const std::string& address) {
  return !address.starts_with("tcp:") && !address.starts_with("can:");
}

struct BaseDrive {
  std::vector<types::Odometry> odometry;
  double model_track_m = 0.0;
};

Result<BaseDrive> play_base(const std::shared_ptr<Replay>& replay, const Configuration& configuration) {
  auto connector = Replay::connector(replay, "base", has_speed(configuration.base.address));
  if (!connector) return tl::unexpected(connector.error());
  pioneer::ConnectionConfig config = base_connection_config(configuration);
  config.wheels = {};
  config.status_delay = {};
  config.gyro = false;
  pioneer::Connection connection(config, std::move(*connector));
  BaseDrive out;
  types::BaseState state;
  std::string said;
  while (!replay->finished()) {
    const auto outcome = connection.step(state, kStep);
    if (outcome == pioneer::StepOutcome::kState) out.odometry.push_back(state.odometry);
    if (outcome == pioneer::StepOutcome::kChanged && out.odometry.empty()) said = connection.message();
    if (connection.info()) out.model_track_m = connection.info()->track_m;
  }
  if (out.odometry.empty())
    return fail(Errc::kProtocol,
                fmt::format("no status packet in the recording; the connection says: {}", said));
  return out;
}

Status play_scanner(const std::shared_ptr<Replay>& replay, const char* channel, const std::string& address,
                    const hokuyo::ConnectionConfig& config,
                    const std::function<void(const types::Scan&)>& take) {
  auto connector = Replay::connector(replay, channel, has_speed(address));
  if (!connector) return tl::unexpected(connector.error());
  hokuyo::Connection connection(config, std::move(*connector));
  const auto scan = std::make_unique<types::Scan>();
  std::string said;
  std::size_t scans = 0;
  while (!replay->finished()) {
    const auto outcome = connection.step(*scan, kStep);
    if (outcome == hokuyo::StepOutcome::kScan) {
      take(*scan);
      ++scans;
    }
    if (outcome == hokuyo::StepOutcome::kChanged && scans == 0) said = connection.message();
  }
  if (scans > 0) return {};
  return fail(
      Errc::kProtocol,
      fmt::format("no scan of the {} scanner in the recording; the connection says: {}", channel, said));
}

/// One device alone: each channel has a clock of its own.
Result<std::shared_ptr<Replay>> open(const std::string& file) {
  ReplayOptions options;
  options.at_once = true;
  // Nobody drives here, so that fewer bytes are written than were: a longer wait for them than the base may
  // be silent would end its connection.
  options.gate_timeout = kGate;
  return Replay::open(file, options);
}

}  // namespace

Result<calibration::DriveLog> recorded_drive(const std::string& file, const Configuration& configuration,
                                             double scan_period_s) {
  auto base_replay = open(file);
  if (!base_replay) return tl::unexpected(base_replay.error());
  auto base = play_base(*base_replay, configuration);
  if (!base) return tl::unexpected(base.error());
  calibration::DriveLog log(base->model_track_m, scan_period_s);
  for (const types::Odometry& odometry : base->odometry) log.add(odometry);
  auto front_replay = open(file);
  if (!front_replay) return tl::unexpected(front_replay.error());
  auto front = play_scanner(*front_replay, "front", configuration.front.address,
                            front_connection_config(configuration.front),
                            [&log](const types::Scan& scan) { log.add_front(scan); });
  if (!front) return tl::unexpected(front.error());
  if (!configuration.coronal.present) return log;
  auto coronal_replay = open(file);
  if (!coronal_replay) return tl::unexpected(coronal_replay.error());
  auto coronal = play_scanner(*coronal_replay, "coronal", configuration.coronal.address,
                              coronal_connection_config(configuration.coronal),
                              [&log](const types::Scan& scan) { log.add_coronal(scan); });
  if (!coronal) return tl::unexpected(coronal.error());
  return log;
}

calibration::Assumed assumed(const Configuration& configuration, double model_track_m) {
  const slam::MapperParams mapper = mapper_params(configuration);
  calibration::Assumed out;
  out.numbers.wheels = configuration.base.wheels;
  if (!(out.numbers.wheels.track_m > 0.0)) out.numbers.wheels.track_m = model_track_m;
  out.numbers.T_base_laser = mapper.T_base_laser;
  out.numbers.delay_s = configuration.base.status_delay_s;
  out.front_z_m = configuration.front.z_m;
  out.coronal = mapper.coronal;
  return out;
}

}  // namespace topo::daemon
