// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/contact/contact_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace topo::bench {
namespace {

nlohmann::json kinds_of(const ContactResult& result) {
  nlohmann::json kinds;
  for (std::size_t kind = 0; kind < team::kMessageKinds; ++kind)
    kinds[std::string(to_text(static_cast<team::MessageKind>(kind)))] = result.steady_bytes_per_s_of.at(kind);
  return kinds;
}

void print_json(const ContactCommand& command, const ContactResult& result) {
  const nlohmann::json report{{"robots", command.setup.robots},
                              {"keyframes", command.setup.keyframes},
                              {"loss", command.setup.loss},
                              {"same_sets", result.same_sets},
                              {"same_after_s", result.same_after_s},
                              {"share_10_50_90_s", result.shares_s},
                              {"catch_up_bytes_per_s", result.catch_up_bytes_per_s},
                              {"repeated", result.repeated},
                              {"assembly_bytes_max", result.assembly_bytes_max},
                              {"steady_bytes_per_s", result.steady_bytes_per_s},
                              {"steady_bytes_per_s_of", kinds_of(result)},
                              {"steady_lag_s", result.steady_lag_s},
                              {"cpu_s", result.cpu_s}};
  fmt::print("{}\n", report.dump());
}

void print_text(const ContactCommand& command, const ContactResult& result) {
  fmt::print("{} robots with {} keyframes each, {:.0f} % loss: {} after {:.1f} s\n", command.setup.robots,
             command.setup.keyframes, 100.0 * command.setup.loss,
             result.same_sets ? "same sets" : "sets still different", result.same_after_s);
  fmt::print(
      "  10, 50, 90 % of what was lacking after {:.0f}, {:.0f}, {:.0f} s; {:.1f} kB/s a robot; {:.1f} % "
      "repeated\n",
      result.shares_s[0], result.shares_s[1], result.shares_s[2], result.catch_up_bytes_per_s / 1000.0,
      100.0 * result.repeated);
  fmt::print("  incomplete items took at most {:.0f} kB; {:.1f} s of processor time in all\n",
             static_cast<double>(result.assembly_bytes_max) / 1000.0, result.cpu_s);
  if (!result.same_sets) return;
  fmt::print("steady: {:.2f} kB/s a robot, at most {:.1f} s behind; of these\n",
             result.steady_bytes_per_s / 1000.0, result.steady_lag_s);
  for (std::size_t kind = 0; kind < team::kMessageKinds; ++kind)
    fmt::print("  {:9} {:6.0f} B/s\n", to_text(static_cast<team::MessageKind>(kind)),
               result.steady_bytes_per_s_of.at(kind));
}

}  // namespace

types::Status run_contact_command(const ContactCommand& command) {
  const ContactResult result = run_contact(command.setup);
  command.json ? print_json(command, result) : print_text(command, result);
  if (!result.same_sets)
    return types::fail(
        types::Errc::kTimeout,
        fmt::format("contact: the sets differ after {} s, expected the same", command.setup.limit_s));
  return {};
}

}  // namespace topo::bench
