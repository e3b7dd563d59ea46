// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/tables.hpp"

#include <fmt/format.h>

#include <string_view>

namespace topo::daemon {
namespace {

/// The member at a path such as "/map/keyframes"; null when it is missing.
const Json& at(const Json& json, const char* path) {
  static const Json none;
  const Json::json_pointer pointer(path);
  return json.contains(pointer) ? json[pointer] : none;
}

std::string text(const Json& json, const char* path) { return text_at(json, path); }

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("{:<12}{}\n", name, value);
}

std::string pose_text(const Json& json, const std::string& path) {
  return fmt::format("x {} m, y {} m, heading {} rad", text(json, (path + "/x_m").c_str()),
                     text(json, (path + "/y_m").c_str()), text(json, (path + "/theta_rad").c_str()));
}

std::string number(const Json& json, const char* path, int decimals) {
  const Json& value = at(json, path);
  return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), decimals) : "-";
}

/// Empty unless the first metres in a session's map are being held against it.
std::string trial_row(const Json& session) {
  if (text(session, "/place/on_trial") != "yes") return {};
  return row("place",
             fmt::format("on trial in session {} for {} m: {} scans match it, {} contradict it",
                         text(session, "/place/session"), number(session, "/place/trial/way_m", 1),
                         text(session, "/place/trial/matched"), text(session, "/place/trial/contradicted")));
}

/// Empty when no session is kept.
std::string session_row(const Json& session) {
  const std::string folder = text(session, "/folder"), obstacle = text(session, "/obstacle");
  if (!is_said(folder)) return {};
  if (is_said(obstacle)) return row("session", obstacle);
  if (text(session, "/journal/failing") == "yes") {
    return row("session", fmt::format("NOT being kept, {} failures: {}", text(session, "/journal/failures"),
                                      text(session, "/journal/message")));
  }
  const std::string name = text(session, "/journal/name");
  if (name.empty()) return row("session", "nothing to be kept yet");
  return row("session", fmt::format("{} keyframes in {}", text(session, "/journal/keyframes"), name));
}

/// The daemon reports 0 when the base does not report a voltage.
std::string battery_text(const Json& status) {
  const Json& battery_v = at(status, "/battery_v");
  const bool reported = battery_v.is_number() && battery_v.get<double>() > 0.0;
  return reported ? number(status, "/battery_v", 1) + " V" : "voltage not reported";
}

/// Whether it is latched, and whether it would be after a restart.
std::string estop_text(const Json& status) {
  std::string out = text(status, "/estop");
  const std::string kept = text(status, "/estop_latch/kept"), since = text(status, "/estop_latch/since");
  if (!is_said(kept)) return out;
  out += kept == "yes"  ? "; kept in " + text(status, "/estop_latch/file")
         : kept == "no" ? "; NOT kept over a restart: " + text(status, "/estop_latch/why")
                        : "; not kept over a restart yet";
  return is_said(since) ? out + "; since before the start: " + since : out;
}

std::string point_text(const Json& json) {
  return fmt::format("({}, {})", number(json, "/x_m", 2), number(json, "/y_m", 2));
}

std::string goal_text(const Json& goal) {
  return fmt::format("{}  place {}, opening {} m", point_text(goal), text(goal, "/place"),
                     number(goal, "/opening_m", 2));
}

/// Concatenates `line` of every member of the list at `path`.
template <class Line>
std::string rows(const Json& json, const char* path, Line line) {
  std::string out;
  const Json& list = at(json, path);
  if (!list.is_array()) return out;
  for (const Json& member : list) out += line(member);
  return out;
}

/// "; places to look at again: (1.0, 2.0), (3.0, 4.0)"
std::string places_text(const Json& places) {
  std::string all;
  for (const Json& place : places) {
    const Json &x_m = at(place, "/x_m"), &y_m = at(place, "/y_m");
    if (!x_m.is_number() || !y_m.is_number()) continue;
    all += fmt::format("{}({:.1f}, {:.1f})", all.empty() ? "; places to look at again: " : ", ",
                       x_m.get<double>(), y_m.get<double>());
  }
  return all;
}

}  // namespace

