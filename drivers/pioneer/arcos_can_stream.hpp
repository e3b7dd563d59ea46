// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "drivers/io/byte_stream.hpp"
#include "drivers/io/can_port.hpp"
#include "drivers/io/iso_tp.hpp"

namespace topo::pioneer {

/// Identifiers of unit 0; those of unit u lie u higher (PROTOCOLS section 14.1).
inline constexpr std::uint16_t kCanStop = 0x688;       ///< to the robot: one byte, E_STOP or STOP
inline constexpr std::uint16_t kCanToRobot = 0x690;    ///< ISO-TP
inline constexpr std::uint16_t kCanFromRobot = 0x698;  ///< ISO-TP
inline constexpr std::uint16_t kCanHeartbeat = 0x6A0;  ///< from the robot, every 100 ms
inline constexpr int kCanUnits = 8;

/// ARCOS over CAN, "ARCOS-TP v1" (PROTOCOLS section 14.1), as a byte stream: every packet is one ISO-TP
/// message. A packet E_STOP or STOP becomes one raw frame of the highest priority at once and ends the
/// transfer under way; what of one is in the interface's queue already cannot be called back, so the frame
/// goes once more behind it. write() never waits: what it begins goes on in read(), and ready() says when it
/// is over. The destructor lets what is under way come to its end, as the kernel does for other transports;
/// it waits 100 ms at most.
class ArcosCanStream final : public io::ByteStream {
 public:
  ArcosCanStream(std::unique_ptr<io::CanPort> port, int unit) : port_(std::move(port)), unit_(unit) {}
  ~ArcosCanStream() override;
  ArcosCanStream(const ArcosCanStream&) = delete;
  ArcosCanStream& operator=(const ArcosCanStream&) = delete;

  /// Error kClosed as well when the controller is bus-off, and when nobody acknowledges for 500 ms.
  types::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout) override;
  /// One packet. kBusy unless ready(), but for a stop; kTimeout when a stop did not get out within 100 ms of
  /// the first order. `timeout` is not used.
  types::Status write(std::span<const std::byte> packet, types::Duration timeout) override;
  [[nodiscard]] bool ready() const override { return !stop_ && !transfer_under_way(); }
  types::Status set_baud(int /*baud*/) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }
  [[nodiscard]] types::Stamp now() const override { return port_->now(); }

  [[nodiscard]] io::BusFaults faults() const override { return faults_; }

 private:
  /// A frame that the interface had no room for yet.
  struct Unsent {
    io::CanData data;
    types::Stamp since{};
  };
  /// A stop goes out twice: past the interface's queue, and behind what is in it.
  struct Stop {
    io::CanData data;
    types::Stamp since{};   ///< of the first order that did not get out
    bool overtook = false;  ///< the first of the two is out
  };

  types::Status write_stop(std::byte command);
  [[nodiscard]] bool transfer_under_way() const { return !sender_.idle() || waiting_; }
  types::Status pump();
  types::Status send_stop();
  types::Status send_transfer();
  types::Status send_reply(const io::CanData& reply);
  void expire();
  types::Status on_event(const io::CanEvent& event);
  types::Status on_frame(const io::CanFrame& frame);
  types::Status on_error(const io::CanError& error);
  void on_packet(std::span<const std::byte> pdu, types::Stamp stamp);
  [[nodiscard]] types::Stamp due() const;
  [[nodiscard]] std::uint16_t id(std::uint16_t base) const {
    return static_cast<std::uint16_t>(base + unit_);
  }

  std::unique_ptr<io::CanPort> port_;
  int unit_;
  io::IsoTpSender sender_;
  io::IsoTpReceiver receiver_;
  std::optional<Stop> stop_;       ///< goes before all else
  std::optional<Unsent> waiting_;  ///< of the transfer
  types::Stamp retry_at_{};
  std::span<const std::byte> packet_;  ///< in the receiver, not fetched yet
  types::Stamp packet_stamp_{};
  types::Stamp unacknowledged_since_{};  ///< zero: not, or something was heard since
  io::BusFaults faults_;
};

}  // namespace topo::pioneer
