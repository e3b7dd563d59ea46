// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/segment_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/types/se2.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/bench/topobench/analyse/analyse_command.hpp"
#include "tests/bench/topobench/analyse/label_picture.hpp"
#include "tests/bench/topobench/analyse/place_option.hpp"
#include "tests/bench/topobench/analyse/segment_score.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using types::Result;
using types::Status;

/// Names of the PNG files in a folder, in order.
Result<std::vector<std::string>> pictures_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".png") names.push_back(it->path().filename().string());
  }
  if (error) {
    return types::fail(types::Errc::kNotFound, fmt::format("{}: {}; expected a folder of PNG files",
                                                           folder.string(), error.message()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

Status analyse_one(const SegmentCommand& command, const analysis::AnalysisParams& params,
                   const std::string& name) {
  const auto input = read_map_input((command.maps / name).string(), command.resolution_m);
  if (!input) return tl::unexpected(input.error());
  const TimedAnalysis timed = timed_analysis(input->map, 1, params);
  if (auto s = save_labels((command.labels / name).string(), labels_of(*input, timed.analysis)); !s) return s;
  const auto overview = daemon::overview_of(timed.analysis, {}, timed.analysis.goals.goals);
  return daemon::save_png((command.labels / "overlay" / name).string(), overview);
}

Status analyse_all(const SegmentCommand& command, const fs::path& truth) {
  analysis::AnalysisParams params;
  for (const auto& [name, value] : command.set)
    if (auto done = set_place_param(name, value, params.places); !done) return done;
  if (auto made = make_folder(command.labels / "overlay"); !made) return made;
  const auto names = pictures_in(command.maps);
  if (!names) return tl::unexpected(names.error());
  for (const std::string& name : *names) {
    if (!fs::exists(truth / name)) continue;
    if (auto done = analyse_one(command, params, name); !done) return done;
  }
  return {};
}

Result<SegmentScore> score_one(const fs::path& labels, const fs::path& truth, double turn_deg) {
  const auto segments = read_labels(labels.string());
  if (!segments) return tl::unexpected(segments.error());
  const auto rooms = read_labels(truth.string());
  if (!rooms) return tl::unexpected(rooms.error());
  auto scored = score(*segments, rooms_of(*rooms), turn_deg * types::kDegree_rad);
  if (!scored) {
    return types::fail(scored.error().code, fmt::format("{}: {}", labels.string(), scored.error().message));
  }
  return scored;
}

double per_room(const SegmentScore& s) {
  return s.rooms == 0 ? 0.0 : static_cast<double>(s.segments) / static_cast<double>(s.rooms);
}

json to_json(const SegmentScore& s) {
  return {{"recall_micro", s.recall_micro},
          {"precision_micro", s.precision_micro},
          {"recall_macro", s.recall_macro},
          {"precision_macro", s.precision_macro},
          {"mcc", s.mcc},
          {"segments_per_room", per_room(s)},
          {"segments", s.segments},
          {"rooms", s.rooms}};
}

/// With maps, labels are written: not over the pictures of others.
Status check(const SegmentCommand& command, const fs::path& truth) {
  constexpr double kMost_deg = 360.0;
  if (!(std::abs(command.turn_deg) <= kMost_deg)) {
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("--turn: found {}, expected degrees from -360 to 360", command.turn_deg));
  }
  if (command.maps.empty()) return {};
  std::error_code error;
  for (const fs::path& other : {command.maps, command.truth, truth}) {
    if (fs::equivalent(command.labels, other, error)) {
      return types::fail(
          types::Errc::kInvalidInput,
          fmt::format("--labels: found {}, which holds the maps or their truth, expected another "
                      "folder: with --maps the labels are written there",
                      command.labels.string()));
    }
  }
  return {};
}

json means(const json& each) {
  json report{{"maps", each.size()}};
  for (const char* key :
       {"recall_micro", "precision_micro", "recall_macro", "precision_macro", "mcc", "segments_per_room"}) {
    double sum = 0.0;
    for (const json& one : each) sum += one[key].get<double>();
    report[key] = sum / static_cast<double>(each.size());
  }
  return report;
}

}  // namespace

Status run_segment(const SegmentCommand& command) {
  const fs::path lines = command.truth / "gt_lines";
  const fs::path truth = fs::is_directory(lines) ? lines : command.truth;
  if (auto checked = check(command, truth); !checked) return checked;
  if (!command.maps.empty()) {
    if (auto done = analyse_all(command, truth); !done) return done;
  }
  const auto names = pictures_in(command.labels);
  if (!names) return tl::unexpected(names.error());
  json each = json::object();
  for (const std::string& name : *names) {
    if (!fs::exists(truth / name)) continue;
    const auto scored = score_one(command.labels / name, truth / name, command.turn_deg);
    if (!scored) return tl::unexpected(scored.error());
    each[fs::path(name).stem().string()] = to_json(*scored);
  }
  if (each.empty()) {
    return types::fail(
        types::Errc::kNotFound,
        fmt::format("{}: found {} pictures (PNG), and of none the true rooms under its name in {}",
                    command.labels.string(), names->size(), truth.string()));
  }
  json report = means(each);
  report["each"] = std::move(each);
  fmt::print("{}\n", command.json ? report.dump() : report.dump(2));
  return {};
}

}  // namespace topo::bench
