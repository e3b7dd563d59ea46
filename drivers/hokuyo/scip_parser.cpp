// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/scip_parser.hpp"

#include <algorithm>

#include "core/types/invariant.hpp"

namespace topo::hokuyo {
namespace {

using Kind = StreamRequest::Kind;

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c <= 0x7E; });
}

bool has_intensity(Kind kind) { return kind == Kind::kRangeIntensity || kind == Kind::kMultiIntensity; }
bool has_echoes(Kind kind) { return kind == Kind::kMultiEcho || kind == Kind::kMultiIntensity; }
std::uint8_t width(Kind kind) { return kind == Kind::kRangeShort ? 2 : 3; }

}  // namespace

void Reply::start(std::string_view echo) {
  echo_size_ = std::min(echo.size(), echo_.size());
  std::copy_n(echo.data(), echo_size_, echo_.data());
  status_size_ = 0;
  lines_ = 0;
  begin_[0] = 0;
}

void Reply::set_status(std::string_view status) {
  status_size_ = std::min(status.size(), status_.size());
  std::copy_n(status.data(), status_size_, status_.data());
}

bool Reply::add_line(std::string_view line) {
  const std::size_t begin = begin_[lines_];
  if (lines_ == kMaxLines || line.size() > kMaxText - begin) return false;
  std::copy_n(line.data(), line.size(), text_.data() + begin);
  begin_[++lines_] = begin + line.size();
  return true;
}

void ScipParser::reset() {
  state_ = State::kEcho;
  line_size_ = 0;
  overflow_ = false;
}

ScipParser::Progress ScipParser::feed(std::span<const std::byte> bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = static_cast<char>(bytes[i]);
    if (c != '\n') {
      if (line_size_ < kMaxLine) {
        line_[line_size_++] = c;
      } else {
        overflow_ = true;
      }
      continue;
    }
    const std::string_view line(line_.data(), line_size_);
    const Event event = overflow_ ? drop(line) : on_line(line);
    line_size_ = 0;
    overflow_ = false;
    if (event != Event::kNone) return {i + 1, event};
  }
  return {bytes.size(), Event::kNone};
}

/// Reports garbage once, at its beginning; an empty line ends it.
ScipParser::Event ScipParser::drop(std::string_view line) {
  const bool told = state_ == State::kSkip;
  state_ = line.empty() ? State::kEcho : State::kSkip;
  return told ? Event::kNone : Event::kGarbage;
}

ScipParser::Event ScipParser::on_line(std::string_view line) {
  switch (state_) {
    case State::kEcho:
      if (line.empty()) return Event::kNone;
      if (line.size() > reply_.echo_.size() || !is_printable(line)) return drop(line);
      reply_.start(line);
      state_ = State::kStatus;
      return Event::kNone;
    case State::kStatus:
      return on_status(line);
    case State::kLines:
      return on_reply_line(line);
    case State::kTime:
      return on_time(line);
    case State::kData:
      return on_data(line);
    case State::kSkip:
      return drop(line);
  }
  return Event::kNone;
}

ScipParser::Event ScipParser::on_status(std::string_view line) {
  if (line.size() == 1 && is_printable(line)) {  // SCIP 1.1: one character, no check
    reply_.set_status(line);
    state_ = State::kLines;
    return Event::kNone;
  }
  const auto status = checked(line);
  if (line.size() != 3 || !status) return drop(line);
  reply_.set_status(*status);
  state_ = State::kLines;
  if (*status == "99" && !start_scan()) return drop(line);
  return Event::kNone;
}

ScipParser::Event ScipParser::on_reply_line(std::string_view line) {
  if (line.empty()) {
    state_ = State::kEcho;
    return Event::kReply;
  }
  return reply_.add_line(line) ? Event::kNone : drop(line);
}

/// Status 99 precedes a scan and occurs nowhere else.
bool ScipParser::start_scan() {
  const auto echo = parse_stream_echo(reply_.echo());
  if (!echo) return false;
  expected_ = echo->points();
  if (expected_ == 0 || expected_ > types::Scan::kMaxBeams) return false;
  scan_.echo = *echo;
  scan_.points = 0;
  value_ = 0;
  characters_ = 0;
  part_ = 0;
  further_echo_ = false;
  last_line_ = false;
  state_ = State::kTime;
  return true;
}

ScipParser::Event ScipParser::on_time(std::string_view line) {
  const auto text = checked(line);
  const auto time = text && text->size() == 4 ? decode_number(*text) : std::nullopt;
  if (!time) return drop(line);
  scan_.time_ms = *time;
  state_ = State::kData;
  return Event::kNone;
}

ScipParser::Event ScipParser::on_data(std::string_view line) {
  if (line.empty()) return finish_scan();
  const auto text = checked(line);
  if (!text || last_line_ || text->size() > kDataWidth || !take_values(*text)) return drop(line);
  last_line_ = text->size() < kDataWidth;
  return Event::kNone;
}

bool ScipParser::take_values(std::string_view text) {
  const bool echoes = has_echoes(scan_.echo.kind);
  for (const char c : text) {
    if (c == '&' && echoes) {
      // Allowed only between two values, after a first echo.
      if (characters_ != 0 || part_ != 0 || scan_.points == 0 || further_echo_) return false;
      further_echo_ = true;
      continue;
    }
    if (c < 0x30 || c > 0x6F) return false;
    value_ = value_ << 6U | static_cast<std::uint32_t>(c - 0x30);
    if (++characters_ < width(scan_.echo.kind)) continue;
    if (!store_value()) return false;
  }
  return true;
}

bool ScipParser::store_value() {
  const bool two_parts = has_intensity(scan_.echo.kind);
  if (!further_echo_) {
    if (scan_.points == expected_) return false;
    types::require(scan_.points < scan_.range_mm.size(), "hokuyo::ScipParser: more values than a scan holds");
    (part_ == 0 ? scan_.range_mm : scan_.intensity)[scan_.points] = value_;
  }
  value_ = 0;
  characters_ = 0;
  if (two_parts && part_ == 0) {
    part_ = 1;
    return true;
  }
  part_ = 0;
  if (!further_echo_) ++scan_.points;
  further_echo_ = false;
  return true;
}

ScipParser::Event ScipParser::finish_scan() {
  const bool complete = scan_.points == expected_ && characters_ == 0 && part_ == 0 && !further_echo_;
  state_ = State::kEcho;
  return complete ? Event::kScan : Event::kGarbage;
}

}  // namespace topo::hokuyo
