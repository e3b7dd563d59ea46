// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/analyse_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/goals/frontiers.hpp"
#include "core/types/se2.hpp"
#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/picture.hpp"
#include "daemon/mapfile/places_geojson.hpp"
#include "tests/bench/topobench/analyse/compass_plot.hpp"
#include "tests/bench/topobench/analyse/label_picture.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

json stage_times(const TimedAnalysis& timed) {
  json stages;
  for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
    const auto& ms = timed.ms[stage];
    stages[std::string(kStageNames[stage])] = {
        {"min", ms.front()}, {"median", ms[ms.size() / 2]}, {"max", ms.back()}};
  }
  return stages;
}

json goals_of(const MapInput& input, const analysis::Analysis& analysis) {
  json goals = json::array();
  for (const goals::Goal& goal : analysis.goals.goals) {
    const types::Vector2 p_map = input.origin + goal.p_map;
    goals.push_back({{"x_m", p_map.x()},
                     {"y_m", p_map.y()},
                     {"place", goal.place},
                     {"side", goals::to_text(goal.side)},
                     {"why", fmt::format("an opening of {:.2f} m to unknown space on this side of its place",
                                         goal.opening_m)}});
  }
  return goals;
}

json rejected_by_reason(const analysis::Analysis& analysis) {
  json reasons = json::object();
  for (const goals::Goal& goal : analysis.goals.rejected) {
    const std::string why(goals::to_text(goal.verdict));
    reasons[why] = reasons.value(why, 0) + 1;
  }
  return reasons;
}

json wings_deg(const analysis::Analysis& analysis) {
  json wings = json::array();
  for (const double wing_rad : analysis.wings_rad) wings.push_back(wing_rad / types::kDegree_rad);
  return wings;
}

json report(const AnalyseCommand& command, const MapInput& input, const TimedAnalysis& timed) {
  const analysis::Analysis& a = timed.analysis;
  const auto unknown = std::count(a.map.cells.begin(), a.map.cells.end(), grid::CellState::kUnknown);
  json compass = nullptr;
  if (a.compass.angle_rad) compass = *a.compass.angle_rad / types::kDegree_rad;
  return {{"map", command.map},
          {"cells", static_cast<std::int64_t>(input.width) * input.height},
          {"known_cells", static_cast<std::int64_t>(a.map.cells.size()) - unknown},
          {"resolution_m", input.map.resolution_m},
          {"stage_ms", stage_times(timed)},
          {"one_pass_ms", one_pass_ms(a.map)},
          {"compass_deg", std::move(compass)},
          {"compass_confidence", a.compass.confidence},
          {"wings_deg", wings_deg(a)},
          {"walls", a.walls.size()},
          {"skeleton_nodes", a.skeleton.nodes.size()},
          {"places", a.places.places.size()},
          {"goals", goals_of(input, a)},
          {"rejected_goals", a.goals.rejected.size()},
          {"rejected_why", rejected_by_reason(a)},
          {"frontier_clusters", goals::find_frontiers(a.map).size()},
          {"peak_rss_mb", peak_rss_mb()}};
}

types::Status write_files(const AnalyseCommand& command, const MapInput& input,
                          const analysis::Analysis& analysis) {
  const auto file = [&](const char* name) { return (command.out / name).string(); };
  if (auto s = save_labels(file("labels.png"), labels_of(input, analysis)); !s) return s;
  const auto overview = daemon::overview_of(analysis, {}, analysis.goals.goals);
  if (auto s = daemon::save_png(file("overlay.png"), overview); !s) return s;
  const std::string geojson = daemon::places_geojson(analysis, analysis.goals.goals, input.origin);
  if (auto s = daemon::write_file(file("places.geojson"), geojson); !s) return s;
  return daemon::save_png(file("compass.png"), compass_plot(analysis.compass));
}

}  // namespace

LabelPicture labels_of(const MapInput& input, const analysis::Analysis& analysis) {
  LabelPicture picture{input.width, input.height, false, {}};
  picture.values.assign(static_cast<std::size_t>(input.width) * static_cast<std::size_t>(input.height), 0);
  const std::vector<std::uint16_t> labels = analysis.places.labels.by_cell(analysis.map.cells.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const grid::CellIndex cell = analysis.map.cell(i);
    if (labels[i] != 0 && input.inside(cell)) picture.values[input.pixel(cell)] = labels[i];
  }
  return picture;
}

types::Status run_analyse(const AnalyseCommand& command) {
  if (command.resolution_m && names_map_yaml(command.map)) {
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("--resolution: found {} for {}, expected it of a picture alone: a YAML "
                                   "file has its own",
                                   *command.resolution_m, command.map));
  }
  constexpr double kUsual_m = 0.05;
  const auto input = read_map_input(command.map, command.resolution_m.value_or(kUsual_m));
  if (!input) return tl::unexpected(input.error());
  print_warnings(command.map, input->warnings);
  if (auto made = make_folder(command.out); !made) return made;
  const TimedAnalysis timed = timed_analysis(input->map, command.repeat);
  const json printed = report(command, *input, timed);
  if (!command.out.empty()) {
    if (auto written = write_files(command, *input, timed.analysis); !written) return written;
  }
  fmt::print("{}\n", command.json ? printed.dump() : printed.dump(2));
  return {};
}

}  // namespace topo::bench
