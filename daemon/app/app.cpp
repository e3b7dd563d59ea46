// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/app.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/epoll.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <cmath>
#include <cstring>

#include "daemon/app/logging.hpp"
#include "daemon/app/mission_log.hpp"
#include "daemon/app/monitor.hpp"
#include "daemon/app/operator.hpp"
#include "daemon/app/version.hpp"
#include "daemon/app/workers.hpp"
#include "daemon/control/methods.hpp"
#include "daemon/logging/event_log.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

// SIGHUP too: when the terminal or ssh session of a daemon started by hand ends, the robot must not drive on
// until its own watchdog expires.
constexpr std::array<int, 3> kStopSignals{SIGTERM, SIGINT, SIGHUP};
constexpr std::uint64_t kTickUsec = 100'000;
constexpr std::uint64_t kTickAccuracyUsec = 10'000;  // 0 would mean 250 ms

Status from_sd(int result, const char* what) {
  if (result >= 0) return {};
  return fail(Errc::kIo, fmt::format("{}: {}", what, std::strerror(-result)), -result);
}

}  // namespace

void block_signals() {
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);  // a file at its size limit equals a full disk: the daemon must not exit
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : kStopSignals) ::sigaddset(&set, number);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

Result<std::unique_ptr<App>> App::make(AppOptions options) {
  std::unique_ptr<App> app(new App(std::move(options)));
  if (auto prepared = app->prepare(); !prepared) return tl::unexpected(prepared.error());
  return app;
}

App::App(AppOptions options) : options_(std::move(options)) {}
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
  if (options_.configuration.session.journal && !options_.configuration.session.folder.empty())
    log_ = std::make_unique<MissionLog>(hand_overs_->journal.log, io::monotonic_now());
  operator_ =
      std::make_unique<Operator>(options_.configuration, options_.effective_configuration, *hand_overs_,
                                 *monitor_, [this](const Json& news) { announce(news); });
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
      *operator_, [this](const Call& call, const Answer& answer) { control_->answer(call, answer); },
      [this](std::uint64_t client) { control_->subscribe(client); });
  ControlRules rules;
  rules.may_command = [group](const Peer& peer) { return may_command(peer, ::geteuid(), group); };
  control_ = std::make_unique<ControlServer>(event_.get(), std::move(options_.socket), std::move(rules),
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
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const int added = sd_event_add_signal(event, &source, kStopSignals[i], stop, nullptr);
    if (auto s = from_sd(added, "signals"); !s) return s;
    signals_[i].reset(source);
  }
  const auto requested = [](sd_event_source* s, int, std::uint32_t, void*) {
    return sd_event_exit(sd_event_source_get_event(s), 0);
  };
  if (auto s = watch(stop_requested_.fd(), requested, nullptr, stop_source_); !s) return s;
  const auto saved = [](sd_event_source*, int, std::uint32_t, void* app) {
    static_cast<App*>(app)->collect(0);
    return 0;
  };
  const auto searched = [](sd_event_source*, int, std::uint32_t, void* app) {
    static_cast<App*>(app)->collect(1);
    return 0;
  };
  const auto latched = [](sd_event_source*, int, std::uint32_t, void* app) {
    static_cast<App*>(app)->collect(2);
    return 0;
  };
  const auto ordered = [](sd_event_source*, int, std::uint32_t, void* app) {
    static_cast<App*>(app)->collect(3);
    return 0;
  };
  const auto fds = operator_->finished_fds();
  if (auto s = watch(fds[0], saved, this, saved_); !s) return s;
  if (auto s = watch(fds[1], searched, this, searched_); !s) return s;
  if (auto s = watch(fds[2], latched, this, latched_); !s) return s;
  if (auto s = watch(fds[3], ordered, this, ordered_); !s) return s;
  const int added = sd_event_add_time_relative(event, &source, CLOCK_MONOTONIC, kTickUsec, kTickAccuracyUsec,
                                               &App::on_tick, this);
  if (auto s = from_sd(added, "timer"); !s) return s;
  tick_.reset(source);
  return {};
}

int App::on_tick(sd_event_source* source, std::uint64_t, void* app) {
  static_cast<App*>(app)->tick();
  sd_event_source_set_time_relative(source, kTickUsec);
  return sd_event_source_set_enabled(source, SD_EVENT_ONESHOT);
}

Status App::watch(int fd, sd_event_io_handler_t handler, void* data, EventSource& source) {
  sd_event_source* added = nullptr;
  const int result = sd_event_add_io(event_.get(), &added, fd, EPOLLIN, handler, data);
  source.reset(added);
  return from_sd(result, "event loop");
}

/// Readers of maps and reports are destroyed before the threads that create and destroy those.
void App::end_readers() {
  saved_.reset();
  searched_.reset();
  latched_.reset();
  ordered_.reset();
  operator_.reset();  // no longer called: the event loop, which serves the socket, has ended
}

/// The report of a job that replaced the map must come with the state of the new map.
void App::collect(std::size_t i) {
  monitor_->update(io::monotonic_now());
  operator_->collect(i);
}

void App::announce(const Json& news) {
  control_->publish(news);
  if (log_ != nullptr) log_->note_event(io::monotonic_now(), news);
}

void App::tell_events() {
  for (Vitals* vitals : workers_->all()) events_->drain(vitals->name, vitals->events);
}

void App::tick() {
  for (const std::string& refusal : workers_->take_refusals()) monitor_->note_refusal(refusal);
  tell_events();
  monitor_->update(io::monotonic_now());
  const types::Stamp now = io::monotonic_now();
  operator_->tick(now);
  if (log_ != nullptr && log_->is_due(now)) log_->note_state(now, operator_->status(), operator_->team());
  // The main loop must not hide a dead worker: without WATCHDOG=1 the service manager restarts the daemon.
  const std::string state =
      fmt::format("STATUS={}{}", monitor_->summary(), monitor_->alive() ? "\nWATCHDOG=1" : "");
  sd_notify(0, state.c_str());
  if (options_.has_ended && options_.has_ended()) request_stop();
}

Status App::enter_real_time() {
  const RealtimeConfig& config = options_.configuration.realtime;
  if (config.policy == RealtimePolicy::kOff) return {};
  const bool enforce = config.policy == RealtimePolicy::kEnforce;
  if (config.lock_memory) {
    if (auto locked = lock_memory(); !locked) {
      if (enforce) return locked;
      monitor_->note_refusal(locked.error().message + "; going on without");
    }
  }
  if (!enforce) return {};
  return try_fifo(std::max(config.base_priority, config.scan_priority));
}

Status App::run() {
  keep_freed_memory();
  if (auto s = enter_real_time(); !s) return s;
  if (auto s = operator_->start(); !s) return s;
  if (auto s = workers_->start(); !s) {
    end_readers();
    workers_->stop();
    return s;
  }
  spdlog::info("topometricd {} serves {} on {}", kVersion, options_.configuration.robot.name,
               options_.configuration.control.socket);
  sd_notify(0, "READY=1");
  const int looped = sd_event_loop(event_.get());
  sd_notify(0, "STOPPING=1");
  if (options_.on_stopping) options_.on_stopping();
  workers_->close_devices();  // a running job may take long to end: the robot must not drive on meanwhile
  end_readers();
  workers_->stop();
  tell_events();  // the last messages of the threads
  spdlog::info("stopped");
  return from_sd(looped, "event loop");
}

}  // namespace topo::daemon
