// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/config/edit.hpp"

namespace topo::daemon {

/// The example file of a model as the text of a first configuration, without what it says of one robot.
[[nodiscard]] std::string first_configuration(RobotModel model);

/// What `topoctl setup` writes, where it differs from what `text` says: names, addresses, serial numbers,
/// places and senses of base and scanners, and the hull.
[[nodiscard]] std::vector<KeyEdit> setup_edits(std::string_view text, const Configuration& wanted);

/// `text` with these edits; the section of a coronal scanner that there is not is commented out. All else
/// stays.
[[nodiscard]] std::string configuration_text(std::string_view text, const Configuration& wanted);

}  // namespace topo::daemon
