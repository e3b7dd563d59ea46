// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/page_client.hpp"

#include <spdlog/spdlog.h>

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>

#include "daemon/app/version.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

namespace websocket = boost::beast::websocket;
using boost::beast::error_code;
using types::Errc;
using types::fail;

/// State repeats itself from message to message, so the window is kept from one to the next and reaches back
/// over several. About 160 kB a page.
websocket::permessage_deflate compression() {
  websocket::permessage_deflate deflate;
  deflate.server_enable = true;
  deflate.memLevel = 6;
  return deflate;
}

websocket::stream_base::timeout timeouts() {
  return {std::chrono::seconds(10), std::chrono::seconds(20), true};
}

}  // namespace

PageClient::PageClient(boost::beast::tcp_stream stream, ViewParts& parts, std::shared_ptr<void> seat)
    : socket_(std::move(stream)),
      parts_(parts),
      seat_(std::move(seat)),
      in_(kMaxActBytes),
      acts_(types::from_seconds(1.0 / parts.limits.acts_per_second), 2 * parts.limits.acts_per_second) {}

void PageClient::start(const Request& request) {
  socket_.next_layer().expires_never();  // the WebSocket has timeouts of its own
  socket_.set_option(timeouts());
  socket_.set_option(compression());
  socket_.read_message_max(kMaxActBytes);
  error_code ignored;
  auto& tcp = socket_.next_layer().socket();
  tcp.set_option(boost::asio::socket_base::send_buffer_size(static_cast<int>(parts_.limits.send_buffer)),
                 ignored);
  tcp.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  socket_.text(true);
  socket_.async_accept(request, [self = shared_from_this()](const error_code& failed) {
    if (failed) return;
    self->open_ = true;
    if (self->parts_.look == ViewLook::kEverybody) self->outbox_.show();
    self->greet();
    self->read();
  });
}

void PageClient::read() {
  socket_.async_read(in_, [self = shared_from_this()](const error_code& ended, std::size_t) {
    if (ended) return self->drop();
    const std::string text = boost::beast::buffers_to_string(self->in_.data());
    self->in_.consume(self->in_.size());
    self->take(text);
    if (self->open_) self->read();
  });
}

void PageClient::take(std::string_view text) {
  const auto act = parse_act(text);
  const bool within = acts_.take(io::monotonic_now());
  if (!act) return answer(0, tl::unexpected(act.error()));
  if (act->kind == Act::Kind::kReplay) return answer(act->id, play(*act, within));
  if (parts_.time_line && act->kind != Act::Kind::kAuthorise)
    return answer(act->id, fail(Errc::kUnsupported, "this is a replay: there is no robot behind this page"));
  if (act->kind == Act::Kind::kEstop) {
    // Whoever may look may stop, however often.
    if (!outbox_.shown())
      return answer(act->id, fail(Errc::kPermission, "who may not look may not stop: a token is needed"));
  } else if (!within) {
    return answer(act->id, fail(Errc::kBusy, "too many orders from this page"));
  }
  if (act->kind == Act::Kind::kAuthorise) return authorise(*act);
  if (act->kind == Act::Kind::kCommand && (token_hash_.empty() || !parts_.rights.hold(token_hash_)))
    return answer(act->id,
                  fail(Errc::kPermission, "this needs a token: topoview pair, on the robot, makes one"));
  if (within) spdlog::info("{}: ordered by a page", act->method);  // a flood does not fill the disk
  parts_.orders.give(*act, [page = weak_from_this(), id = act->id](const types::Result<Json>& result) {
    if (const auto self = page.lock()) self->answer(id, result);
  });
}

/// Whoever may look may go to and fro: no robot moves by it.
types::Result<Json> PageClient::play(const Act& act, bool within) {
  if (!parts_.time_line)
    return fail(Errc::kUnsupported, "this is no replay: the robot is live (topoview --replay)");
  if (!outbox_.shown()) return fail(Errc::kPermission, "looking needs a token here");
  if (!within) return fail(Errc::kBusy, "too many wishes from this page");
  if (auto done = parts_.time_line(act.params); !done) return tl::unexpected(done.error());
  return Json::object();
}

void PageClient::authorise(const Act& act) {
  const std::string hash = token_hash(act.token);
  if (!parts_.rights.hold(hash)) {
    answer(act.id, fail(Errc::kPermission, "this token is not known here, or was revoked"));
    if (++wrong_tokens_ >= parts_.limits.wrong_tokens) drop();
    return;
  }
  token_hash_ = hash;
  outbox_.show();
  answer(act.id, Json::object());
  greet();
}

void PageClient::greet() {
  const bool may = !token_hash_.empty();
  if (!outbox_.answer({{"t", "hello"},
                       {"robot", parts_.robot},
                       {"version", kVersion},
                       {"look", outbox_.shown()},
                       {"may", may && !parts_.time_line},
                       {"replay", static_cast<bool>(parts_.time_line)}}))
    return drop();
  pump();
}

void PageClient::answer(std::uint64_t id, const types::Result<Json>& result) {
  Json json{{"t", "answer"}, {"id", id}, {"ok", result.has_value()}};
  if (result) json["v"] = *result;
  if (!result) json["why"] = result.error().message;
  if (!outbox_.answer(json)) return drop();
  pump();
}

void PageClient::pump() {
  if (!open_ || sending_ != nullptr) return;
  const bool needs_token = parts_.look == ViewLook::kToken && outbox_.shown();
  if (needs_token && !parts_.rights.hold(token_hash_)) return drop();  // it was revoked
  sending_ = outbox_.next(parts_.board);
  if (sending_ == nullptr) return;
  socket_.async_write(boost::asio::buffer(*sending_),
                      [self = shared_from_this()](const error_code& failed, std::size_t) {
                        self->sending_ = nullptr;
                        if (failed) return self->drop();
                        self->pump();
                      });
}

void PageClient::drop() {
  open_ = false;
  socket_.next_layer().close();  // pending operations end with an error
}

}  // namespace topo::daemon
