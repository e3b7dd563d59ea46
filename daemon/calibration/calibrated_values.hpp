// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/calibrate.hpp"
#include "daemon/config/edit.hpp"

namespace topo::daemon {

/// One number of a calibration, by its key in the configuration.
struct CalibratedValue {
  std::string key;  ///< "base.track_m"
  double before = 0.0, found = 0.0, sigma = 0.0;
  std::string effect;  ///< what the change does, in words
};

/// All numbers that a drive calibrated; none where there was no fit. Those of the coronal scanner only where
/// floor or walls determined them.
[[nodiscard]] std::vector<CalibratedValue> calibrated_values(const calibration::Calibration& found,
                                                             const calibration::Assumed& before);

/// The same as they are written to a configuration, in five digits: a hundredth of a millimetre.
[[nodiscard]] std::vector<KeyEdit> edits_of(std::span<const CalibratedValue> values);

}  // namespace topo::daemon
