// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/tcp.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <memory>
#include <utility>

#include "drivers/io/fd_stream.hpp"
#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;
using types::Errc;
using types::fail;

constexpr Duration kAttemptLimit = 3s;

class TcpStream final : public FdStream {
 public:
  using FdStream::FdStream;

  Status set_baud(int /*baud*/) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }

 private:
  ssize_t write_some(std::span<const std::byte> bytes) override {
    return ::send(fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
};

Status set_option(int fd, const std::string& name, int level, int option, int value) {
  if (::setsockopt(fd, level, option, &value, sizeof value) == 0) return {};
  return fail_errno(name, "setting a socket option", errno);
}

/// PROTOCOLS section 11.1: no message boundaries, hence no delay; a half-open link holds the sensor's only
/// slot.
Status set_options(int fd, const std::string& name) {
  constexpr int kUserTimeoutMs = 3000;
  const std::pair<std::pair<int, int>, int> options[] = {
      {{IPPROTO_TCP, TCP_NODELAY}, 1},  {{SOL_SOCKET, SO_KEEPALIVE}, 1},
      {{IPPROTO_TCP, TCP_KEEPIDLE}, 1}, {{IPPROTO_TCP, TCP_KEEPINTVL}, 1},
      {{IPPROTO_TCP, TCP_KEEPCNT}, 3},  {{IPPROTO_TCP, TCP_USER_TIMEOUT}, kUserTimeoutMs}};
  for (const auto& [option, value] : options) {
    if (Status set = set_option(fd, name, option.first, option.second, value); !set) return set;
  }
  return {};
}

struct AddressListDelete {
  void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};
using AddressList = std::unique_ptr<addrinfo, AddressListDelete>;

Result<AddressList> resolve(const std::string& host, std::uint16_t port, const std::string& name) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* list = nullptr;
  const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (error != 0) {
    return fail(Errc::kNotFound, name + ": cannot resolve host \"" + host + "\": " + ::gai_strerror(error));
  }
  return AddressList(list);
}

}  // namespace

TcpConnector::TcpConnector(std::string host, std::uint16_t port, std::string name)
    : host_(std::move(host)), port_(port), name_(std::move(name)) {}

Result<TcpConnector::Attempt> TcpConnector::start() const {
  auto addresses = resolve(host_, port_, name_);
  if (!addresses) return tl::unexpected<types::Error>(addresses.error());
  const addrinfo& address = **addresses;
  UniqueFd fd(::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.valid()) return fail_errno(name_, "making a socket", errno);
  if (Status set = set_options(fd.get(), name_); !set) return tl::unexpected<types::Error>(set.error());
  if (::connect(fd.get(), address.ai_addr, address.ai_addrlen) != 0 && errno != EINPROGRESS &&
      errno != EINTR) {
    return fail_errno(name_, "connecting", errno);
  }
  return Attempt{std::move(fd), monotonic_now()};
}

Result<std::unique_ptr<ByteStream>> TcpConnector::connect(Duration timeout) {
  if (!attempt_) {
    auto started = start();
    if (!started) return tl::unexpected<types::Error>(started.error());
    attempt_ = std::move(*started);
  }
  const int events = wait_for(attempt_->fd.get(), POLLOUT, timeout);
  if (events == 0) {
    if (monotonic_now() - attempt_->started > kAttemptLimit) attempt_.reset();
    return fail(Errc::kTimeout,
                name_ + ": no answer to the connection request; is the device powered and in this network?");
  }
  Attempt attempt = std::move(*attempt_);
  attempt_.reset();
  int error = events < 0 ? errno : 0;
  socklen_t size = sizeof error;
  if (events > 0 && ::getsockopt(attempt.fd.get(), SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
  if (error != 0) return fail_errno(name_, "connecting", error);
  return std::make_unique<TcpStream>(std::move(attempt.fd), name_);
}

}  // namespace topo::io
