// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/worker_processes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <span>
#include <vector>

#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::bench {
namespace {

using io::fail_errno;
using io::retry_interrupted;
using types::Errc;
using types::fail;

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kPollMax_ms = 3'600'000;
constexpr int kWhole = 0, kFailed = 3;  // exit statuses: of neither is the text a part of something

/// A process at work. One that is dropped is killed.
class Worker {
 public:
  Worker(std::size_t job, pid_t pid, io::UniqueFd text, Clock::time_point end)
      : job_(job), end_(end), pid_(pid), fd_(std::move(text)) {}
  Worker(Worker&& other) noexcept
      : job_(other.job_),
        end_(other.end_),
        pid_(std::exchange(other.pid_, -1)),
        fd_(std::move(other.fd_)),
        text_(std::move(other.text_)) {}
  Worker& operator=(Worker&& other) noexcept {
    std::swap(job_, other.job_);
    std::swap(end_, other.end_);
    std::swap(pid_, other.pid_);
    std::swap(fd_, other.fd_);
    std::swap(text_, other.text_);
    return *this;
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() { kill(); }

  void kill() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    (void)wait();
  }

  [[nodiscard]] std::size_t job() const { return job_; }
  [[nodiscard]] int fd() const { return fd_.get(); }
  /// When it has to be done.
  [[nodiscard]] Clock::time_point end() const { return end_; }

  /// Reads what is there. False at the end of the text.
  bool read() {
    std::array<char, 65536> buffer{};
    const ssize_t got = retry_interrupted([&] { return ::read(fd_.get(), buffer.data(), buffer.size()); });
    if (got > 0) text_.append(buffer.data(), static_cast<std::size_t>(got));
    return got > 0;
  }

  /// After the end of the text: what came of it.
  types::Result<std::string> result() {
    const int status = wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kWhole) return std::move(text_);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kFailed) return fail(Errc::kInvalidInput, text_);
    if (WIFSIGNALED(status))
      return fail(Errc::kIo,
                  fmt::format("killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status))));
    return fail(Errc::kIo, fmt::format("ended with status {}", WEXITSTATUS(status)));
  }

 private:
  int wait() {
    int status = 0;
    retry_interrupted([&] { return ::waitpid(pid_, &status, 0); });
    pid_ = -1;
    return status;
  }

  std::size_t job_;
  Clock::time_point end_;
  pid_t pid_;
  io::UniqueFd fd_;
  std::string text_;
};

bool write_all(int fd, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written =
        retry_interrupted([&] { return ::write(fd, text.data() + at, text.size() - at); });
    if (written < 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void do_job(std::size_t job, const Work& work, int fd, pid_t parent) noexcept {
  // A parent that died before the first call is another one now.
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != parent) ::_exit(1);
  const types::Result<std::string> text = work(job);
  const bool written = write_all(fd, text ? *text : text.error().message);
  ::_exit(!written ? 1 : text ? kWhole : kFailed);
}

types::Result<Worker> start(std::size_t job, const Work& work, std::chrono::seconds limit) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return fail_errno("a run's process", "making a pipe", errno);
  io::UniqueFd reading(ends[0]), writing(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return fail_errno("a run's process", "starting it", errno);
  if (child == 0) do_job(job, work, writing.get(), parent);
  return Worker(job, child, std::move(reading), Clock::now() + limit);
}

/// Until one of them has something to say, or its time is over. True at each that has.
types::Result<std::vector<bool>> wait_for(std::span<const Worker> workers) {
  std::vector<pollfd> waiting;
  Clock::time_point first_end = Clock::time_point::max();
  for (const Worker& worker : workers) {
    waiting.push_back({worker.fd(), POLLIN, 0});
    first_end = std::min(first_end, worker.end());
  }
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(first_end - Clock::now());
  const int timeout_ms = static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, kPollMax_ms));
  if (retry_interrupted([&] { return ::poll(waiting.data(), waiting.size(), timeout_ms); }) < 0)
    return fail_errno("the runs' processes", "waiting for them", errno);
  std::vector<bool> ready;
  for (const pollfd& one : waiting) ready.push_back(one.revents != 0);
  return ready;
}

}  // namespace

types::Status run_in_processes(std::size_t count, const WorkerLimits& limits, const Work& work,
                               const JobDone& done) {
  std::vector<Worker> workers;
  for (std::size_t next = 0; next < count || !workers.empty();) {
    for (; next < count && workers.size() < static_cast<std::size_t>(limits.at_once); ++next) {
      auto worker = start(next, work, limits.each);
      if (!worker) return tl::unexpected(worker.error());
      workers.push_back(std::move(*worker));
    }
    const auto ready = wait_for(workers);
    if (!ready) return tl::unexpected(ready.error());
    for (std::size_t i = workers.size(); i-- > 0;) {
      Worker& worker = workers[i];
      const bool ended = (*ready)[i] && !worker.read();
      const bool late = !ended && Clock::now() >= worker.end();
      if (!ended && !late) continue;
      if (late) worker.kill();
      const types::Result<std::string> text =
          late ? fail(Errc::kTimeout,
                      fmt::format("killed: not done after {} s by the clock", limits.each.count()))
               : worker.result();
      const std::size_t job = worker.job();
      workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(i));
      if (auto status = done(job, text); !status) return status;
    }
  }
  return {};
}

}  // namespace topo::bench
