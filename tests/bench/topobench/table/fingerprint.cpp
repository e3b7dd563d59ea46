// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/fingerprint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <iterator>
#include <vector>

namespace topo::bench {
namespace {

std::string digits_of(const void* bytes, std::size_t size) {
  return fmt::format("{:016x}", XXH3_64bits(bytes, size));
}

void add(const sim::Polygon& outline, std::vector<double>& numbers) {
  numbers.push_back(static_cast<double>(outline.size()));
  for (const types::Vector2& p : outline) numbers.insert(numbers.end(), {p.x(), p.y()});
}

}  // namespace

std::string fingerprint_of(const sim::World& world) {
  const sim::Raster& floor = world.structure();
  std::vector<double> numbers{floor.resolution_m, floor.origin.x(), floor.origin.y(), world.ceiling_m(),
                              static_cast<double>(floor.width)};
  for (const sim::Prism& prism : world.prisms()) {
    numbers.insert(numbers.end(), {prism.z_min_m, prism.z_max_m});
    add(prism.outline, numbers);
  }
  for (const sim::Polygon& outline : world.wall_outlines()) add(outline, numbers);
  for (const types::Segment& pane : world.glass())
    numbers.insert(numbers.end(), {pane.a.x(), pane.a.y(), pane.b.x(), pane.b.y()});
  numbers.insert(numbers.end(), floor.cells.begin(), floor.cells.end());
  return digits_of(numbers.data(), numbers.size() * sizeof(double));
}

types::Result<std::string> fingerprint_of_program() {
  constexpr const char* kSelf = "/proc/self/exe";
  std::ifstream file(kSelf, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty())
    return types::fail(types::Errc::kIo, fmt::format("{}: cannot be read, to tell this program from others; "
                                                     "expected a mounted /proc, or --program NAME",
                                                     kSelf));
  return digits_of(bytes.data(), bytes.size());
}

}  // namespace topo::bench
