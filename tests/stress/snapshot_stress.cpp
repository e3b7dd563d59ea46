// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The mapping thread's pattern: one writer changes a persistent map in place and publishes versions of it,
// readers pin them, hold old ones, compare them with new ones. Each version has an invariant that any tear or
// early reuse breaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "core/patricia/cow.hpp"
#include "core/patricia/map.hpp"
#include "core/sync/snapshot_cell.hpp"
#include "tests/stress/yielding.hpp"

namespace topo {
namespace {

using patricia::cell_key;
using patricia::Cow;
using patricia::Key;
using Bits = std::uint64_t;
struct Tile {
  std::array<Bits, 32> cells{};
};
using BitMap = patricia::Map<Bits>;
using TileMap = patricia::Map<Cow<Tile>>;

constexpr std::size_t kReaders = 3;
constexpr std::int32_t kSide = 48;

/// Invariant: the values' sum is `sum`, there are `size` keys, and every tile is filled with one number.
struct Version {
  std::uint64_t revision;
  std::uint64_t sum;
  std::size_t size;
  BitMap bits;
  TileMap tiles;
};
template <class Steps>
using Cell = sync::SnapshotCell<Version, kReaders, Steps>;

/// A small generator, so that a failure comes again.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t n) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return (state_ >> 33U) % n;
  }

 private:
  std::uint64_t state_;
};

class Writer {
 public:
  Writer() {
    for (std::int32_t x = 0; x < kSide; ++x) {
      for (std::int32_t y = 0; y < kSide; ++y) bits_.insert(cell_key(x, y), 1);
    }
    sum_ = bits_.size();
  }

  /// The constructing thread hands the writer over to the calling one.
  void adopt() {
    bit_arena_.adopt();
    tile_arena_.adopt();
  }

  void change() {
    for (int i = 0; i < 20; ++i) {
      const Key key = any_key();
      if (dice_.below(4) == 0) {
        if (const Bits* value = bits_.find(key)) sum_ -= *value;
        bits_.erase(key);
      } else {
        const Bits more = dice_.below(100);
        bits_.insert_with(key, more, [](Bits a, Bits b) { return a + b; });
        sum_ += more;
      }
    }
    tiles_.update(cell_key(static_cast<std::int32_t>(dice_.below(6)), 0)).write().cells.fill(revision_);
  }

  std::unique_ptr<const Version> make_version() {
    return std::unique_ptr<const Version>(new Version{++revision_, sum_, bits_.size(), bits_, tiles_});
  }

  [[nodiscard]] bool only_own_nodes_alive() const {
    return bit_arena_.counts().leaves == bits_.size() && tile_arena_.counts().leaves == tiles_.size();
  }

 private:
  Key any_key() {
    return cell_key(static_cast<std::int32_t>(dice_.below(kSide)),
                    static_cast<std::int32_t>(dice_.below(kSide)));
  }

  patricia::Arena<Bits> bit_arena_;
  patricia::Arena<Cow<Tile>> tile_arena_;
  BitMap bits_{bit_arena_};
  TileMap tiles_{tile_arena_};
  std::uint64_t sum_ = 0;
  std::uint64_t revision_ = 0;
  Dice dice_{7};
};

bool holds(const Version& v) {
  std::uint64_t sum = 0;
  std::size_t size = 0;
  bool good = true;
  v.bits.for_each([&](Key, Bits b) { sum += b, ++size; });
  v.tiles.for_each([&](Key, const Cow<Tile>& tile) {
    for (const Bits b : tile.read().cells) good = good && b == tile.read().cells[0];
  });
  return good && sum == v.sum && size == v.size && v.bits.size() == v.size;
}

/// The sum of one version from that of another and their difference.
bool differ_by_difference(const Version& before, const Version& after) {
  std::uint64_t sum = before.sum;
  BitMap::difference(before.bits, after.bits, [&](Key, const Bits* old_value, const Bits* new_value) {
    if (old_value != nullptr) sum -= *old_value;
    if (new_value != nullptr) sum += *new_value;
  });
  return sum == after.sum;
}

struct Findings {
  std::uint64_t looks = 0;
  std::uint64_t broken = 0;
  std::uint64_t backwards = 0;
};

