// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "daemon/calibration/calibrated_values.hpp"

namespace topo::daemon {

/// The drive, the numbers with standard deviations and effects, and the verdict, as a person reads them.
[[nodiscard]] std::string calibration_text(const calibration::Calibration& found,
                                           std::span<const CalibratedValue> values);
/// The same for programs.
[[nodiscard]] nlohmann::json calibration_json(const calibration::Calibration& found,
                                              std::span<const CalibratedValue> values);

}  // namespace topo::daemon
