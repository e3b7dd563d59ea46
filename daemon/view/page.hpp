// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace topo::daemon {

/// One file of the page, built into the program (embed_page.cmake): the page and the program that serves it
/// are of one version.
struct PageFile {
  std::string_view name;  ///< "index.html"
  std::string_view bytes;
};
std::span<const PageFile> page_files();

/// The file for a request's target ("/" is "/index.html"); null when there is none. Nothing on the disk is
/// reached by any target.
const PageFile* find_page_file(std::string_view target);

/// Its media type, by the name's ending.
std::string_view media_type(std::string_view name);

/// `bytes` as a gzip member (RFC 1952).
std::string gzip(std::string_view bytes);

}  // namespace topo::daemon
