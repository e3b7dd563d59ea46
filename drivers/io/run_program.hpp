// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::io {

/// Body of a program's main(): returns the exit status of `start`, or 1 when that is 0 and standard output
/// could not be written completely, which is reported on standard error. A standard stream that the caller
/// closed is replaced by one on which every access fails, so that no file opened later gets its descriptor
/// and its text.
int run_program(const char* name, int (*start)(int argc, char** argv), int argc, char** argv);

}  // namespace topo::io
