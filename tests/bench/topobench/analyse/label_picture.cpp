// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// libpng's simplified interface: it reports through return values, not by longjmp.
#include "tests/bench/topobench/analyse/label_picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/input_file.hpp"

namespace topo::bench {
namespace {

using types::Result;
using types::Status;

struct Png {
  png_image image{};
  Png() { image.version = PNG_IMAGE_VERSION; }
  ~Png() { png_image_free(&image); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

Result<LabelPicture> read_grey16(const std::string& path, Png& png) {
  LabelPicture out{static_cast<int>(png.image.width), static_cast<int>(png.image.height), false, {}};
  png.image.format = PNG_FORMAT_LINEAR_Y;  // as the file has it: 16 bits are taken for linear
  std::vector<png_uint_16> grey(PNG_IMAGE_SIZE(png.image) / sizeof(png_uint_16));
  if (png_image_finish_read(&png.image, nullptr, grey.data(), 0, nullptr) == 0)
    return daemon::bad_file(path, "", png.image.message, "a whole PNG file");
  out.values.assign(grey.begin(), grey.end());
  return out;
}

Result<LabelPicture> read_bytes(const std::string& path, Png& png) {
  const bool coloured = (png.image.format & PNG_FORMAT_FLAG_COLOR) != 0;
  LabelPicture out{static_cast<int>(png.image.width), static_cast<int>(png.image.height), coloured, {}};
  png.image.format = PNG_FORMAT_RGBA;  // with alpha, which is not looked at, so that nothing is mixed with it
  std::vector<png_byte> rgba(PNG_IMAGE_SIZE(png.image));
  if (png_image_finish_read(&png.image, nullptr, rgba.data(), 0, nullptr) == 0)
    return daemon::bad_file(path, "", png.image.message, "a whole PNG file");
  out.values.resize(rgba.size() / 4);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const std::uint32_t r = rgba[4 * i], g = rgba[4 * i + 1], b = rgba[4 * i + 2];
    out.values[i] = coloured ? r | g << 8U | b << 16U : r;
  }
  return out;
}

}  // namespace

Result<LabelPicture> read_labels(const std::string& path) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 29U;
  const auto content = daemon::read_file(path, kMaxBytes);
  if (!content) return tl::unexpected(content.error());
  Png png;
  if (png_image_begin_read_from_memory(&png.image, content->data(), content->size()) == 0)
    return daemon::bad_file(path, "", png.image.message, "a PNG file");
  if (auto s = daemon::check_size(path, png.image.width, png.image.height); !s)
    return tl::unexpected(s.error());
  const bool grey16 =
      (png.image.format & (PNG_FORMAT_FLAG_LINEAR | PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA)) ==
      PNG_FORMAT_FLAG_LINEAR;
  return grey16 ? read_grey16(path, png) : read_bytes(path, png);
}

Status save_labels(const std::string& path, const LabelPicture& labels) {
  const std::vector<png_uint_16> grey(labels.values.begin(), labels.values.end());
  Png png;
  png.image.width = static_cast<png_uint_32>(labels.width);
  png.image.height = static_cast<png_uint_32>(labels.height);
  png.image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, grey.data(), 0, nullptr) == 0)
    return types::fail(types::Errc::kIo, fmt::format("{}: cannot pack: {}", path, png.image.message));
  return daemon::write_file(path, std::span<const std::byte>(bytes).first(size));
}

}  // namespace topo::bench
