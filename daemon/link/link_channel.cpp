// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_channel.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

LinkChannel::Sent outcome_of(ssize_t sent) {
  if (sent >= 0) return LinkChannel::Sent::kYes;
  const bool full = errno == EAGAIN || errno == ENOBUFS;
  // Otherwise what the other end said before it left is still to be read: next() closes.
  return full ? LinkChannel::Sent::kFull : LinkChannel::Sent::kClosed;
}

}  // namespace

LinkChannel::LinkChannel(io::UniqueFd socket, const LinkIdentity& own, bool greeted)
    : socket_(std::move(socket)), own_(own), state_(greeted ? State::kOpen : State::kGreeting) {
  if (!greeted) send(encode_hello(own_));
}

void LinkChannel::close(std::string why) {
  socket_.reset();
  state_ = State::kClosed;
  why_ = std::move(why);
}

void LinkChannel::refuse(const std::string& words) {
  send(encode_refusal(words));
  refused_ = true;
  close(words);
}

std::optional<std::span<const std::byte>> LinkChannel::read() {
  if (!socket_.valid()) return {};
  const auto receive = [this] {
    return io::retry_interrupted(
        [this] { return ::recv(socket_.get(), buffer_.data(), buffer_.size(), MSG_DONTWAIT | MSG_TRUNC); });
  };
  ssize_t got = receive();
  // Told once, when the other end left without reading all; behind it stands what that said before.
  if (got < 0 && errno == ECONNRESET) got = receive();
  if (got < 0 && errno == EAGAIN) return {};
  if (got < 0) return close(std::strerror(errno)), std::nullopt;
  if (got == 0) return close("the other end is gone"), std::nullopt;
  const auto size = static_cast<std::size_t>(got);
  if (size > buffer_.size()) {
    refuse(fmt::format("found a message of {} bytes, expected at most {}", size, buffer_.size()));
    return {};
  }
  return std::span<const std::byte>(buffer_).first(size);
}

bool LinkChannel::greeted_by(std::span<const std::byte> packet) {
  const auto other = decode_hello(packet);
  const std::string fault = other ? mismatch(own_, *other) : other.error().message;
  if (!fault.empty()) return refuse(fault), false;
  state_ = State::kOpen;
  return true;
}

std::optional<LinkChannel::Packet> LinkChannel::next() {
  while (const auto bytes = read()) {
    const Packet packet{*bytes};
    if (packet.kind() == LinkMessage::kRefusal) {
      refused_ = true;
      close("the other end refuses: " + decode_refusal(*bytes));
      return {};
    }
    if (state_ == State::kOpen) return packet;
    if (!greeted_by(*bytes)) return {};
  }
  return {};
}

LinkChannel::Sent LinkChannel::send_datagram(std::span<const std::byte> datagram) {
  std::array<std::byte, kKindBytes + kDatagramMax_bytes> message{};
  if (datagram.size() > kDatagramMax_bytes) return Sent::kFull;
  message[0] = static_cast<std::byte>(LinkMessage::kDatagram);
  std::copy(datagram.begin(), datagram.end(), message.begin() + kKindBytes);
  return send(std::span(message).first(kKindBytes + datagram.size()));
}

LinkChannel::Sent LinkChannel::send_heard(std::uint16_t sender, std::span<const std::byte> datagram) {
  std::array<std::byte, kHeardBytes + kDatagramMax_bytes> message{};
  if (datagram.size() > kDatagramMax_bytes) return Sent::kFull;
  message[0] = static_cast<std::byte>(LinkMessage::kHeard);
  types::store_le<std::uint16_t>(message, kKindBytes, sender);
  std::copy(datagram.begin(), datagram.end(), message.begin() + kHeardBytes);
  return send(std::span(message).first(kHeardBytes + datagram.size()));
}

LinkChannel::Sent LinkChannel::send(std::span<const std::byte> message) {
  if (!socket_.valid()) return Sent::kClosed;
  return outcome_of(io::retry_interrupted(
      [&] { return ::send(socket_.get(), message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL); }));
}

}  // namespace topo::daemon
