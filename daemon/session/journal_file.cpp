// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/journal_file.hpp"

#include <unistd.h>

#include "daemon/session/format.hpp"

namespace topo::daemon {

using types::Result;
using types::Status;

namespace {

/// A map with pose errors of this size is good enough to be continued: the corrections of all poses need not
/// be written after every closure.
constexpr PoseTolerance kTolerance{0.02, 0.002};

}  // namespace

Result<JournalFile> JournalFile::create(const std::string& path, std::uint64_t params_hash) {
  auto file = AppendFile::create(path, "journal");
  if (!file) return tl::unexpected(file.error());
  JournalFile journal(std::move(*file));
  if (auto kept = journal.file_.append(encode_session_header({params_hash})); !kept) {
    ::unlink(path.c_str());
    return tl::unexpected(kept.error());
  }
  return journal;
}

Result<bool> JournalFile::append(const slam::Session& session) {
  const auto records = writer_.changes(session, kTolerance);
  if (!records) return tl::unexpected(records.error());
  if (records->empty()) return false;
  if (auto s = file_.append(*records); !s) return tl::unexpected(s.error());
  writer_.written(session, kTolerance);
  return true;
}

Status JournalFile::close(const slam::Session& session) {
  const auto records = writer_.changes(session, {});
  if (!records) return tl::unexpected(records.error());
  if (auto s = file_.append(*records); !s) return s;
  writer_.written(session, {});
  return file_.append(writer_.end());
}

}  // namespace topo::daemon
