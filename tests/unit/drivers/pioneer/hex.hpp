// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace topo::pioneer {

using Bytes = std::vector<std::byte>;

/// "fa fb 03": the notation of PROTOCOLS section 16.
inline Bytes from_hex(const std::string& text) {
  Bytes out;
  std::istringstream in(text);
  for (std::string word; in >> word;) out.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
  return out;
}

inline Bytes to_bytes(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Vectors of PROTOCOLS section 16.
inline const Bytes kSync2Reply =
    from_hex("fa fb 1a 02 73 69 6d 62 6f 74 00 50 69 6f 6e 65 65 72 00 70 33 64 78 2d 73 68 00 43 a9");
inline const Bytes kStatusVector = from_hex(
    "fa fb 28 33 fe 7f 05 00 00 fc c3 00 cd 00 7f 00 00 00 00 07 00 00 02 03 dc 05 04 83 13 00 00 00 ff 00 "
    "7f "
    "00 00 10 00 00 00 55 85");
inline const Bytes kEncoderVector = from_hex("fa fb 0b 90 c7 cf ff ff 70 11 01 00 71 37");

}  // namespace topo::pioneer
