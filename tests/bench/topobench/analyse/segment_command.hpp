// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct SegmentCommand {
  std::filesystem::path labels;  ///< folder of label pictures
  std::filesystem::path truth;   ///< folder of pictures of the same names, or one that holds `gt_lines`
  std::filesystem::path maps;    ///< folder of maps to analyse first, into `labels`; empty: none
  double resolution_m = 0.05;
  double turn_deg = 0.0;  ///< of the truth's pictures against the maps, counter-clockwise
  /// Parameters of the segmentation that are not as they are, by name (place_option.hpp).
  std::vector<std::pair<std::string, double>> set;
  bool json = false;
};

/// `topobench segment`: scores label pictures against the truth and prints the report of REPORTS "topobench
/// segment". With `maps` every map there that has a truth is analysed first; its labels go into `labels`,
/// and its overlay beside them into a folder `overlay`. Pictures without a truth are passed over.
types::Status run_segment(const SegmentCommand& command);

}  // namespace topo::bench
