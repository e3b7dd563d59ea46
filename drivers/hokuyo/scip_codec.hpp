// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace topo::hokuyo {

/// The check character of a line without it: six low bits of the sum, made printable (PROTOCOLS section 9).
[[nodiscard]] char checksum(std::string_view text);

/// The line without its check character; empty when that is wrong or the line has no content.
[[nodiscard]] std::optional<std::string_view> checked(std::string_view line);

/// Decodes six bits per character, most significant first; empty when a character is outside 0x30..0x6F.
[[nodiscard]] std::optional<std::uint32_t> decode_number(std::string_view text);

/// Parameters of MD, MS, ME, ND or NE; the echo before every scan repeats them.
struct StreamRequest {
  enum class Kind : std::uint8_t {
    kRange,           ///< MD: three characters a step
    kRangeShort,      ///< MS: two characters
    kRangeIntensity,  ///< ME: three and three
    kMultiEcho,       ///< ND: as MD, further echoes after '&'
    kMultiIntensity,  ///< NE: as ME, further echoes after '&'
  };
  Kind kind = Kind::kRange;
  std::uint16_t start = 0, end = 0;  ///< steps, both inclusive
  std::uint8_t cluster = 1;          ///< neighbours merged into one value
  std::uint8_t interval = 0;         ///< scans omitted between two
  std::uint8_t count = 0;            ///< scans to send; 0: endless. In an echo: scans remaining.

  /// Values in one scan; 0 when `end` is before `start`.
  [[nodiscard]] std::size_t points() const;
  /// True for the same stream: all fields but the running count are equal.
  [[nodiscard]] bool same_stream(const StreamRequest& other) const;
};

/// One request without its line feed.
class RequestText {
 public:
  [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }
  void append(std::string_view text);
  void append_number(unsigned value, std::size_t digits);  ///< fixed width, leading zeros

 private:
  std::array<char, 24> text_{};
  std::size_t size_ = 0;
};

[[nodiscard]] RequestText encode(const StreamRequest& request);

/// Parses an echo of the form M?/N? and 13 digits; empty for any other text.
[[nodiscard]] std::optional<StreamRequest> parse_stream_echo(std::string_view echo);

}  // namespace topo::hokuyo
