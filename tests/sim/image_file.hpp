// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/types/result.hpp"

namespace topo::sim {

/// Grey image, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Reads PNG (colour is converted to grey) and PGM (P2, P5, up to 255). Errors name the file and the fault.
types::Result<GreyImage> read_image(const std::filesystem::path& file);

/// Writes a PNG of 8 bits. The same image gives the same bytes.
types::Status write_png(const GreyImage& image, const std::filesystem::path& file);

}  // namespace topo::sim
