// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "daemon/app/doctor.hpp"

namespace topo::daemon {

/// What helps a device that does not work, in plain words: by its state, which its driver chooses by what is
/// the matter, and by the system's error text in its message.
[[nodiscard]] std::string device_cure(const DoctorFacts::Device& device);

}  // namespace topo::daemon
