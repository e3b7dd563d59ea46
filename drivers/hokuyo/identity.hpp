// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/types/result.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/hokuyo/scip_parser.hpp"

namespace topo::hokuyo {

/// What the models differ in (PROTOCOLS sections 10.2, 11 and 13). Decided from PROD, never by trial: a
/// command that a URG-04LX does not know can hang it until its power is cut.
enum class Family : std::uint8_t {
  kUtm,      ///< UTM-30LX on USB
  kUtmEw,    ///< UTM-30LX-EW
  kUst,      ///< UST-10LX, UST-20LX
  kUrg,      ///< URG-04LX and its kin
  kUnknown,  ///< speaks SCIP 2; only what every model knows is used
};

[[nodiscard]] Family family_of(std::string_view product);
[[nodiscard]] bool has_intensity(Family family);

/// Vendor, product, firmware, protocol, serial number out of VV. kProtocol when PROD is missing or the
/// serial number is unreadable.
[[nodiscard]] types::Status read_version(const Reply& reply, SensorInfo& info);

/// Measuring constants out of PP, validated: nothing that follows can index or divide out of bounds.
[[nodiscard]] types::Status read_parameters(const Reply& reply, SensorInfo& info);

/// The sensor's own words on its state (STAT) out of II; left alone when there are none.
void read_state(const Reply& reply, SensorInfo& info);

/// The device's clock out of a reply to TM1, in milliseconds of 24 bits.
[[nodiscard]] std::optional<std::uint32_t> read_time(const Reply& reply);

/// Serial numbers compared as people mean them: a leading 0 equals H, letters in either case.
[[nodiscard]] bool same_serial(std::string_view a, std::string_view b);

/// What a status other than 00, 02 and 99 means, for a message.
[[nodiscard]] std::string_view describe_status(std::string_view status);

}  // namespace topo::hokuyo
