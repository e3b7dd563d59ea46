// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// An image in levels of grey, top row first. Its values are the file's numbers, never corrected for a
/// screen: a map holds measurements, not colours.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;  ///< 0 black to `greatest` white
  std::vector<bool> transparent;      ///< empty, or one value per pixel
  int greatest = 255;

  /// 0 black to 1 white.
  [[nodiscard]] double shade(std::size_t pixel) const {
    return static_cast<double>(pixels[pixel]) / static_cast<double>(greatest);
  }
};

/// Decodes a PGM file's content, P2 or P5 (Netpbm's pgm(5)), with a maximum value of up to 65535. A head
/// whose lines end in CR LF has been through a text converter: it is read where the number of bytes says
/// which of them are pixels, and else refused. `path` is for messages.
types::Result<GreyImage> decode_pgm(const std::string& path, std::string_view content);

/// Decodes a PNG file's content of 8 or 16 bits; colours are converted to the mean of red, green and blue.
/// Gamma, colour space and profile are ignored.
types::Result<GreyImage> decode_png(const std::string& path, std::string_view content);

/// kInvalidInput when the size is zero or exceeds the limits of a map.
types::Status check_size(const std::string& path, std::int64_t width, std::int64_t height);

}  // namespace topo::daemon
