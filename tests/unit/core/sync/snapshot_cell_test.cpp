// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/snapshot_cell.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace topo::sync {
namespace {

/// Counts the living, to see when the writer destroys.
class Value {
 public:
  explicit Value(int number) : number_(number) { ++alive; }
  Value(const Value&) = delete;
  Value& operator=(const Value&) = delete;
  ~Value() { --alive; }
  [[nodiscard]] int number() const { return number_; }
  static inline int alive = 0;

 private:
  int number_;
};

using Cell = SnapshotCell<Value, 2>;

TEST(SnapshotCell, PinsNothingBeforeTheFirstPublish) {
  Cell cell;
  auto reader = cell.reader(0);
  const auto a = reader.pin();
  const auto b = reader.pin();
  const auto c = reader.pin();  // an empty pin takes no slot
  EXPECT_FALSE(a || b || c);
  EXPECT_EQ(a.get(), nullptr);
  EXPECT_EQ(cell.current(), nullptr);
}

TEST(SnapshotCell, DestroysTheOldValueWhenNobodyPinsIt) {
  Value::alive = 0;
  {
    Cell cell;
    cell.publish(std::make_unique<Value>(1));
    cell.publish(std::make_unique<const Value>(2));
    EXPECT_EQ(Value::alive, 1);
    EXPECT_EQ(cell.current()->number(), 2);
  }
  EXPECT_EQ(Value::alive, 0);
}

TEST(SnapshotCell, KeepsWhatIsPinnedUntilTheWriterReclaims) {
  Value::alive = 0;
  Cell cell;
  cell.publish(std::make_unique<Value>(1));
  auto reader = cell.reader(1);
  auto pin = reader.pin();
  cell.publish(std::make_unique<Value>(2));
  cell.publish(std::make_unique<Value>(3));
  EXPECT_EQ(pin->number(), 1);
  EXPECT_EQ((*pin).number(), 1);
  EXPECT_EQ(Value::alive, 2);
  pin.reset();
  EXPECT_EQ(Value::alive, 2);  // a reader destroys nothing
  EXPECT_EQ(cell.retired(), 1U);
  EXPECT_EQ(cell.reclaim(), 0U);
  EXPECT_EQ(Value::alive, 1);
}

TEST(SnapshotCell, ReaderHoldsTheOldWhileItTakesTheNew) {
  Cell cell;
  auto reader = cell.reader(0);
  cell.publish(std::make_unique<Value>(0));
  auto held = reader.pin();
  for (int i = 1; i < 10; ++i) {
    cell.publish(std::make_unique<Value>(i));
    auto fresh = reader.pin();
    EXPECT_EQ(held->number(), i - 1);
    EXPECT_EQ(fresh->number(), i);
    held = std::move(fresh);
  }
}

TEST(SnapshotCell, OldValuesAreBoundedByTheHazardSlots) {
  Value::alive = 0;
  Cell cell;
  std::vector<Cell::Reader> readers;
  readers.push_back(cell.reader(0));
  readers.push_back(cell.reader(1));
  std::vector<Cell::Pin> pins;
  cell.publish(std::make_unique<Value>(0));
  for (int i = 1; i <= 4; ++i) {
    pins.push_back(readers[static_cast<std::size_t>(i % 2)].pin());
    cell.publish(std::make_unique<Value>(i));
  }
  for (int i = 5; i < 50; ++i) cell.publish(std::make_unique<Value>(i));
  EXPECT_EQ(cell.retired(), 4U);
  EXPECT_EQ(Value::alive, 5);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(pins[static_cast<std::size_t>(i)]->number(), i);
}

TEST(SnapshotCell, AReaderThatWasGivenBackCanBeTakenAgain) {
  Cell cell;
  std::optional<Cell::Reader> first = cell.reader(0);
  first.reset();
  auto second = cell.reader(0);
  cell.publish(std::make_unique<Value>(5));
  EXPECT_EQ(second.pin()->number(), 5);
}

TEST(SnapshotCellDeathTest, WrongUseAborts) {
  Cell cell;
  cell.publish(std::make_unique<Value>(1));
  auto reader = cell.reader(0);
  EXPECT_DEATH((void)cell.reader(0), "taken twice");
  EXPECT_DEATH((void)cell.reader(2), "no such reader");
  EXPECT_DEATH(cell.publish(std::unique_ptr<const Value>()), "null published");
  const auto a = reader.pin();
  const auto b = reader.pin();
  EXPECT_DEATH((void)reader.pin(), "three pins");
}

}  // namespace
}  // namespace topo::sync
