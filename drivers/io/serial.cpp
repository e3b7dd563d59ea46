// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/serial.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <utility>

#include "drivers/io/fd_stream.hpp"
#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;
using types::Errc;
using types::fail;

constexpr std::array<std::pair<int, speed_t>, 10> kSpeeds{{{9600, B9600},
                                                           {19200, B19200},
                                                           {38400, B38400},
                                                           {57600, B57600},
                                                           {115200, B115200},
                                                           {230400, B230400},
                                                           {460800, B460800},
                                                           {500000, B500000},
                                                           {921600, B921600},
                                                           {1000000, B1000000}}};

/// Longest wait for pending bytes before the speed changes: a full 4 KiB buffer at 38400 baud takes 1.1 s,
/// but no command is longer than 32 bytes (34 ms at 9600 baud).
constexpr Duration kDrainLimit = 50ms;

class SerialStream final : public FdStream {
 public:
  using FdStream::FdStream;

  Status set_baud(int baud) override;
  [[nodiscard]] bool has_baud() const override { return true; }

 private:
  ssize_t write_some(std::span<const std::byte> bytes) override {
    return ::write(fd(), bytes.data(), bytes.size());
  }
  void drain() const;
};

void SerialStream::drain() const {
  const Stamp deadline = monotonic_now() + kDrainLimit;
  int queued = 0;
  while (::ioctl(fd(), TIOCOUTQ, &queued) == 0 && queued > 0 && monotonic_now() < deadline) {
    (void)wait_for(-1, 0, 1ms);  // a negative descriptor: only the time-out ends the wait
  }
}

Status SerialStream::set_baud(int baud) {
  for (const auto& [rate, speed] : kSpeeds) {
    if (rate != baud) continue;
    drain();
    termios settings{};
    if (::tcgetattr(fd(), &settings) != 0) return fail_errno(name(), "reading the line settings", errno);
    ::cfsetispeed(&settings, speed);
    ::cfsetospeed(&settings, speed);
    if (::tcsetattr(fd(), TCSANOW, &settings) != 0)
      return fail_errno(name(), "setting the line speed", errno);
    return {};
  }
  return fail(Errc::kUnsupported,
              name() + ": line speed " + std::to_string(baud) +
                  " is not supported; expected 9600, 19200, 38400, 57600, 115200, 230400, "
                  "460800, 500000, 921600 or 1000000");
}

/// 8 data bits, no parity, one stop bit, no translation, no flow control; a read never waits.
Status make_raw(int fd, const std::string& name) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) {
    const int error = errno;
    if (error == ENOTTY) return fail(Errc::kInvalidInput, name + ": is not a serial device", error);
    return fail_errno(name, "reading the line settings", error);
  }
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  // HUPCL would drop DTR at close, and some USB adapters reset their device on that.
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | HUPCL);
  // With VMIN 1 a read that returns 0 can only mean a hang-up (O_NONBLOCK gives EAGAIN otherwise).
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (::tcsetattr(fd, TCSANOW, &settings) != 0) return fail_errno(name, "setting raw mode", errno);
  ::tcflush(fd, TCIOFLUSH);  // discards bytes from before this connection
  return {};
}

tl::unexpected<types::Error> fail_busy(const std::string& name, int error) {
  return fail(
      Errc::kBusy,
      name + ": another program holds the device (fuser -v names it; ModemManager and getty are usual)",
      error);
}

Status lock(int fd, const std::string& name) {
  if (retry_interrupted([&] { return ::flock(fd, LOCK_EX | LOCK_NB); }) != 0) {
    return errno == EWOULDBLOCK ? Status(fail_busy(name, errno)) : Status(fail_errno(name, "locking", errno));
  }
  if (::ioctl(fd, TIOCEXCL) != 0 && errno != ENOTTY) return fail_errno(name, "claiming exclusively", errno);
  return {};
}

}  // namespace

Result<std::unique_ptr<ByteStream>> SerialConnector::connect(Duration /*timeout*/) {
  UniqueFd fd(
      retry_interrupted([&] { return ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); }));
  if (!fd.valid()) {
    const int error = errno;
    if (error == EBUSY) return fail_busy(path_, error);
    return fail_open(path_, error);
  }
  if (Status locked = lock(fd.get(), path_); !locked) return tl::unexpected<types::Error>(locked.error());
  if (Status raw = make_raw(fd.get(), path_); !raw) return tl::unexpected<types::Error>(raw.error());
  return std::make_unique<SerialStream>(std::move(fd), path_);
}

}  // namespace topo::io
