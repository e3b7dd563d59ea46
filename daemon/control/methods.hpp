// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "core/team/exchange/log_entry.hpp"
#include "core/types/area_limits.hpp"
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
  /// The whole team's e-stop; this robot is stopped first. The number of the order, which team() names with
  /// the robots that have acknowledged it; 0: this robot has no team.
  virtual std::uint64_t estop_team() = 0;
  /// An order to one robot, or to all, this one first. "order" is its number, as of an e-stop; of this robot
  /// alone there is none. "refused_here": why this one does not obey an order to all. Refused when the one
  /// does not obey or is out of reach.
  virtual types::Result<Json> order_team(team::OrderKind kind, std::optional<std::uint16_t> to) = 0;
  /// Who is in the team, and what each of it lacks.
  [[nodiscard]] virtual Json team() const = 0;
  /// The goals with their reasons, and the places; empty before planning has a map.
  [[nodiscard]] virtual Json goals() const = 0;
  [[nodiscard]] virtual Json places() const = 0;
  /// The map for displays: tiles that changed after number `since` of an earlier answer (0: all), a bounded
  /// part of them, and the ways of the robots. Each calls `done` on the main thread, later.
  virtual void map_tiles(std::uint64_t since, std::function<void(types::Result<Json>)> done) = 0;
  virtual void map_trails(std::function<void(types::Result<Json>)> done) = 0;
  /// The front scanner's newest scan in the map (scan_json()); empty before the first.
  [[nodiscard]] virtual Json scan() const = 0;
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
  /// The map of the session that waits for the operator's word on the robot's place, as map_tiles().
  virtual void session_tiles(std::uint64_t since, SessionDone done) = 0;
  /// Says that the proposed place of a session is right, or where the robot is.
  virtual void confirm_session(const std::optional<types::Se2>& pose, SessionDone done) = 0;
  /// Keeps the map made since the start, instead of a session that the daemon would resume.
  virtual types::Status begin_anew() = 0;
  /// Checks whether the point can be reached, and calls `done` on the main thread, later.
  virtual void go_to(const types::Vector2& target, std::function<void(types::Status)> done) = 0;
  virtual types::Status set_log_level(const std::string& level) = 0;
  /// What speaks against the map as it was last looked at (doubt.json); null before.
  [[nodiscard]] virtual Json map_doubt() const = 0;
  /// Areas that operators drew, of this robot and of its mates, and whether they are in force here.
  [[nodiscard]] virtual Json areas() const = 0;
  /// No wheel enters the area from the base's next period on; mates learn of it by the link. Gives its id.
  virtual types::Result<std::string> draw_area(const types::Polygon& corners_map, types::AreaKind kind) = 0;
  /// The area may be entered again, by all robots of the team. kNotFound: there is none with this id.
  virtual types::Status withdraw_area(const std::string& id) = 0;
};

/// Has this robot carry out an order of its own operator or of a mate's.
[[nodiscard]] types::Status carry_out(Operations& operations, team::OrderKind kind);

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
