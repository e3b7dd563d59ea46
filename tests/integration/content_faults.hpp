// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "tests/integration/wire_rig.hpp"

namespace topo::test {

/// A fault on the wires in which much arrives, in form and in time, and is wrong; or one of the machine on
/// which the daemon runs. It strikes a robot at full speed.
struct ContentFault {
  std::string name;          ///< as in the table: "device: what is wrong"
  std::vector<Json> strike;  ///< toposim's commands
  std::vector<Json> lift;
  /// A part of what state, doubts or health have to say, or one of several with a bar between them; empty:
  /// the daemon need not know.
  std::string says;
  double box_after_s = 1.5;                ///< until a box appears 1 m ahead; below 0: none appears
  std::function<void(WireRig&)> before{};  ///< the robot drives
  std::function<void(WireRig&)> act{};     ///< after `strike`
  std::function<void(WireRig&)> undo{};    ///< before `lift`
  const char* order = nullptr;             ///< by the operator, half a second after the blow
  bool sonar_only = false, tcp_only = false;
  bool journal = false;     ///< sessions are kept
  bool process = false;     ///< the daemon is one of its own
  bool guest = false;       ///< of a machine of its own (tests/vm/machine_faults_test.py)
  unsigned processors = 1;  ///< that the machine has at least
  std::string cgroup{};     ///< of the daemon
  bool deaf = false;        ///< the daemon cannot answer while the fault is there
  bool harmless = false;    ///< it is not to stop the robot
};
std::ostream& operator<<(std::ostream& out, const ContentFault& fault);

std::vector<ContentFault> content_faults();

/// Faults for which the test has to be root and the daemon to have real-time rights; ContentFault::guest:
/// those that are done to the whole machine.
std::vector<ContentFault> host_faults();

/// What no test on a developer's machine does to it, and where it is done.
struct Elsewhere {
  std::string name, where;
};
std::vector<Elsewhere> faults_elsewhere();

}  // namespace topo::test
