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

/// Groups of models with different behaviour (PROTOCOLS sections 10.2, 11 and 13). Determined from PROD,
/// never by trial: a command unknown to a URG-04LX can hang it until its power is cut.
enum class Family : std::uint8_t {
  kUtm,      ///< UTM-30LX on USB
  kUtmEw,    ///< UTM-30LX-EW
  kUst,      ///< UST-10LX, UST-20LX
  kUrg,      ///< URG-04LX and related models
  kUnknown,  ///< SCIP 2 with only the functions common to all models
};

[[nodiscard]] Family family_of(std::string_view product);
/// False for a model that PROTOCOLS section 11 does not list, also when its family is known.
[[nodiscard]] bool is_listed(std::string_view product);
/// Neighbouring steps that are merged into one beam, so that a scan holds them. 1: none are.
[[nodiscard]] int cluster_of(const SensorInfo& info);
/// What is taken for granted of a model that is not listed; empty when it is.
[[nodiscard]] std::string assumption(const SensorInfo& info);
[[nodiscard]] bool has_intensity(Family family);

/// Reads vendor, product, firmware, protocol and serial number from VV. kProtocol when PROD or the serial
/// number is missing or damaged, kUnsupported when it is none.
[[nodiscard]] types::Status read_version(const Reply& reply, SensorInfo& info);

/// Reads the measurement constants from PP and validates them: later code cannot index or divide out of
/// bounds. kProtocol when one is missing or damaged, kUnsupported when it is out of what can be.
[[nodiscard]] types::Status read_parameters(const Reply& reply, SensorInfo& info);

/// Reads the sensor's state text (STAT) from II; unchanged when there is none.
void read_state(const Reply& reply, SensorInfo& info);

/// The device's clock in a reply to TM1, in milliseconds of 24 bits.
[[nodiscard]] std::optional<std::uint32_t> read_time(const Reply& reply);

/// Compares serial numbers as printed: a leading 0 equals H, case is ignored.
[[nodiscard]] bool same_serial(std::string_view a, std::string_view b);

/// Meaning of a status other than 00, 02 and 99, for a message.
[[nodiscard]] std::string_view describe_status(std::string_view status);

}  // namespace topo::hokuyo
