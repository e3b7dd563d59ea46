// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace topo::canary {

/// Reads one element past the end of a heap block of `size` integers.
int read_past_heap_block(std::size_t size);
/// Adds one to the largest int when given 1.
int overflow_int(int step);
/// Allocates blocks and forgets them.
void lose_memory();
/// Two threads count one variable without any order between them.
int race_on_counter();
/// Indexes a vector at its size.
int index_at_size(const std::vector<int>& values);
/// Correct.
int sum(const std::vector<int>& values);
/// Writes past a block of four bytes when the input begins with the magic word and is longer.
void parse(const unsigned char* data, std::size_t size);

}  // namespace topo::canary
