// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "daemon/session/record_scan.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"

namespace topo::daemon {
namespace {

using Bytes = std::vector<std::byte>;
using ::testing::HasSubstr;

/// A journal of a drive in batches, with what its records say: the oracle that does not read damaged files.
struct Journal {
  slam::Session session;
  Bytes file = encode_session_header({1});
  std::vector<FoundRecord> records;

  Journal(std::size_t batches, std::size_t each, unsigned seed) {
    std::mt19937 random(seed);
    SessionWriter writer;
    for (std::size_t i = 0; i < batches; ++i) {
      testing::drive_on(session, each, random);
      // A closure now and then moves the poses from some keyframe on, by less than is looked for here.
      if (i % 5 == 4) session.poses[random() % session.poses.size()].x_m += 0.001;
      const auto changes = writer.changes(session, {});
      file.insert(file.end(), changes->begin(), changes->end());
      writer.written(session, {});
    }
    records = scan_records(file, SessionHeader::kSize, kSessionVersion).records;
  }

  [[nodiscard]] std::span<const std::byte> bytes_of(const FoundRecord& record) const {
    return std::span(file).subspan(record.offset, SessionRecordHead::kSize + record.head.packed_bytes);
  }
};

/// True of the records that are whole somewhere in the file.
std::vector<bool> survivors(const Journal& journal, const Bytes& file) {
  std::vector<bool> left;
  for (const FoundRecord& record : journal.records) {
    const auto bytes = journal.bytes_of(record);
    left.push_back(std::search(file.begin(), file.end(), bytes.begin(), bytes.end()) != file.end());
  }
  return left;
}

/// Of `count` items of a kind, those that the surviving records tell: written by a survivor, and by no lost
/// record after it.
std::vector<bool> told(const Journal& journal, const std::vector<bool>& left, SessionRecord kind,
                       std::size_t count) {
  std::vector<bool> items(count, false);
  for (std::size_t r = 0; r < left.size(); ++r) {
    const SessionRecordHead& head = journal.records[r].head;
    if (head.kind != kind) continue;
    // The end of what it wrote is the beginning of the next one of the same batch and kind, or all.
    std::fill(items.begin() + *head.first, items.end(), left[r]);
  }
  return items;
}

/// Keyframes that must come back: undamaged, and with a pose or tied by told edges to one that has one.
std::set<std::uint32_t> must_come_back(const Journal& journal, const std::vector<bool>& left) {
  const std::size_t n = journal.session.keyframes.size();
  const auto keyframes = told(journal, left, SessionRecord::kKeyframes, n);
  auto placed = told(journal, left, SessionRecord::kPoses, n);
  const auto edges = told(journal, left, SessionRecord::kEdges, journal.session.edges.size());
  for (std::size_t i = 0; i < n; ++i) placed[i] = placed[i] && keyframes[i];
  for (std::size_t round = 0; round < n; ++round) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto& edge = journal.session.edges[e];
      if (!edges[e] || !keyframes[edge.from] || !keyframes[edge.to]) continue;
      placed[edge.from] = placed[edge.to] = placed[edge.from] || placed[edge.to];
    }
  }
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < n; ++i) {
    if (placed[i]) numbers.insert(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

std::ptrdiff_t place(const Bytes& file, std::mt19937& random) {
  return static_cast<std::ptrdiff_t>(random() % (file.size() + 1));
}

/// One fault of a disk, a copy or a hand.
void damage(Bytes& file, std::mt19937& random) {
  const auto at = place(file, random);
  const auto end = at + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(file.size()) - at,
                                                 static_cast<std::ptrdiff_t>(random() % 1500));
  const Bytes piece(file.begin() + at, file.begin() + end);
  switch (random() % 6) {
    case 0:  // a bit
    case 1:
      if (at < end) file[static_cast<std::size_t>(at)] ^= std::byte{1} << (random() % 8);
      break;
    case 2:  // a sector of zeros
      std::fill(file.begin() + at, file.begin() + end, std::byte{0});
      break;
    case 3:  // a piece is missing
      file.erase(file.begin() + at, file.begin() + end);
      break;
    case 4: {  // a piece is there twice
      file.insert(file.begin() + place(file, random), piece.begin(), piece.end());
      break;
    }
    default:  // the end is missing
      file.resize(file.size() - random() % (1 + file.size() / 4));
  }
}

bool in_one_piece(const slam::Session& session) {
  std::vector<std::size_t> parts(session.keyframes.size());
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  for (std::size_t round = 0; round < parts.size(); ++round) {
    for (const slam::Edge& edge : session.edges)
      parts[edge.from] = parts[edge.to] = std::min(parts[edge.from], parts[edge.to]);
  }
  return std::all_of(parts.begin(), parts.end(), [](std::size_t part) { return part == 0; });
}

void check(const Journal& journal, const Bytes& file) {
  const auto left = survivors(journal, file);
  const auto loaded = parse_session(file);
  if (!loaded) {
    RC_ASSERT(std::none_of(left.begin(), left.end(), [](bool l) { return l; }));
    return;
  }
  RC_ASSERT(loaded->bytes + loaded->damaged == file.size());
  std::set<std::uint32_t> expected = must_come_back(journal, left);
  std::int64_t before = -1;
  for (std::size_t i = 0; i < loaded->session.keyframes.size(); ++i) {
    const slam::Keyframe& keyframe = *loaded->session.keyframes[i];
    const std::uint32_t number = keyframe.id.sequence;
    RC_ASSERT(std::int64_t{number} > before);
    before = number;
    RC_ASSERT(slam::testing::same(keyframe, *journal.session.keyframes[number]));
    const types::Se2 off = testing::on_circle(number).inverse() * loaded->session.poses[i];
    RC_ASSERT(std::hypot(off.x_m, off.y_m) < 0.05);
    RC_ASSERT(std::abs(off.theta_rad) < 0.02);
    expected.erase(number);
  }
  RC_ASSERT(expected.empty());
  RC_ASSERT(in_one_piece(loaded->session) || loaded->mended.keyframes == 0);
  RC_ASSERT(loaded->damaged == 0 || !damage_text(*loaded).empty());
}

RC_GTEST_PROP(SessionDamage, WhatIsUndamagedAndConnectedComesBack, (unsigned seed)) {
  std::mt19937 random(seed);
  const Journal journal(14, 1 + seed % 4, seed);
  for (int trial = 0; trial < 10; ++trial) {
    Bytes file = journal.file;
    for (std::size_t faults = 1 + random() % 6; faults > 0; --faults) damage(file, random);
    check(journal, file);
  }
}

// Every byte of a journal, one after the other: at most the batch around it suffers.
TEST(SessionDamage, AKillBetweenTheRecordsOfABatchCostsNoKeyframe) {
  const Journal journal(14, 1, 171540);
  for (std::size_t r = 0; r < journal.records.size(); ++r) {
    const FoundRecord& record = journal.records[r];
    const std::size_t end = record.offset + SessionRecordHead::kSize + record.head.packed_bytes;
    check(journal, Bytes(journal.file.begin(), journal.file.begin() + static_cast<std::ptrdiff_t>(end)));
  }
}

TEST(SessionDamage, AFlippedBitAnywhereCostsAtMostItsRecord) {
  const Journal journal(8, 2, 3);
  const std::size_t all = journal.session.keyframes.size();
  for (std::size_t i = SessionHeader::kSize; i < journal.file.size(); ++i) {
    Bytes file = journal.file;
    file[i] ^= std::byte{0x04};
    const auto loaded = parse_session(file);
    ASSERT_TRUE(loaded) << i << ": " << loaded.error().message;
    ASSERT_GE(loaded->session.keyframes.size(), all - 2) << i;
    ASSERT_EQ(loaded->records_lost, 1U) << i;
    ASSERT_GT(loaded->damaged, 0U) << i;
    ASSERT_LE(loaded->damaged, 1500U) << i;
    ASSERT_TRUE(in_one_piece(loaded->session)) << i;
  }
}

TEST(SessionDamage, ItSaysWhereHowMuchAndWhatIsLost) {
  const Journal journal(20, 1, 5);
  const auto record = std::find_if(journal.records.begin(), journal.records.end(), [](const auto& r) {
    return r.head.kind == SessionRecord::kKeyframes && *r.head.first == 6;
  });
  Bytes file = journal.file;
  file[record->offset + SessionRecordHead::kSize + 20] ^= std::byte{1};
  const auto loaded = parse_session(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(
      damage_text(*loaded),
      fmt::format("{} bytes from byte {} on are damaged: 1 of its records are lost, 19 of 20 keyframes are "
                  "kept, 1 gaps are bridged by poses alone",
                  SessionRecordHead::kSize + record->head.packed_bytes, record->offset));
  EXPECT_EQ(loaded->session.edges.size(), 18U) << "those of the lost keyframe are gone, a bridge is there";
}

TEST(SessionDamage, LostPosesFollowFromEdges) {
  const Journal journal(4, 5, 5);
  Bytes file = journal.file;
  for (const FoundRecord& record : journal.records) {
    if (record.head.kind == SessionRecord::kPoses && *record.head.first == 5)
      file[record.offset + SessionRecordHead::kSize] ^= std::byte{1};
  }
  const auto loaded = parse_session(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->session.keyframes.size(), 20U);
  EXPECT_THAT(damage_text(*loaded), HasSubstr("20 of 20 keyframes are kept, 5 poses follow from edges"));
  for (std::size_t i = 0; i < 20; ++i) {
    const types::Se2 off = testing::on_circle(i).inverse() * loaded->session.poses[i];
    EXPECT_LT(std::hypot(off.x_m, off.y_m), 1e-6) << i;
  }
}

// A file whose first sector is gone is still known by its records.
TEST(SessionDamage, ADamagedHeaderCostsOnlyTheHashOfTheParameters) {
  const Journal journal(5, 2, 7);
  for (std::size_t i = 0; i < SessionHeader::kSize; ++i) {
    Bytes file = journal.file;
    file[i] ^= std::byte{0x20};
    const auto loaded = parse_session(file);
    ASSERT_TRUE(loaded) << i << ": " << loaded.error().message;
    EXPECT_EQ(loaded->session.keyframes.size(), 10U);
    EXPECT_EQ(loaded->params_hash, 0U);
    EXPECT_THAT(damage_text(*loaded), HasSubstr("28 bytes from byte 0 on are damaged")) << i;
  }
}

TEST(SessionDamage, RecordsThatAreMissingWithoutATraceAreCounted) {
  const Journal journal(6, 2, 9);
  const auto& first = journal.records[6];
  const auto& last = journal.records[9];
  Bytes file = journal.file;
  file.erase(file.begin() + static_cast<std::ptrdiff_t>(first.offset),
             file.begin() + static_cast<std::ptrdiff_t>(last.offset));
  const auto loaded = parse_session(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->damaged, 0U);
  EXPECT_EQ(loaded->records_lost, 3U);
  EXPECT_EQ(loaded->session.keyframes.size(), 10U);
  EXPECT_THAT(damage_text(*loaded), HasSubstr("records are missing: 3 of its records are lost"));
}

}  // namespace
}  // namespace topo::daemon
