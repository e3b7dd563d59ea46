// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {

using types::Result;
using types::Status;

namespace {

/// Numbers of a Netpbm file, with white space and comments between them.
class Tokens {
 public:
  Tokens(const std::string& path, std::string_view content) : path_(path), content_(content) {}

  Result<int> number(std::string_view name, int min, int max) {
    skip_space();
    int value = 0;
    const char* begin = content_.data() + at_;
    const auto [end, error] = std::from_chars(begin, content_.data() + content_.size(), value);
    if (error != std::errc{} || value < min || value > max) {
      const std::string found = at_ >= content_.size() ? "the end of the file"
                                : error != std::errc{} ? "no number"
                                                       : std::to_string(value);
      return bad_file(path_, fmt::format("byte {}", at_), fmt::format("{} as {}", found, name),
                      fmt::format("{} to {}", min, max));
    }
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  /// The data after the single white space behind the last number.
  [[nodiscard]] std::string_view rest() const { return content_.substr(std::min(at_ + 1, content_.size())); }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

 private:
  void skip_space() {
    while (at_ < content_.size()) {
      if (content_[at_] == '#') {
        at_ = std::min(content_.find('\n', at_), content_.size());
      } else if (is_space(content_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }
  const std::string& path_;
  std::string_view content_;
  std::size_t at_ = 2;
};

constexpr int kMaxGrey = 65535;
constexpr int kMaxByte = 255;

Status read_text(Tokens& tokens, GreyImage& image) {
  for (std::uint16_t& pixel : image.pixels) {
    const auto value = tokens.number("pixel", 0, image.greatest);
    if (!value.has_value()) return tl::unexpected(value.error());
    pixel = static_cast<std::uint16_t>(*value);
  }
  return {};
}

/// A byte a pixel, or two with the more significant one first.
Status read_raw(const std::string& path, std::string_view raster, GreyImage& image) {
  const bool wide = image.greatest > kMaxByte;
  const auto byte = [&](std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(raster[at]));
  };
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const unsigned value = wide ? byte(2 * i) << 8U | byte(2 * i + 1) : byte(i);
    if (value > static_cast<unsigned>(image.greatest))
      return bad_file(path, fmt::format("pixel {}", i), std::to_string(value),
                      fmt::format("0 to {}", image.greatest));
    image.pixels[i] = static_cast<std::uint16_t>(value);
  }
  return {};
}

/// The pixels behind the head. One white space ends it. Where more bytes follow than the pixels need and the
/// first is white space too, the head may have been ended by CR LF or by two blanks, or something follows the
/// picture: only the number of bytes tells, and where it does not, a map that is shifted by a pixel is worse
/// than none.
Result<std::string_view> raster_of(const std::string& path, std::string_view rest, std::size_t needed) {
  if (rest.size() <= needed || !Tokens::is_space(rest.front())) return rest;
  const bool one_more = rest.size() == needed + 1 && !Tokens::is_space(rest.back());
  if (one_more) return rest.substr(1);
  return bad_file(
      path, "",
      fmt::format("two white spaces behind the head and {} bytes after the first (a text converter?)",
                  rest.size()),
      fmt::format("one, and {} bytes of pixels", needed));
}

}  // namespace

Status check_size(const std::string& path, std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1 || width > MapImage::kMaxSide || height > MapImage::kMaxSide ||
      width * height > MapImage::kMaxCells) {
    return bad_file(
        path, "", fmt::format("an image of {} x {} pixels", width, height),
        fmt::format("1 to {} a side and at most {} in all", MapImage::kMaxSide, MapImage::kMaxCells));
  }
  return {};
}

Result<GreyImage> decode_pgm(const std::string& path, std::string_view content) {
  const bool raw = content.starts_with("P5");
  if (!raw && !content.starts_with("P2"))
    return bad_file(path, "byte 0", "other content", "a PGM file (P2 or P5)");
  Tokens tokens(path, content);
  const auto width = tokens.number("width", 1, MapImage::kMaxSide);
  if (!width.has_value()) return tl::unexpected(width.error());
  const auto height = tokens.number("height", 1, MapImage::kMaxSide);
  if (!height.has_value()) return tl::unexpected(height.error());
  if (auto s = check_size(path, *width, *height); !s.has_value()) return tl::unexpected(s.error());
  const auto greatest = tokens.number("greatest value", 1, kMaxGrey);
  if (!greatest.has_value()) return tl::unexpected(greatest.error());
  const auto pixels = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
  // A pixel needs at least one byte: nothing is allocated for pixels that the file cannot contain.
  const std::size_t needed = !raw ? 2 * pixels - 1 : *greatest > kMaxByte ? 2 * pixels : pixels;
  if (tokens.rest().size() < needed) {
    return bad_file(path, "", fmt::format("{} bytes of pixels (truncated file)", tokens.rest().size()),
                    fmt::format("at least {} for {} x {}", needed, *width, *height));
  }
  GreyImage image{*width, *height, std::vector<std::uint16_t>(pixels), {}, *greatest};
  Status read;
  if (raw) {
    const auto raster = raster_of(path, tokens.rest(), needed);
    if (!raster.has_value()) return tl::unexpected(raster.error());
    read = read_raw(path, *raster, image);
  } else {
    read = read_text(tokens, image);
  }
  if (!read.has_value()) return tl::unexpected(read.error());
  return image;
}

}  // namespace topo::daemon
