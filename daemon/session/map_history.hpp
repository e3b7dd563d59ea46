// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/result.hpp"

namespace topo::daemon {

/// How a map came to be, as its journal was written: the keyframes in their order, and the poses that they
/// had in between. Of a saved session, and of a damaged file, the poses at its end alone are known.
class MapHistory {
 public:
  MapHistory() = default;

  [[nodiscard]] const std::vector<slam::KeyframePtr>& keyframes() const { return keyframes_; }

  /// The poses of the first `count` keyframes when there were that many: of each the newest that was written
  /// by then, of one that was not written yet the first. A pure function of `count`.
  [[nodiscard]] std::vector<types::Se2> poses(std::size_t count) const;

 private:
  friend types::Result<MapHistory> parse_history(std::span<const std::byte> file);
  /// Poses as they were written, from keyframe number `first` on.
  struct Written {
    std::size_t keyframes = 0;  ///< there were, then
    std::size_t first = 0;
    std::vector<types::Se2> poses;
  };
  [[nodiscard]] static std::vector<Written> written_in(std::span<const std::byte> file,
                                                       std::size_t keyframes);

  std::vector<slam::KeyframePtr> keyframes_;
  std::vector<Written> written_;  ///< the last: of all keyframes
};

/// Reads a session's file; errors as of parse_session(). Safe for untrusted input.
[[nodiscard]] types::Result<MapHistory> parse_history(std::span<const std::byte> file);

/// As parse_history(), for a file; errors name it. Blocks on the disk.
[[nodiscard]] types::Result<MapHistory> load_history(const std::string& path);

}  // namespace topo::daemon
