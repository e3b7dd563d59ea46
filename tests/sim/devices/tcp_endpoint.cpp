// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "tests/sim/devices/endpoint.hpp"
#include "tests/sim/devices/file_descriptor.hpp"

namespace topo::sim {
namespace {

using types::Errc;

class TcpEndpoint final : public Endpoint {
 public:
  explicit TcpEndpoint(std::uint16_t port) : port_(port) {}

  types::Status open() override {
    FileDescriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int on = 1;
    ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port_);
    if (::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
        ::listen(listener.get(), 4) != 0) {
      const int error = errno;
      return types::fail(error == EADDRINUSE ? Errc::kBusy : Errc::kIo,
                         "cannot listen on 127.0.0.1:" + std::to_string(port_) + ": " + std::strerror(error),
                         error);
    }
    socklen_t size = sizeof(address);
    ::getsockname(listener.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    listener_ = std::move(listener);
    return {};
  }

  void close() override {
    forgotten_.clear();
    client_.reset();
    listener_.reset();
  }

  bool forget_client() override {
    if (!client_.valid()) return false;
    forgotten_.push_back(std::move(client_));
    return true;
  }

  void service() override {
    // A client that reconnects at once must find the slot free, and its disconnection must be noticed first.
    if (!listener_.valid() || drop_dead_client() || client_is_talking()) return;
    FileDescriptor fresh(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!fresh.valid()) return;
    if (client_.valid()) return;  // one client at a time: rejects the second
    const int on = 1;
    ::setsockopt(fresh.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    client_ = std::move(fresh);
  }

  std::size_t read(std::span<std::uint8_t> into) override {
    if (!client_.valid()) return 0;
    const auto got = ::recv(client_.get(), into.data(), into.size(), 0);
    if (got > 0) return static_cast<std::size_t>(got);
    if (got == 0 || !would_block()) client_.reset();
    return 0;
  }

  std::size_t write(std::span<const char> bytes) override {
    if (!client_.valid()) return 0;
    const auto put = ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (put >= 0) return static_cast<std::size_t>(put);
    if (!would_block()) client_.reset();
    return 0;
  }

  void append_poll(std::vector<pollfd>& fds) const override {
    if (listener_.valid()) fds.push_back({listener_.get(), POLLIN, 0});
    if (client_.valid()) fds.push_back({client_.get(), POLLIN, 0});
  }

  [[nodiscard]] bool connected() const override { return client_.valid(); }
  [[nodiscard]] bool serial() const override { return false; }
  [[nodiscard]] unsigned client_rate_bps() const override { return 0; }
  [[nodiscard]] DeviceAddress address() const override { return {true, "127.0.0.1", port_, {}}; }

 private:
  /// True when the client has disconnected: no other is accepted before the caller has noticed that.
  bool drop_dead_client() {
    if (!client_.valid()) return false;
    char byte = 0;
    const auto got = ::recv(client_.get(), &byte, 1, MSG_PEEK);
    if (got > 0 || (got < 0 && would_block())) return false;
    client_.reset();
    return true;
  }
  /// True when bytes are pending, perhaps before the end of the link: they must be read first.
  bool client_is_talking() const {
    char byte = 0;
    return client_.valid() && ::recv(client_.get(), &byte, 1, MSG_PEEK) > 0;
  }

  static bool would_block() { return errno == EAGAIN || errno == EINTR; }

  std::uint16_t port_;
  FileDescriptor listener_;
  FileDescriptor client_;
  std::vector<FileDescriptor> forgotten_;
};

}  // namespace

std::unique_ptr<Endpoint> make_tcp_endpoint(std::uint16_t port) {
  return std::make_unique<TcpEndpoint>(port);
}

}  // namespace topo::sim
