// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace topo::test {

using Bytes = std::vector<std::byte>;

/// "fa fb 03": the notation of PROTOCOLS section 16.
inline Bytes from_hex(const std::string& text) {
  Bytes out;
  std::istringstream in(text);
  for (std::string word; in >> word;) out.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
  return out;
}

inline Bytes to_bytes(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace topo::test
