// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/topobench/fresh/building.hpp"

namespace topo::bench::fresh {

inline constexpr int kSuiteMax = 200;  ///< buildings of one suite

/// The public plans that parameters were developed on (doc/results.md, "What was tuned on what").
inline constexpr std::array<const char*, 16> kDevPlans{
    "aaf_y3",     "bham_cs_lg", "columbia", "corner",           "corridor",     "ctcv",
    "cumberland", "gdc_1",      "gdc_3ne",  "hospital_section", "kth_50052749", "lincoln_collection",
    "longwood",   "loop",       "uol_mht",  "willow-full-0.05"};

/// Seed of one building of a suite: none depends on how many there are.
std::uint64_t seed_of_building(std::uint64_t suite_seed, int building);

/// Writes a building as an image and a map_server YAML with its start, as the public plans have them: walls
/// black, what is behind them unknown.
types::Status write_building(const Building& building, const std::filesystem::path& yaml);

/// Draws the buildings 1 to `buildings` of a suite into an existing folder, fresh-SEED-01.yaml and so on, and
/// gives their files.
types::Result<std::vector<std::filesystem::path>> write_fresh_suite(std::uint64_t suite_seed, int buildings,
                                                                    const std::filesystem::path& folder);

/// The plans of kDevPlans in a folder. An error names the first that is missing.
types::Result<std::vector<std::filesystem::path>> dev_suite(const std::filesystem::path& folder);

}  // namespace topo::bench::fresh
