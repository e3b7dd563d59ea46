// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::io {

/// What a program's main() does: gives the exit status of `start`, or 1 when that is 0 and not all of the
/// standard output could be written, which is said on standard error. A standard stream that the caller
/// closed is one on which every access fails, so that no file that is opened later takes its number and its
/// text.
int run_program(const char* name, int (*start)(int argc, char** argv), int argc, char** argv);

}  // namespace topo::io
