// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/unit/drivers/pioneer/hex.hpp"

namespace topo::pioneer {

struct ConfigValues {
  std::string robot_class = "Pioneer", subclass = "p3dx-sh", serial_number = "SN123", name = "scripted";
  unsigned watchdog_ms = 2000;
  unsigned velocity_top_mmps = 1500;
  unsigned sip_cycle_ms = 100;
};

/// CONFIGpac in the order of PROTOCOLS section 5, with its example values.
inline Bytes config_payload(const ConfigValues& v) {
  Bytes out{std::byte{0x20}};
  const auto u8 = [&](unsigned x) { out.push_back(static_cast<std::byte>(x)); };
  const auto u16 = [&](unsigned x) {
    u8(x & 0xFFU);
    u8(x >> 8U);
  };
  const auto str = [&](const std::string& s) {
    for (const char c : s) u8(static_cast<unsigned char>(c));
    u8(0);
  };
  str(v.robot_class);
  str(v.subclass);
  str(v.serial_number);
  u8(0);
  for (const unsigned x : {360U, v.velocity_top_mmps, 300U, 2000U, 500U}) u16(x);
  str(v.name);
  for (const unsigned x : {v.sip_cycle_ms, 0U, 0U}) u8(x);
  u16(0);  // gripper
  u16(1);  // front sonar
  u8(0);   // rear sonar
  u16(110);
  u16(16570);
  u16(v.watchdog_ms);
  u8(1);
  for (const unsigned x :
       {200U, 100U, 600U, 50U, 100U, 750U, 100U, 100U, 40U, 20U, 0U, 300U, 300U, 40U, 30U, 0U})
    u16(x);
  for (const unsigned x : {1U, 0U, 0U, 40U, 1U, 0U}) u8(x);
  u16(0);  // DriftFactor
  u8(0);
  u8(0);
  u16(138);
  u16(105);
  str("2.9");
  return out;
}

}  // namespace topo::pioneer
