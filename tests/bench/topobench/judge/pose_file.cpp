// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/judge/pose_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "daemon/mapfile/input_file.hpp"

namespace topo::bench {
namespace {

constexpr std::size_t kBytesMax = std::size_t{256} << 20U;

std::string_view next_word(std::string_view& line) {
  const auto begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return line = {};
  line.remove_prefix(begin);
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
  line.remove_prefix(word.size());
  return word;
}

/// The line's four numbers; the word that is none.
std::optional<std::string_view> read_numbers(std::string_view line, std::array<double, 4>& numbers) {
  for (double& number : numbers) {
    const std::string_view word = next_word(line);
    const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
    if (read.ec != std::errc{} || read.ptr != word.data() + word.size() || !std::isfinite(number))
      return word;
  }
  return std::nullopt;
}

}  // namespace

types::Result<std::vector<TimedPose>> read_poses(const std::string& path) {
  const auto text = daemon::read_file(path, kBytesMax);
  if (!text) return tl::unexpected(text.error());
  std::vector<TimedPose> poses;
  std::string_view rest = *text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::string where = fmt::format("line {}", number);
    if (std::string_view words = line; next_word(words).empty() || line.front() == '#') continue;
    std::array<double, 4> n{};
    if (const auto word = read_numbers(line, n))
      return daemon::bad_file(path, where, fmt::format("'{}'", *word), "four numbers: t x y theta");
    if (!poses.empty() && n[0] <= poses.back().stamp_s)
      return daemon::bad_file(path, where, fmt::format("t = {:.6f}", n[0]), "a later stamp than before");
    poses.push_back({n[0], {n[1], n[2], n[3]}});
  }
  if (poses.empty()) return daemon::bad_file(path, "", "no pose", "lines t x y theta");
  return poses;
}

std::optional<types::Se2> pose_at(std::span<const TimedPose> poses, double stamp_s) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp_s,
                                      [](const TimedPose& p, double t) { return p.stamp_s < t; });
  if (after == poses.end()) return std::nullopt;
  if (after->stamp_s == stamp_s) return after->pose;
  if (after == poses.begin()) return std::nullopt;
  const TimedPose& before = *std::prev(after);
  const double part = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  return types::interpolate(before.pose, after->pose, part);
}

}  // namespace topo::bench
