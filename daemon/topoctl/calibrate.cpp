// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <span>

#include "core/calibration/figure.hpp"
#include "daemon/calibration/calibration_text.hpp"
#include "daemon/calibration/configuration_file.hpp"
#include "daemon/calibration/recorded_drive.hpp"
#include "daemon/config/edit.hpp"
#include "daemon/config/load.hpp"
#include "daemon/topoctl/commands.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kFigurePeriod =
    std::chrono::milliseconds(100);  ///< the daemon's dead-man time is 300 ms
/// Between the end of the drive and reading the recording: the recorder writes what it has every second.
constexpr types::Duration kWritten = std::chrono::seconds(3);

types::Status tell_figure(Client& client, const types::Twist2& twist) {
  const Json params{{"v_mps", twist.v_mps}, {"omega_radps", twist.omega_radps}};
  if (auto told = client.call("drive", params, kPatience); !told) return tl::unexpected(told.error());
  return {};
}

types::Status drive_figure(const Arguments& a) {
  auto client = Client::connect(a.socket);
  if (!client) return tl::unexpected(client.error());
  fmt::print("driving eights for three minutes in a circle of three metres; control-C stops\n");
  std::fflush(stdout);
  catch_signals();
  const types::Stamp start = io::monotonic_now();
  for (types::Stamp now = start; !interrupted(); now = io::monotonic_now()) {
    const auto twist = calibration::figure_twist(types::to_seconds(now - start));
    if (auto told = tell_figure(*client, twist.value_or(types::Twist2{})); !told) return told;
    if (!twist) break;
    pause_until(now + kFigurePeriod);
  }
  if (interrupted()) {
    if (auto stopped = tell_figure(*client, {}); !stopped) return stopped;
    return types::fail(types::Errc::kInvalidInput, "stopped before its end");
  }
  pause_until(io::monotonic_now() + kWritten);
  return {};
}

int write(const std::string& file, std::span<const CalibratedValue> values) {
  const auto text = read_text(file);
  if (!text) return complain(text.error());
  const auto kept = replace_configuration(file, edited(*text, edits_of(values)));
  if (!kept) return complain(kept.error());
  fmt::print("written to {}; as it was before: {}\n", file, *kept);
  return kOk;
}

/// No daemon is involved: a file that is not there is a failure.
int refuse_file(const types::Error& error) {
  const int status = complain(error);
  return status == kNoDaemon ? kFailed : status;
}

}  // namespace

int calibrate_robot(const Arguments& a) {
  const auto loaded = load_configuration(a.calibration.config);
  if (!loaded) return refuse_file(loaded.error());
  if (!loaded->faults.empty()) {
    fmt::print(stderr, "{}", faults_text(*loaded));
    return kFailed;
  }
  if (a.calibration.drive)
    if (const auto driven = drive_figure(a); !driven) return complain(driven.error());
  calibration::CalibrationParams params;
  params.mapper = mapper_params(loaded->values);
  const auto drive = recorded_drive(a.calibration.recording, loaded->values, params.scan_period_s);
  if (!drive) return refuse_file(drive.error());
  const calibration::Assumed before = assumed(loaded->values, drive->model_track_m());
  const calibration::Calibration found = calibration::calibrate(*drive, before, params);
  const std::vector<CalibratedValue> values = calibrated_values(found, before);
  if (a.json)
    fmt::print("{}\n", pretty(calibration_json(found, values)));
  else
    fmt::print("{}", calibration_text(found, values));
  if (!found.believable()) return kFailed;
  return a.calibration.write ? write(a.calibration.config, values) : kOk;
}

}  // namespace topo::daemon
