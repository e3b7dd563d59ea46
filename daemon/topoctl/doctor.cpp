// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"

namespace topo::daemon {
namespace {

/// The only check that the client makes.
Json reachable(const types::Status& status, const std::string& socket) {
  Json check{{"check", "daemon"}, {"ok", status.has_value()},
             {"warning", false},  {"found", "answers on " + socket},
             {"cure", ""},        {"safer", ""}};
  if (status) return check;
  check["found"] = status.error().message;
  if (status.error().code == types::Errc::kTimeout) {
    check["cure"] =
        "it hangs: topometric-estop --config FILE --force ends it and stops the robot; then start it "
        "(systemctl restart topometric)";
    return check;
  }
  check["cure"] =
      "start it (systemctl start topometric; journalctl -u topometric says why it ended), or name its socket "
      "with --socket (control.socket of its configuration)";
  return check;
}

}  // namespace

int doctor(const Arguments& arguments) {
  auto answer = ask(arguments, "doctor");
  const bool answered = answer.has_value();
  Json result = answered ? *answer : Json{{"ok", false}, {"checks", Json::array()}};
  const types::Status status = answered ? types::Status() : types::Status(tl::unexpected(answer.error()));
  if (Json& checks = result["checks"]; checks.is_array())
    checks.insert(checks.begin(), reachable(status, arguments.socket));
  if (arguments.json) {
    fmt::print("{}\n", pretty(result));
  } else {
    fmt::print("{}", doctor_table(result));
  }
  if (!answered) return status_of(answer.error());
  return text_at(result, "/ok") == "yes" ? kOk : kFailed;
}

}  // namespace topo::daemon
