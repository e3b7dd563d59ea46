// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/suite_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/bench/topobench/fresh/floor_figures.hpp"
#include "tests/bench/topobench/fresh/suite.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/bench/topobench/table/table_world.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench {
namespace {

namespace fs = std::filesystem;
using fresh::FloorFigures;

types::Result<std::vector<FloorFigures>> figures_of(const std::vector<fs::path>& files) {
  std::vector<FloorFigures> out;
  for (const fs::path& file : files) {
    const auto world = sim::World::load(file);
    if (!world) return tl::unexpected(world.error());
    const auto start = own_start(file, *world);
    if (!start) return tl::unexpected(start.error());
    out.push_back(fresh::floor_figures(world->structure(), start->translation()));
    const FloorFigures& f = out.back();
    fmt::print(
        stderr,
        "{}: {:.0f} m2, {} passages, median {:.2f} m, {:.1f} small pieces in 100 m2, {:.1f} % furnished\n",
        file.stem().string(), f.floor_m2, f.doors_m.size(), fresh::quantile(f.doors_m, 0.5),
        f.pieces_per_100m2, 100.0 * f.furnished_share);
  }
  return out;
}

/// Lowest, quartiles, highest.
std::string spread(const std::vector<double>& values, const char* format) {
  std::string text;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    text += (text.empty() ? "" : " / ") + fmt::format(fmt::runtime(format), fresh::quantile(values, share));
  return text;
}

void print_column(const char* name, const std::vector<FloorFigures>& suite) {
  std::vector<double> areas, doors, per_100m2, pieces, shares;
  for (const FloorFigures& f : suite) {
    areas.push_back(f.floor_m2);
    doors.insert(doors.end(), f.doors_m.begin(), f.doors_m.end());
    per_100m2.push_back(100.0 * static_cast<double>(f.doors_m.size()) / std::max(f.floor_m2, 1.0));
    pieces.push_back(f.pieces_per_100m2);
    shares.push_back(100.0 * f.furnished_share);
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", name, suite.size(), spread(areas, "{:.0f}"),
             spread(per_100m2, "{:.1f}"), spread(doors, "{:.2f}"), spread(pieces, "{:.1f}"),
             spread(shares, "{:.1f}"));
}

types::Result<std::vector<fs::path>> files_of(const SuiteCommand& command) {
  if (command.suite == "dev") return fresh::dev_suite(command.plans);
  if (command.out.empty())
    return types::fail(types::Errc::kInvalidInput,
                       "--out: expected a folder for the buildings of a fresh suite");
  if (auto made = make_folder(command.out); !made) return tl::unexpected(made.error());
  return fresh::write_fresh_suite(command.seed, command.buildings, command.out);
}

}  // namespace

types::Status run_suite(const SuiteCommand& command) {
  const auto files = files_of(command);
  if (!files) return tl::unexpected(files.error());
  const auto figures = figures_of(*files);
  if (!figures) return tl::unexpected(figures.error());
  fmt::print(
      "Lowest / quartiles / highest. Passages: narrow ones, up to 2.1 m, between wider places; pieces: under "
      "1 m\n"
      "across, free on the floor; furnished: share of the floor under pieces of up to 3 m, percent.\n\n"
      "| suite | floors | m2 | passages in 100 m2 | width of passages, m | pieces in 100 m2 | furnished, % "
      "|\n"
      "|---|---|---|---|---|---|---|\n");
  print_column(command.suite == "dev" ? "public plans" : fmt::format("fresh, seed {}", command.seed).c_str(),
               *figures);
  if (command.suite == "dev" || command.plans.empty()) return {};
  const auto plans = fresh::dev_suite(command.plans);
  if (!plans) return tl::unexpected(plans.error());
  const auto beside = figures_of(*plans);
  if (!beside) return tl::unexpected(beside.error());
  print_column("public plans", *beside);
  return {};
}

}  // namespace topo::bench
