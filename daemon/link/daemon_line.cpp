// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/daemon_line.hpp"

#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {
namespace {

constexpr types::Duration kTryAgain = std::chrono::seconds(1);
constexpr types::Duration kPatience = std::chrono::milliseconds(100);
/// A turn of the main loop ends, whatever the daemon sends.
constexpr std::size_t kMessagesATurn = 256;

}  // namespace

DaemonLine::DaemonLine(std::string path, const LinkIdentity& own, int greeted)
    : path_(std::move(path)), own_(own) {
  if (greeted < 0) return;
  channel_.emplace(io::UniqueFd(greeted), own_, true);
  told_joined_ = true;
}

std::optional<std::string> DaemonLine::told(std::string words) {
  if (words == told_) return {};
  told_ = std::move(words);
  return told_;
}

std::optional<std::string> DaemonLine::connect(types::Stamp now) {
  if (now < next_try_) return {};
  next_try_ = now + kTryAgain;
  auto socket = io::connect_unix(path_, kPatience, kLinkSocketKind);
  if (!socket) return told("waiting for the daemon: " + socket.error().message);
  channel_.emplace(std::move(*socket), own_);
  return {};
}

std::optional<std::string> DaemonLine::turn(types::Stamp now, const Take& take, std::uint64_t& wrong_size) {
  if (!channel_) return connect(now);
  for (std::size_t n = 0; n < kMessagesATurn; ++n) {
    const auto packet = channel_->next();
    if (!packet) break;
    if (packet->is_datagram())
      take(packet->content());
    else
      ++wrong_size;
  }
  if (channel_->state() == LinkChannel::State::kClosed) {
    std::string why =
        (channel_->refused() ? "the daemon and the link do not fit: " : "the daemon is gone: ") +
        channel_->why();
    channel_.reset();
    told_joined_ = false;
    return told(std::move(why));
  }
  if (!joined() || std::exchange(told_joined_, true)) return {};
  return told("the daemon is there");
}

LinkChannel::Sent DaemonLine::send(std::uint16_t sender, std::span<const std::byte> datagram) {
  return joined() ? channel_->send_heard(sender, datagram) : LinkChannel::Sent::kClosed;
}

void DaemonLine::send_stats(const LinkStats& stats) {
  if (joined()) channel_->send(encode_stats(stats));
}

}  // namespace topo::daemon
