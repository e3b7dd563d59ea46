// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/calibration/verdict.hpp"
#include "core/types/se2.hpp"

namespace topo::daemon {

/// Angles are told in degrees.
[[nodiscard]] inline double in_degrees(double rad) { return rad / types::kDegree_rad; }

/// One sentence: what was the matter with the drive, with its number, and what to do.
[[nodiscard]] std::string refusal_text(const calibration::Refusal& refusal);

/// "yaw of the front scanner" of a number.
[[nodiscard]] std::string_view number_name(calibration::Number number);

}  // namespace topo::daemon
