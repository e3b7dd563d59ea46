// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, SignedOverflow) { EXPECT_NE(topo::canary::overflow_int(1), 1); }
