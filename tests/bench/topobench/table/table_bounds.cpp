// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_bounds.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "tests/bench/topobench/bound/bound_command.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

constexpr int kMethod = 2;  // of finding them: another number finds them anew

struct Wanted {
  const TableWorld* world;
  std::uint64_t seed;
  int robots;

  [[nodiscard]] const sim::Se2& start() const { return world->starts[seed - 1]; }
  [[nodiscard]] json key() const {
    return {{"bound", kMethod},
            {"world", world->name},
            {"building", world->building},
            {"robots", robots},
            {"start", {start().x_m, start().y_m, start().theta_rad}}};
  }
};

std::optional<KnownBound> bound_in(const json& report) {
  const auto at = [&](const char* key) -> std::optional<double> {
    if (!report.contains(key) || !report[key].contains("0.99") || !report[key]["0.99"].is_number())
      return std::nullopt;
    return report[key]["0.99"].get<double>();
  };
  const auto way_m = at("m_per_robot"), lower_m = at("lower_m_per_robot");
  if (!way_m || !lower_m) return std::nullopt;
  return KnownBound{*way_m, *lower_m};
}

types::Status find(const std::vector<Wanted>& missing, const WorkerLimits& limits, RunLog& log) {
  const auto work = [&](std::size_t job) -> types::Result<std::string> {
    const Wanted& wanted = missing[job];
    BoundCommand command;
    command.world = wanted.world->file;
    command.robots = wanted.robots;
    command.start = {wanted.start().x_m, wanted.start().y_m, wanted.start().theta_rad};
    const auto report = bound_report(command);
    if (!report) return tl::unexpected(report.error());
    return report->dump();
  };
  const auto done = [&](std::size_t job, const types::Result<std::string>& text) -> types::Status {
    if (!text) return log.append_crash(missing[job].key(), text.error().message);
    return log.append(missing[job].key(), json::parse(*text, nullptr, false));
  };
  return run_in_processes(missing.size(), limits, work, done);
}

}  // namespace

types::Result<Bounds> table_bounds(std::span<const TableWorld> worlds, std::span<const int> robots,
                                   const WorkerLimits& limits, bool find_missing, RunLog& log) {
  std::vector<Wanted> all, missing;
  for (const TableWorld& world : worlds) {
    for (std::uint64_t seed = 1; seed <= world.starts.size(); ++seed) {
      for (const int n : robots) all.push_back({&world, seed, n});
    }
  }
  for (const Wanted& wanted : all) {
    if (find_missing && log.find(wanted.key()) == nullptr) missing.push_back(wanted);
  }
  if (!missing.empty()) fmt::print(stderr, "{} bounds with full knowledge are found\n", missing.size());
  if (auto found = find(missing, limits, log); !found) return tl::unexpected(found.error());
  Bounds bounds;
  for (const Wanted& wanted : all) {
    const json* report = log.find(wanted.key());
    const auto known = report != nullptr ? bound_in(*report) : std::nullopt;
    if (known) bounds[{wanted.world->name, wanted.seed, wanted.robots}] = *known;
  }
  return bounds;
}

}  // namespace topo::bench
