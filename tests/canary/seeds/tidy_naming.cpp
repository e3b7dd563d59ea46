// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
namespace topo::canary {

int BadName(int value);
int BadName(int value) { return value; }

}  // namespace topo::canary