std::string text_at(const Json& json, const char* path) {
  const Json& value = at(json, path);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.3f}", value.get<double>());
  if (value.is_number()) return fmt::format("{}", value.get<std::int64_t>());
  return "-";
}

bool is_said(std::string_view text) { return !text.empty() && text != "-"; }

std::string mission_text(const Json& mission) {
  const std::string reason = text(mission, "/reason");
  return fmt::format("mission {} ({}) {}{}; {} s, {} m driven\n", text(mission, "/number"),
                     text(mission, "/order"), text(mission, "/state"), is_said(reason) ? ": " + reason : "",
                     number(mission, "/elapsed_s", 0), number(mission, "/distance_m", 1));
}

std::string watch_line(const Json& status) {
  const double elapsed_s =
      at(status, "/mission/elapsed_s").is_number() ? at(status, "/mission/elapsed_s").get<double>() : 0.0;
  const int whole_s = static_cast<int>(elapsed_s);
  std::string out =
      fmt::format("{:2}:{:02} {:<9} {:>6} m2 {:>2} goals  ({:>6}, {:>6}) {:>5} m/s {:>6} m", whole_s / 60,
                  whole_s % 60, text(status, "/activity"), number(status, "/known_m2", 1),
                  text(status, "/open_goals"), number(status, "/pose/x_m", 2), number(status, "/pose/y_m", 2),
                  number(status, "/twist/v_mps", 2), number(status, "/mission/distance_m", 1));
  if (at(status, "/goal").is_object()) out += "  to " + point_text(at(status, "/goal"));
  const std::string state = text(status, "/state");
  return state == "driving" || state == "standing" ? out : out + "  " + state;
}

std::string doctor_table(const Json& doctor) {
  std::string out = rows(doctor, "/checks", [](const Json& c) {
    const bool ok = text(c, "/ok") == "yes";
    const bool warning = text(c, "/warning") == "yes";
    const std::string line = fmt::format("{:<4} {:<18} {}\n",
                                         !ok       ? "BAD"
                                         : warning ? "warn"
                                                   : "ok",
                                         text(c, "/check"), text(c, "/found"));
    if (!ok) return line + fmt::format("     {:<18} cure: {}\n", "", text(c, "/cure"));
    return warning ? line + fmt::format("     {:<18} {}\n", "", text(c, "/safer")) : line;
  });
  return out;
}

std::string goals_table(const Json& goals) {
  std::string out;
  if (at(goals, "/goal").is_object()) out += row("on the way", goal_text(at(goals, "/goal")));
  out += rows(goals, "/open", [](const Json& g) { return row("open", goal_text(g)); });
  out += rows(goals, "/given_up", [](const Json& g) {
    const std::string when =
        at(g, "/back_in_s").is_null() ? "for good" : "back in " + number(g, "/back_in_s", 0) + " s";
    return row("put off", fmt::format("{}  {}: {}", point_text(g), when, text(g, "/why")));
  });
  return out.empty() ? "no goals\n" : out;
}

std::string why_table(const Json& goals) {
  std::string out = goals_table(goals);
  out += rows(goals, "/dropped", [](const Json& g) {
    return row("dropped", fmt::format("{}  {}", goal_text(g), text(g, "/why")));
  });
  out += rows(goals, "/decisions", [](const Json& d) {
    return row(fmt::format("{} s ago", number(d, "/age_s", 0)),
               fmt::format("{}  {}", point_text(d), text(d, "/text")));
  });
  return out;
}

std::string places_table(const Json& places) {
  std::string out = fmt::format("{:>5} {:>18} {:>9} {:>16} {:>6}\n", "place", "middle (m)", "area m2",
                                "length x width m", "goals");
  return out + rows(places, "/places", [](const Json& p) {
           return fmt::format("{:>5} {:>18} {:>9} {:>16} {:>6}\n", text(p, "/number"), point_text(p),
                              number(p, "/area_m2", 1),
                              number(p, "/length_m", 1) + " x " + number(p, "/width_m", 1),
                              text(p, "/goals"));
         });
}

