// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/sim/devices/scip_models.hpp"
#include "tests/sim/devices/scip_turn.hpp"

namespace topo::sim::scip {

/// A validated request for scans: GD/GS (one, the latest) or MD/MS/ME/ND/NE (a stream).
struct ScanRequest {
  char kind = 'M';      ///< first letter: G, M, N or H
  char encoding = 'D';  ///< second letter: D three characters, S two, E range and intensity
  int start = 0;
  int end = 0;
  int cluster = 1;   ///< 00 means 01
  int interval = 0;  ///< scans skipped between two that are sent
  int count = 0;     ///< 0: endless

  [[nodiscard]] bool multi_echo() const { return kind == 'N' || kind == 'H'; }
};

/// Parses a body such as MD0000108001000. Returns the error status (01 to 07, PROTOCOLS section 10), or an
/// empty text when request is filled.
[[nodiscard]] std::string_view parse_scan_request(std::string_view body, const ScipModelSpec& model,
                                                  ScanRequest& request);

/// The encoded values of a turn for the request, before the division into lines.
[[nodiscard]] std::string encode_turn(const ScanRequest& request, const ScipModelSpec& model,
                                      const Turn& turn);

/// A complete data reply: echo, status, time, data, empty line.
[[nodiscard]] std::string data_reply(std::string_view echo, std::string_view status, std::uint32_t time_ms,
                                     std::string_view encoded);

/// The echo of a streaming request, with the number of remaining scans in its last two digits.
[[nodiscard]] std::string stream_echo(std::string_view request_line, int remaining);

}  // namespace topo::sim::scip
