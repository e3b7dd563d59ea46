// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/fault_table.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/plausibility/doubt.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::test {
namespace {

constexpr std::string_view kHead =
    "| fault | form | what the robot does | what it says | how it comes back |\n|---|---|---|---|---|\n";

constexpr std::string_view kIntroduction = R"(# Faults, and what the robot does

Written by the tests that inject them, row by row:

```sh
TOPOMETRIC_FAULT_TABLE=$PWD/doc/faults.md build/release/tests/integration/plausibility_sim_test
TOPOMETRIC_FAULT_TABLE=$PWD/doc/faults.md ctest --test-dir build/release -R wire_faults
TOPOMETRIC_FAULT_TABLE=$PWD/doc/faults.md python3 -B tests/vm/machine_faults_test.py build/release
```

*Values*: a P3-DX in lock-step with the simulator, the fault from the start, at 0.7 or at 1.2 m/s, three seeds each, the worst of
them shown. A box appears 1 m ahead 1.5 s after the fault (late commands: 3.5 and 4.5 s; scanner of another robot,
encoder: 2.5 s). *Wires*: the whole daemon at 0.7 m/s on a mission against `toposim`'s devices, in real time, on the
transport that the row names, with the sonar on or off. Where the fault leaves the robot driving a box appears 1 m ahead
as well. Way and time are from the fault (values) or from the blow (wires) until the robot stands. No run touched anything
unless the row says so. *An emulated guest*: the same, robot and daemon in a guest of one processor whose clock counts its
instructions, so that it keeps time; the front scanner at 10 Hz, the coronal one a URG-04LX. The limits are set as systemd
sets them (RLIMIT_RTTIME, memory.max), without systemd. Suspend is to RAM, and the simulated robot sleeps as well: one that
does not is stopped by its watchdog, as in the row of SIGSTOP. Not run: suspend to idle, because the guest's kernel has no
idle state in which it stops its clock; a hog on one of several processors, because QEMU counts the instructions of one
(the row without a guest has it). Every kind on TCP and on terminals, with sonar and without, N seeds:

```sh
TOPOMETRIC_FAULT_CROSS=N python3 -B tests/integration/side_by_side.py \
  build/release/tests/integration/wire_faults_test 'Tcp/*' 'TcpWithoutSonar/*' 'Terminal/*' 'TerminalWithoutSonar/*'
```

Commands that become late less than the time of one answer before an obstacle appears are not known in time: at 0.7 m/s
with 1.5 s of delay the robot runs 1.05 m before it brakes.

)";

std::string line_of(const FaultRow& row) {
  return "| " + row.fault + " | " + row.form + " | " + row.does + " | " + row.says + " | " + row.back + " |";
}

/// "fault | form" of a line of the table.
std::string key_of(const std::string& line) {
  const auto second = line.find(" | ", line.find(" | ") + 1);
  return line.substr(2, second - 2);
}

using Rows = std::map<std::string, std::string>;

Rows rows_in(const std::string& file) {
  Rows rows;
  std::ifstream in(file);
  bool in_table = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("|---|---|---|---|---|")) {
      in_table = true;
    } else if (in_table && line.starts_with("| ")) {
      rows[key_of(line)] = line;
    } else {
      in_table = false;
    }
  }
  return rows;
}

void write_table(const std::string& file, const Rows& rows) {
  std::set<std::string> kinds;
  for (const auto& [key, line] : rows) kinds.insert(key.substr(0, key.find(" | ")));
  std::ofstream out(file, std::ios::trunc);
  out << kIntroduction << kinds.size() << " kinds:\n\n" << kHead;
  for (const auto& [key, line] : rows) out << line << "\n";
  out << "\nHow each doubt ends, and its cure:\n\n| doubt | found | cure |\n|---|---|---|\n";
  for (const plausibility::DoubtText& text : plausibility::doubt_texts())
    out << "| " << text.name << " | " << text.found << " | " << text.cure << " |\n";
  out.close();
  EXPECT_TRUE(out) << "cannot write " << file;
}

}  // namespace

std::string stands_after(double way_m, double time_s) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "stands after %.2f m, %.2f s", way_m, time_s);
  return text.data();
}

void record(const FaultRow& row) {
  const char* file = std::getenv("TOPOMETRIC_FAULT_TABLE");
  if (file == nullptr) return;
  const io::UniqueFd lock(::open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  ASSERT_TRUE(lock.valid() && ::flock(lock.get(), LOCK_EX) == 0) << "cannot open and lock " << file;
  Rows rows = rows_in(file);
  const std::string line = line_of(row);
  rows[key_of(line)] = line;
  write_table(file, rows);
}

}  // namespace topo::test
