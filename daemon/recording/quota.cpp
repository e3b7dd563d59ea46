// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/quota.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {
namespace {

constexpr std::string_view kStampForm = "00000000T000000Z.rec";  // 0: any digit

/// The beginning of a recording's name up to its stamp; empty when the name is of another form.
std::string_view series_of(std::string_view name) {
  if (name.size() <= kStampForm.size()) return {};
  const std::string_view stamp = name.substr(name.size() - kStampForm.size());
  const bool fits = std::equal(stamp.begin(), stamp.end(), kStampForm.begin(), [](char c, char form) {
    return form == '0' ? c >= '0' && c <= '9' : c == form;
  });
  const std::string_view series = name.substr(0, name.size() - stamp.size());
  return fits && series.ends_with('-') ? series : std::string_view();
}

}  // namespace

void mark_as_written(int fd) {
  static_cast<void>(io::retry_interrupted([fd] { return ::flock(fd, LOCK_EX | LOCK_NB); }));
}

bool remove_finished(const std::string& path) {
  const io::UniqueFd fd(
      io::retry_interrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }));
  if (!fd.valid()) return false;
  const int locked = io::retry_interrupted([&] { return ::flock(fd.get(), LOCK_EX | LOCK_NB); });
  if (locked != 0 && errno == EWOULDBLOCK) return false;
  return ::unlink(path.c_str()) == 0;
}

QuotaResult keep_to_quota(std::span<const QuotaFile> oldest_first, std::uint64_t quota_bytes) {
  QuotaResult result;
  for (const QuotaFile& file : oldest_first) result.left_bytes += file.bytes;
  for (std::size_t i = 0; i + 1 < oldest_first.size() && result.left_bytes > quota_bytes; ++i) {
    if (!remove_finished(oldest_first[i].path)) continue;
    ++result.removed;
    result.removed_bytes += oldest_first[i].bytes;
    result.left_bytes -= oldest_first[i].bytes;
  }
  return result;
}

std::vector<QuotaFile> recordings_beside(const std::string& path) {
  const std::filesystem::path own(path);
  const std::string own_name = own.filename().string();
  const std::string_view series = series_of(own_name);
  std::vector<QuotaFile> files;
  if (series.empty()) return files;
  std::error_code error;
  for (auto it = std::filesystem::directory_iterator(own.parent_path(), error);
       !error && it != std::filesystem::end(it); it.increment(error)) {
    std::error_code gone;  // another process may remove the file meanwhile
    const std::string name = it->path().filename().string();
    if (series_of(name) != series || !it->is_regular_file(gone)) continue;
    const std::uintmax_t bytes = it->file_size(gone);
    if (!gone) files.push_back({it->path().string(), bytes});
  }
  std::sort(files.begin(), files.end(),
            [](const QuotaFile& a, const QuotaFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace topo::daemon
