// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seeds.hpp"

#include <gtest/gtest.h>

TEST(Canary, DataRace) { EXPECT_GE(topo::canary::race_on_counter(), 1); }
