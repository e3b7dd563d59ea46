// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <rapidcheck.h>

#include <fstream>
#include <sstream>

#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

std::string sample() {
  const char* folder = std::getenv("TOPOMETRIC_CONFIG");
  std::ifstream in(std::string(folder == nullptr ? "config" : folder) + "/p3dx.toml");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What holds of every outcome: places lie in the file, and something that names no robot is refused.
void check_outcome(const std::string& text) {
  const auto loaded = parse_configuration(text, "f.toml");
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  for (const auto& fault : loaded.faults) {
    RC_ASSERT(fault.place.line >= 1);
    RC_ASSERT(fault.place.line <= lines);
    RC_ASSERT(fault.place.column >= 1);
    RC_ASSERT(!fault.message.empty());
  }
  if (loaded.faults.empty()) {
    RC_ASSERT(!loaded.values.base.address.empty());
    RC_ASSERT(!loaded.values.front.address.empty());
    RC_ASSERT(parse_configuration(effective_text(loaded), "g.toml").faults.empty());
  }
}

TEST(ConfigurationFuzz, MutatedExamplesNeverCrash) {
  const std::string original = sample();
  ASSERT_GT(original.size(), 1000U);
  EXPECT_TRUE(rc::check("mutations of an example", [&original] {
    std::string text = original;
    const int edits = *rc::gen::inRange(1, 8);
    for (int i = 0; i < edits && !text.empty(); ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
      switch (*rc::gen::inRange(0, 4)) {
        case 0:
          text[at] = *rc::gen::arbitrary<char>();
          break;
        case 1:
          text.erase(at, *rc::gen::inRange<std::size_t>(1, 40));
          break;
        case 2:
          text.insert(at, 1, *rc::gen::element('=', '[', ']', '"', '\n', '#', '.', '{', '}', ',', '-', '9'));
          break;
        default: {
          const auto from = *rc::gen::inRange<std::size_t>(0, text.size());
          text.insert(at, text.substr(from, 60));
        }
      }
    }
    check_outcome(text);
  }));
}

TEST(ConfigurationFuzz, ArbitraryBytesNeverCrash) {
  EXPECT_TRUE(rc::check("any bytes", [] { check_outcome(*rc::gen::arbitrary<std::string>()); }));
}

TEST(ConfigurationFuzz, DeepNestingIsRefused) {
  const std::string deep = "a = " + std::string(100000, '[');
  EXPECT_FALSE(faults_of(deep).empty());
}

}  // namespace
}  // namespace topo::daemon
