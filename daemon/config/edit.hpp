// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace topo::daemon {

/// A key and its new value, as it stands in a file: {"base.track_m", "0.361"}.
struct KeyEdit {
  std::string path;
  std::string value;
};

/// A configuration's text with other values. Comments and order stay: a key that is set or stands behind a #
/// keeps its place and what is said of it, others go to the end of their section, and a section that is not
/// there to the end of the text.
[[nodiscard]] std::string edited(std::string_view text, std::span<const KeyEdit> edits);

/// The text with every line of a section behind a #: what it said can still be read.
[[nodiscard]] std::string without_section(std::string_view text, std::string_view section);

}  // namespace topo::daemon
