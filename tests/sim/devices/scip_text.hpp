// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// The simulator's own SCIP 2 text codec (PROTOCOLS section 9). It shares no code with the driver: only the
/// vectors of PROTOCOLS section 16 are common to both.
namespace topo::sim::scip {

/// Checksum character of a line.
[[nodiscard]] char checksum(std::string_view line);

/// Appends value in `digits` characters of six bits each, most significant first; larger values saturate at
/// all ones.
void append_value(std::string& out, std::uint32_t value, int digits);

/// Appends line, its checksum and LF.
void append_summed_line(std::string& out, std::string_view line);

/// Appends `KEY:value;c` and LF. The checksum covers the text before the semicolon or, as with the UTM-30LX
/// (USB), only the text before `<-`.
void append_key_line(std::string& out, std::string_view key, std::string_view value, bool stop_at_arrow);

/// Appends the encoded data in lines of 64 characters, each with its checksum.
void append_block(std::string& out, std::string_view encoded);

/// A complete reply without data: echo, status, empty line.
[[nodiscard]] std::string status_reply(std::string_view echo, std::string_view status);

/// Unsigned decimal value of the whole text; nothing when a character is not a digit.
[[nodiscard]] std::optional<int> parse_digits(std::string_view text);

/// The parts of a request line.
struct Request {
  std::string_view line;    ///< as received, for the echo
  std::string_view body;    ///< before the semicolon
  std::string_view string;  ///< after the semicolon
  bool has_string = false;
};
[[nodiscard]] Request split_request(std::string_view line);

/// The error status for a request's string part (0G too long, 0H bad characters); empty when it is valid.
[[nodiscard]] std::string_view string_fault(const Request& request);

}  // namespace topo::sim::scip