std::string areas_table(const Json& areas) {
  std::string out = fmt::format("{:<20} {:<10} {:>6}  {}\n", "area", "kind", "robot", "corners (m)");
  out += rows(areas, "/areas", [](const Json& area) {
    std::string corners;
    for (const Json& corner : at(area, "/corners_m"))
      corners += fmt::format("({}, {}) ", number(corner, "/0", 2), number(corner, "/1", 2));
    return fmt::format("{:<20} {:<10} {:>6}  {}\n", text(area, "/id"), text(area, "/kind"),
                       text(area, "/robot"), corners);
  });
  if (at(areas, "/kept") == false) out += "(a restart does not find them)\n";
  const std::string trouble = text(areas, "/trouble");
  return is_said(trouble) ? out + "(" + trouble + ")\n" : out;
}

std::string status_table(const Json& status) {
  std::string out = row("robot", fmt::format("{} ({})", text(status, "/robot"), text(status, "/model")));
  out += row("state", text(status, "/state"));
  out += row("activity", fmt::format("{}; {}", text(status, "/activity"), text(status, "/reason")));
  out += row("mission", mission_text(at(status, "/mission")));
  out.pop_back();  // removes the line end, which row() adds
  out += row("e-stop", estop_text(status));
  out += row("pose", pose_text(status, "/pose"));
  out += row("odometry", pose_text(status, "/odometry"));
  out += row("speed", fmt::format("{} m/s, {} rad/s", text(status, "/twist/v_mps"),
                                  text(status, "/twist/omega_radps")));
  out += row("battery", battery_text(status));
  out += row("map", fmt::format("revision {}, {} keyframes, {} closures", text(status, "/map/revision"),
                                text(status, "/map/keyframes"), text(status, "/map/closures/accepted")));
  if (const Json& why = at(status, "/map/doubt/why");
      why.is_string() && !why.get_ref<const std::string&>().empty())
    out += row("doubt", why.get<std::string>() + places_text(at(status, "/map/doubt/look_again")));
  out += row("scans", fmt::format("{} matched, {} lost, {} skipped", text(status, "/map/scans_matched"),
                                  text(status, "/map/scans_lost"), text(status, "/map/scans_skipped")));
  out += session_row(at(status, "/session"));
  out += trial_row(at(status, "/session"));
  const Json& devices = at(status, "/devices");
  if (!devices.is_object()) return out;
  for (const auto& [name, device] : devices.items()) {
    out += row(name, fmt::format("{}; {}", text(device, "/state"), text(device, "/message")));
  }
  return out;
}

std::string latency_table(const Json& latency) {
  std::string out = fmt::format("{:<10}{:<6}{:>10}{:>11}{:>11}{:>11}{:>11}{:>10}\n", "thread", "what",
                                "count", "p50 ms", "p99 ms", "p99.9 ms", "max ms", "overruns");
  if (!latency.is_object()) return out;
  for (const auto& [thread, values] : latency.items()) {
    for (const char* what : {"wake", "run"}) {
      const Json& h = at(values, (std::string("/") + what).c_str());
      out += fmt::format("{:<10}{:<6}{:>10}{:>11}{:>11}{:>11}{:>11}{:>10}\n", thread, what, text(h, "/count"),
                         text(h, "/p50_ms"), text(h, "/p99_ms"), text(h, "/p999_ms"), text(h, "/max_ms"),
                         text(values, "/overruns"));
    }
  }
  return out;
}

std::string health_table(const Json& health) {
  std::string out = row("healthy", text(health, "/healthy"));
  const Json& faults = at(health, "/faults");
  if (!faults.is_array()) return out;
  for (const Json& fault : faults) out += row("fault", fault.is_string() ? fault.get<std::string>() : "-");
  const Json& assumed = at(health, "/assumed");
  if (!assumed.is_array()) return out;
  for (const Json& one : assumed) out += row("assumed", one.is_string() ? one.get<std::string>() : "-");
  return out;
}

}  // namespace topo::daemon
