// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <span>

#include "daemon/app/app.hpp"
#include "daemon/app/command_line.hpp"
#include "daemon/app/device_connectors.hpp"
#include "daemon/app/logging.hpp"
#include "daemon/config/load.hpp"
#include "daemon/config/replayed.hpp"
#include "daemon/recording/format.hpp"
#include "daemon/recording/summary.hpp"
#include "drivers/io/run_program.hpp"

namespace topo::daemon {
namespace {

// Exit statuses, as in topometricd(8).
constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsersFault = 2;

// The devices are closed first, within their closing times. When one hangs, or the other threads take long,
// SIGALRM ends the process; the robot's own watchdog has stopped the wheels by then.
constexpr unsigned kStopLimit_s = 6;

struct Arguments {
  std::string config, check, record, replay, sessions, summary;
  bool print = false;
};

int complain(const types::Error& error) {
  fmt::print(stderr, "topometricd: {}\n", error.message);
  const bool user = error.code == types::Errc::kInvalidInput || error.code == types::Errc::kNotFound;
  return user ? kUsersFault : kFailed;
}

/// Reads a configuration; when it has faults, prints them and returns the exit status.
int load(const std::string& file, LoadedConfiguration& loaded) {
  auto read = load_configuration(file);
  if (!read) {
    fmt::print(stderr, "topometricd: {}\n", read.error().message);
    return kUsersFault;
  }
  loaded = std::move(*read);
  if (loaded.faults.empty()) return kOk;
  fmt::print(stderr, "{}", faults_text(loaded));
  return kUsersFault;
}

/// The recording's file: from the command line, or a new one in the configured folder. Empty: no recording.
std::string recording_path(const LoadedConfiguration& loaded, const Arguments& arguments) {
  if (!arguments.record.empty() || !arguments.replay.empty()) return arguments.record;
  const std::string& folder = loaded.values.record.folder;
  if (folder.empty()) return {};
  return fmt::format("{}/{}-{:%Y%m%dT%H%M%S}Z.rec", folder, loaded.values.robot.name,
                     fmt::gmtime(std::time(nullptr)));
}

types::Result<std::unique_ptr<Recorder>> start_recorder(const std::string& file,
                                                        const LoadedConfiguration& loaded) {
  if (file.empty()) return std::unique_ptr<Recorder>();
  RecorderOptions options;
  options.path = file;
  options.channels = {"base", "front", "coronal"};
  const std::string configuration = effective_text(loaded);
  options.config_hash = checksum(std::as_bytes(std::span(configuration)));
  options.quota_bytes = static_cast<std::uint64_t>(loaded.values.record.quota_mb) * 1'000'000U;
  options.on_warning = [](const std::string& warning) { spdlog::warn("recording: {}", warning); };
  return Recorder::start(std::move(options));
}

/// A truncated or damaged recording plays up to the damage.
void tell_damage(const RecordingReader& recording) {
  if (recording.damage()) spdlog::warn("replay: {}; plays up to there", recording.damage()->message);
  if (recording.missing_frames() > 0)
    spdlog::warn("replay: {}: {} frames are missing, its disk did not take them", recording.path(),
                 recording.missing_frames());
}

std::function<bool()> is_at_end(const std::shared_ptr<Replay>& replay) {
  if (replay == nullptr) return {};
  return [replay] {
    if (replay->finished()) spdlog::info("replay: {}: at its end, stopping", replay->recording().path());
    return replay->finished();
  };
}

/// Prints the contents of a recording.
int summarise_recording(const std::string& file) {
  const auto reader = RecordingReader::open(file);
  if (!reader) return complain(reader.error());
  fmt::print("{}", format_summary(summarise(*reader)));
  return kOk;
}

types::Status end(Recorder& recorder) {
  auto stopped = recorder.stop();
  const RecorderStats stats = recorder.stats();
  spdlog::info("recorded {} bytes of the devices; {} found no room, {} frames were not taken by the disk",
               stats.recorded_bytes, stats.lost_bytes, stats.lost_frames);
  return stopped;
}

int run(const LoadedConfiguration& loaded, const Arguments& arguments) {
  std::shared_ptr<Replay> replay;
  if (!arguments.replay.empty()) {
    auto opened = Replay::open(arguments.replay);
    if (!opened) return complain(opened.error());
    replay = std::move(*opened);
    tell_damage(replay->recording());
  }
  // Opened before a recording is started: another daemon of this robot may be writing it.
  auto socket = io::ListeningSocket::open(loaded.values.control.socket);
  if (!socket) return complain(socket.error());
  auto recorder = start_recorder(recording_path(loaded, arguments), loaded);
  if (!recorder) return complain(recorder.error());
  AppOptions options{loaded.values,
                     effective_text(loaded),
                     std::move(*socket),
                     replay != nullptr ? replay_connectors(replay) : device_connectors(recorder->get()),
                     [] { ::alarm(kStopLimit_s); },
                     is_at_end(replay)};
  auto app = App::make(std::move(options));
  if (!app) return complain(app.error());
  const auto ran = (*app)->run();
  app->reset();
  int status = ran ? kOk : complain(ran.error());
  if (*recorder != nullptr) {
    if (auto ended = end(**recorder); !ended) status = complain(ended.error());
  }
  if (replay != nullptr && replay->gates_released() > 0) {
    spdlog::warn("replay: {} connections went on without the bytes that the recorded daemon had written",
                 replay->gates_released());
  }
  return status;
}

int serve(const LoadedConfiguration& loaded, const Arguments& arguments) {
  block_signals();
  if (auto logging = start_logging(loaded.values.log); !logging) return complain(logging.error());
  const int status = run(loaded, arguments);
  end_logging();
  return status;
}

int start(int argc, char** argv) {
  CLI::App cli(
      "Topometric's daemon: drives a Pioneer with Hokuyo scanners and maps what it sees.\n"
      "Exit status: 0 stopped in order, 1 failed, 2 wrong configuration or command line.");
  Arguments arguments;
  auto* config =
      cli.add_option("--config", arguments.config, "configuration file (see /usr/share/doc/topometric)");
  auto* check = cli.add_option("--check-config", arguments.check,
                               "check a configuration file, print all its faults and exit")
                    ->excludes(config);
  auto* print =
      cli.add_flag("--print-config", arguments.print, "print every effective value with its origin and exit");
  auto* record =
      cli.add_option("--record", arguments.record, "record every byte from and to the devices into FILE");
  auto* replay = cli.add_option("--replay", arguments.replay,
                                "play a recording in place of the devices, and end with it")
                     ->excludes(record);
  cli.add_option("--sessions", arguments.sessions,
                 "folder for the sessions of a replay, which leaves the robot's own alone")
      ->needs(replay);
  for (auto* used : {record, replay}) check->excludes(used);
  auto* summary =
      cli.add_option("--summary", arguments.summary, "say what a recording holds and what it lost, and exit");
  for (auto* used : {config, check, print, record, replay}) summary->excludes(used);
  if (const auto ended = parse_command_line(cli, "topometricd", argc, argv)) return *ended;
  if (!arguments.summary.empty()) return summarise_recording(arguments.summary);
  LoadedConfiguration loaded;
  if (!arguments.check.empty()) {
    const int status = load(arguments.check, loaded);
    if (status == kOk && arguments.print) fmt::print("{}", effective_text(loaded));
    if (status == kOk && !arguments.print) fmt::print("{}: no faults\n", arguments.check);
    return status;
  }
  if (arguments.config.empty()) {
    fmt::print(stderr, "topometricd: --config FILE is missing (--help tells more)\n");
    return kUsersFault;
  }
  if (const int status = load(arguments.config, loaded); status != kOk) return status;
  if (!arguments.replay.empty()) loaded = replayed(std::move(loaded), arguments.sessions);
  if (arguments.print) {
    fmt::print("{}", effective_text(loaded));
    return kOk;
  }
  return serve(loaded, arguments);
}

}  // namespace
}  // namespace topo::daemon

int main(int argc, char** argv) {
  return topo::io::run_program("topometricd", topo::daemon::start, argc, argv);
}
