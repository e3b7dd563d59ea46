// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/qr_text.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace topo::daemon {
namespace {

using Rows = std::vector<std::string>;

/// The modules that the lines show, a row each: '#' dark, '.' light.
Rows modules_of(const std::string& text) {
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    Rows two(2);
    for (std::size_t at = 0; at < line.size();) {
      const bool block = line[at] != ' ';  // of three bytes in UTF-8
      const std::string sign = line.substr(at, block ? 3 : 1);
      two[0] += sign == "▀" || sign == "█" ? '#' : '.';
      two[1] += sign == "▄" || sign == "█" ? '#' : '.';
      at += sign.size();
    }
    rows.insert(rows.end(), two.begin(), two.end());
  }
  return rows;
}

TEST(QrText, HasItsThreeFindersWithinALightMargin) {
  const auto text =
      qr_text("http://robot1:8080/#token=k7c8-abqg-jukj-6e66-tper", {.margin = 2, .colours = false});
  ASSERT_TRUE(text.has_value());
  const Rows rows = modules_of(*text);
  const std::size_t side = rows.front().size() - 4;
  EXPECT_EQ((side - 17) % 4, 0U) << "sides there are: 21, 25, 29, ...";
  const Rows finder{"#######", "#.....#", "#.###.#", "#.###.#", "#.###.#", "#.....#", "#######"};
  for (const auto& [x, y] :
       std::vector<std::pair<std::size_t, std::size_t>>{{2, 2}, {side - 5, 2}, {2, side - 5}})
    for (std::size_t i = 0; i < finder.size(); ++i)
      EXPECT_EQ(rows[y + i].substr(x, 7), finder[i]) << x << " " << y;
  for (const std::size_t y : {0UL, 1UL, side + 2, side + 3}) EXPECT_EQ(rows[y].find('#'), std::string::npos);
  for (const std::string& row : rows) EXPECT_EQ(row.substr(0, 2) + row.substr(side + 2), "....");
}

TEST(QrText, AnotherTextIsAnotherCode) {
  EXPECT_NE(qr_text("a").value_or(""), qr_text("b").value_or(""));
  EXPECT_EQ(qr_text("a").value_or("1"), qr_text("a").value_or("2"));
}

TEST(QrText, WhatDoesNotFitIsRefused) {
  EXPECT_FALSE(qr_text("").has_value());
  EXPECT_FALSE(qr_text(std::string(4000, 'a')).has_value());
}

}  // namespace
}  // namespace topo::daemon
