// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
int narrowed(long value);
int narrowed(long value) { return value; }
