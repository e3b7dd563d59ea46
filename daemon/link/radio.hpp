// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/sync/ring.hpp"
#include "core/types/stamp.hpp"
#include "daemon/link/cyclone_config.hpp"
#include "daemon/link/link_wire.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

/// A datagram between two threads.
struct RadioSlot {
  std::uint16_t size = 0;
  std::uint16_t robot = 0;  ///< that sent it; 0 on the way out
  std::array<std::byte, kDatagramMax_bytes> bytes{};
  [[nodiscard]] std::span<const std::byte> content() const { return std::span(bytes).first(size); }
};
/// More than a second at 200 kB/s, the most that the exchange asks for.
using RadioRing = sync::Ring<RadioSlot, 256>;

/// DDS, in two threads of its own: one makes the participant and writes, one reads. Whoever uses it never
/// waits for either: with the interface down a write blocks for seconds and ending may take for ever (the
/// participant is then left to the end of the process).
class Radio {
 public:
  /// What the two threads share with the one that uses them.
  struct Shared {
    RadioRing out, in;
    Wakeup to_send, arrived;  ///< of the writer; of the user
    std::atomic<bool> up{false};
    std::atomic<bool> failed{false};  ///< the participant cannot be made; failure() says why
    std::atomic<bool> stop{false}, reader_ended{false}, ended{false};
    std::atomic<std::int64_t> busy_since_ns{0};  ///< a call of DDS that has not returned; 0: none
    std::atomic<std::uint16_t> mates{0};
    std::atomic<std::uint64_t> sent{0}, sent_bytes{0};
    std::array<std::atomic<std::uint64_t>, kLinkDrops> dropped{};  ///< by the two threads
    std::string failure;                                           ///< written before `failed`
  };

  Radio(RadioPlan plan, const LinkIdentity& own);
  /// Not joined: a thread that hangs in DDS would keep the process.
  ~Radio() = default;
  Radio(const Radio&) = delete;
  Radio& operator=(const Radio&) = delete;

  /// Starts the threads. Ends the process when the system gives none; the service manager starts it again.
  void start();
  /// Asks both threads to end, deletes the participant. False: they did not within `patience`.
  bool end(types::Duration patience);

  /// False: the way to the radio is full.
  bool send(std::span<const std::byte> datagram);
  [[nodiscard]] Shared& shared() { return *shared_; }
  /// How long the thread that writes has been in one call of DDS.
  [[nodiscard]] types::Duration busy(types::Stamp now) const;

 private:
  RadioPlan plan_;
  LinkIdentity own_;
  std::shared_ptr<Shared> shared_;  // outlives a thread that hangs
};

}  // namespace topo::daemon
