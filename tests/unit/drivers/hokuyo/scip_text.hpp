// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace topo::hokuyo::testing_scip {

// The sensor's side of the wire, written for the tests alone: encoding from PROTOCOLS section 9, not from
// the driver.

inline std::string with_sum(std::string_view text) {
  int sum = 0;
  for (const char c : text) sum += c;
  return std::string(text) + static_cast<char>((sum & 63) + 48) + "\n";
}

inline std::string number(std::uint32_t value, int characters) {
  std::string text;
  for (int shift = 6 * (characters - 1); shift >= 0; shift -= 6)
    text += static_cast<char>(((value >> shift) & 63U) + 48U);
  return text;
}

inline std::string data_lines(const std::string& data) {
  std::string lines;
  for (std::size_t i = 0; i < data.size(); i += 64) lines += with_sum(std::string_view(data).substr(i, 64));
  return lines;
}

/// Echo, status 99, time, data, empty line.
inline std::string scan_text(const std::string& echo, std::uint32_t time_ms, const std::string& data) {
  return echo + "\n99b\n" + with_sum(number(time_ms & 0xFFFFFFU, 4)) + data_lines(data) + "\n";
}

inline std::string ranges(const std::vector<std::uint32_t>& values) {
  std::string data;
  for (const std::uint32_t value : values) data += number(value, 3);
  return data;
}

/// A reply without data, or with lines that are complete already.
inline std::string reply_text(const std::string& echo, const std::string& status,
                              const std::string& lines = "") {
  return echo + "\n" + with_sum(status) + lines + "\n";
}

}  // namespace topo::hokuyo::testing_scip
