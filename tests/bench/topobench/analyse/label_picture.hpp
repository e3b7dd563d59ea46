// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

/// One number a pixel, the uppermost row first.
struct LabelPicture {
  int width = 0;
  int height = 0;
  bool coloured = false;  ///< of the file: its numbers are r + 256 g + 65536 b
  std::vector<std::uint32_t> values;
};

/// Reads a PNG file of grey levels (8 or 16 bit) or colours, without any conversion of them. Errors name the
/// file.
types::Result<LabelPicture> read_labels(const std::string& path);

/// Writes 16-bit grey levels; numbers above 65535 must not occur. Blocks on the disk.
types::Status save_labels(const std::string& path, const LabelPicture& labels);

}  // namespace topo::bench
