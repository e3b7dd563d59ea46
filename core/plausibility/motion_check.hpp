// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/plausibility/params.hpp"
#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"

namespace topo::plausibility {

/// True when the model cannot have made the reported motion: faster than its catalogue, or a pose that the
/// speeds of this status and the one before do not lead to. `before`: null for the first status.
[[nodiscard]] bool is_impossible(const types::Odometry* before, const types::Odometry& now,
                                 const types::ModelSize& model, const MotionParams& params);

}  // namespace topo::plausibility
