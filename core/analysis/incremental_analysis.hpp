// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/analysis/analysis.hpp"

namespace topo::analysis {

/// analyse() of successive maps, with bit-identical results, reusing the previous analysis. Distances and
/// thinning are redone only where the map has changed. The same holds for first labels while the box stays
/// the same, for the compass's histograms while the box of its points stays the same, and for walls and
/// regions while, in addition, the compass angle stays the same. Regions are always merged anew. One thread.
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
