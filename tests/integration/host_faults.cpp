// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What is done here needs rights, and much of it is done to the whole machine: its clock, its processors, its
// memory.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <list>
#include <memory>
#include <thread>

#include "tests/integration/content_faults.hpp"

namespace topo::test {
namespace {

namespace fs = std::filesystem;

constexpr double kNoBox = -1.0;
constexpr int kHogPriority = 60, kTestPriority = 80;  // the daemon's threads have 45 and 40

ContentFault of_the_host(std::string name, double box_after_s) {
  ContentFault made;
  made.name = "machine: " + std::move(name);
  made.box_after_s = box_after_s;
  made.process = true;
  return made;
}

/// Nothing for a machine that others use.
ContentFault in_a_guest(ContentFault fault) {
  fault.guest = true;
  return fault;
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  EXPECT_TRUE(out) << file << ": " << std::strerror(errno);
}

void shift_clock(std::int64_t seconds) {
  timespec now{};
  ASSERT_EQ(::clock_gettime(CLOCK_REALTIME, &now), 0);
  now.tv_sec += seconds;
  ASSERT_EQ(::clock_settime(CLOCK_REALTIME, &now), 0) << std::strerror(errno);
}

ContentFault clock_set(const std::string& name, std::int64_t seconds) {
  ContentFault fault = of_the_host(name, 1.5);
  fault.journal = fault.harmless = true;
  fault.act = [seconds](WireRig&) { shift_clock(seconds); };
  fault.undo = [seconds](WireRig&) { shift_clock(-seconds); };
  return fault;
}

/// The simulator stands still as the rest of the machine, so that this shows the daemon's clocks and
/// connections, not the robot's way.
ContentFault suspended() {
  ContentFault fault = of_the_host("suspended for 5 s, and the simulated robot with it", 1.5);
  fault.act = [](WireRig&) {
    timespec monotonic[2], boot[2];
    ::clock_gettime(CLOCK_MONOTONIC, &monotonic[0]);
    ::clock_gettime(CLOCK_BOOTTIME, &boot[0]);
    put("/sys/class/rtc/rtc0/wakealarm", "+5");
    put("/sys/power/mem_sleep", "deep");
    put("/sys/power/state", "mem");
    ::clock_gettime(CLOCK_MONOTONIC, &monotonic[1]);
    ::clock_gettime(CLOCK_BOOTTIME, &boot[1]);
    const auto elapsed = [](const timespec(&t)[2]) { return t[1].tv_sec - t[0].tv_sec; };
    EXPECT_GE(elapsed(boot) - elapsed(monotonic), 2) << "it slept";
  };
  return fault;
}

void set_policy(pid_t thread, int policy, int priority) {
  const sched_param param{priority};
  EXPECT_EQ(::sched_setscheduler(thread, policy, &param), 0) << std::strerror(errno);
}

/// Threads of this process beside hogs: the simulator's must run whatever the daemon's cannot.
void set_own_policy(int policy, int priority) {
  for (const auto& task : fs::directory_iterator("/proc/self/task"))
    set_policy(static_cast<pid_t>(std::stol(task.path().filename())), policy, priority);
}

unsigned processors_here() { return std::thread::hardware_concurrency(); }

/// A process that computes for some seconds above the daemon, on each of so many processors.
class PriorityHog {
 public:
  explicit PriorityHog(unsigned processors) {
    constexpr unsigned kSeconds = 5;
    for (unsigned cpu = 0; cpu < processors; ++cpu) {
      const pid_t child = ::fork();
      if (child == 0) {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(cpu, &one);
        const sched_param param{kHogPriority};
        if (::sched_setaffinity(0, sizeof one, &one) != 0 || ::sched_setscheduler(0, SCHED_FIFO, &param) != 0)
          ::_exit(1);
        ::signal(SIGALRM, SIG_DFL);
        ::alarm(kSeconds);
        for (std::atomic<bool> ever{true}; ever.load(std::memory_order_relaxed);) {
        }
      }
      children_.push_back(child);
    }
  }
  ~PriorityHog() {
    for (const pid_t child : children_) {
      int status = 0;
      EXPECT_EQ(::waitpid(child, &status, 0), child);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) << "it did not run as it should";
    }
  }
  PriorityHog(const PriorityHog&) = delete;
  PriorityHog& operator=(const PriorityHog&) = delete;

