// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <utility>

#include "daemon/app/display_json.hpp"
#include "daemon/app/doctor.hpp"
#include "daemon/app/json/plan_json.hpp"
#include "daemon/app/monitor.hpp"
#include "daemon/app/operator.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// Free space on the disk of a writable folder; of its parent while the folder is missing.
std::optional<std::uint64_t> free_bytes(std::string folder) {
  if (::access(folder.c_str(), F_OK) != 0) folder = folder.substr(0, folder.rfind('/') + 1);
  struct stat info {};
  struct statvfs disk {};
  if (::stat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode)) return {};
  if (::access(folder.c_str(), W_OK) != 0 || ::statvfs(folder.c_str(), &disk) != 0) return {};
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
}

}  // namespace

Json Operator::status() const {
  Json json = monitor_.status();
  json["estop"] = estop_.latched();
  json["estop_latch"] = estop_.json();
  json["mission"] = mission_json();
  json["session"] = sessions_.status();
  json["map"]["doubt"] = doubts_.json();
  json["team"] = team_.brief();
  const auto* report = plan_.report();
  if (report == nullptr) return json;
  json["activity"] = to_text(report->activity);
  const bool paused = missions_.state() == MissionState::kPaused;  // planning does not know the reason
  json["reason"] = paused ? missions_.reason() : report->reason;
  json["goal"] = goal_json(report->goal);
  json["open_goals"] = report->open_goals.size();
  json["second_phase"] = report->second_phase;
  json["known_m2"] = report->known_m2;
  return json;
}

Json Operator::latency() const { return monitor_.latency(); }

Json Operator::health() const {
  Json json = monitor_.health();
  if (const std::string trouble = estop_.trouble(); !trouble.empty()) {
    json["healthy"] = false;
    json["faults"].push_back("e-stop: " + trouble);
  }
  if (const std::string trouble = team_.trouble(); !trouble.empty()) {
    json["healthy"] = false;
    json["faults"].push_back("team: " + trouble);
  }
  if (const std::string trouble = areas_.trouble(); !trouble.empty()) {
    json["healthy"] = false;
    json["faults"].push_back("areas: " + trouble);
  }
  if (const std::string& trouble = silence_.trouble(); !trouble.empty()) {
    json["healthy"] = false;
    json["faults"].push_back("base: " + trouble);
  }
  if (const std::string trouble = sessions_.trouble(); !trouble.empty()) {
    json["healthy"] = false;
    json["faults"].push_back("session: " + trouble);
  }
  return json;
}

Json Operator::mission_json() const {
  return {{"number", missions_.number()},
          {"order", to_text(missions_.order())},
          {"state", to_text(missions_.state())},
          {"reason", missions_.reason()},
          {"elapsed_s", types::to_seconds(missions_.elapsed(io::monotonic_now()))},
          {"distance_m", way_.distance_m()}};
}

Json Operator::progress() const {
  const std::string why_not = obstacle();
  return {{"ready", why_not.empty()}, {"why_not", why_not}, {"mission", mission_json()}};
}

Json Operator::goals() const {
  const auto* report = plan_.report();
  if (report == nullptr) return Json::object();
  Json json = goals_json(*report);
  Json& route = json["route"] = Json::array();
  for (const types::Vector2& p : report->route_map) route.push_back({{"x_m", p.x()}, {"y_m", p.y()}});
  return json;
}

Json Operator::places() const {
  const auto* report = plan_.report();
  return report == nullptr ? Json::object() : places_json(*report);
}

Json Operator::scan() const {
  const types::Scan* scan = hand_overs_.front.to_main.read();
  if (scan == nullptr) return Json::object();
  const double sweep_s = static_cast<double>(scan->geometry.time_increment_s) * scan->beams;
  const types::Stamp middle = scan->first_beam + types::from_seconds(sweep_s / 2.0);
  return scan_json(*scan, monitor_.pose_at(middle) * mapper_params(configuration_).T_base_laser);
}

void Operator::doctor(std::function<void(Json)> done) {
  DoctorFacts facts = monitor_.facts();
  facts.estop_latched = estop_.latched();
  facts.estop_trouble = estop_.trouble();
  facts.session_obstacle = sessions_.obstacle();
  facts.place = sessions_.standing();
  facts.map_doubt = doubts_.text();
  facts.journal = sessions_.journal();
  facts.team = team_.facts();
  // The disk may be slow.
  auto job = [facts = std::move(facts), done]() mutable -> Background::Finish {
    for (DoctorFacts::Disk& disk : facts.disks) disk.free_bytes = free_bytes(disk.folder);
    Json checks = Json::array();
    bool ok = true;
    for (const Check& check : examine(facts)) {
      ok = ok && check.ok;
      checks.push_back({{"check", check.name},
                        {"ok", check.ok},
                        {"warning", !check.safer.empty()},
                        {"found", check.found},
                        {"cure", check.cure},
                        {"safer", check.safer}});
    }
    return [done, json = Json{{"ok", ok}, {"checks", std::move(checks)}}] { done(json); };
  };
  if (!searches_.add(std::move(job))) done(Json{{"ok", false}, {"checks", Json::array()}});
}

}  // namespace topo::daemon
