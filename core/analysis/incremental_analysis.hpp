// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/analysis/analysis.hpp"

namespace topo::analysis {

/// analyse() of one map after the other, equal to the bit, by what the analysis before it left: of a map that
/// has grown or was corrected, distances and thinning are redone where something has changed; first labels,
/// too, while the box stays the same, and the compass's histograms while its walls' box does; walls and
/// regions while, too, the compass does not turn. Regions are always merged anew. One thread.
class IncrementalAnalysis {
 public:
  IncrementalAnalysis();
  ~IncrementalAnalysis();
  IncrementalAnalysis(const IncrementalAnalysis&) = delete;
  IncrementalAnalysis& operator=(const IncrementalAnalysis&) = delete;

  Analysis take(AnalysisInput input, const AnalysisParams& params, const StageWatch& done = {});

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace topo::analysis
