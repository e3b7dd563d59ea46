// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/params.hpp"

namespace topo::exploration {

std::string_view to_text(Finish finish) { return finish == Finish::kEssential ? "essential" : "complete"; }

}  // namespace topo::exploration
