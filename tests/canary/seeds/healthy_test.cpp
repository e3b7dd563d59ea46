// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, CleanCodePasses) { EXPECT_EQ(topo::canary::sum({1, 2, 3}), 6); }
