// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// An image in levels of grey, top row first.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 0 black to 255 white
  std::vector<bool> transparent;     ///< empty, or one value per pixel
};

/// Decodes a PGM file's content, P2 or P5 (Netpbm's pgm(5)), with a maximum value of up to 255. `path` is for
/// messages.
types::Result<GreyImage> decode_pgm(const std::string& path, std::string_view content);

/// Decodes a PNG file's content; colours are converted to the mean of red, green and blue.
types::Result<GreyImage> decode_png(const std::string& path, std::string_view content);

/// kInvalidInput when the size is zero or exceeds the limits of a map.
types::Status check_size(const std::string& path, std::int64_t width, std::int64_t height);

}  // namespace topo::daemon
