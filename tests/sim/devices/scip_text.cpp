// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scip_text.hpp"

#include <algorithm>
#include <cctype>

namespace topo::sim::scip {

char checksum(std::string_view line) {
  unsigned sum = 0;
  for (const char c : line) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & 0x3FU) + 0x30U);
}

void append_value(std::string& out, std::uint32_t value, int digits) {
  const std::uint32_t limit = (std::uint32_t{1} << (6 * digits)) - 1;
  const std::uint32_t clamped = std::min(value, limit);
  for (int shift = 6 * (digits - 1); shift >= 0; shift -= 6) {
    out.push_back(static_cast<char>(((clamped >> shift) & 0x3FU) + 0x30U));
  }
}

void append_summed_line(std::string& out, std::string_view line) {
  out.append(line);
  out.push_back(checksum(line));
  out.push_back('\n');
}

void append_key_line(std::string& out, std::string_view key, std::string_view value, bool stop_at_arrow) {
  std::string line;
  line.append(key).append(":").append(value);
  const auto arrow = stop_at_arrow ? line.find("<-") : std::string::npos;
  const char sum = checksum(std::string_view(line).substr(0, arrow));
  out.append(line).append(";");
  out.push_back(sum);
  out.push_back('\n');
}

void append_block(std::string& out, std::string_view encoded) {
  constexpr std::size_t kLine = 64;
  for (std::size_t at = 0; at < encoded.size(); at += kLine)
    append_summed_line(out, encoded.substr(at, kLine));
}

std::string status_reply(std::string_view echo, std::string_view status) {
  std::string out;
  out.append(echo).append("\n");
  append_summed_line(out, status);
  out.push_back('\n');
  return out;
}

std::optional<int> parse_digits(std::string_view text) {
  if (text.empty() || text.size() > 6) return std::nullopt;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

Request split_request(std::string_view line) {
  Request request{line, line, {}, false};
  const auto semicolon = line.find(';');
  if (semicolon == std::string_view::npos) return request;
  request.body = line.substr(0, semicolon);
  request.string = line.substr(semicolon + 1);
  request.has_string = true;
  return request;
}

std::string_view string_fault(const Request& request) {
  constexpr std::size_t kLongest = 16;
  if (!request.has_string) return {};
  if (request.string.size() > kLongest) return "0G";
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view(" ._+@").find(c) != std::string_view::npos;
  };
  return std::all_of(request.string.begin(), request.string.end(), allowed) ? std::string_view{}
                                                                            : std::string_view("0H");
}

}  // namespace topo::sim::scip
