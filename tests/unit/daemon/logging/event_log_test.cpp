// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/logging/event_log.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>
#include <spdlog/sinks/ostream_sink.h>

#include <memory>
#include <set>
#include <sstream>
#include <thread>

#include "daemon/logging/event_catalogue.hpp"

namespace topo::daemon {
namespace {

using sync::Severity;
using ::testing::HasSubstr;

class EventLogTest : public ::testing::Test {
 protected:
  EventLogTest() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(out_);
    auto logger = std::make_shared<spdlog::logger>("test", sink);
    logger->set_pattern("%l %v");
    log_ = std::make_unique<EventLog>(logger);
    logger_ = logger;
  }
  std::ostringstream out_;
  std::shared_ptr<spdlog::logger> logger_;
  std::unique_ptr<EventLog> log_;
  sync::EventRing<4> ring_;
};

TEST_F(EventLogTest, FormatsWithSeverityThreadAndStamp) {
  post(ring_, 2'500'000'000, EventId::kPlanningSlow, Severity::kWarning, {480'000'000, 400'000'000, 3});
  post(ring_, 3'000'000'000, EventId::kScanRingFull, Severity::kError, {7, 0, 0}, "front");
  EXPECT_EQ(log_->drain("base", ring_), 2U);
  EXPECT_EQ(
      out_.str(),
      "warning base: planning took 480 ms, the period is 400 ms; 3 times since the start [at 2.500000 s]\n"
      "error base: front: the mapping thread is behind: 7 scans lost since the start [at 3.000000 s]\n");
}

TEST_F(EventLogTest, TellsLossesOnce) {
  for (int i = 0; i < 7; ++i) post(ring_, i, EventId::kDeadlineMissed, Severity::kInfo);
  EXPECT_EQ(log_->drain("scan front", ring_), 4U);
  EXPECT_THAT(
      out_.str(),
      HasSubstr("warning scan front: 3 events found no room in the ring and are lost, 3 since the start"));
  out_.str("");
  EXPECT_EQ(log_->drain("scan front", ring_), 0U);
  EXPECT_EQ(out_.str(), "");
  EXPECT_EQ(log_->lost(), 3U);
}

TEST_F(EventLogTest, WhatTheLevelLeavesOutIsTakenFromTheRingAllTheSame) {
  logger_->set_level(spdlog::level::warn);
  post(ring_, 0, EventId::kPlanningSlow, Severity::kInfo);
  EXPECT_EQ(log_->drain("base", ring_), 1U);
  EXPECT_EQ(out_.str(), "");
}

TEST(EventCatalogue, EveryEventHasATemplateThatFormats) {
  std::set<std::string_view> names;
  for (std::uint16_t id = 0; id < static_cast<std::uint16_t>(EventId::kCount); ++id) {
    const auto known = template_of(id);
    ASSERT_TRUE(known.has_value());
    EXPECT_TRUE(names.insert(known->name).second) << known->name;
    sync::Event event;
    event.id = id;
    event.args = {1, -2, INT64_MIN};
    event.set_text("front");
    const std::string text = format_event(event);
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find('{'), std::string::npos) << text;
  }
}

TEST(EventCatalogue, AnyRecordBecomesOnePrintableLine) {
  EXPECT_TRUE(rc::check([](std::uint16_t id, std::int64_t a, std::int64_t b, const std::string& text) {
    sync::Event event;
    event.id = id % 40;
    event.args = {a, b, 0};
    event.set_text(text);
    for (const char c : format_event(event)) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20);
  }));
}

TEST(EventCatalogue, AnUnknownNumberIsSaid) {
  sync::Event event;
  event.id = 999;
  event.args = {1, 2, 3};
  EXPECT_EQ(format_event(event), "event 999 without a name (1, 2, 3) ");
}

TEST_F(EventLogTest, TakesWhatAnotherThreadPostsAndCountsTheRest) {
  constexpr std::uint64_t kPosts = 5000;
  std::thread poster([this] {
    for (std::uint64_t i = 0; i < kPosts; ++i)
      post(ring_, static_cast<std::int64_t>(i), EventId::kDeadlineMissed, Severity::kDebug);
  });
  std::uint64_t taken = 0;
  for (int i = 0; i < 100; ++i) taken += log_->drain("base", ring_);
  poster.join();
  while (const std::size_t n = log_->drain("base", ring_)) taken += n;
  EXPECT_EQ(taken + log_->lost(), kPosts);
}

}  // namespace
}  // namespace topo::daemon
