// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace topo::io {

/// Faults of a bus that do not end the connection.
enum class BusFault : std::uint8_t {
  kBadMessage,
  kBadTransfer,
  kUnanswered,
  kInterrupted,
  kQueueFull,
  kDropped,
  kPassive,
  kViolation,
  kTransmitTimeout,
  kOverflow,
  kRestarted,
};
inline constexpr std::size_t kBusFaults = static_cast<std::size_t>(BusFault::kRestarted) + 1;

/// Count of each fault.
class BusFaults {
 public:
  std::uint64_t& operator[](BusFault fault) { return counts_[static_cast<std::size_t>(fault)]; }
  std::uint64_t operator[](BusFault fault) const { return counts_[static_cast<std::size_t>(fault)]; }
  BusFaults& operator+=(const BusFaults& other);
  BusFaults& operator-=(const BusFaults& other);
  friend bool operator==(const BusFaults&, const BusFaults&) = default;

 private:
  std::array<std::uint64_t, kBusFaults> counts_{};
};

/// A fault's key in reports and its description for users.
struct BusFaultName {
  BusFault fault;
  std::string_view key, words;
};
/// All faults, in the order of the enumeration.
[[nodiscard]] const std::array<BusFaultName, kBusFaults>& bus_fault_names();

/// "3 x error passive: most frames fail; ..."; empty when no fault occurred. A transfer that a stop
/// interrupted is not a fault of the bus and is left out.
[[nodiscard]] std::string to_text(const BusFaults& faults);

}  // namespace topo::io
