// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scip_scan.hpp"

#include <algorithm>

#include "tests/sim/devices/scip_text.hpp"

namespace topo::sim::scip {
namespace {

bool is_valid(const Echo& echo, const ScipModelSpec& model) {
  return echo.range_mm >= static_cast<std::uint32_t>(model.dmin_mm) &&
         echo.range_mm <= static_cast<std::uint32_t>(model.dmax_mm);
}

Beam beam_at(int step, const ScipModelSpec& model, const Turn& turn) {
  const int index = step - model.amin;
  if (index >= 0 && static_cast<std::size_t>(index) < turn.beams.size()) {
    return turn.beams[static_cast<std::size_t>(index)];
  }
  Beam outside;
  outside.echoes[0] = {model.code_not_measured, 0};
  return outside;
}

/// The smallest valid value of a group of steps, or its first code when none is valid (PROTOCOLS 10.1).
Beam merge_group(int first, int last, const ScipModelSpec& model, const Turn& turn) {
  Beam best = beam_at(first, model, turn);
  for (int step = first + 1; step <= last; ++step) {
    const Beam next = beam_at(step, model, turn);
    if (!is_valid(next.echoes[0], model)) continue;
    if (!is_valid(best.echoes[0], model) || next.echoes[0].range_mm < best.echoes[0].range_mm) best = next;
  }
  return best;
}

void append_echo(std::string& out, const ScanRequest& request, const Echo& echo) {
  append_value(out, echo.range_mm, request.encoding == 'S' ? 2 : 3);
  if (request.encoding == 'E') append_value(out, echo.intensity, 3);
}

}  // namespace

std::string_view parse_scan_request(std::string_view body, const ScipModelSpec& model, ScanRequest& request) {
  request = {};
  request.kind = body[0];
  request.encoding = body[1];
  const bool stream = request.kind == 'M' || request.kind == 'N';
  const auto start = parse_digits(body.substr(2, 4));
  const auto end = parse_digits(body.substr(6, 4));
  const auto cluster = parse_digits(body.substr(10, 2));
  if (!start) return "01";
  if (!end) return "02";
  if (!cluster) return "03";
  if (*end > model.amax) return "04";
  if (*end < *start) return "05";
  request.start = *start;
  request.end = *end;
  request.cluster = std::max(1, *cluster);
  if (!stream) return {};
  const auto interval = parse_digits(body.substr(12, 1));
  const auto count = parse_digits(body.substr(13, 2));
  if (!interval) return "06";
  if (!count) return "07";
  request.interval = *interval;
  request.count = *count;
  return {};
}

std::string encode_turn(const ScanRequest& request, const ScipModelSpec& model, const Turn& turn) {
  std::string out;
  out.reserve(static_cast<std::size_t>(request.end - request.start + 1) * 6);
  for (int step = request.start; step <= request.end; step += request.cluster) {
    const Beam group = merge_group(step, std::min(request.end, step + request.cluster - 1), model, turn);
    const std::size_t echoes =
        request.multi_echo() ? std::clamp<std::size_t>(group.count, 1, Beam::kMaxEchoes) : 1;
    for (std::size_t i = 0; i < echoes; ++i) {
      if (i > 0) out.push_back('&');
      append_echo(out, request, group.echoes[i]);
    }
  }
  return out;
}

std::string data_reply(std::string_view echo, std::string_view status, std::uint32_t time_ms,
                       std::string_view encoded) {
  std::string out;
  out.append(echo).append("\n");
  append_summed_line(out, status);
  std::string time;
  append_value(time, time_ms & 0xFFFFFFU, 4);
  append_summed_line(out, time);
  append_block(out, encoded);
  out.push_back('\n');
  return out;
}

std::string stream_echo(std::string_view request_line, int remaining) {
  std::string echo(request_line);
  constexpr std::size_t kCountAt = 13;  // MD SSSS EEEE CC I NN
  echo[kCountAt] = static_cast<char>('0' + remaining / 10 % 10);
  echo[kCountAt + 1] = static_cast<char>('0' + remaining % 10);
  return echo;
}

}  // namespace topo::sim::scip