/// Looks `looks` times, holding the version before while it takes the next.
template <class Steps>
void watch(typename Cell<Steps>::Reader reader, std::uint64_t looks, Findings& findings) {
  auto held = reader.pin();
  while (findings.looks < looks) {
    auto fresh = reader.pin();
    ++findings.looks;
    if (fresh->revision < held->revision) ++findings.backwards;
    if (!holds(*fresh) || !differ_by_difference(*held, *fresh)) ++findings.broken;
    held = std::move(fresh);
  }
}

template <class Steps>
void check_versions(std::uint64_t looks) {
  Writer writer;
  auto cell = std::make_unique<Cell<Steps>>();
  cell->publish(writer.make_version());
  std::array<Findings, kReaders> findings{};
  std::size_t most_retired = 0;
  std::atomic<std::size_t> watching{kReaders};
  std::vector<std::thread> readers;
  for (std::size_t i = 0; i < kReaders; ++i) {
    readers.emplace_back([&, i] {
      watch<Steps>(cell->reader(i), looks, findings[i]);
      watching.fetch_sub(1, std::memory_order_relaxed);
    });
  }
  std::thread mapping([&] {
    writer.adopt();
    while (watching.load(std::memory_order_relaxed) > 0) {
      writer.change();
      cell->publish(writer.make_version());
      most_retired = std::max(most_retired, cell->retired());
    }
  });
  for (std::thread& r : readers) r.join();
  mapping.join();
  writer.adopt();

  for (const Findings& f : findings) {
    EXPECT_EQ(f.looks, looks);
    EXPECT_EQ(f.broken, 0U);
    EXPECT_EQ(f.backwards, 0U);
  }
  EXPECT_LE(most_retired, 2 * kReaders);
  EXPECT_EQ(cell->reclaim(), 0U);
  cell.reset();
  EXPECT_TRUE(writer.only_own_nodes_alive());
}

TEST(SnapshotStress, PinnedVersionsOfAMapNeverChangeAndNoneLeaks) { check_versions<sync::Undisturbed>(400); }
TEST(SnapshotStressYielding, PinnedVersionsOfAMapNeverChangeAndNoneLeaks) {
  check_versions<stress::Yielding>(100);
}

/// Spoils itself when it is destroyed.
struct Small {
  explicit Small(std::uint64_t n) : number(n), twin(~n) {}
  Small(const Small&) = delete;
  Small& operator=(const Small&) = delete;
  ~Small() { twin = number; }
  [[nodiscard]] bool alive() const { return twin == ~number; }
  std::uint64_t number;
  std::uint64_t twin;
};

// The other test's publishes are far apart; these come into the middle of a pin. With one reader the list of
// retired values is shortest, and every slot is in use most of the time.
template <std::size_t readers_of_it, class Steps>
void check_pins(std::uint64_t looks) {
  using SmallCell = sync::SnapshotCell<Small, readers_of_it, Steps>;
  auto cell = std::make_unique<SmallCell>();
  cell->publish(std::make_unique<Small>(0));
  std::array<std::uint64_t, readers_of_it> wrong{};
  std::atomic<std::size_t> watching{readers_of_it};
  std::vector<std::thread> readers;
  for (std::size_t i = 0; i < readers_of_it; ++i) {
    readers.emplace_back([&, i] {
      auto reader = cell->reader(i);
      auto held = reader.pin();
      for (std::uint64_t look = 0; look < looks; ++look) {
        auto fresh = reader.pin();
        if (!fresh->alive() || !held->alive() || fresh->number < held->number) ++wrong[i];
        held = std::move(fresh);
      }
      watching.fetch_sub(1, std::memory_order_relaxed);
    });
  }
  std::size_t most_retired = 0;
  for (std::uint64_t n = 1; watching.load(std::memory_order_relaxed) > 0; ++n) {
    cell->publish(std::make_unique<Small>(n));
    most_retired = std::max(most_retired, cell->retired());
  }
  for (std::thread& r : readers) r.join();
  for (const std::uint64_t w : wrong) EXPECT_EQ(w, 0U);
  EXPECT_LE(most_retired, SmallCell::kSlots);
}

TEST(SnapshotStress, APinHoldsHoweverFastTheWriterIs) { check_pins<kReaders, sync::Undisturbed>(300000); }
TEST(SnapshotStressYielding, APinHoldsHoweverFastTheWriterIs) {
  check_pins<kReaders, stress::Yielding>(20000);
}
TEST(SnapshotStressYielding, APinOfTheOnlyReaderHolds) { check_pins<1, stress::Yielding>(50000); }

}  // namespace
}  // namespace topo
