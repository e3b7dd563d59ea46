// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/calibration/configuration_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "daemon/config/load.hpp"
#include "daemon/mapfile/atomic_file.hpp"

namespace topo::daemon {
namespace {

types::Result<std::string> keep_old(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(file, error)) return std::string();
  for (int n = 1;; ++n) {
    std::string kept = fmt::format("{}.{}", file, n);
    if (fs::exists(kept, error)) continue;
    if (fs::copy_file(file, kept, error)) return kept;
    return types::fail(types::Errc::kIo,
                       fmt::format("{}: cannot be kept as {}: {}", file, kept, error.message()));
  }
}

}  // namespace

types::Result<std::string> read_text(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    const int why = errno;
    const auto code = why == ENOENT   ? types::Errc::kNotFound
                      : why == EACCES ? types::Errc::kPermission
                                      : types::Errc::kIo;
    return types::fail(code, fmt::format("{}: {}", file, std::strerror(why)), why);
  }
  return std::string(std::istreambuf_iterator<char>(in), {});
}

types::Result<std::string> replace_configuration(const std::string& file, std::string_view text) {
  const LoadedConfiguration checked = parse_configuration(text, file);
  if (!checked.faults.empty()) return types::fail(types::Errc::kInvalidInput, faults_text(checked));
  auto kept = keep_old(file);
  if (!kept) return kept;
  if (auto written = write_file(file, text); !written) return tl::unexpected(written.error());
  return kept;
}

}  // namespace topo::daemon
