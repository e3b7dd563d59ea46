// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/slam/params.hpp"
#include "daemon/app/tile_book.hpp"
#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

/// The map of a session's file for displays: in it the operator shows where the robot is, before it becomes
/// the map. One thread at a time.
class SessionView {
 public:
  explicit SessionView(const slam::GridParams& params) : params_(params) {}

  /// As MapView::tiles(), of the session in the file `path`, which is read once. Blocks on the disk. Errors
  /// as of load_session().
  types::Result<Json> tiles(const std::string& path, std::uint64_t since);

 private:
  slam::GridParams params_;
  std::string drawn_;  ///< the file of the session in the book
  TileBook book_;
};

}  // namespace topo::daemon
