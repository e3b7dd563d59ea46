// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

namespace topo::canary {

std::size_t moved(std::string text);
std::size_t moved(std::string text) {
  const std::string taken = std::move(text);
  return taken.size() + text.size();
}

}  // namespace topo::canary
