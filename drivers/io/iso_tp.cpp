// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/iso_tp.hpp"

#include <algorithm>

#include "core/types/invariant.hpp"

namespace topo::io {
namespace {

using types::Duration;
using types::Stamp;

// ISO 15765-2:2016, table 9: the first four bits give the kind of a frame.
constexpr unsigned kSingle = 0, kFirst = 1, kConsecutive = 2, kFlow = 3;
// Table 18: flow status.
constexpr unsigned kContinue = 0, kWait = 1, kOverflow = 2;
constexpr std::byte kPadding{0xCC};
constexpr std::size_t kSingleMax = 7, kFirstBytes = 6, kConsecutiveBytes = 7;
constexpr unsigned kSequenceMask = 0x0F;

unsigned value(std::byte b) { return std::to_integer<unsigned>(b); }
unsigned kind_of(std::span<const std::byte> frame) { return frame.empty() ? ~0U : value(frame[0]) >> 4U; }

CanData padded_frame(unsigned first_byte) {
  CanData frame;
  frame.bytes.fill(kPadding);
  frame.size = 8;
  frame.bytes[0] = static_cast<std::byte>(first_byte);
  return frame;
}

/// STmin (table 20). Reserved values count as the longest gap.
Duration gap_of(unsigned st_min) {
  if (st_min <= 0x7F) return std::chrono::milliseconds(st_min);
  if (st_min >= 0xF1 && st_min <= 0xF9) return std::chrono::microseconds(100 * (st_min - 0xF0));
  return std::chrono::milliseconds(0x7F);
}

}  // namespace

bool is_flow_control(std::span<const std::byte> frame) { return kind_of(frame) == kFlow; }

IsoTpReceiver::Taken IsoTpReceiver::take(std::span<const std::byte> frame, Stamp now) {
  switch (kind_of(frame)) {
    case kSingle:
      return take_single(frame);
    case kFirst:
      return take_first(frame, now);
    case kConsecutive:
      return take_consecutive(frame, now);
    default:
      return {{}, {}, frame.empty() ? IsoTpFault::kLength : IsoTpFault::kUnexpected};
  }
}

IsoTpReceiver::Taken IsoTpReceiver::take_single(std::span<const std::byte> frame) {
  const std::size_t size = value(frame[0]) & 0x0FU;
  // 0 is the escape of CAN FD, which a frame of 8 bytes does not need.
  if (size == 0 || size > kSingleMax || frame.size() < size + 1) return {{}, {}, IsoTpFault::kLength};
  // The start of another PDU ends the transfer in progress and is accepted (section 9.8.3).
  const IsoTpFault fault = busy_ ? IsoTpFault::kUnexpected : IsoTpFault::kNone;
  busy_ = false;
  std::copy_n(frame.begin() + 1, size, pdu_.begin());
  return {std::span(pdu_).first(size), {}, fault};
}

IsoTpReceiver::Taken IsoTpReceiver::take_first(std::span<const std::byte> frame, Stamp now) {
  if (frame.size() < 8) return {{}, {}, IsoTpFault::kLength};
  const std::size_t size = (value(frame[0]) & 0x0FU) << 8U | value(frame[1]);
  const IsoTpFault fault = busy_ ? IsoTpFault::kUnexpected : IsoTpFault::kNone;
  // 0 announces a length of 32 bits: longer than 4095 bytes.
  const bool too_long = size == 0 || size > kIsoTpPduMax;
  if (!too_long && size <= kSingleMax) return {{}, {}, IsoTpFault::kLength};
  busy_ = false;
  if (too_long) return {{}, flow_control(kOverflow), IsoTpFault::kTooLong};
  busy_ = true;
  expected_ = size;
  have_ = kFirstBytes;
  next_ = 1;
  block_left_ = flow_.block_size;
  deadline_ = now + timeouts_.gap;
  std::copy_n(frame.begin() + 2, kFirstBytes, pdu_.begin());
  return {{}, flow_control(kContinue), fault};
}

IsoTpReceiver::Taken IsoTpReceiver::take_consecutive(std::span<const std::byte> frame, Stamp now) {
  if (!busy_) return {{}, {}, IsoTpFault::kUnexpected};
  types::require(have_ <= expected_ && expected_ <= pdu_.size(),
                 "io::IsoTpReceiver: a PDU longer than announced");
  const std::size_t size = std::min(kConsecutiveBytes, expected_ - have_);
  busy_ = false;
  if (frame.size() < size + 1) return {{}, {}, IsoTpFault::kLength};
  if ((value(frame[0]) & kSequenceMask) != next_) return {{}, {}, IsoTpFault::kSequence};
  std::copy_n(frame.begin() + 1, size, pdu_.begin() + static_cast<std::ptrdiff_t>(have_));
  have_ += size;
  if (have_ == expected_) return {std::span(pdu_).first(expected_), {}, IsoTpFault::kNone};
  busy_ = true;
  next_ = (next_ + 1) & kSequenceMask;
  deadline_ = now + timeouts_.gap;
  if (block_left_ == 0 || --block_left_ > 0) return {};
  block_left_ = flow_.block_size;
  return {{}, flow_control(kContinue), IsoTpFault::kNone};
}

IsoTpFault IsoTpReceiver::expire(Stamp now) {
  if (!busy_ || now < deadline_) return IsoTpFault::kNone;
  busy_ = false;
  return IsoTpFault::kGap;
}

CanData IsoTpReceiver::flow_control(unsigned status) const {
  CanData frame = padded_frame(kFlow << 4U | status);
  frame.bytes[1] = status == kContinue ? std::byte{flow_.block_size} : std::byte{0};
  frame.bytes[2] = status == kContinue ? std::byte{flow_.st_min} : std::byte{0};
  return frame;
}

bool IsoTpSender::begin(std::span<const std::byte> pdu) {
  if (!idle() || pdu.empty() || pdu.size() > kIsoTpPduMax) return false;
  std::copy(pdu.begin(), pdu.end(), pdu_.begin());
  size_ = pdu.size();
  sent_ = 0;
  state_ = State::kStart;
  when_ = Stamp{};
  return true;
}

std::optional<CanData> IsoTpSender::next(Stamp now) {
  if (state_ == State::kStart) {
    if (size_ > kSingleMax) {
      state_ = State::kWaitFlow;
      when_ = now + timeouts_.flow;
      return first_frame();
    }
    CanData frame = padded_frame(kSingle << 4U | static_cast<unsigned>(size_));
    std::copy_n(pdu_.begin(), size_, frame.bytes.begin() + 1);
    state_ = State::kIdle;
    return frame;
  }
  if (state_ != State::kSending || now < when_) return {};
  const CanData frame = consecutive_frame();
  when_ = now + gap_;
  if (sent_ == size_) {
    state_ = State::kIdle;
  } else if (block_left_ > 0 && --block_left_ == 0) {
    state_ = State::kWaitFlow;
    when_ = now + timeouts_.flow;
  }
  return frame;
}

CanData IsoTpSender::first_frame() {
  CanData frame = padded_frame(kFirst << 4U | static_cast<unsigned>(size_ >> 8U));
  frame.bytes[1] = static_cast<std::byte>(size_ & 0xFFU);
  std::copy_n(pdu_.begin(), kFirstBytes, frame.bytes.begin() + 2);
  sent_ = kFirstBytes;
  next_ = 1;
  return frame;
}

CanData IsoTpSender::consecutive_frame() {
  CanData frame = padded_frame(kConsecutive << 4U | next_);
  types::require(sent_ <= size_, "io::IsoTpSender: more sent than there is");
  const std::size_t size = std::min(kConsecutiveBytes, size_ - sent_);
  std::copy_n(pdu_.begin() + static_cast<std::ptrdiff_t>(sent_), size, frame.bytes.begin() + 1);
  sent_ += size;
  next_ = (next_ + 1) & kSequenceMask;
  return frame;
}

IsoTpFault IsoTpSender::take_flow(std::span<const std::byte> frame, Stamp now) {
  if (state_ != State::kWaitFlow || !is_flow_control(frame)) return IsoTpFault::kUnexpected;
  if (frame.size() < 3) return IsoTpFault::kLength;  // ignored: N_Bs decides
  const unsigned status = value(frame[0]) & 0x0FU;
  if (status != kContinue) {
    abort();
    return status == kWait || status == kOverflow ? IsoTpFault::kRefused : IsoTpFault::kFlowStatus;
  }
  block_left_ = value(frame[1]);
  gap_ = gap_of(value(frame[2]));
  state_ = State::kSending;
  when_ = now;
  return IsoTpFault::kNone;
}

IsoTpFault IsoTpSender::expire(Stamp now) {
  if (state_ != State::kWaitFlow || now < when_) return IsoTpFault::kNone;
  abort();
  return IsoTpFault::kNoFlow;
}

Stamp IsoTpSender::due() const { return idle() ? Stamp::max() : when_; }

}  // namespace topo::io
