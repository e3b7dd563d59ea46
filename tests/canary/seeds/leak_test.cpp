// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, Leak) { EXPECT_NO_THROW(topo::canary::lose_memory()); }
