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
// frames of 8, with flow control. Sans-I/O: frames in, frames out, the time is an argument. Nothing
// allocates.
namespace topo::io {

/// What one classic CAN frame carries.
struct CanData {
  std::array<std::byte, 8> bytes{};
  std::uint8_t size = 0;  ///< 0..8

  [[nodiscard]] std::span<const std::byte> view() const {
    return std::span(bytes).first(std::min<std::size_t>(size, bytes.size()));
  }
};

/// Why a transfer ended without its PDU, or a frame was not taken.
enum class IsoTpFault : std::uint8_t {
  kNone,
  kLength,      ///< a length that its frame cannot have, or a frame shorter than its kind
  kSequence,    ///< a consecutive frame is missing, doubled or out of order
  kUnexpected,  ///< a frame that belongs to no transfer, or the start of another one in the middle of one
  kTooLong,     ///< a PDU longer than kIsoTpPduMax was announced; the sender was told so
  kGap,         ///< no consecutive frame within N_Cr
  kNoFlow,      ///< no flow control within N_Bs: nobody listens
  kRefused,     ///< the receiver said overflow, or wait more often than it may (WFTmax 0)
  kFlowStatus,  ///< a flow status that the standard does not know
};

/// The longest ARCOS packet has 207 bytes.
inline constexpr std::size_t kIsoTpPduMax = 256;

/// What a receiver asks of a sender (ISO 15765-2, 9.6.5).
struct IsoTpFlow {
  std::uint8_t block_size = 0;  ///< consecutive frames between two flow controls; 0: all
  std::uint8_t st_min = 0;      ///< least gap between them: 0..127 ms, or 0xF1..0xF9 for 100..900 us
};

struct IsoTpTimeouts {
  types::Duration flow = std::chrono::milliseconds(100);  ///< N_Bs
  types::Duration gap = std::chrono::milliseconds(100);   ///< N_Cr
};

/// Puts PDUs together. One transfer at a time, as normal addressing has it.
class IsoTpReceiver {
 public:
  explicit IsoTpReceiver(IsoTpFlow flow = {}, IsoTpTimeouts timeouts = {})
      : flow_(flow), timeouts_(timeouts) {}

  struct Taken {
    std::span<const std::byte> pdu;  ///< complete with this frame, until the next call; else empty
    std::optional<CanData> reply;    ///< flow control, to be sent now
    IsoTpFault fault = IsoTpFault::kNone;
  };
  /// A single, first or consecutive frame; padded or not, whatever the padding. A flow control is not for a
  /// receiver: kUnexpected.
  Taken take(std::span<const std::byte> frame, types::Stamp now);

  /// When expire() has something to do; far in the future when no transfer is under way.
  [[nodiscard]] types::Stamp deadline() const { return busy_ ? deadline_ : types::Stamp::max(); }
  /// kGap, once, when the next frame did not come in time; the transfer is given up.
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
  unsigned block_left_ = 0;  ///< frames until the next flow control is due; 0: none will be
  bool busy_ = false;
  types::Stamp deadline_{};
};

/// Takes a PDU apart.
class IsoTpSender {
 public:
  explicit IsoTpSender(IsoTpTimeouts timeouts = {}) : timeouts_(timeouts) {}

  [[nodiscard]] bool idle() const { return state_ == State::kIdle; }
  /// False, and nothing begun, while another transfer is under way or when the PDU is empty or longer than
  /// kIsoTpPduMax.
  bool begin(std::span<const std::byte> pdu);
  /// The frame that is due, if one is; padded to 8 bytes with 0xCC. It counts as sent.
  std::optional<CanData> next(types::Stamp now);
  /// A flow control that came. kUnexpected, and nothing changed, when none was waited for.
  IsoTpFault take_flow(std::span<const std::byte> frame, types::Stamp now);
  /// kNoFlow, once, when no flow control came in time; the transfer is given up.
  IsoTpFault expire(types::Stamp now);
  /// When next() has a frame, or expire() something to do; far in the future when idle.
  [[nodiscard]] types::Stamp due() const;
  /// Gives the transfer up: what is on the wire stays there, and the receiver's N_Cr ends it.
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
  unsigned block_left_ = 0;  ///< frames until a flow control is waited for; 0: none will be
  types::Duration gap_{};    ///< STmin
  State state_ = State::kIdle;
  types::Stamp when_{};  ///< of the next frame, or until when flow control is waited for
};

/// Is it a flow control? Then it is for the sender; all others are for the receiver.
[[nodiscard]] bool is_flow_control(std::span<const std::byte> frame);

}  // namespace topo::io
