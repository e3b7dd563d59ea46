// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/types/stamp.hpp"

// ISO 15765-2 (ISO-TP) with normal addressing over classic CAN frames: messages (PDUs) of up to 4095 bytes in
// frames of 8, with flow control. Sans-I/O: frames in, frames out, the time is an argument. No allocation.
namespace topo::io {

/// Payload of one classic CAN frame.
struct CanData {
  std::array<std::byte, 8> bytes{};
  std::uint8_t size = 0;  ///< 0..8

  [[nodiscard]] std::span<const std::byte> view() const {
    return std::span(bytes).first(std::min<std::size_t>(size, bytes.size()));
  }
};

/// Reason why a transfer ended without its PDU, or why a frame was not accepted.
enum class IsoTpFault : std::uint8_t {
  kNone,
  kLength,      ///< a length that its frame cannot have, or a frame shorter than its kind
  kSequence,    ///< a consecutive frame is missing, doubled or out of order
  kUnexpected,  ///< a frame that belongs to no transfer, or the start of another transfer during one
  kTooLong,     ///< a PDU longer than kIsoTpPduMax was announced; the reply reports overflow
  kGap,         ///< no consecutive frame within N_Cr
  kNoFlow,      ///< no flow control within N_Bs: no receiver
  kRefused,     ///< the receiver reported overflow, or wait more often than allowed (WFTmax 0)
  kFlowStatus,  ///< a flow status that the standard does not define
};

/// The longest ARCOS packet has 207 bytes.
inline constexpr std::size_t kIsoTpPduMax = 256;

/// A receiver's parameters of flow control for the sender (ISO 15765-2, 9.6.5).
struct IsoTpFlow {
  std::uint8_t block_size = 0;  ///< consecutive frames between two flow controls; 0: all
  std::uint8_t st_min = 0;      ///< minimum gap between them: 0..127 ms, or 0xF1..0xF9 for 100..900 us
};

struct IsoTpTimeouts {
  types::Duration flow = std::chrono::milliseconds(100);  ///< N_Bs
  types::Duration gap = std::chrono::milliseconds(100);   ///< N_Cr
};

/// Assembles PDUs. One transfer at a time, as in normal addressing.
class IsoTpReceiver {
 public:
  explicit IsoTpReceiver(IsoTpFlow flow = {}, IsoTpTimeouts timeouts = {})
      : flow_(flow), timeouts_(timeouts) {}

  struct Taken {
    std::span<const std::byte> pdu;  ///< complete with this frame, valid until the next call; empty otherwise
    std::optional<CanData> reply;    ///< flow control to send now
    IsoTpFault fault = IsoTpFault::kNone;
  };
  /// Takes a single, first or consecutive frame, with or without padding of any value. A flow control frame
  /// is not for a receiver: kUnexpected.
  Taken take(std::span<const std::byte> frame, types::Stamp now);

  /// Time of the next expire(); far in the future when no transfer is in progress.
  [[nodiscard]] types::Stamp deadline() const { return busy_ ? deadline_ : types::Stamp::max(); }
  /// Returns kGap once when the next frame did not arrive in time; the transfer is aborted.
  IsoTpFault expire(types::Stamp now);

 private:
  Taken take_single(std::span<const std::byte> frame);
  Taken take_first(std::span<const std::byte> frame, types::Stamp now);
  Taken take_consecutive(std::span<const std::byte> frame, types::Stamp now);
  [[nodiscard]] CanData flow_control(unsigned status) const;

  IsoTpFlow flow_;
  IsoTpTimeouts timeouts_;
  std::array<std::byte, kIsoTpPduMax> pdu_{};
  std::size_t expected_ = 0;  ///< bytes of the whole PDU
  std::size_t have_ = 0;
  unsigned next_ = 0;        ///< sequence number, 0..15
  unsigned block_left_ = 0;  ///< frames until the next flow control is due; 0: none follows
  bool busy_ = false;
  types::Stamp deadline_{};
};

/// Splits a PDU into frames.
class IsoTpSender {
 public:
  explicit IsoTpSender(IsoTpTimeouts timeouts = {}) : timeouts_(timeouts) {}

  [[nodiscard]] bool idle() const { return state_ == State::kIdle; }
  /// False, without effect, while another transfer is in progress or when the PDU is empty or longer than
  /// kIsoTpPduMax.
  bool begin(std::span<const std::byte> pdu);
  /// The frame that is due, if any; padded to 8 bytes with 0xCC. It counts as sent.
  std::optional<CanData> next(types::Stamp now);
  /// Takes a received flow control. kUnexpected, without effect, when none was awaited.
  IsoTpFault take_flow(std::span<const std::byte> frame, types::Stamp now);
  /// Returns kNoFlow once when no flow control arrived in time; the transfer is aborted.
  IsoTpFault expire(types::Stamp now);
  /// Time of the next frame or of the next expire(); far in the future when idle.
  [[nodiscard]] types::Stamp due() const;
  /// Aborts the transfer: frames already sent remain valid, and the receiver's N_Cr ends its part.
  void abort() { state_ = State::kIdle; }

 private:
  enum class State : std::uint8_t { kIdle, kStart, kWaitFlow, kSending };

  CanData first_frame();
  CanData consecutive_frame();

  IsoTpTimeouts timeouts_;
  std::array<std::byte, kIsoTpPduMax> pdu_{};
  std::size_t size_ = 0;
  std::size_t sent_ = 0;
  unsigned next_ = 0;        ///< sequence number
  unsigned block_left_ = 0;  ///< frames until a flow control is awaited; 0: none follows
  types::Duration gap_{};    ///< STmin
  State state_ = State::kIdle;
  types::Stamp when_{};  ///< time of the next frame, or limit of the wait for flow control
};

/// True for a flow control frame, which is for the sender; all others are for the receiver.
[[nodiscard]] bool is_flow_control(std::span<const std::byte> frame);

}  // namespace topo::io
