// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/types/scan.hpp"

namespace topo::daemon {

/// Of a picture in characters, which are twice as high as wide.
struct ScanPictureParams {
  double reach_m = 3.0;  ///< from the scanner to each edge
  std::size_t rows = 15;
  std::size_t columns = 37;
};

/// The lines of a picture of a scan from above: the scanner is the + in the middle, its zero beam points up,
/// # is what it sees.
[[nodiscard]] std::vector<std::string> scan_picture(const types::Scan& scan,
                                                    const ScanPictureParams& params = {});

/// Pictures beside each other, each below its title.
[[nodiscard]] std::string side_by_side(std::span<const std::string> titles,
                                       std::span<const std::vector<std::string>> pictures);

}  // namespace topo::daemon
