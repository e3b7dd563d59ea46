// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace topo::types {

/// Why an operation on the environment (device, file, configuration, wire) failed.
enum class Errc {
  kInvalidInput,  ///< input from the user or from a file is wrong
  kNotFound,      ///< no such file, device or host
  kPermission,    ///< it exists, but access is denied
  kBusy,          ///< in use elsewhere
  kTimeout,       ///< no response in time
  kClosed,        ///< the peer or the device went away
  kProtocol,      ///< the received bytes violate the protocol
  kWrongDevice,   ///< a device responds, but not the expected one
  kUnsupported,   ///< understood and refused
  kIo,            ///< any other failure of the operating system
};

/// Error that the user can act on: what was found, where, and what would be correct.
struct Error {
  Errc code = Errc::kIo;
  std::string message;
  int sys_errno = 0;  ///< 0 when no system call failed
};

/// Value or Error. Only has_value, *, ->, error, value_or, and_then and transform are used, so that
/// std::expected can take its place; value() is not, because it throws.
template <class T>
struct [[nodiscard]] Result : tl::expected<T, Error> {
  using tl::expected<T, Error>::expected;
};

using Status = Result<void>;

inline tl::unexpected<Error> fail(Errc code, std::string message, int sys_errno = 0) {
  return tl::unexpected<Error>(Error{code, std::move(message), sys_errno});
}

}  // namespace topo::types
