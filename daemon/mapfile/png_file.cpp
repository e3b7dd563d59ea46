// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Uses libpng's simplified interface, which reports errors by return values, not by longjmp.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <vector>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/mapfile/picture.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;
using types::Status;

namespace {

/// Frees libpng's data in all cases.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

/// Most bytes that one byte of a deflate stream can become (RFC 1951: 258 from two bits at best).
constexpr std::int64_t kInflates = 1032;

std::int64_t bits_of_pixel(std::string_view content) {
  constexpr std::size_t kDepth = 24, kColours = 25;  // in IHDR, which is the first chunk
  constexpr std::array<int, 7> kChannels{1, 1, 3, 1, 2, 1, 4};
  const auto at = [content](std::size_t i) { return static_cast<std::uint8_t>(content[i]); };
  return std::int64_t{at(kDepth)} * kChannels[std::min<std::size_t>(at(kColours), kChannels.size() - 1)];
}

/// True when a file of this size cannot contain so many pixels: memory is not reserved for what a file of
/// some bytes claims.
bool is_too_short(std::string_view content, const png_image& image) {
  const std::int64_t row = (std::int64_t{image.width} * bits_of_pixel(content) + 7) / 8 + 1;
  return row * image.height > kInflates * static_cast<std::int64_t>(content.size());
}

}  // namespace

Result<GreyImage> decode_png(const std::string& path, std::string_view content) {
  PngImage png;
  const auto damaged = [&] {
    return bad_file(path, "", fmt::format("a damaged PNG file ({})", png.image.message), "a whole one");
  };
  if (png_image_begin_read_from_memory(&png.image, content.data(), content.size()) == 0) return damaged();
  if (auto s = check_size(path, png.image.width, png.image.height); !s.has_value())
    return tl::unexpected(s.error());
  if (is_too_short(content, png.image)) {
    return bad_file(path, "",
                    fmt::format("a PNG file of {} bytes that claims {} x {} pixels", content.size(),
                                png.image.width, png.image.height),
                    "one that contains its pixels");
  }
  png.image.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> rgba(PNG_IMAGE_SIZE(png.image));
  if (png_image_finish_read(&png.image, nullptr, rgba.data(), 0, nullptr) == 0) return damaged();
  const std::size_t pixels = rgba.size() / 4;
  GreyImage grey{static_cast<int>(png.image.width), static_cast<int>(png.image.height),
                 std::vector<std::uint8_t>(pixels), std::vector<bool>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    const int sum = rgba[4 * i] + rgba[4 * i + 1] + rgba[4 * i + 2];
    grey.pixels[i] = static_cast<std::uint8_t>((sum + 1) / 3);
    grey.transparent[i] = rgba[4 * i + 3] < 128;
  }
  return grey;
}

Status save_png(const std::string& path, const Picture& picture) {
  PngImage png;
  png.image.width = static_cast<png_uint_32>(picture.width());
  png.image.height = static_cast<png_uint_32>(picture.height());
  png.image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, picture.pixels().data(), 0, nullptr) ==
      0) {
    return types::fail(Errc::kIo, fmt::format("{}: cannot pack the picture: {}", path, png.image.message));
  }
  return write_file(path, std::span<const std::byte>(bytes).first(size));
}

}  // namespace topo::daemon
