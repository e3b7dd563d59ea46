// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/result.hpp"
#include "tests/bench/topobench/contact/contact.hpp"

namespace topo::bench {

struct ContactCommand {
  ContactSetup setup;
  bool json = false;
};

/// Prints what run_contact() found. kTimeout: the sets are not the same within the limit.
types::Status run_contact_command(const ContactCommand& command);

}  // namespace topo::bench
