// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/view/tokens.hpp"

namespace topo::daemon {

/// The tokens that hold now: the folder's file is read again whenever it was replaced, so that a revoked
/// token ends with the next order of whoever has it. With a file that cannot be read no token holds. One
/// thread.
class Rights {
 public:
  explicit Rights(std::string folder) : folder_(std::move(folder)) {}

  [[nodiscard]] bool hold(const std::string& hash);

 private:
  /// What tells one file of this name from another.
  struct Version {
    std::uint64_t inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;
    friend bool operator==(const Version&, const Version&) = default;
  };
  [[nodiscard]] std::optional<Version> version() const;

  std::string folder_;
  std::optional<Version> read_;
  std::vector<KeptToken> tokens_;
};

}  // namespace topo::daemon
