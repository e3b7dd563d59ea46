// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/image_file.hpp"

#include <png.h>

#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace topo::sim {

namespace {

using types::Errc;

constexpr std::int64_t kPixelsMax = 100'000'000;  // 500 m x 500 m at 0.05 m

tl::unexpected<types::Error> bad(const std::filesystem::path& file, const std::string& what) {
  return types::fail(Errc::kInvalidInput, file.string() + ": " + what);
}

// The chunks with pixels, palette and opacity: libpng would correct the numbers by those on colours.
std::string without_colours(const std::string& bytes) {
  constexpr std::size_t kSignature = 8, kAround = 12;
  std::string kept = bytes.substr(0, kSignature);
  std::size_t at = kept.size();
  while (bytes.size() >= at + kAround) {
    std::uint32_t length = 0;
    for (std::size_t i = at; i < at + 4; ++i) length = length * 256U + static_cast<unsigned char>(bytes[i]);
    if (bytes.size() - at - kAround < length) break;
    const bool needed =
        std::isupper(static_cast<unsigned char>(bytes[at + 4])) != 0 || bytes.compare(at + 4, 4, "tRNS") == 0;
    if (needed) kept.append(bytes, at, kAround + length);
    at += kAround + length;
  }
  return kept.append(bytes, at, std::string::npos);
}

types::Result<GreyImage> read_png(const std::filesystem::path& file, const std::string& packed) {
  const std::string bytes = without_colours(packed);
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return bad(file, std::string("broken PNG: ") + png.message);
  }
  if (static_cast<std::int64_t>(png.width) * png.height > kPixelsMax) {
    png_image_free(&png);
    return bad(file, "image of more than 100 million pixels; expected a building");
  }
  png.format = PNG_FORMAT_GRAY;
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits are scaled to 8, not taken for light
  GreyImage image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    return bad(file, std::string("broken PNG: ") + png.message);
  }
  return image;
}

// Next number of a PGM header or P2 body; comments extend from # to the end of the line.
std::optional<int> next_number(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size()) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else if (std::isspace(static_cast<unsigned char>(bytes[at])) != 0) {
      ++at;
    } else {
      break;
    }
  }
  int value = 0;
  const auto [end, error] = std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), value);
  if (error != std::errc{} || value < 0) return std::nullopt;
  at = static_cast<std::size_t>(end - bytes.data());
  return value;
}

types::Result<GreyImage> read_pgm(const std::filesystem::path& file, const std::string& bytes) {
  std::size_t at = 2;
  const auto width = next_number(bytes, at);
  const auto height = next_number(bytes, at);
  const auto top = next_number(bytes, at);
  if (!width || !height || !top || *width == 0 || *height == 0)
    return bad(file, "PGM header without width, height and maximum");
  if (*top == 0 || *top > 65535)
    return bad(file, "PGM maximum " + std::to_string(*top) + "; expected 1 to 65535");
  const std::int64_t count = static_cast<std::int64_t>(*width) * *height;
  if (count > kPixelsMax) return bad(file, "image of more than 100 million pixels; expected a building");
  GreyImage image{*width, *height, {}};
  const bool binary = bytes[1] == '5';
  const auto grey = [&](int value) { return static_cast<std::uint8_t>(std::min(255, value * 255 / *top)); };
  if (binary) {
    ++at;  // one white space ends the header
    const bool wide = *top > 255;
    const std::size_t there = bytes.size() > at ? bytes.size() - at : 0;
    const std::size_t needed = static_cast<std::size_t>(count) * (wide ? 2U : 1U);
    if (there < needed) {
      return bad(file, "PGM cut off: " + std::to_string(there) + " of " + std::to_string(needed) + " bytes");
    }
    if (there > needed && std::isspace(static_cast<unsigned char>(bytes[at])) != 0) {
      // A text converter wrote CR LF, or something follows the pixels: the number of bytes tells, or nothing.
      if (there > needed + 1)
        return bad(file, "PGM with CR LF and too many bytes; expected one white space before the pixels");
      ++at;
    }
    image.pixels.reserve(static_cast<std::size_t>(count));
    for (const std::size_t end = at + needed; at < end; at += wide ? 2U : 1U) {
      const int first = static_cast<unsigned char>(bytes[at]);
      image.pixels.push_back(grey(wide ? 256 * first + static_cast<unsigned char>(bytes[at + 1]) : first));
    }
  } else {
    for (std::int64_t i = 0; i < count; ++i) {
      const auto value = next_number(bytes, at);
      if (!value || *value > *top)
        return bad(file, "PGM pixel " + std::to_string(i) + " is missing or beyond the maximum");
      image.pixels.push_back(grey(*value));
    }
  }
  return image;
}

}  // namespace

types::Result<GreyImage> read_image(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return types::fail(Errc::kNotFound, file.string() + ": cannot be opened; expected a PNG or PGM image");
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.starts_with("\x89PNG")) return read_png(file, bytes);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return read_pgm(file, bytes);
  return bad(file, "neither PNG nor PGM (P2, P5); expected one of them");
}

types::Status write_png(const GreyImage& image, const std::filesystem::path& file) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&png, file.c_str(), 0, image.pixels.data(), 0, nullptr) == 0)
    return types::fail(Errc::kIo, file.string() + ": image not written: " + png.message);
  return {};
}

}  // namespace topo::sim
