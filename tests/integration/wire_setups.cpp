// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/wire_setups.hpp"

#include <cstdlib>

namespace topo::test {
namespace {

constexpr std::uint64_t kUsualSeed = 1;

std::uint64_t seeds() {
  const char* text = std::getenv("TOPOMETRIC_FAULT_CROSS");
  return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

WireSetup setup(Wires wires, bool sonar, std::uint64_t seed) {
  WireSetup made;
  made.wires = wires;
  made.sonar = sonar;
  made.seed = seed;
  return made;
}

}  // namespace

bool is_cross() { return seeds() > 0; }

std::vector<WireSetup> setups_of(std::size_t number) {
  if (!is_cross())
    return {setup(number % 2 == 0 ? Wires::kTcp : Wires::kPty, number / 2 % 2 == 0, kUsualSeed)};
  std::vector<WireSetup> all;
  for (std::uint64_t seed = 1; seed <= seeds(); ++seed)
    for (const Wires wires : {Wires::kTcp, Wires::kPty})
      for (const bool sonar : {true, false}) all.push_back(setup(wires, sonar, seed));
  return all;
}

std::string suffix_of(const WireSetup& setup) {
  return is_cross() ? "_seed" + std::to_string(setup.seed) : "";
}

std::string form_of(const WireSetup& setup) {
  return std::string("wires: ") + (setup.wires == Wires::kTcp ? "TCP" : "terminal") +
         (setup.sonar ? ", with sonar" : ", without sonar");
}

}  // namespace topo::test
