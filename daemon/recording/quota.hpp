// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace topo::daemon {

/// A file that counts to a quota.
struct QuotaFile {
  std::string path;
  std::uint64_t bytes = 0;
};

struct QuotaResult {
  std::size_t removed = 0;  ///< files
  std::uint64_t removed_bytes = 0;
  std::uint64_t left_bytes =
      0;  ///< more than the quota when what is being written, or is held, has that much
};

/// Marks a file as being written for as long as the descriptor is open (flock(2)): released by the kernel
/// when the process is killed. Not all file systems can; then a file is protected by being the newest one
/// only.
void mark_as_written(int fd);

/// Removes a file unless somebody writes it (mark_as_written()), this process included. False: it is still
/// there.
bool remove_finished(const std::string& path);

/// Removes files, the first ones of the list first, until all together have at most `quota_bytes`. Neither
/// the last of the list nor one that is being written is removed. Blocks on the disk.
QuotaResult keep_to_quota(std::span<const QuotaFile> oldest_first, std::uint64_t quota_bytes);

/// The recordings of the same series as `path`, NAME-YYYYMMDDTHHMMSSZ.rec in its folder, the oldest first.
/// None when its own name is not of this form: what a user named is not the daemon's to remove.
[[nodiscard]] std::vector<QuotaFile> recordings_beside(const std::string& path);

}  // namespace topo::daemon
