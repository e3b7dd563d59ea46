// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "core/slam/found_relations.hpp"
#include "core/slam/map_builder.hpp"
#include "core/slam/mapper.hpp"
#include "core/types/bytes.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/recording/format.hpp"
#include "daemon/session/format.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using testing::same;
using testing::sample_session;

std::vector<std::byte> bytes_of(const slam::Session& session) {
  auto bytes = session_bytes(session, 42);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return *bytes;
}

std::vector<std::byte> of_version_9() {
  auto file = bytes_of(sample_session(3, 1));
  file[8] = std::byte{9};
  types::store_le(std::span(file), 20, checksum(std::span(file).first(20)));
  return file;
}

RC_GTEST_PROP(SessionFile, WhatIsSavedIsLoadedToTheBit, (unsigned seed)) {
  const slam::Session session = sample_session(seed % 60, seed);
  const auto loaded = parse_session(*session_bytes(session, seed));
  RC_ASSERT(loaded.has_value());
  RC_ASSERT(same(loaded->session, session));
  RC_ASSERT(loaded->params_hash == seed);
  RC_ASSERT(loaded->closed);
  RC_ASSERT(loaded->damaged == 0U);
}

// A journal: keyframes come, poses are corrected, edges come, go and change.
RC_GTEST_PROP(SessionFile, GrowsByWhatChanged, (unsigned seed)) {
  std::mt19937 random(seed);
  slam::Session session;
  SessionWriter writer;
  std::vector<std::byte> file = encode_session_header({1});
  for (int step = 0; step < 8; ++step) {
    testing::grow(session, random() % 5, random);
    if (random() % 3 == 0 && !session.poses.empty())
      session.poses[random() % session.poses.size()].x_m += 0.001;
    if (random() % 3 == 0 && !session.edges.empty()) session.edges.pop_back();
    if (random() % 3 == 0 && !session.edges.empty())
      session.edges[random() % session.edges.size()].robust ^= true;
    const auto changes = writer.changes(session, {});
    RC_ASSERT(changes.has_value());
    file.insert(file.end(), changes->begin(), changes->end());
    writer.written(session, {});
    RC_ASSERT(writer.changes(session, {})->empty());
    const auto loaded = parse_session(file);
    RC_ASSERT(loaded.has_value());
    RC_ASSERT(same(loaded->session, session));
    RC_ASSERT(!loaded->closed);
  }
}

TEST(SessionFile, SmallCorrectionsCanWait) {
  std::mt19937 random(1);
  slam::Session session = sample_session(20, 1);
  SessionWriter writer;
  constexpr PoseTolerance kCoarse{0.02, 0.002};
  writer.written(session, kCoarse);
  session.poses[3].x_m += 0.019;
  EXPECT_TRUE(writer.changes(session, kCoarse)->empty());
  EXPECT_FALSE(writer.changes(session, {})->empty());
  session.poses[3].x_m += 0.002;  // what waited adds up
  EXPECT_FALSE(writer.changes(session, kCoarse)->empty());
}

// Killed at any instant: every cut gives what was whole before it, and more bytes never give less. Keyframes
// whose poses were cut off are placed by their edges.
TEST(SessionFile, ACutAnywhereKeepsWhatIsWhole) {
  std::mt19937 random(2);
  slam::Session session;
  SessionWriter writer;
  std::vector<std::byte> file = encode_session_header({1});
  for (int step = 0; step < 6; ++step) {
    testing::drive_on(session, 3, random);
    const auto changes = writer.changes(session, {});
    ASSERT_TRUE(changes);
    file.insert(file.end(), changes->begin(), changes->end());
    writer.written(session, {});
  }
  std::size_t before = 0;
  for (std::size_t n = 0; n <= file.size(); ++n) {
    const auto loaded = parse_session(std::span(file).first(n));
    ASSERT_EQ(loaded.has_value(), n >= SessionHeader::kSize) << n;
    if (!loaded) continue;
    const std::size_t keyframes = loaded->session.keyframes.size();
    ASSERT_GE(keyframes, before) << n;
    ASSERT_EQ(keyframes % 3, 0U) << n;
    ASSERT_TRUE(testing::same_keyframes(loaded->session, session, keyframes)) << n;
    for (std::size_t i = 0; i < keyframes; ++i) {
      const types::Se2 off = session.poses[i].inverse() * loaded->session.poses[i];
      ASSERT_LT(std::hypot(off.x_m, off.y_m) + std::abs(off.theta_rad), 1e-9) << n;
    }
    ASSERT_EQ(loaded->bytes + loaded->damaged, n);
    before = keyframes;
  }
  EXPECT_EQ(before, 18U);
}