 private:
  std::vector<pid_t> children_;
};

ContentFault hogged(const std::string& name, unsigned processors, double box_after_s) {
  ContentFault fault = of_the_host(name, box_after_s);
  fault.deaf = true;
  const auto hog = std::make_shared<std::unique_ptr<PriorityHog>>();
  fault.act = [hog, processors](WireRig&) {
    // On all processors the kernel would leave a twentieth to the others, not to the simulator.
    if (processors == processors_here()) put("/proc/sys/kernel/sched_rt_runtime_us", "-1");
    set_own_policy(SCHED_FIFO, kTestPriority);
    *hog = std::make_unique<PriorityHog>(processors);
  };
  fault.undo = [hog](WireRig&) {
    hog->reset();
    set_own_policy(SCHED_OTHER, 0);
  };
  return fault;
}

ContentFault half_hogged() {
  constexpr double kBoxAfter_s = 1.5;
  ContentFault fault = hogged("CPU hog at a higher priority, on one of two processors", 1, kBoxAfter_s);
  fault.processors = 2;
  return fault;
}

/// A thread of the daemon, by its name.
pid_t thread_of(pid_t process, const std::string& name) {
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream in(task.path() / "comm");
    std::string found;
    if (std::getline(in, found) && found == name)
      return static_cast<pid_t>(std::stol(task.path().filename()));
  }
  ADD_FAILURE() << "no thread " << name;
  return 0;
}

/// The thread goes on at an instruction that jumps to itself: it computes and never waits.
void make_spin(pid_t thread) {
  ASSERT_EQ(::ptrace(PTRACE_ATTACH, thread, nullptr, nullptr), 0) << std::strerror(errno);
  int status = 0;
  ASSERT_EQ(::waitpid(thread, &status, __WALL), thread);
#if defined(__x86_64__)
  user_regs_struct registers{};
  ASSERT_EQ(::ptrace(PTRACE_GETREGS, thread, nullptr, &registers), 0);
  registers.orig_rax = static_cast<decltype(registers.orig_rax)>(-1);  // no system call is begun again
  ASSERT_EQ(::ptrace(PTRACE_SETREGS, thread, nullptr, &registers), 0);
  const auto at = static_cast<std::uintptr_t>(registers.rip);
  errno = 0;
  const long word = ::ptrace(PTRACE_PEEKTEXT, thread, at, nullptr);
  ASSERT_EQ(errno, 0);
  constexpr long kJumpToItself = 0xFEEB;
  ASSERT_EQ(::ptrace(PTRACE_POKETEXT, thread, at, (word & ~0xFFFFL) | kJumpToItself), 0);
#else
  ADD_FAILURE() << "an instruction of x86-64";
#endif
  ASSERT_EQ(::ptrace(PTRACE_DETACH, thread, nullptr, nullptr), 0);
}

/// As the service does it: whatever ended the daemon, topometric-estop writes to the port, and it is started
/// again.
void ends(WireRig& rig, const std::function<void(pid_t)>& kill, const std::function<void()>& meanwhile) {
  rig.kill_daemon(
      [&] {
        meanwhile();
        EXPECT_EQ(rig.run_estop(), 0);
      },
      kill);
}

