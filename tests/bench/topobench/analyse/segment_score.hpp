// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/types/result.hpp"
#include "tests/bench/topobench/analyse/label_picture.hpp"

namespace topo::bench {

/// Measures of Bormann et al. (Room segmentation: survey, implementation, and analysis, ICRA 2016) and the
/// correlation of rooms matched one to one as in MAORIS (Mielle et al. 2018). Fractions.
struct SegmentScore {
  double recall_micro = 0.0;     ///< mean over true rooms of the share that one segment covers
  double precision_micro = 0.0;  ///< mean over segments of the share that lies in one room
  double recall_macro = 0.0;     ///< the same weighted by area
  double precision_macro = 0.0;
  double mcc = 0.0;
  std::size_t segments = 0;
  std::size_t rooms = 0;
};

/// Numbers the rooms of a truth picture from 1: of a grey one the areas above 250, connected over eight
/// neighbours, between drawn lines; of a coloured one each colour but black. What has at most 100 pixels is
/// none and becomes 0.
LabelPicture rooms_of(const LabelPicture& truth);

/// `rooms` from rooms_of; where they are larger than the segmentation, that lies in their middle. It is
/// turned by `turn_rad` first, counter-clockwise for the eye. kInvalidInput for other differences of size.
types::Result<SegmentScore> score(const LabelPicture& segments, const LabelPicture& rooms,
                                  double turn_rad = 0.0);

}  // namespace topo::bench
