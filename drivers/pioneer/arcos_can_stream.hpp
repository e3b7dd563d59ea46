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

/// Identifiers of unit 0; those of unit u are higher by u (PROTOCOLS section 14.1).
inline constexpr std::uint16_t kCanStop = 0x688;       ///< to the robot: one byte, E_STOP or STOP
inline constexpr std::uint16_t kCanToRobot = 0x690;    ///< ISO-TP
inline constexpr std::uint16_t kCanFromRobot = 0x698;  ///< ISO-TP
inline constexpr std::uint16_t kCanHeartbeat = 0x6A0;  ///< from the robot, every 100 ms
inline constexpr int kCanUnits = 8;

/// ARCOS over CAN, "ARCOS-TP v1" (PROTOCOLS section 14.1), as a byte stream: every packet is one ISO-TP
/// message. A packet E_STOP or STOP is sent at once as one raw frame of the highest priority and aborts the
/// transfer in progress; frames of that transfer that are already in the interface's queue cannot be
/// withdrawn, so the stop frame is sent again behind them. write() never waits: read() continues the
/// transfer, and ready() reports its end. The destructor waits for the end of a transfer in progress, as the
/// kernel does for other transports, 100 ms at most.
class ArcosCanStream final : public io::ByteStream {
 public:
  ArcosCanStream(std::unique_ptr<io::CanPort> port, int unit) : port_(std::move(port)), unit_(unit) {}
  ~ArcosCanStream() override;
  ArcosCanStream(const ArcosCanStream&) = delete;
  ArcosCanStream& operator=(const ArcosCanStream&) = delete;

  /// Error kClosed also when the controller is bus-off, or without acknowledgement for 500 ms.
  types::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout) override;
  /// Writes one packet. kBusy unless ready(), except for a stop; kTimeout when a stop could not be sent
  /// within 100 ms of the first order. `timeout` is unused.
  types::Status write(std::span<const std::byte> packet, types::Duration timeout) override;
  [[nodiscard]] bool ready() const override { return !stop_ && !transfer_under_way(); }
  types::Status set_baud(int /*baud*/) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }
  [[nodiscard]] types::Stamp now() const override { return port_->now(); }

  [[nodiscard]] io::BusFaults faults() const override { return faults_; }

 private:
  /// A frame for which the interface's queue had no space yet.
  struct Unsent {
    io::CanData data;
    types::Stamp since{};
  };
  /// A stop is sent twice: ahead of the interface's queue, and behind the frames in it.
  struct Stop {
    io::CanData data;
    types::Stamp since{};   ///< time of the first order that was not sent
    bool overtook = false;  ///< the first of the two has been sent
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
  std::optional<Stop> stop_;       ///< sent before everything else
  std::optional<Unsent> waiting_;  ///< frame of the transfer
  types::Stamp retry_at_{};
  std::span<const std::byte> packet_;  ///< in the receiver, not fetched yet
  types::Stamp packet_stamp_{};
  types::Stamp unacknowledged_since_{};  ///< zero: acknowledged, or a frame was received since
  io::BusFaults faults_;
};

}  // namespace topo::pioneer