ContentFault endless_computation() {
  ContentFault fault = of_the_host("LimitRTTIME is used up by the daemon's base thread", kNoBox);
  fault.journal = true;
  fault.act = [](WireRig& rig) {
    const auto kill = [](pid_t daemon) {
      constexpr rlim_t kMicroseconds = 1'000'000;  // of topometric.service
      const rlimit limit{kMicroseconds, kMicroseconds};
      ASSERT_EQ(::prlimit(daemon, RLIMIT_RTTIME, &limit, nullptr), 0) << std::strerror(errno);
      make_spin(thread_of(daemon, "base"));
    };
    ends(rig, kill, [] {});
  };
  return fault;
}

/// Made by tests/vm/machine_faults_test.py: of version 2, with the controller of memory.
const std::string& memory_group() {
  static const std::string kGroup = "/sys/fs/cgroup/topometric";
  return kGroup;
}

ContentFault memory_used_up() {
  ContentFault fault = of_the_host("MemoryMax is used up by the daemon", kNoBox);
  fault.journal = true;
  fault.cgroup = memory_group();
  fault.act = [](WireRig& rig) {
    // In place of a daemon that grows to its limit, the limit comes down to the daemon.
    const auto kill = [](pid_t) { put(memory_group() + "/memory.max", "1M"); };
    ends(rig, kill, [] { put(memory_group() + "/memory.max", "max"); });
  };
  return fault;
}

/// Another process takes all memory that there is; the daemon has topometric.service's OOMScoreAdjust.
ContentFault memory_pressure() {
  ContentFault fault = of_the_host("another process takes all memory", 1.5);
  const auto eater = std::make_shared<pid_t>(0);
  fault.act = [eater](WireRig& rig) {
    put("/proc/self/oom_score_adj", "-1000");
    put("/proc/" + std::to_string(rig.daemon_pid()) + "/oom_score_adj", "-900");
    *eater = ::fork();
    if (*eater != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::ofstream("/proc/self/oom_score_adj") << "0" << std::flush;
    constexpr std::size_t kPiece = 1 << 20;
    for (std::list<std::array<char, kPiece>> taken;;) taken.emplace_back();  // its pages are written
  };
  fault.undo = [eater](WireRig&) {
    int status = 0;
    EXPECT_EQ(::waitpid(*eater, &status, 0), *eater);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "the kernel ends it";
  };
  return fault;
}

/// For this thread, and the processes that it starts from now on.
void make_read_only(const std::string& folder) {
  ASSERT_EQ(::unshare(CLONE_NEWNS), 0) << std::strerror(errno);
  ASSERT_EQ(::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr), 0) << std::strerror(errno);
  ASSERT_EQ(::mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr), 0) << std::strerror(errno);
  ASSERT_EQ(::mount(nullptr, folder.c_str(), nullptr, MS_BIND | MS_REMOUNT | MS_RDONLY, nullptr), 0)
      << std::strerror(errno);
}

ContentFault read_only() {
  ContentFault fault = of_the_host("disk read-only", 1.5);
  fault.journal = true;
  fault.says = "not being kept";
  fault.before = [](WireRig& rig) { rig.kill_daemon([&rig] { make_read_only(rig.sessions()); }); };
  fault.undo = [](WireRig& rig) { EXPECT_EQ(::umount2(rig.sessions().c_str(), MNT_DETACH), 0); };
  return fault;
}

}  // namespace

std::vector<ContentFault> host_faults() {
  constexpr std::int64_t kHour_s = 3600, kYear_s = 365 * 24 * kHour_s;
  return {
      in_a_guest(clock_set("the clock is set ahead by an hour", kHour_s)),
      in_a_guest(clock_set("the clock is set back by a year", -kYear_s)),
      read_only(),
      in_a_guest(memory_pressure()),
      in_a_guest(memory_used_up()),
      endless_computation(),
      half_hogged(),
      in_a_guest(hogged("CPU hog at a higher priority, on all processors", processors_here(), kNoBox)),
      in_a_guest(suspended()),  // the last: files that the guest shares with its host are gone afterwards
  };
}

}  // namespace topo::test
