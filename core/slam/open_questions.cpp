// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/open_questions.hpp"

namespace topo::slam {

void OpenQuestions::close(std::size_t node) {
  open_.erase(node);
  closed_.insert(node);
}

bool OpenQuestions::is_beside_closed(std::size_t node) const {
  const auto from = closed_.lower_bound(node < apart_ ? 0 : node - apart_ + 1);
  return from != closed_.end() && *from < node + apart_;
}

void OpenQuestions::correct(std::span<const types::Se2> poses) {
  again_.clear();
  for (const auto& [node, asked] : open_) {
    if (types::is_apart(asked, poses[node], moved_m_, moved_rad_)) again_.insert(node);
  }
}

std::optional<std::size_t> OpenQuestions::take() {
  while (!again_.empty()) {
    const std::size_t node = *again_.begin();
    again_.erase(again_.begin());
    if (!is_beside_closed(node)) return node;
  }
  return std::nullopt;
}

}  // namespace topo::slam
