// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/journal_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "daemon/recording/quota.hpp"
#include "daemon/session/format.hpp"
#include "drivers/io/folder_sync.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;
using types::Status;

namespace {

/// A map with pose errors of this size is good enough to be continued: the corrections of all poses need not
/// be written after every closure.
constexpr PoseTolerance kTolerance{0.02, 0.002};

}  // namespace

Result<JournalFile> JournalFile::create(const std::string& path, std::uint64_t params_hash) {
  // Without the folder, for a report of bounded length: the folder is in the configuration.
  const std::string name = std::filesystem::path(path).filename().string();
  io::UniqueFd fd(io::retry_interrupted(
      [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644); }));
  if (!fd.valid()) {
    if (errno == EEXIST)
      return types::fail(Errc::kInvalidInput, fmt::format("{}: there is such a file already", name), EEXIST);
    return io::fail_errno(name, "cannot create the journal", errno);
  }
  mark_as_written(fd.get());
  JournalFile journal(path, name, std::move(fd));
  Status kept = journal.write(encode_session_header({params_hash}));
  if (kept) kept = io::sync_folder_of(path);
  if (!kept) {
    ::unlink(path.c_str());
    return tl::unexpected(kept.error());
  }
  return journal;
}

/// Truncates the file: part of a record, or the rest of a longer one, would hide all later records from a
/// reader.
tl::unexpected<types::Error> JournalFile::take_back(const std::string& doing, int error) {
  static_cast<void>(::ftruncate(fd_.get(), static_cast<off_t>(size_)));
  return io::fail_errno(name_, doing, error);
}

Status JournalFile::write(std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto n = io::retry_interrupted([&] {
      return ::pwrite(fd_.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(size_ + done));
    });
    if (n < 0) return take_back(fmt::format("cannot write {} bytes at byte {}", bytes.size(), size_), errno);
    done += static_cast<std::size_t>(n);
  }
  if (::fdatasync(fd_.get()) != 0 && errno != EINVAL) return take_back("cannot bring it to the disk", errno);
  size_ += bytes.size();
  return {};
}

Result<bool> JournalFile::append(const slam::Session& session) {
  const auto records = writer_.changes(session, kTolerance);
  if (!records) return tl::unexpected(records.error());
  if (records->empty()) return false;
  if (auto s = write(*records); !s) return tl::unexpected(s.error());
  writer_.written(session, kTolerance);
  return true;
}

Status JournalFile::close(const slam::Session& session) {
  const auto records = writer_.changes(session, {});
  if (!records) return tl::unexpected(records.error());
  if (auto s = write(*records); !s) return s;
  writer_.written(session, {});
  return write(writer_.end());
}

}  // namespace topo::daemon