// Checksums before meaning: of a damaged record nothing is taken.
TEST(SessionFile, AFlippedByteAnywhereTakesNothingWrong) {
  std::mt19937 random(3);
  slam::Session session;
  testing::drive_on(session, 6, random);
  const auto file = bytes_of(session);
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto damaged = file;
    damaged[i] ^= std::byte{0x10};
    const auto loaded = parse_session(damaged);
    ASSERT_TRUE(loaded) << i;
    ASSERT_GT(loaded->damaged, 0U) << i;
    const auto& left = loaded->session;
    ASSERT_TRUE(testing::same_keyframes(left, session, left.keyframes.size())) << i;
    for (std::size_t n = 0; n < left.poses.size(); ++n) {
      const types::Se2 off = session.poses[n].inverse() * left.poses[n];
      ASSERT_LT(std::hypot(off.x_m, off.y_m) + std::abs(off.theta_rad), 1e-6) << i;
    }
  }
}

// With checksums that fit, as an enemy can make them: what the records say is checked too.
TEST(SessionFile, HostileRecordsAreNotBelieved) {
  const auto with = [](SessionRecord kind, const types::ByteWriter& content, std::uint32_t first = 0) {
    auto file = encode_session_header({1});
    const auto changes = SessionWriter().changes(sample_session(4, 4), {});
    file.insert(file.end(), changes->begin(), changes->end());
    EXPECT_TRUE(append_record(file, kind, 3, first, content.bytes()));
    return parse_session(file);
  };
  types::ByteWriter gap;
  gap.varint(std::uint64_t{1} << 40U);
  for (const auto kind : {SessionRecord::kEdges, SessionRecord::kPoses, SessionRecord::kEnd}) {
    const auto loaded = with(kind, gap);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->session.keyframes.size(), 4U);
    EXPECT_FALSE(loaded->closed);
  }
  for (const auto kind : {SessionRecord::kEdges, SessionRecord::kPoses, SessionRecord::kKeyframes})
    EXPECT_EQ(with(kind, {}, 4'000'000'000U)->session.keyframes.size(), 4U);
  types::ByteWriter nowhere;
  nowhere.real(1e300);
  nowhere.real(0.0);
  nowhere.real(0.0);
  EXPECT_FALSE(with(SessionRecord::kPoses, nowhere)) << "a pose out of range";
  types::ByteWriter huge;
  huge.varint(std::uint64_t{1} << 50U);
  EXPECT_EQ(with(SessionRecord::kKeyframes, huge)->session.keyframes.size(), 4U);
  EXPECT_EQ(with(static_cast<SessionRecord>(77), huge)->session.keyframes.size(), 4U);
}

TEST(SessionFile, AnotherVersionAndAnotherFileAreNamed) {
  const testing::TempDir folder;
  const auto refused = load_session(folder.write("a.session", "TOPOSES and something else, long enough"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            folder.file("a.session") + ": the file does not begin as a session does");
  const auto version = parse_session(of_version_9());
  ASSERT_FALSE(version);
  EXPECT_EQ(version.error().message, "found version 9, expected 3");
  const auto empty = load_session(folder.write("empty.session", ""));
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().message, folder.file("empty.session") + ": the file is empty");
  EXPECT_EQ(load_session(folder.file("none.session")).error().code, types::Errc::kNotFound);
}

// Poses come last: a saved session that lost its end has none.
TEST(SessionFile, WhatItLacksIsSaid) {
  const testing::TempDir folder;
  const auto file = bytes_of(sample_session(6, 3));
  const auto written = [&](std::vector<std::byte> bytes) {
    return folder.write("a.session", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  const auto whole = parse_session(file);
  ASSERT_TRUE(whole);
  EXPECT_EQ(damage_text(*whole), "");
  EXPECT_TRUE(check_map(*whole, "a"));

  const std::string path = written({file.begin(), file.end() - 100});
  const auto cut = load_session(path);
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(damage_text(*cut),
            fmt::format("cut at byte {}, its last whole record ends at {}", file.size() - 100, cut->bytes));
  const auto refused = check_map(*cut, path);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            fmt::format("{}: no keyframe with a pose is in it: {}", path, damage_text(*cut)));

  auto flipped = file;
  flipped[SessionHeader::kSize + 40] ^= std::byte{1};
  const auto damaged = parse_session(flipped);
  ASSERT_TRUE(damaged);
  EXPECT_THAT(damage_text(*damaged),
              HasSubstr(fmt::format("bytes from byte {} on are damaged: 1 of its records "
                                    "are lost, 0 of 6 keyframes are kept",
                                    SessionHeader::kSize)));

  auto longer = file;
  longer.resize(file.size() + 5);
  EXPECT_EQ(damage_text(*parse_session(longer)), "5 bytes behind its end are no part of it");
}

TEST(SessionFile, ItsHeaderSaysWhetherItIsOne) {
  const testing::TempDir folder;
  auto file = bytes_of(sample_session(3, 1));
  const auto fault_of = [&] {
    return header_fault(folder.write("a.session", {reinterpret_cast<const char*>(file.data()), file.size()}));
  };
  EXPECT_EQ(fault_of(), "");
  file.resize(SessionHeader::kSize);
  EXPECT_EQ(fault_of(), "") << "a journal that has only begun";
  file = of_version_9();
  EXPECT_EQ(fault_of(), "found version 9, expected 3");
  file[21] ^= std::byte{1};
  EXPECT_EQ(fault_of(), "its header is damaged; what else is whole can be loaded");
  file[0] ^= std::byte{1};
  EXPECT_EQ(fault_of(), "the file does not begin as a session does");
  file.clear();
  EXPECT_EQ(fault_of(), "the file is empty");
  EXPECT_THAT(header_fault(folder.file("none.session")), HasSubstr("none.session"));
}

// A journal that version 1 of the format wrote, with 6 keyframes in 3 batches.
TEST(SessionFile, TheVersionBeforeIsReadUpToItsDamage) {
  const char* source = std::getenv("TOPOMETRIC_SOURCE");
  ASSERT_NE(source, nullptr) << "set TOPOMETRIC_SOURCE to the source folder, as ctest does";
  const std::string path = std::string(source) + "/tests/fuzz/seeds/session/version_1";
  const auto content = read_file(path, 100'000);
  ASSERT_TRUE(content) << content.error().message;
  const auto all = std::as_bytes(std::span(*content));
  const auto loaded = parse_session(all);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->session.keyframes.size(), 6U);
  EXPECT_EQ(loaded->session.poses.size(), 6U);
  EXPECT_EQ(loaded->params_hash, 77U);
  EXPECT_EQ(damage_text(*loaded), "");
  std::vector<std::byte> damaged(all.begin(), all.end());
  damaged[all.size() / 2] ^= std::byte{1};
  const auto part = parse_session(damaged);
  ASSERT_TRUE(part) << part.error().message;
  EXPECT_EQ(part->session.keyframes.size(), 2U);
  EXPECT_THAT(damage_text(*part), HasSubstr("1 of its records are lost, 2 of 2 keyframes are kept"));
}

// A journal that version 2 wrote does not say who found its edges; the same of version 3 says it of two of
// three.
TEST(SessionFile, EdgesOfVersionTwoHaveNoFinder) {
  const char* source = std::getenv("TOPOMETRIC_SOURCE");
  ASSERT_NE(source, nullptr) << "set TOPOMETRIC_SOURCE to the source folder, as ctest does";
  const auto session_of = [&](const std::string& seed) {
    const auto content = read_file(std::string(source) + "/tests/fuzz/seeds/session/" + seed, 100'000);
    EXPECT_TRUE(content) << content.error().message;
    const auto loaded = parse_session(std::as_bytes(std::span(*content)));
    EXPECT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->damaged, 0U);
    return loaded->session;
  };
  const slam::Session before = session_of("journal"), now = session_of("finders");
  ASSERT_GT(before.edges.size(), 3U);
  EXPECT_TRUE(slam::found_relations(before.keyframes, before.edges).empty());
  ASSERT_EQ(now.edges.size(), before.edges.size());
  std::size_t known = 0;
  for (std::size_t i = 0; i < now.edges.size(); ++i) {
    EXPECT_EQ(now.edges[i].T_from_to, before.edges[i].T_from_to);
    EXPECT_EQ(now.edges[i].finder.sequence, i);
    known += slam::has_finder(now.edges[i]) ? 1U : 0U;
  }
  EXPECT_EQ(slam::found_relations(now.keyframes, now.edges).size(), known);
  EXPECT_EQ(known, now.edges.size() - (now.edges.size() + 2) / 3);
}

// What is loaded draws the same map as what was mapped, to the bit: keyframes are rounded before they enter
// it.
TEST(SessionFile, ALoadedMapIsTheLiveMap) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(5);
  slam::Mapper mapper({});
  walls::ColumnCollector columns({});
  for (int i = 0; i < 60; ++i) {
    const types::Se2 pose{1.5 + 0.08 * i, 1.5, 0.0};
    (void)mapper.add(slam::testing::view_of(world, pose, 0.02, random).cloud, {0.08 * i, 0.0, 0.0}, columns);
  }
  ASSERT_GT(mapper.keyframes().size(), 8U);
  const testing::TempDir folder;
  ASSERT_TRUE(save_session(folder.file("rooms.session"), mapper.session(), 1));
  const auto loaded = load_session(folder.file("rooms.session"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(same(loaded->session, mapper.session()));
  slam::MapBuilder live({}), again({});
  live.update(mapper.keyframes(), mapper.poses());
  again.update(loaded->session.keyframes, loaded->session.poses);
  std::size_t cells = 0;
  live.grid().tiles().for_each([&](patricia::Key key, const grid::TileRef& tile) {
    const auto corner = patricia::cell_of(key);
    for (int y = 0; y < grid::Tile::kSide; ++y) {
      for (int x = 0; x < grid::Tile::kSide; ++x, ++cells) {
        const grid::CellIndex cell{corner.x * grid::Tile::kSide + x, corner.y * grid::Tile::kSide + y};
        ASSERT_EQ(tile.read().cells[grid::Tile::index(x, y)], again.grid().counts(cell));
      }
    }
  });
  EXPECT_GT(cells, 10000U);
  EXPECT_EQ(live.grid().tiles().size(), again.grid().tiles().size());
}

}  // namespace
}  // namespace topo::daemon
