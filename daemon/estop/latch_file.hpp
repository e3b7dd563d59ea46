// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"

namespace topo::daemon {

/// The file that keeps a latched e-stop beyond the daemon's end. That it is there means latched, whatever is
/// in it; the text is for people.
[[nodiscard]] std::string latch_path(const std::string& folder);
/// The same for the silence towards a base that does not obey: a file of the same form, that binds the next
/// daemon and topometric-estop.
[[nodiscard]] std::string silence_path(const std::string& folder);

/// What the start finds.
struct FoundLatch {
  bool latched = false;
  std::string text;  ///< since when and why; or what is wrong with the file
  bool damaged = false;
};

/// Not latched only when there is no file. One that cannot be read, or is not as keep_latch() writes it,
/// counts as latched.
[[nodiscard]] FoundLatch read_latch(const std::string& path);

/// Writes the file, and brings it and its folder to the disk. Blocks on the disk. `reason`: one line. Errors
/// name the file.
types::Status keep_latch(const std::string& path, const std::string& reason);

/// Removes the file and brings its folder to the disk. Blocks on the disk. On an error the file may be there
/// again at the next start.
types::Status remove_latch(const std::string& path);

}  // namespace topo::daemon
