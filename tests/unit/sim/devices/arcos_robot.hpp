// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/devices/arcos_device.hpp"
#include "tests/unit/sim/devices/device_tools.hpp"

namespace topo::sim {

inline std::string from_hex(const std::string& hex) {
  std::string out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 3) {
    out.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return out;
}

/// A host's command, framed by hand.
inline std::string command(int number) {
  return arcos::PacketBuilder(static_cast<std::uint8_t>(number)).frame();
}
inline std::string command(int number, int value) {
  arcos::PacketBuilder b(static_cast<std::uint8_t>(number));
  return b.u8(value < 0 ? 0x1B : 0x3B).u16(std::abs(value)).frame();
}

/// A robot on a floor without end: its wheels do what they are told.
struct Robot {
  explicit Robot(arcos::Parameters parameters = arcos::p3dx_parameters())
      : device(std::move(parameters), 1) {}

  std::string ask(const std::string& text) {
    send(device, text, now);
    return drain(device, now);
  }
  std::string run(SimTime time) {
    const SimTime end = now + time;
    for (constexpr SimTime kStep = std::chrono::milliseconds(1); now < end; now += kStep) {
      const auto wheels = device.control(now, kStep, inputs);
      inputs.left_mps = wheels.left_mps;
      inputs.right_mps = wheels.right_mps;
      inputs.left_m += wheels.left_mps * 1e-3;
      inputs.right_m += wheels.right_mps * 1e-3;
    }
    return drain(device, now);
  }
  /// As run, with a PULSE now and then, so that the watchdog never bites.
  void run_fed(SimTime time) {
    for (constexpr SimTime kPulse = std::chrono::milliseconds(100); time > SimTime{0}; time -= kPulse) {
      ask(command(0));
      run(kPulse);
    }
  }
  void connect() {
    ask(command(0) + command(1) + command(2));
    ask(command(1, 1));
  }
  double speed_mm_s() const { return (inputs.left_mps + inputs.right_mps) * 500.0; }

  ArcosDevice device;
  BaseInputs inputs;
  SimTime now{0};
};

/// Payloads of the packets in a stream, checksums asserted.
inline std::vector<std::string> packets(const std::string& stream) {
  std::vector<std::string> out;
  std::size_t at = 0;
  while (at + 3 <= stream.size()) {
    EXPECT_EQ(stream.substr(at, 2), "\xFA\xFB");
    const auto count = static_cast<std::size_t>(static_cast<unsigned char>(stream[at + 2]));
    const std::string payload = stream.substr(at + 3, count - 2);
    const auto sum = arcos::checksum(payload);
    EXPECT_EQ(stream.substr(at + 1 + count, 2),
              (std::string{static_cast<char>(sum >> 8), static_cast<char>(sum & 0xFF)}));
    out.push_back(payload);
    at += count + 3;
  }
  EXPECT_EQ(at, stream.size());
  return out;
}

inline int u8(const std::string& payload, std::size_t at) {
  return static_cast<unsigned char>(payload.at(at));
}
inline int u16(const std::string& payload, std::size_t at) {
  return u8(payload, at) | u8(payload, at + 1) << 8;
}
inline int i16(const std::string& payload, std::size_t at) {
  return static_cast<std::int16_t>(u16(payload, at));
}

inline std::string last_sip(const std::string& stream) {
  std::string sip;
  for (const std::string& payload : packets(stream)) {
    if ((u8(payload, 0) & 0xF0) == 0x30) sip = payload;
  }
  return sip;
}

}  // namespace topo::sim
