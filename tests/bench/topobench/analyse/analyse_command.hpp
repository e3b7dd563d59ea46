// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/types/result.hpp"
#include "tests/bench/topobench/analyse/label_picture.hpp"
#include "tests/bench/topobench/analyse/map_input.hpp"
#include "tests/bench/topobench/analyse/timed_analysis.hpp"

namespace topo::bench {

struct AnalyseCommand {
  std::string map;
  std::optional<double> resolution_m;  ///< of a picture without a YAML file; else 0.05
  int repeat = 1;
  std::filesystem::path out;  ///< empty: no files
  bool json = false;
};

/// `topobench analyse`: the topometric analysis of one map file; prints the report of REPORTS "topobench
/// analyse" and writes labels.png, overlay.png, places.geojson and compass.png.
types::Status run_analyse(const AnalyseCommand& command);

/// Place numbers in the size of the picture that the map came from.
LabelPicture labels_of(const MapInput& input, const analysis::Analysis& analysis);

}  // namespace topo::bench
