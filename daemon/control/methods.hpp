// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "core/types/transform.hpp"
#include "daemon/control/server.hpp"

namespace topo::daemon {

/// Operations of the daemon for an operator. Called on the main thread; none may block.
class Operations {
 public:
  virtual ~Operations() = default;
  [[nodiscard]] virtual Json status() const = 0;
  [[nodiscard]] virtual Json health() const = 0;
  [[nodiscard]] virtual Json latency() const = 0;
  [[nodiscard]] virtual Json config() const = 0;
  /// Latches; the base stops within 100 ms.
  virtual void estop() = 0;
  /// The whole team's e-stop, and the end of all missions; this robot is stopped first. The number of the
  /// order, which team() names with those who have acknowledged it; 0: this robot has no team.
  virtual std::uint64_t estop_team() = 0;
  virtual std::uint64_t stop_team() = 0;
  /// Who is in the team, and what each of it lacks.
  [[nodiscard]] virtual Json team() const = 0;
  /// The goals with their reasons, and the places; empty before planning has a map.
  [[nodiscard]] virtual Json goals() const = 0;
  [[nodiscard]] virtual Json places() const = 0;
  /// Every condition that keeps the robot from moving, with its cure; calls `done` on the main thread, later.
  virtual void doctor(std::function<void(Json)> done) = 0;
  /// Whether a mission would be accepted now, and the newest mission: for scripts that wait.
  [[nodiscard]] virtual Json progress() const = 0;
  /// Missions. A refusal gives the reason.
  virtual types::Status explore() = 0;
  virtual types::Status go_home() = 0;
  virtual types::Status pause() = 0;
  virtual types::Status resume() = 0;
  /// Calls `done` on the main thread, later: when nothing on the disk would latch the e-stop again.
  virtual void clear_estop(std::function<void(types::Status)> done) = 0;
  /// Drives for the dead-man's time unless repeated.
  virtual types::Status drive(const types::Twist2& twist) = 0;
  virtual void stop() = 0;
  /// Writes the map's files into a folder and calls `done` on the main thread, later.
  virtual void save_map(const std::string& folder, std::function<void(types::Result<Json>)> done) = 0;
  /// Sessions, each answered on the main thread, later: the list of saved ones; saving the map with all its
  /// data; continuing a saved one, near a pose in its map or with a search for the robot.
  using SessionDone = std::function<void(types::Result<Json>)>;
  virtual void list_sessions(SessionDone done) = 0;
  virtual void save_session(const std::string& name, SessionDone done) = 0;
  virtual void load_session(const std::string& name, const std::optional<types::Se2>& pose,
                            SessionDone done) = 0;
  /// Says that the proposed place of a session is right, or where the robot is.
  virtual void confirm_session(const std::optional<types::Se2>& pose, SessionDone done) = 0;
  /// Keeps the map made since the start, instead of a session that the daemon would resume.
  virtual types::Status begin_anew() = 0;
  /// Checks whether the point can be reached, and calls `done` on the main thread, later.
  virtual void go_to(const types::Vector2& target, std::function<void(types::Status)> done) = 0;
  virtual types::Status set_log_level(const std::string& level) = 0;
};

/// The methods of the control socket. `late` receives answers that come after answer() has returned;
/// `subscribe` receives the number of a client that subscribes to events.
class Methods {
 public:
  using Late = std::function<void(const Call&, const Answer&)>;
  using Subscribe = std::function<void(std::uint64_t client)>;
  Methods(Operations& operations, Late late, Subscribe subscribe)
      : operations_(operations), late_(std::move(late)), subscribe_(std::move(subscribe)) {}

  /// The answer, or nothing when it comes later.
  std::optional<Answer> answer(const Call& call);

 private:
  Operations& operations_;
  Late late_;
  Subscribe subscribe_;
};

}  // namespace topo::daemon
