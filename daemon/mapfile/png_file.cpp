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

/// The file without what is said of colours (gamma, colour space, profile) and without comments: of its
/// chunks those that hold numbers. libpng would correct the numbers for a screen. A file with a damaged chunk
/// stays as it is from there on.
std::string numbers_alone(std::string_view content) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // a chunk's length, name and checksum
  std::string kept(content.substr(0, kSignature));
  std::size_t at = kept.size();
  while (content.size() - at >= kFrame) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | static_cast<unsigned char>(content[at + i]);
    if (length > content.size() - at - kFrame) break;
    const std::string_view name = content.substr(at + 4, 4);
    const bool critical = name.front() >= 'A' && name.front() <= 'Z';
    if (critical || name == "tRNS") kept += content.substr(at, kFrame + length);
    at += kFrame + length;
  }
  kept += content.substr(at);
  return kept;
}

/// The mean of three channels as their sum over three times the greatest value, which is exact.
void take_bytes(const std::vector<png_byte>& rgba, GreyImage& grey) {
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
    grey.pixels[i] = static_cast<std::uint16_t>(rgba[4 * i] + rgba[4 * i + 1] + rgba[4 * i + 2]);
    grey.transparent[i] = rgba[4 * i + 3] < 128;
  }
  grey.greatest = 3 * 255;
}

/// In 16 bits libpng gives colours that are multiplied by their opacity.
void take_words(const std::vector<png_uint_16>& rgba, GreyImage& grey) {
  constexpr std::uint32_t kOpaque = 65535;
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
    const std::uint64_t sum = std::uint64_t{rgba[4 * i]} + rgba[4 * i + 1] + rgba[4 * i + 2];
    const std::uint32_t alpha = rgba[4 * i + 3];
    grey.transparent[i] = alpha < kOpaque / 2 + 1;
    const std::uint64_t mean = alpha == 0 ? 0 : (sum * kOpaque + 3 * alpha / 2) / (std::uint64_t{3} * alpha);
    grey.pixels[i] = static_cast<std::uint16_t>(std::min<std::uint64_t>(mean, kOpaque));
  }
  grey.greatest = kOpaque;
}

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
  const std::string numbers = numbers_alone(content);
  if (png_image_begin_read_from_memory(&png.image, numbers.data(), numbers.size()) == 0) return damaged();
  if (auto s = check_size(path, png.image.width, png.image.height); !s.has_value())
    return tl::unexpected(s.error());
  if (is_too_short(numbers, png.image)) {
    return bad_file(path, "",
                    fmt::format("a PNG file of {} bytes that claims {} x {} pixels", content.size(),
                                png.image.width, png.image.height),
                    "one that contains its pixels");
  }
  const std::size_t pixels = std::size_t{png.image.width} * png.image.height;
  GreyImage grey{static_cast<int>(png.image.width), static_cast<int>(png.image.height),
                 std::vector<std::uint16_t>(pixels), std::vector<bool>(pixels), 0};
  // Without a gamma libpng takes 16 bits for linear and 8 bits for sRGB; asked for the same it changes
  // nothing.
  if ((png.image.format & PNG_FORMAT_FLAG_LINEAR) != 0) {
    png.image.format = PNG_FORMAT_LINEAR_RGB_ALPHA;
    std::vector<png_uint_16> rgba(4 * pixels);
    if (png_image_finish_read(&png.image, nullptr, rgba.data(), 0, nullptr) == 0) return damaged();
    take_words(rgba, grey);
  } else {
    png.image.format = PNG_FORMAT_RGBA;
    std::vector<png_byte> rgba(4 * pixels);
    if (png_image_finish_read(&png.image, nullptr, rgba.data(), 0, nullptr) == 0) return damaged();
    take_bytes(rgba, grey);
  }
  return grey;
}

Status save_png(const std::string& path, const Picture& picture) {
  PngImage png;
  png.image.width = static_cast<png_uint_32>(picture.width());
  png.image.height = static_cast<png_uint_32>(picture.height());
  png.image.format = PNG_FORMAT_RGB;
  // Packed twice, first for the size alone: a picture takes a few per cent of the most that it may take.
  std::vector<std::byte> bytes;
  for (const bool for_size : {true, false}) {
    png_alloc_size_t size = bytes.size();
    void* memory = for_size ? nullptr : bytes.data();
    if (png_image_write_to_memory(&png.image, memory, &size, 0, picture.pixels().data(), 0, nullptr) == 0)
      return types::fail(Errc::kIo, fmt::format("{}: cannot pack the picture: {}", path, png.image.message));
    bytes.resize(size);
  }
  return write_file(path, bytes);
}

}  // namespace topo::daemon
