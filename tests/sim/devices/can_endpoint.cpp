// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The gateway between a robot's controller and a CAN bus (PROTOCOLS section 14.1).
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <utility>

#include "tests/sim/devices/can_message.hpp"
#include "tests/sim/devices/endpoint.hpp"
#include "tests/sim/devices/file_descriptor.hpp"

namespace topo::sim {
namespace {

using types::Errc;

constexpr canid_t kStopId = 0x688, kFromHostId = 0x690, kToHostId = 0x698, kHeartbeatId = 0x6A0;
constexpr std::size_t kPacketMost = 207;
constexpr SimTime kHeartbeat = std::chrono::milliseconds{100};

class CanEndpoint final : public Endpoint {
 public:
  CanEndpoint(std::string interface, int unit, std::function<int()> state)
      : interface_(std::move(interface)), unit_(static_cast<canid_t>(unit)), state_(std::move(state)) {}

  types::Status open() override {
    FileDescriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    if (!socket.valid()) return failure("cannot make a CAN socket", errno);
    constexpr canid_t kMask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG;
    const std::array<can_filter, 2> filters{{{kStopId + unit_, kMask}, {kFromHostId + unit_, kMask}}};
    ::setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), sizeof filters);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface_.c_str()));
    if (address.can_ifindex == 0) return failure("no interface " + interface_, errno);
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      return failure("cannot bind to " + interface_, errno);
    socket_ = std::move(socket);
    born_ = clock();
    next_heartbeat_ = born_;
    return {};
  }

  void close() override {
    socket_.reset();
    splitter_ = {};
    assembler_ = {};
    unsent_.reset();
    inbox_.clear();
  }

  void service() override {
    if (!socket_.valid()) return;
    take_frames();
    splitter_.tick(clock());
    beat();
    send_frames();
  }

  std::size_t read(std::span<std::uint8_t> into) override {
    const std::size_t count = std::min(into.size(), inbox_.size());
    std::copy_n(inbox_.begin(), count, into.begin());
    inbox_.erase(0, count);
    return count;
  }

  /// Takes one packet at a time, and none while one is being sent.
  std::size_t write(std::span<const char> bytes) override {
    if (!socket_.valid() || splitter_.busy() || unsent_) return 0;
    const std::string packet(
        bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kPacketMost)));
    if (is_status(packet)) ++statuses_;
    splitter_.start(packet, clock());
    send_frames();
    return packet.size();
  }

  void append_poll(std::vector<pollfd>& fds) const override {
    if (socket_.valid()) fds.push_back({socket_.get(), POLLIN, 0});
  }
  /// A CAN node cannot detect its clients.
  [[nodiscard]] bool connected() const override { return socket_.valid(); }
  [[nodiscard]] bool serial() const override { return false; }
  [[nodiscard]] unsigned client_rate_bps() const override { return 0; }
  [[nodiscard]] DeviceAddress address() const override {
    return {false, {}, 0, {}, interface_, static_cast<int>(unit_)};
  }

 private:
  static SimTime clock() { return std::chrono::steady_clock::now().time_since_epoch(); }
  types::Status failure(const std::string& what, int error) const {
    const bool missing = error == ENODEV || error == EAFNOSUPPORT;
    return types::fail(missing ? Errc::kNotFound : Errc::kIo,
                       "can:" + interface_ + ": " + what + ": " + std::strerror(error), error);
  }
  static bool is_status(const std::string& packet) {
    return packet.size() > 3 && (static_cast<unsigned char>(packet[3]) & 0xF0U) == 0x30U;
  }

  /// False when the interface accepts no more frames; the caller tries again later.
  bool send(canid_t id, const std::string& content) {
    can_frame frame{};
    frame.can_id = id + unit_;
    frame.can_dlc = static_cast<std::uint8_t>(content.size());
    std::copy(content.begin(), content.end(), frame.data);
    return ::write(socket_.get(), &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
  }

  void send_frames() {
    while (true) {
      if (!unsent_) unsent_ = splitter_.next(clock());
      if (!unsent_ || !send(kToHostId, *unsent_)) return;
      unsent_.reset();
    }
  }

  void take_frames() {
    can_frame frame{};
    while (::recv(socket_.get(), &frame, sizeof frame, 0) == static_cast<ssize_t>(sizeof frame)) {
      const std::size_t size = std::min<std::size_t>(frame.can_dlc, CAN_MAX_DLEN);
      const std::string content(frame.data, frame.data + size);
      if (frame.can_id == kStopId + unit_) {
        take_stop(content);
      } else if (can::is_flow(content)) {
        splitter_.on_flow(content, clock());
      } else {
        take_segment(content);
      }
    }
  }

  /// Converts the stop frame into the equivalent packet.
  void take_stop(const std::string& content) {
    if (content.empty() || (content[0] != '\x37' && content[0] != '\x1D')) return;
    inbox_ += std::string{'\xFA', '\xFB', '\x03', content[0], '\0', content[0]};
  }

  void take_segment(const std::string& content) {
    const auto step = assembler_.take(content, clock());
    if (step.message) inbox_ += *step.message;
    if (step.answer) send(kToHostId, *step.answer);
  }

  void beat() {
    if (clock() < next_heartbeat_) return;
    next_heartbeat_ = std::max(next_heartbeat_ + kHeartbeat, clock());
    const auto uptime_ms = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(clock() - born_).count());
    std::string content{static_cast<char>(state_()), static_cast<char>(statuses_ & 0xFFU)};
    for (int byte = 0; byte < 2; ++byte)
      content.push_back(static_cast<char>(assembler_.broken() >> (8 * byte) & 0xFFU));
    for (int byte = 0; byte < 4; ++byte)
      content.push_back(static_cast<char>(uptime_ms >> (8 * byte) & 0xFFU));
    send(kHeartbeatId, content);
  }

  std::string interface_;
  canid_t unit_;
  std::function<int()> state_;
  FileDescriptor socket_;
  can::Splitter splitter_;
  can::Assembler assembler_;
  std::optional<std::string> unsent_;
  std::string inbox_;
  unsigned statuses_ = 0;
  SimTime born_{0};
  SimTime next_heartbeat_{0};
};

}  // namespace

std::unique_ptr<Endpoint> make_can_endpoint(std::string interface, int unit, std::function<int()> state) {
  return std::make_unique<CanEndpoint>(std::move(interface), unit, std::move(state));
}

}  // namespace topo::sim
