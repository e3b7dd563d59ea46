// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/control_line.hpp"

#include <fmt/format.h>

#include <boost/asio/write.hpp>
#include <utility>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using boost::system::error_code;
using types::Errc;
using types::fail;

constexpr std::size_t kMaxAnswerBytes = 4 << 20;  // as topoctl's
constexpr auto kConnectAgain = std::chrono::seconds(1);
// The longest answers are those of searches for a route on a loaded machine.
constexpr types::Duration kPatience = std::chrono::seconds(20);
constexpr auto kWatchPeriod = std::chrono::seconds(1);

}  // namespace

ControlLine::ControlLine(boost::asio::io_context& io, std::string socket, News news)
    : peer_(io),
      again_(io),
      watch_(io),
      socket_(std::move(socket)),
      news_(std::move(news)),
      in_(kMaxAnswerBytes) {}

void ControlLine::start() {
  connect();
  watch();
}

void ControlLine::connect() {
  error_code refused;
  peer_ = boost::asio::local::stream_protocol::socket(again_.get_executor());
  // A Unix socket connects at once or, when its backlog is full, not at all: non-blocking from the beginning.
  peer_.open({}, refused);
  if (!refused) peer_.non_blocking(true, refused);
  if (!refused) peer_.connect(boost::asio::local::stream_protocol::endpoint(socket_), refused);
  if (refused) return lose(fmt::format("no daemon answers on {}: {}", socket_, refused.message()));
  joined_ = true;
  ++connection_;
  in_ = LineBuffer(kMaxAnswerBytes);
  read();
  news_.joined();
}

void ControlLine::read() {
  peer_.async_read_some(boost::asio::buffer(bytes_),
                        [this, connection = connection_](const error_code& ended, std::size_t got) {
                          if (connection != connection_ || !joined_) return;
                          if (ended) return lose("the daemon hung up");
                          const bool fits = in_.append({bytes_.data(), got});
                          while (auto line = in_.take_line()) {
                            take_line(*line);
                            if (connection != connection_ || !joined_) return;
                          }
                          if (!fits) return lose("the daemon's answer does not end");
                          read();
                        });
}

void ControlLine::take_line(const std::string& line) {
  if (const auto event = parse_notification(line)) return news_.event(*event);
  const Json json = Json::parse(line, nullptr, false);
  const auto id = json.is_object() ? json.find("id") : json.end();
  if (!json.is_object() || id == json.end() || !id->is_number_integer()) return;
  const auto found = waiting_.find(id->get<int>());
  if (found == waiting_.end()) return;
  const Done done = std::move(found->second.done);
  const int number = found->first;
  waiting_.erase(found);
  done(parse_answer(line, number));
}

void ControlLine::call(std::string_view method, const Json& params, Done done) {
  if (!joined_) return done(fail(Errc::kClosed, "no daemon answers"));
  const int id = next_id_;
  next_id_ = next_id_ % (1 << 30) + 1;
  waiting_[id] = {std::move(done), io::monotonic_now()};
  out_ += request_line(method, params, id);
  write();
}

void ControlLine::write() {
  if (writing_ || out_.empty() || !joined_) return;
  writing_ = true;
  sending_ = std::exchange(out_, {});
  boost::asio::async_write(peer_, boost::asio::buffer(sending_),
                           [this, connection = connection_](const error_code& failed, std::size_t) {
                             if (connection != connection_ || !joined_) return;
                             writing_ = false;
                             if (failed) return lose("the daemon hung up");
                             write();
                           });
}

void ControlLine::watch() {
  watch_.expires_after(kWatchPeriod);
  watch_.async_wait([this](const error_code& cancelled) {
    if (cancelled) return;
    const types::Stamp now = io::monotonic_now();
    for (const auto& [id, waiting] : waiting_) {
      if (now - waiting.since <= kPatience) continue;
      lose("the daemon does not answer");
      break;
    }
    watch();
  });
}

void ControlLine::lose(const std::string& why) {
  joined_ = false;
  writing_ = false;
  error_code ignored;
  peer_.close(ignored);
  out_.clear();
  again_.expires_after(kConnectAgain);
  again_.async_wait([this](const error_code& cancelled) {
    if (!cancelled) connect();
  });
  news_.lost(why);
  for (auto& [id, waiting] : std::exchange(waiting_, {})) waiting.done(fail(Errc::kClosed, why));
}

}  // namespace topo::daemon
