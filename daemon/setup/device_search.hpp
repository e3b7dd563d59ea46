// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/calibration/still_picture.hpp"
#include "daemon/setup/device_probe.hpp"

namespace topo::daemon {

/// A scanner that was found and goes on streaming.
class LiveScanner {
 public:
  explicit LiveScanner(std::unique_ptr<hokuyo::Connection> connection)
      : connection_(std::move(connection)), latest_(std::make_unique<types::Scan>()) {
    latest_->beams = 0;
  }
  /// Takes the scans that wait, and waits for one for `timeout`.
  void step(types::Duration timeout);
  void begin_picture() { taker_.clear(); }
  [[nodiscard]] std::size_t scans() const { return taker_.scans(); }
  [[nodiscard]] calibration::StillPicture picture() const { return taker_.picture(); }
  [[nodiscard]] const types::Scan& latest() const { return *latest_; }
  void close();

 private:
  std::unique_ptr<hokuyo::Connection> connection_;
  std::unique_ptr<types::Scan> latest_;
  calibration::PictureTaker taker_;
};

struct SearchResult {
  Found found;
  std::vector<LiveScanner> scanners;  ///< in the order of found.scanners
};

/// Looks at all places at once, until each has told what it is or `limit` has passed. `stop` is asked now and
/// then, and ends it early when it says true.
[[nodiscard]] SearchResult search_devices(const SearchPlaces& places, types::Duration limit,
                                          const std::function<bool()>& stop);

}  // namespace topo::daemon
