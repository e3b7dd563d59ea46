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

types::Result<GreyImage> read_png(const std::filesystem::path& file, const std::string& bytes) {
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
  if (*top == 0 || *top > 255)
    return bad(file, "PGM maximum " + std::to_string(*top) + "; expected 1 to 255");
  const std::int64_t count = static_cast<std::int64_t>(*width) * *height;
  if (count > kPixelsMax) return bad(file, "image of more than 100 million pixels; expected a building");
  GreyImage image{*width, *height, {}};
  const bool binary = bytes[1] == '5';
  if (binary) {
    ++at;  // one white space ends the header
    const std::size_t there = bytes.size() > at ? bytes.size() - at : 0;
    if (there < static_cast<std::size_t>(count)) {
      return bad(file, "PGM cut off: " + std::to_string(there) + " of " + std::to_string(count) + " pixels");
    }
    image.pixels.assign(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at) + count);
  } else {
    for (std::int64_t i = 0; i < count; ++i) {
      const auto value = next_number(bytes, at);
      if (!value || *value > *top)
        return bad(file, "PGM pixel " + std::to_string(i) + " is missing or beyond the maximum");
      image.pixels.push_back(static_cast<std::uint8_t>(*value));
    }
  }
  for (std::uint8_t& p : image.pixels) p = static_cast<std::uint8_t>(std::min(255, p * 255 / *top));
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
