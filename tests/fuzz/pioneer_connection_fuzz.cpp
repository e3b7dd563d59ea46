// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A hostile robot behind a whole connection: whatever it answers, a step ends in time and every state that it
// gives is finite and later than the one before. The input is a list of answers, one a write: a length byte,
// then as many bytes of payload, which are framed here so that short inputs get past the checksum. Length 0
// stands for the request itself, 255 for five raw bytes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/connection.hpp"
#include "tests/mocks/scripted_stream.hpp"

namespace {

using namespace std::chrono_literals;
using namespace topo;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string framed(std::string_view payload) {
  const unsigned sum = pioneer::checksum(std::as_bytes(std::span(payload)));
  std::string out = "\xFA\xFB";
  out.push_back(static_cast<char>(payload.size() + 2));
  out.append(payload);
  out.push_back(static_cast<char>(sum >> 8U));
  out.push_back(static_cast<char>(sum & 0xFFU));
  return out;
}

class Answers {
 public:
  explicit Answers(std::string_view input) : rest_(input) {}
  std::string next(std::string_view request) {
    if (rest_.empty()) return {};
    const auto length = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    if (length == 0) return std::string(request);
    const std::size_t size = std::min<std::size_t>(length == 255 ? 5 : length, rest_.size());
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return length == 255 ? std::string(bytes) : framed(bytes);
  }

 private:
  std::string_view rest_;
};

bool is_finite(const types::BaseState& s) {
  const types::Se2& pose = s.odometry.T_odom_base.se2();
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad) &&
         std::isfinite(s.odometry.twist.v_mps) && std::isfinite(s.odometry.twist.omega_radps);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  mocks::ScriptedLine line;
  line.has_baud = size % 2 == 1;
  Answers answers(input);
  line.on_write = [&](std::string_view request) { line.send(answers.next(request)); };
  pioneer::Connection connection({}, std::make_unique<mocks::ScriptedConnector>(line));
  types::BaseState state;
  types::Stamp last{};
  for (int i = 0; i < 200; ++i) {
    const types::Stamp before = line.now;
    const auto outcome = connection.step(state, 50ms);
    require(line.now - before <= 52ms);
    require(!connection.message().empty());
    std::ignore = connection.command({.twist = {0.1, 0.1}, .enable_motors = true, .estop = false});
    if (outcome != pioneer::StepOutcome::kState) continue;
    require(is_finite(state) && state.odometry.stamp > last && state.odometry.stamp <= line.now + 1ms);
    last = state.odometry.stamp;
  }
  connection.close(50ms);
  return 0;
}
