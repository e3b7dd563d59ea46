// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "daemon/app/connector_factory.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/control/server.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

class EventLog;
class Methods;
class Monitor;
class MissionLog;
class Operator;
class Workers;
struct HandOvers;

struct AppOptions {
  Configuration configuration;
  std::string effective_configuration;  ///< for the `config` method
  io::ListeningSocket socket;           ///< of configuration.control.socket
  ConnectorFactory connectors;
  std::function<void()> on_stopping;  ///< called when the stop begins; may be empty
  std::function<bool()> has_ended{};  ///< called every tick; true: the devices have ended, stop. May be empty
};

/// The daemon: all parts, created in the order of dependency, and the loop of the main thread. The members
/// are in that order, so that they are destroyed in the reverse order.
class App {
 public:
  /// Creates all parts; starts no thread and accesses no device.
  static types::Result<std::unique_ptr<App>> make(AppOptions options);
  App(const App&) = delete;
  App& operator=(const App&) = delete;
  ~App();

  /// Starts the threads and serves until SIGTERM, SIGINT, SIGHUP or request_stop(); then stops in order: the
  /// robot stands and the lasers are off on return. Precondition: these signals are blocked in every thread,
  /// see block_signals().
  types::Status run();

  /// Callable from any thread.
  void request_stop() { stop_requested_.post(); }

 private:
  explicit App(AppOptions options);
  types::Status prepare();
  types::Status serve_control();
  types::Status add_events();
  types::Status enter_real_time();
  void tick();
  void tell_events();
  void announce(const Json& news);
  void collect(std::size_t i);
  void end_readers();
  types::Status watch(int fd, sd_event_io_handler_t handler, void* data, EventSource& source);
  static int on_tick(sd_event_source* source, std::uint64_t usec, void* app);

  struct EventDeleter {
    void operator()(sd_event* event) const { sd_event_unref(event); }
  };

  AppOptions options_;
  Wakeup stop_requested_;
  std::unique_ptr<sd_event, EventDeleter> event_;
  std::unique_ptr<HandOvers> hand_overs_;
  std::unique_ptr<Workers> workers_;
  std::unique_ptr<EventLog> events_;
  std::unique_ptr<Monitor> monitor_;
  std::unique_ptr<MissionLog> log_;  ///< null without a journal
  std::unique_ptr<Operator> operator_;
  std::unique_ptr<Methods> methods_;
  std::unique_ptr<ControlServer> control_;
  EventSource tick_, saved_, searched_, latched_, ordered_, stop_source_;
  std::array<EventSource, 3> signals_;
};

/// Blocks SIGTERM, SIGINT and SIGHUP, which the main loop reads, and ignores SIGPIPE and SIGXFSZ. To be
/// called before any thread is started.
void block_signals();

}  // namespace topo::daemon
