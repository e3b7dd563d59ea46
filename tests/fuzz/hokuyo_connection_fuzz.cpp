// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A hostile sensor behind a whole connection: whatever it answers to the requests, a step ends in time and no
// scan is given that breaks its own bounds. The input is cut at zero bytes into one answer a request.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "drivers/hokuyo/connection.hpp"
#include "tests/mocks/scripted_stream.hpp"

namespace {

using namespace std::chrono_literals;
using namespace topo;

void require(bool holds) {
  if (!holds) std::abort();
}

/// "#" stands for the request itself, so that short inputs get past the echo.
std::string expand(const std::string& answer, std::string_view request) {
  std::string text;
  for (const char c : answer) {
    if (c == '#') {
      text.append(request.substr(0, request.find('\n')));
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  mocks::ScriptedLine line;
  line.has_baud = !input.empty() && (input[0] & 1) != 0;
  std::size_t at = 0;
  line.on_write = [&](std::string_view request) {
    const std::size_t end = input.find('\0', at);
    line.send(expand(input.substr(at, end == std::string::npos ? end : end - at), request));
    at = end == std::string::npos ? input.size() : end + 1;
  };
  hokuyo::ConnectionConfig config;
  config.name = "fuzz";
  config.intensity = size % 2 == 0;
  hokuyo::Connection connection(config, std::make_unique<mocks::ScriptedConnector>(line));
  const auto scan = std::make_unique<types::Scan>();
  for (int i = 0; i < 300; ++i) {
    const types::Stamp before = line.now;
    const auto outcome = connection.step(*scan, 50ms);
    require(line.now - before <= 52ms);
    if (outcome == hokuyo::StepOutcome::kScan)
      require(scan->beams > 0 && scan->beams <= types::Scan::kMaxBeams);
    require(!connection.message().empty());
  }
  connection.close(50ms);
  return 0;
}
