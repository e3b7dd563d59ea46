// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "tests/sim/devices/endpoint.hpp"
#include "tests/sim/devices/file_descriptor.hpp"

namespace topo::sim {
namespace {

using types::Errc;

unsigned rate_of(speed_t speed) {
  switch (speed) {
    case B9600:
      return 9600;
    case B19200:
      return 19200;
    case B38400:
      return 38400;
    case B57600:
      return 57600;
    case B115200:
      return 115200;
    default:
      return 1;  // no Pioneer has such a speed: differs from all
  }
}

class PtyEndpoint final : public Endpoint {
 public:
  explicit PtyEndpoint(std::filesystem::path link) : link_(std::move(link)) {}
  PtyEndpoint(const PtyEndpoint&) = delete;
  PtyEndpoint& operator=(const PtyEndpoint&) = delete;
  ~PtyEndpoint() override { take_down(); }

  types::Status open() override {
    FileDescriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    std::array<char, 128> name{};
    if (!master.valid() || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0 ||
        ::ptsname_r(master.get(), name.data(), name.size()) != 0) {
      return failure("cannot make a pseudo terminal", errno);
    }
    std::error_code error;
    if (std::filesystem::is_symlink(link_, error)) std::filesystem::remove(link_, error);
    std::filesystem::create_symlink(name.data(), link_, error);
    if (error) return failure("cannot make the link " + link_.string(), error.value());
    master_ = std::move(master);
    make_raw();
    // A terminal that was never opened does not report that it is closed: open and close it once.
    FileDescriptor once(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    return {};
  }

  void close() override { take_down(); }

  void service() override {
    if (!master_.valid()) return;
    pollfd fd{master_.get(), 0, 0};
    const bool open_now = ::poll(&fd, 1, 0) >= 0 && (fd.revents & POLLHUP) == 0;
    if (connected_ && !open_now) {
      // Bytes left in the line belong to no client; the next one finds it empty and raw.
      ::tcflush(master_.get(), TCIOFLUSH);
      make_raw();
    }
    connected_ = open_now;
  }

  std::size_t read(std::span<std::uint8_t> into) override {
    if (!connected_) return 0;
    const auto got = ::read(master_.get(), into.data(), into.size());
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }

  std::size_t write(std::span<const char> bytes) override {
    if (!connected_) return 0;
    const auto put = ::write(master_.get(), bytes.data(), bytes.size());
    return put > 0 ? static_cast<std::size_t>(put) : 0;
  }

  void append_poll(std::vector<pollfd>& fds) const override {
    if (master_.valid() && connected_) fds.push_back({master_.get(), POLLIN, 0});
  }

  [[nodiscard]] bool connected() const override { return connected_; }
  [[nodiscard]] bool serial() const override { return true; }
  [[nodiscard]] unsigned client_rate_bps() const override {
    termios settings{};
    if (!master_.valid() || ::tcgetattr(master_.get(), &settings) != 0) return 0;
    return rate_of(::cfgetospeed(&settings));
  }
  [[nodiscard]] DeviceAddress address() const override { return {false, {}, 0, link_}; }

 private:
  types::Status failure(const std::string& what, int error) const {
    return types::fail(error == EACCES ? Errc::kPermission : Errc::kIo, what + ": " + std::strerror(error),
                       error);
  }

  void make_raw() const {
    termios settings{};
    if (::tcgetattr(master_.get(), &settings) != 0) return;
    ::cfmakeraw(&settings);
    ::tcsetattr(master_.get(), TCSANOW, &settings);
  }

  void take_down() {
    if (!master_.valid()) return;
    std::error_code ignored;
    std::filesystem::remove(link_, ignored);
    master_.reset();
    connected_ = false;
  }

  std::filesystem::path link_;
  FileDescriptor master_;
  bool connected_ = false;
};

}  // namespace

std::unique_ptr<Endpoint> make_pty_endpoint(std::filesystem::path link) {
  return std::make_unique<PtyEndpoint>(std::move(link));
}

}  // namespace topo::sim
