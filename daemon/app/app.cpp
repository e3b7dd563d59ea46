// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/app.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/epoll.h>
#include <systemd/sd-daemon.h>

#include <cmath>
#include <cstring>

#include "daemon/app/logging.hpp"
#include "daemon/app/version.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

constexpr std::uint64_t kTickUsec = 100'000;

Status from_sd(int result, const char* what) {
  if (result >= 0) return {};
  return fail(Errc::kIo, fmt::format("{}: {}", what, std::strerror(-result)), -result);
}

}  // namespace

void block_signals() {
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGTERM);
  ::sigaddset(&set, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

Result<std::unique_ptr<App>> App::make(AppOptions options) {
  std::unique_ptr<App> app(new App(std::move(options)));
  if (auto prepared = app->prepare(); !prepared) return tl::unexpected(prepared.error());
  return app;
}

App::~App() = default;

Status App::prepare() {
  sd_event* event = nullptr;
  if (auto s = from_sd(sd_event_new(&event), "event loop"); !s) return s;
  event_.reset(event);
  hand_overs_ = std::make_unique<HandOvers>();
  auto workers = Workers::make(options_.configuration, *hand_overs_, options_.connectors);
  if (!workers) return tl::unexpected(workers.error());
  workers_ = std::move(*workers);
  events_ = std::make_unique<EventLog>(spdlog::default_logger());
  monitor_ = std::make_unique<Monitor>(options_.configuration, *hand_overs_, *workers_);
  saver_ = std::make_unique<MapSaver>(*hand_overs_);
  if (auto s = serve_control(); !s) return s;
  return add_events();
}

Status App::serve_control() {
  const auto group = find_group(options_.configuration.control.group);
  if (!group) {
    spdlog::warn("control.group: there is no group {} here; only root and the daemon's own user may command",
                 options_.configuration.control.group);
  }
  methods_ = std::make_unique<Methods>(
      *this, [this](const Call& call, const Answer& answer) { control_->answer(call, answer); });
  control_ = std::make_unique<ControlServer>(event_.get(), std::move(options_.socket), group,
                                             [this](const Call& call) { return methods_->answer(call); });
  return control_->start();
}

Status App::add_events() {
  sd_event* event = event_.get();
  sd_event_source* source = nullptr;
  const auto stop = [](sd_event_source* s, const signalfd_siginfo* info, void*) {
    spdlog::info("{} received: stopping", ::strsignal(static_cast<int>(info->ssi_signo)));
    return sd_event_exit(sd_event_source_get_event(s), 0);
  };
  if (auto s = from_sd(sd_event_add_signal(event, &source, SIGTERM, stop, nullptr), "SIGTERM"); !s) return s;
  sigterm_.reset(source);
  if (auto s = from_sd(sd_event_add_signal(event, &source, SIGINT, stop, nullptr), "SIGINT"); !s) return s;
  sigint_.reset(source);
  const auto requested = [](sd_event_source* s, int, std::uint32_t, void*) {
    return sd_event_exit(sd_event_source_get_event(s), 0);
  };
  if (auto s =
          from_sd(sd_event_add_io(event, &source, stop_requested_.fd(), EPOLLIN, requested, nullptr), "stop");
      !s) {
    return s;
  }
  stop_source_.reset(source);
  const auto saved = [](sd_event_source*, int, std::uint32_t, void* app) {
    static_cast<App*>(app)->saver_->collect();
    return 0;
  };
  if (auto s = from_sd(sd_event_add_io(event, &source, saver_->fd(), EPOLLIN, saved, this), "saver"); !s)
    return s;
  saved_.reset(source);
  const int added =
      sd_event_add_time_relative(event, &source, CLOCK_MONOTONIC, kTickUsec, 0, &App::on_tick, this);
  if (auto s = from_sd(added, "timer"); !s) return s;
  tick_.reset(source);
  return {};
}

int App::on_tick(sd_event_source* source, std::uint64_t, void* app) {
  static_cast<App*>(app)->tick();
  sd_event_source_set_time_relative(source, kTickUsec);
  return sd_event_source_set_enabled(source, SD_EVENT_ONESHOT);
}

void App::tick() {
  for (const std::string& refusal : workers_->take_refusals()) spdlog::warn("{}", refusal);
  for (Vitals* vitals : workers_->all()) events_->drain(vitals->name, vitals->events);
  monitor_->update(io::monotonic_now());
  // A dead worker must not be covered up by a main loop that runs: then the service manager starts us again.
  const std::string state =
      fmt::format("STATUS={}{}", monitor_->summary(), monitor_->alive() ? "\nWATCHDOG=1" : "");
  sd_notify(0, state.c_str());
}

Status App::enter_real_time() {
  const RealtimeConfig& config = options_.configuration.realtime;
  if (config.policy == RealtimePolicy::kOff) return {};
  const bool enforce = config.policy == RealtimePolicy::kEnforce;
  if (config.lock_memory) {
    if (auto locked = lock_memory(); !locked) {
      if (enforce) return locked;
      spdlog::warn("{}; going on without", locked.error().message);
    }
  }
  if (!enforce) return {};
  return try_fifo(std::max(config.base_priority, config.scan_priority));
}

Status App::run() {
  if (auto s = enter_real_time(); !s) return s;
  if (auto s = saver_->start(); !s) return s;
  if (auto s = workers_->start(); !s) {
    saver_.reset();
    workers_->stop();
    return s;
  }
  spdlog::info("topometricd {} serves {} on {}", kVersion, options_.configuration.robot.name,
               options_.configuration.control.socket);
  sd_notify(0, "READY=1");
  const int looped = sd_event_loop(event_.get());
  sd_notify(0, "STOPPING=1");
  if (options_.on_stopping) options_.on_stopping();
  // The map's readers go before the mapping thread, which ends the map.
  saved_.reset();
  saver_.reset();
  workers_->stop();
  spdlog::info("stopped");
  return from_sd(looped, "event loop");
}

void App::estop() {
  hand_overs_->estop.store(true, std::memory_order_release);
  spdlog::warn("e-stop");
}

Status App::clear_estop() {
  stop();  // what was wanted before the e-stop is not wanted any more
  hand_overs_->estop.store(false, std::memory_order_release);
  hand_overs_->estop_clears.fetch_add(1, std::memory_order_acq_rel);
  spdlog::info("e-stop cleared");
  return {};
}

Status App::drive(const types::Twist2& twist) {
  const BaseConfig& base = options_.configuration.base;
  if (std::abs(twist.v_mps) > base.v_max_mps) {
    return fail(Errc::kInvalidInput,
                fmt::format("v_mps: found {}, expected at most {} either way", twist.v_mps, base.v_max_mps));
  }
  if (std::abs(twist.omega_radps) > base.omega_max_radps) {
    return fail(Errc::kInvalidInput, fmt::format("omega_radps: found {}, expected at most {} either way",
                                                 twist.omega_radps, base.omega_max_radps));
  }
  // The base's report comes a moment later than a clear; the gate has the last word either way.
  if (hand_overs_->estop.load(std::memory_order_acquire)) {
    return fail(Errc::kBusy, "the e-stop is latched; clear it first (topoctl clear-estop)");
  }
  hand_overs_->drive.store({io::monotonic_now(), twist});
  return {};
}

void App::stop() { hand_overs_->drive.store({io::monotonic_now() - std::chrono::hours(1), {}}); }

void App::save_map(const std::string& folder, std::function<void(Result<Json>)> done) {
  if (folder.empty() || folder.front() != '/') {
    done(fail(Errc::kInvalidInput, fmt::format("dir: found \"{}\", expected an absolute path", folder)));
    return;
  }
  saver_->save(folder, [done = std::move(done)](MapSaver::Outcome outcome) {
    if (!outcome) {
      done(tl::unexpected(outcome.error()));
      return;
    }
    spdlog::info("map revision {} saved to {}", outcome->revision, outcome->folder);
    done(Json{{"dir", outcome->folder},
              {"revision", outcome->revision},
              {"width", outcome->width},
              {"height", outcome->height},
              {"points", outcome->points}});
  });
}

Status App::set_log_level(const std::string& level) {
  const auto parsed = parse_log_level(level);
  if (!parsed) {
    return fail(Errc::kInvalidInput,
                fmt::format("level: found \"{}\", expected trace, debug, info, warning or error", level));
  }
  topo::daemon::set_log_level(*parsed);
  return {};
}

}  // namespace topo::daemon
