// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, HeapOverflow) { EXPECT_NE(topo::canary::read_past_heap_block(8), 12345678); }
