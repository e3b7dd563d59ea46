// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bzlib.h>
#include <zlib.h>

#include <string>

namespace topo::bench::testing {

/// Five beams, two scans out of order, one odometry line.
inline const std::string kSampleLog =
    "# CARMEN Logfile\n"
    "PARAM robot_length 0.47 10.0 host 0.0\n"
    "ODOM 1.0 2.0 0.5 0.3 0.1 0 10.1 host 0.1\n"
    "FLASER 5 1.5 81.91 0 2.5 80.0 1 2 0.5 1.1 2.1 0.6 10.3 host 0.3\n"
    "FLASER 5 1 2 3 4 5 3 4 -0.5 3 4 -0.5 10.2 host 0.2\n";

inline std::string bzip2(std::string text) {
  std::string out(text.size() + 1000, '\0');
  auto size = static_cast<unsigned>(out.size());
  BZ2_bzBuffToBuffCompress(out.data(), &size, text.data(), static_cast<unsigned>(text.size()), 9, 0, 0);
  out.resize(size);
  return out;
}

inline std::string gzip(std::string text) {
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(text.size() + 1000, '\0');
  z.next_in = reinterpret_cast<Bytef*>(text.data());
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

}  // namespace topo::bench::testing
