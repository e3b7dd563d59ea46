// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, ContainerBounds) { EXPECT_NE(topo::canary::index_at_size({1, 2, 3}), 12345678); }
