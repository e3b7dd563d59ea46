// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

namespace topo::test {

/// A program of the build in a process of its own, which ends with this one.
class ChildProcess {
 public:
  /// `program`: its name; what it says goes behind what `log` has already. `cgroup`: the folder of the
  /// control group that it is born in; empty: this process's. Null (and a failure of the test) when there is
  /// no such program.
  static std::unique_ptr<ChildProcess> start(const std::string& program,
                                             const std::vector<std::string>& arguments,
                                             const std::string& log, const std::string& cgroup = "");
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Its exit status; 128 and the number of the signal that ended it.
  int wait();

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_;  ///< 0: it has ended
};

}  // namespace topo::test
