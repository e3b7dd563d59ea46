// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/run_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "drivers/io/posix.hpp"

namespace topo::bench {
namespace {

using io::fail_errno;
using io::retry_interrupted;
using nlohmann::json;

types::Result<std::string> content_of(int fd, const std::string& name) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t got = retry_interrupted([&] { return ::read(fd, buffer.data(), buffer.size()); });
    if (got < 0) return fail_errno(name, "reading", errno);
    if (got == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

types::Result<RunLog> RunLog::open(const std::filesystem::path& file) {
  const std::string name = file.string();
  io::UniqueFd fd(::open(name.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!fd.valid()) return fail_errno(name, "opening", errno);
  // Of the process, where flock(2) is of the open file: the runs' processes inherit the file, and one that
  // outlives its parent by a moment must not keep the next program from it.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(fd.get(), F_SETLK, &whole) != 0) {
    if (errno != EACCES && errno != EAGAIN) return fail_errno(name, "locking", errno);
    return types::fail(types::Errc::kBusy,
                       fmt::format("{}: another topobench writes it; wait for it, or give --out another "
                                   "folder",
                                   name));
  }
  const auto text = content_of(fd.get(), name);
  if (!text) return tl::unexpected(text.error());
  RunLog log(file, std::move(fd));
  std::size_t begin = 0;
  for (std::size_t end = text->find('\n'); end != std::string::npos; end = text->find('\n', begin)) {
    log.take_line(text->substr(begin, end - begin));
    begin = end + 1;
  }
  if (begin < text->size() && ::ftruncate(log.fd_.get(), static_cast<off_t>(begin)) != 0)
    return fail_errno(name, "cutting off a torn line", errno);
  return log;
}

void RunLog::take_line(const std::string& line) {
  json entry = json::parse(line, nullptr, false);
  const bool has_run = entry.is_object() && entry.contains("run") && entry["run"].is_object();
  if (has_run && entry.contains("report") && entry["report"].is_object())
    take_report(entry["run"], std::move(entry["report"]));
  else if (has_run && entry.contains("crashed") && entry["crashed"].is_string())
    crashes_[entry["run"].dump()] = entry["crashed"];
  else
    ++strange_lines_;
}

void RunLog::take_report(const json& run, json report) {
  if (run.contains("program") && run["program"].is_string()) programs_.insert(run["program"]);
  crashes_.erase(run.dump());
  reports_[run.dump()] = std::move(report);
}

const json* RunLog::find(const json& run) const {
  const auto at = reports_.find(run.dump());
  return at == reports_.end() ? nullptr : &at->second;
}

const std::string* RunLog::find_crash(const json& run) const {
  const auto at = crashes_.find(run.dump());
  return at == crashes_.end() ? nullptr : &at->second;
}

types::Status RunLog::write_line(const json& entry) {
  const std::string line = entry.dump() + '\n';
  const ssize_t written = retry_interrupted([&] { return ::write(fd_.get(), line.data(), line.size()); });
  if (written == static_cast<ssize_t>(line.size())) return {};
  return fail_errno(file_.string(), "writing a whole line", written < 0 ? errno : ENOSPC);
}

types::Status RunLog::append(const json& run, json report) {
  if (auto status = write_line({{"run", run}, {"report", report}}); !status) return status;
  take_report(run, std::move(report));
  return {};
}

types::Status RunLog::append_crash(const json& run, const std::string& why) {
  if (auto status = write_line({{"run", run}, {"crashed", why}}); !status) return status;
  crashes_[run.dump()] = why;
  return {};
}

}  // namespace topo::bench
