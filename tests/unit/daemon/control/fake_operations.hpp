// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "daemon/control/methods.hpp"

namespace topo::daemon {

/// Notes what was asked.
class FakeOperations final : public Operations {
 public:
  std::vector<std::string> calls;
  types::Twist2 twist;
  std::string folder;
  std::optional<types::Se2> pose;
  std::function<void(types::Result<Json>)> save_done;
  types::Vector2 target{0.0, 0.0};
  types::Polygon polygon;
  types::AreaKind area_kind = types::AreaKind::kKeepOut;
  std::function<void(types::Status)> goto_done;
  types::Status outcome;

  [[nodiscard]] Json status() const override { return Json{{"state", "standing"}}; }
  [[nodiscard]] Json health() const override { return Json{{"healthy", true}}; }
  [[nodiscard]] Json latency() const override { return Json::object(); }
  [[nodiscard]] Json config() const override { return Json{{"text", ""}}; }
  [[nodiscard]] Json goals() const override { return Json{{"open", Json::array()}}; }
  [[nodiscard]] Json places() const override { return Json{{"places", Json::array()}}; }
  [[nodiscard]] Json progress() const override { return Json{{"ready", true}}; }
  void map_tiles(std::uint64_t since, std::function<void(types::Result<Json>)> done) override {
    done(Json{{"revision", since + 1}});
  }
  [[nodiscard]] Json scan() const override { return Json{{"cm", Json::array()}}; }
  void session_tiles(std::uint64_t since, SessionDone done) override { done(Json{{"revision", since + 2}}); }
  void map_trails(std::function<void(types::Result<Json>)> done) override { done(Json{{"own", 1}}); }
  void doctor(std::function<void(Json)> done) override { done(Json{{"ok", true}}); }
  types::Status explore() override { return calls.push_back("explore"), outcome; }
  types::Status go_home() override { return calls.push_back("home"), outcome; }
  types::Status pause() override { return calls.push_back("pause"), outcome; }
  types::Status resume() override { return calls.push_back("resume"), outcome; }
  void go_to(const types::Vector2& point, std::function<void(types::Status)> done) override {
    target = point;
    goto_done = std::move(done);
  }
  void estop() override { calls.push_back("estop"); }
  std::uint64_t estop_team() override { return calls.push_back("estop_team"), 7; }
  types::Result<Json> order_team(team::OrderKind kind, std::optional<std::uint16_t> to) override {
    calls.push_back(std::string(team::to_text(kind)) + (to ? " to " + std::to_string(*to) : "_team"));
    if (!outcome) return tl::unexpected(outcome.error());
    return Json{{"order", 8}};
  }
  [[nodiscard]] Json team() const override { return Json{{"present", false}}; }
  void clear_estop(std::function<void(types::Status)> done) override {
    calls.push_back("clear_estop");
    done(outcome);
  }
  types::Status drive(const types::Twist2& t) override {
    twist = t;
    return calls.push_back("drive"), outcome;
  }
  void stop() override { calls.push_back("stop"); }
  void save_map(const std::string& f, std::function<void(types::Result<Json>)> done) override {
    folder = f;
    save_done = std::move(done);
  }
  void list_sessions(SessionDone done) override { done(Json{{"sessions", Json::array()}}); }
  void save_session(const std::string& name, SessionDone done) override {
    folder = name;
    save_done = std::move(done);
  }
  void load_session(const std::string& name, const std::optional<types::Se2>& at, SessionDone done) override {
    folder = name;
    pose = at;
    save_done = std::move(done);
  }
  void confirm_session(const std::optional<types::Se2>& at, SessionDone done) override {
    folder = "confirm";
    pose = at;
    save_done = std::move(done);
  }
  types::Status begin_anew() override { return calls.push_back("new"), outcome; }
  types::Status set_log_level(const std::string&) override { return calls.push_back("log_level"), outcome; }
  [[nodiscard]] Json map_doubt() const override { return nullptr; }
  [[nodiscard]] Json areas() const override { return Json{{"areas", Json::array()}}; }
  types::Result<std::string> draw_area(const types::Polygon& corners_map, types::AreaKind kind) override {
    polygon = corners_map;
    area_kind = kind;
    if (!outcome) return tl::unexpected(outcome.error());
    return std::string("7");
  }
  types::Status withdraw_area(const std::string& id) override {
    return calls.push_back("withdraw " + id), outcome;
  }
};

}  // namespace topo::daemon
