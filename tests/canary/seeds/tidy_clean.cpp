// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
namespace topo::canary {

int twice(int value);
int twice(int value) { return 2 * value; }

}  // namespace topo::canary
