// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_socket.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <cerrno>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr mode_t kOwnerOnly = 0600;  // who can write here speaks for the whole team

bool watch(int events, int fd) {
  epoll_event entry{};
  entry.events = EPOLLIN;
  entry.data.fd = fd;
  return ::epoll_ctl(events, EPOLL_CTL_ADD, fd, &entry) == 0;
}

}  // namespace

types::Result<LinkSocket> LinkSocket::listen(const std::string& path, const LinkIdentity& own,
                                             const LinkSocketParams& params) {
  auto listening = io::ListeningSocket::open(path, kOwnerOnly, kLinkSocketKind);
  if (!listening) return tl::unexpected(listening.error());
  io::UniqueFd events(::epoll_create1(EPOLL_CLOEXEC));
  if (!events.valid() || !watch(events.get(), listening->fd()))
    return io::fail_errno("link socket " + path, "no event queue", errno);
  return LinkSocket(std::move(*listening), std::move(events), own, params);
}

void LinkSocket::accept(types::Stamp now) {
  io::UniqueFd fd(io::retry_interrupted(
      [this] { return ::accept4(listening_.fd(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); }));
  if (!fd.valid()) return;
  const bool held = channel_ && channel_->state() != LinkChannel::State::kClosed &&
                    now - heard_.value_or(now) <= params_.silence_max;
  if (held) {
    LinkChannel second(std::move(fd), own_);
    second.send(encode_refusal("another link serves this daemon; expected one"));
    return;
  }
  if (!watch(events_.get(), fd.get())) return;
  channel_.emplace(std::move(fd), own_);
  link_.reset();
  heard_ = now;
}

void LinkSocket::take_messages(types::Stamp now, const Take& take) {
  for (std::size_t n = 0; channel_ && n < params_.messages_a_turn; ++n) {
    const auto packet = channel_->next();
    if (!packet) return;
    heard_ = now;
    if (packet->is_heard()) {
      ++counts_.received;
      take(packet->sender(), packet->datagram());
      continue;
    }
    const auto stats = decode_stats(packet->bytes);
    if (stats)
      link_ = *stats;
    else
      ++counts_.malformed;
  }
}

std::optional<LinkNews> LinkSocket::alone(std::string words) {
  joined_ = false;
  link_.reset();
  if (std::exchange(told_alone_, true)) return {};
  return LinkNews{LinkNews::Kind::kAlone, std::move(words)};
}

std::optional<LinkNews> LinkSocket::changed(types::Stamp now) {
  if (channel_ && channel_->state() == LinkChannel::State::kClosed) {
    const std::string why = channel_->why();
    const bool refused = channel_->refused();
    channel_.reset();
    heard_ = now;
    if (!refused) return alone(fmt::format("the link is gone: {}", why));
    joined_ = false;
    link_.reset();
    told_alone_ = true;
    if (std::exchange(told_refusal_, why) == why) return {};
    return LinkNews{LinkNews::Kind::kRefused, why};
  }
  const bool silent = now - heard_.value_or(now) > params_.silence_max;
  if (silent)
    return alone(channel_
                     ? fmt::format("the link says nothing for {} s", types::to_seconds(params_.silence_max))
                     : std::string("no link is there (topometric-link.service)"));
  if (!channel_ || channel_->state() != LinkChannel::State::kOpen || joined_) return {};
  joined_ = true;
  told_alone_ = false;
  told_refusal_.clear();
  return LinkNews{LinkNews::Kind::kJoined, "the link is there"};
}

std::optional<LinkNews> LinkSocket::turn(types::Stamp now, const Take& take) {
  if (!heard_) heard_ = now;
  take_messages(now, take);
  // That the last one is gone is told before the next one is accepted.
  if (channel_ && channel_->state() == LinkChannel::State::kClosed) return changed(now);
  accept(now);
  take_messages(now, take);
  return changed(now);
}

bool LinkSocket::send(std::span<const std::byte> datagram) {
  if (datagram.empty() || datagram.size() > kDatagramMax_bytes) return ++counts_.dropped_size, false;
  if (!joined_ || !channel_) return ++counts_.dropped_alone, false;
  switch (channel_->send_datagram(datagram)) {
    case LinkChannel::Sent::kYes:
      return ++counts_.sent, true;
    case LinkChannel::Sent::kFull:
      return ++counts_.dropped_full, false;
    case LinkChannel::Sent::kClosed:
      break;
  }
  return ++counts_.dropped_alone, false;
}

}  // namespace topo::daemon
