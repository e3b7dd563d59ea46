// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace topo::types {

/// Why an operation on the environment (device, file, configuration, wire) failed.
enum class Errc {
  kInvalidInput,  ///< what a person or file gave is wrong: the user's fault
  kNotFound,      ///< no such file, device or host
  kPermission,    ///< it is there, but not for us
  kBusy,          ///< somebody else holds it
  kTimeout,       ///< nothing came in time
  kClosed,        ///< the peer or the device went away
  kProtocol,      ///< bytes came that the protocol does not allow
  kWrongDevice,   ///< a device answers, but not the one that was asked for
  kUnsupported,   ///< understood and refused
  kIo,            ///< any other failure of the operating system
};

/// An error that a person can act on: what was found, where, and what would be right.
struct Error {
  Errc code = Errc::kIo;
  std::string message;
  int sys_errno = 0;  ///< 0 when the operating system had no part in it
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
