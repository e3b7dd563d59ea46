// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Any frames at any time: what comes out is bounded, every transfer ends, and a clean one goes through
// afterwards.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "drivers/io/iso_tp.hpp"

namespace {

using namespace topo::io;
using topo::types::Stamp;

void require(bool holds) {
  if (!holds) std::abort();
}

/// One PDU through both, with nothing lost.
void transfer(IsoTpSender& sender, IsoTpReceiver& receiver, Stamp now) {
  std::array<std::byte, 207> pdu{};
  for (std::size_t i = 0; i < pdu.size(); ++i) pdu[i] = static_cast<std::byte>(i);
  require(sender.begin(pdu));
  for (int i = 0; i < 100; ++i) {
    const auto frame = sender.next(now);
    require(frame.has_value());
    const auto taken = receiver.take(frame->view(), now);
    if (!taken.pdu.empty()) {
      require(std::equal(taken.pdu.begin(), taken.pdu.end(), pdu.begin(), pdu.end()));
      require(sender.idle());
      return;
    }
    if (taken.reply) require(sender.take_flow(taken.reply->view(), now) == IsoTpFault::kNone);
  }
  require(false);
}

}  // namespace

/// Pieces of a length, a pause in ms and the frame's bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  IsoTpReceiver receiver;
  IsoTpSender sender;
  Stamp now{std::chrono::seconds(1)};
  std::array<std::byte, 60> own{};
  for (std::size_t at = 0; at + 2 <= size;) {
    const std::size_t length = std::min<std::size_t>(data[at] % 9U, size - at - 2);
    now += std::chrono::milliseconds(data[at + 1]);
    const auto frame = std::as_bytes(std::span(data + at + 2, length));
    at += 2 + length;
    if (sender.idle()) require(sender.begin(own));
    (void)sender.next(now);
    const auto taken = receiver.take(frame, now);
    require(taken.pdu.size() <= kIsoTpPduMax);
    require(!taken.reply || taken.reply->size == 8);
    (void)sender.take_flow(frame, now);
    (void)sender.expire(now);
    (void)receiver.expire(now);
    require(receiver.deadline() == Stamp::max() ||
            receiver.deadline() <= now + std::chrono::milliseconds(100));
  }
  sender.abort();
  transfer(sender, receiver, now);
  return 0;
}
