// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "daemon/session/format.hpp"

namespace topo::daemon {

/// A record of a session's file.
struct FoundRecord {
  SessionRecordHead head;
  std::size_t offset = 0;  ///< of its head, in the file
  bool sealed = false;     ///< its content has its checksum; false: only the head is whole
};

/// Bytes of a file that belong to no record that is used: damaged, incomplete, or a second copy.
struct DamagedPiece {
  std::size_t offset = 0;
  std::size_t bytes = 0;
};

/// The records of a file.
struct RecordScan {
  std::vector<FoundRecord> records;  ///< by number, each number once
  std::vector<DamagedPiece> pieces;  ///< by offset
  std::uint64_t missing = 0;  ///< records before the last one of which nothing is left, by their numbers
  bool cut = false;           ///< the file ends within a record whose beginning is undamaged
};

/// Finds the records from `begin` on. Behind damage the search goes on at the next head with its checksum: at
/// the record's end, when its own head is whole, otherwise at the next "TSRC". Records of version 1 have no
/// numbers: they end at the first damage. Time is linear in the file's size but for a hostile file, in which
/// each "TSRC" costs one checksum of a head.
[[nodiscard]] RecordScan scan_records(std::span<const std::byte> file, std::size_t begin,
                                      std::uint32_t version);

}  // namespace topo::daemon
