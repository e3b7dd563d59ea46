// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/unit/support/hex.hpp"

namespace topo::pioneer {

using test::Bytes;
using test::from_hex;
using test::to_bytes;

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
