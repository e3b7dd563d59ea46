// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types/result.hpp"

namespace topo::bench {

struct SuiteCommand {
  std::string suite = "fresh";  ///< fresh or dev
  std::uint64_t seed = 1;       ///< of a fresh one
  int buildings = 24;           ///< of a fresh one
  std::filesystem::path plans;  ///< folder of the public plans: to print beside, or the suite dev itself
  std::filesystem::path out;    ///< for the buildings' files and pictures
};

/// `topobench suite`: writes a fresh suite's buildings as maps, like other plans, and prints how large, how
/// many-doored and how full they are, beside the public plans.
types::Status run_suite(const SuiteCommand& command);

}  // namespace topo::bench
