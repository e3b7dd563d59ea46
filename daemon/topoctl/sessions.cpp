// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kDiskPatience = std::chrono::minutes(2);

std::int64_t number_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<std::int64_t>() : 0;
}

std::string saved_text(const Json& answer) {
  return fmt::format("session of {} keyframes saved to {}\n", number_of(answer, "keyframes"),
                     text_at(answer, "/file"));
}

Json pose_params(const Arguments& arguments) {
  if (arguments.pose.size() != 3) return Json::object();
  return {{"x_m", arguments.pose[0]}, {"y_m", arguments.pose[1]}, {"theta_rad", arguments.pose[2]}};
}

std::string loaded_text(const Json& answer) {
  const auto proposal = answer.find("proposal");
  const bool waits = proposal != answer.end() && *proposal == true;
  std::string text =
      fmt::format("{} session {}, {} keyframes: {}\n", waits ? "waits for" : "goes on with",
                  text_at(answer, "/name"), number_of(answer, "keyframes"), text_at(answer, "/place"));
  if (waits)
    text +=
        "(the robot stands until topoctl session confirm says that this is right, or with --pose X Y THETA "
        "where it is; topoctl session new leaves the session alone)\n";
  if (const auto other = answer.find("other_parameters"); other != answer.end() && *other == true)
    text += "(it was made with other parameters of the mapper or places of the scanners)\n";
  if (const std::string damage = text_at(answer, "/damage"); is_said(damage))
    text += fmt::format("(its file is not whole: {})\n", damage);
  return text;
}

}  // namespace

std::string sessions_table(const Json& answer) {
  const auto sessions = answer.find("sessions");
  if (sessions == answer.end() || !sessions->is_array()) return {};
  if (sessions->empty()) return fmt::format("no sessions in {}\n", text_at(answer, "/folder"));
  std::string text = fmt::format("{:<36} {:>10}  {}\n", "session", "kB", "last written (UTC)");
  for (const Json& session : *sessions) {
    const auto written = static_cast<std::time_t>(number_of(session, "written_s"));
    const std::string fault = text_at(session, "/fault");
    text += fmt::format("{:<36} {:>10.1f}  {:%Y-%m-%d %H:%M:%S}{}\n", text_at(session, "/name"),
                        static_cast<double>(number_of(session, "bytes")) / 1e3, fmt::gmtime(written),
                        is_said(fault) ? "  no session: " + fault : "");
  }
  return text;
}

int save_session(const Arguments& arguments) {
  return show(arguments, "session.save", &saved_text, Json{{"name", arguments.session}}, kDiskPatience);
}

int load_session(const Arguments& arguments) {
  Json params = pose_params(arguments);
  params["name"] = arguments.session;
  return show(arguments, "session.load", &loaded_text, params, kDiskPatience);
}

int confirm_session(const Arguments& arguments) {
  return show(arguments, "session.confirm", &loaded_text, pose_params(arguments), kDiskPatience);
}

}  // namespace topo::daemon
