// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/map_film.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "daemon/session/journal_file.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

/// A journal in which every batch of keyframes moved those before it.
MapHistory corrected_map(std::size_t batches) {
  const testing::TempDir folder;
  std::mt19937 random(1);
  slam::Session session;
  auto journal = JournalFile::create(folder.file("journal-1.session"), 7);
  for (std::size_t i = 0; i < batches; ++i) {
    testing::drive_on(session, 3, random);
    for (types::Se2& pose : session.poses) pose.x_m += 0.1;
    EXPECT_TRUE(journal->append(session).has_value());
  }
  EXPECT_TRUE(journal->close(session));
  return std::move(*load_history(journal->path()));
}

/// What a page has of a map that is shown to it: the cells of each tile that is not unknown.
class PageMap {
 public:
  void take(const MapFilm& film) {
    for (bool more = true; more;) {
      const Json tiles = film.tiles(revision_);
      revision_ = tiles["revision"].get<std::uint64_t>();
      more = tiles["more"].get<bool>();
      for (const Json& tile : tiles["tiles"])
        tiles_[{tile[0].get<int>(), tile[1].get<int>()}] = tile[2].get<std::string>();
    }
  }
  [[nodiscard]] std::map<std::pair<int, int>, std::string> known() const {
    auto known = tiles_;
    const std::string unknown = encode_cells(std::vector<grid::CellState>(TileBook::kSide * TileBook::kSide));
    std::erase_if(known, [&](const auto& tile) { return tile.second == unknown; });
    return known;
  }

 private:
  std::uint64_t revision_ = 0;
  std::map<std::pair<int, int>, std::string> tiles_;
};

RC_GTEST_PROP(MapFilm, ByWhateverWayAPlaceIsReachedItShowsTheSame, ()) {
  static const MapHistory history = corrected_map(6);
  MapFilm film({}), fresh({});
  film.load(history);
  fresh.load(history);
  PageMap page, other;
  const auto way =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, 20)));
  for (const std::size_t keyframes : way) {
    film.show(keyframes);
    page.take(film);
  }
  fresh.show(way.back());
  other.take(fresh);
  RC_ASSERT(page.known() == other.known());
  RC_ASSERT(film.trails() == fresh.trails());
}

TEST(MapFilm, ShowsAMapOnce) {
  MapFilm film({});
  EXPECT_TRUE(film.show(3)) << "that there is none";
  film.load(corrected_map(2));
  EXPECT_TRUE(film.show(3));
  EXPECT_FALSE(film.show(3));
  EXPECT_EQ(film.trails()["own"].size(), 3U);
  EXPECT_TRUE(film.show(1));
  EXPECT_EQ(film.trails()["own"].size(), 1U);
  EXPECT_FALSE(film.tiles(0)["tiles"].empty());
}

TEST(MapFilm, AMateIsWhereItsNewestKeyframeThenIs) {
  std::mt19937 random(3);
  slam::Session session;
  testing::drive_on(session, 6, random);
  for (const std::size_t i : {std::size_t{2}, std::size_t{4}}) {
    slam::Keyframe of_mate = *session.keyframes[i];
    of_mate.id.robot = static_cast<std::uint16_t>(session.keyframes[0]->id.robot + 2);
    session.keyframes[i] = std::make_shared<const slam::Keyframe>(std::move(of_mate));
  }
  auto history = parse_history(*session_bytes(session, 1));
  ASSERT_TRUE(history);
  MapFilm film({});
  film.load(std::move(*history));
  film.show(2);
  EXPECT_TRUE(film.last_places().empty());
  film.show(4);
  ASSERT_EQ(film.last_places().size(), 1U);
  EXPECT_EQ(film.last_places()[0].keyframe, 2U);
  film.show(6);
  EXPECT_EQ(film.last_places()[0].keyframe, 4U);
  EXPECT_EQ(film.last_places()[0].T_map_base, session.poses[4]);
  EXPECT_EQ(film.trails()["mates"][0].size(), 2U);
}

}  // namespace
}  // namespace topo::daemon
