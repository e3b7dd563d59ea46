// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/plot_text.hpp"

#include <array>

namespace topo::bench {
namespace {

/// 3 x 5 pixels, rows from above, the left pixel in the highest bit.
using Glyph = std::array<unsigned, 5>;

constexpr std::array<Glyph, 10> kDigits{{{7, 5, 5, 5, 7},
                                         {2, 6, 2, 2, 7},
                                         {7, 1, 7, 4, 7},
                                         {7, 1, 7, 1, 7},
                                         {5, 5, 7, 1, 1},
                                         {7, 4, 7, 1, 7},
                                         {7, 4, 7, 5, 7},
                                         {7, 1, 1, 1, 1},
                                         {7, 5, 7, 5, 7},
                                         {7, 5, 7, 1, 7}}};

constexpr std::array<Glyph, 26> kLetters{
    {{2, 5, 7, 5, 5}, {6, 5, 6, 5, 6}, {3, 4, 4, 4, 3}, {6, 5, 5, 5, 6}, {7, 4, 6, 4, 7}, {7, 4, 6, 4, 4},
     {3, 4, 5, 5, 3}, {5, 5, 7, 5, 5}, {7, 2, 2, 2, 7}, {1, 1, 1, 5, 2}, {5, 5, 6, 5, 5}, {4, 4, 4, 4, 7},
     {5, 7, 7, 5, 5}, {6, 5, 5, 5, 5}, {2, 5, 5, 5, 2}, {6, 5, 6, 4, 4}, {2, 5, 5, 6, 3}, {6, 5, 6, 5, 5},
     {3, 4, 2, 1, 6}, {7, 2, 2, 2, 2}, {5, 5, 5, 5, 7}, {5, 5, 5, 5, 2}, {5, 5, 7, 7, 5}, {5, 5, 2, 5, 5},
     {5, 5, 2, 2, 2}, {7, 1, 2, 4, 7}}};

Glyph glyph_of(char c) {
  if (c >= '0' && c <= '9') return kDigits[static_cast<std::size_t>(c - '0')];
  if (c >= 'a' && c <= 'z') return kLetters[static_cast<std::size_t>(c - 'a')];
  if (c >= 'A' && c <= 'Z') return kLetters[static_cast<std::size_t>(c - 'A')];
  if (c == '-') return {0, 0, 7, 0, 0};
  if (c == '.') return {0, 0, 0, 0, 2};
  return {};
}

}  // namespace

void write_text(sim::Picture& picture, double x, double y, std::string_view text, sim::Colour colour) {
  for (const char c : text) {
    const Glyph rows = glyph_of(c);
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 3; ++column) {
        if ((rows[static_cast<std::size_t>(row)] >> static_cast<unsigned>(2 - column) & 1U) == 0) continue;
        for (const double dx : {0.5, 1.5}) {
          for (const double dy : {0.5, 1.5}) picture.dot({x + 2 * column + dx, y - 2 * row - dy}, colour);
        }
      }
    }
    x += kTextWidth_px;
  }
}

}  // namespace topo::bench
