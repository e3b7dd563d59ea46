// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace topo::bench {

/// What a graph file calls a node. Names, not numbers: tools for several robots put a letter into the upper
/// byte of a 64-bit number (GTSAM's Symbol), and others write letters outright.
struct NodeName {
  std::string prefix;  ///< all before the digits at the end; empty for a number
  std::string digits;

  [[nodiscard]] std::string text() const { return prefix + digits; }
  /// What tells the robots of one file apart: the prefix, or the upper 16 bits of a number (letter and label
  /// of a Symbol, whose index has 48 bits in practice).
  [[nodiscard]] std::string robot() const;

  /// Numbers by their value and before all other names; these by prefix, then by the number at the end.
  std::strong_ordering operator<=>(const NodeName& other) const;
  bool operator==(const NodeName& other) const = default;
};

/// A name of letters, digits and underscores; a number's leading zeros are dropped, as g2o reads it. Nothing
/// for any other word.
std::optional<NodeName> parse_node_name(std::string_view word);

}  // namespace topo::bench
