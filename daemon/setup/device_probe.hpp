// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "daemon/setup/device_places.hpp"
#include "daemon/setup/found.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/pioneer/connection.hpp"

namespace topo::daemon {

/// Finds out what answers at one address, with the daemon's own drivers: first as a scanner, because a base
/// takes no harm from its words and a URG-04LX may from a base's; then as a base, whose first bytes stop it.
/// A base is left as soon as it has told what it is; a scanner goes on streaming.
class DeviceProbe {
 public:
  explicit DeviceProbe(SearchPlace place);

  /// Goes on for about `timeout`.
  void step(types::Scan& scratch, types::Duration timeout);
  [[nodiscard]] bool done() const { return phase_ == Phase::kDone; }

  [[nodiscard]] const std::string& address() const { return place_.address; }
  [[nodiscard]] const std::optional<FoundScanner>& scanner() const { return scanner_; }
  [[nodiscard]] const std::optional<FoundBase>& base() const { return base_; }
  /// The connection to what scanner() tells of, once.
  [[nodiscard]] std::unique_ptr<hokuyo::Connection> take_connection() { return std::move(as_scanner_); }
  /// True when something answered there, or could not be asked: said() is worth telling.
  [[nodiscard]] bool is_notable() const { return notable_; }
  /// What the drivers said last.
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  enum class Phase { kScanner, kBase, kNamelessBase, kDone };
  void begin_scanner();
  void begin_base(Phase phase, const char* family);
  void step_scanner(types::Scan& scratch, types::Duration timeout);
  void step_base(types::Duration timeout);
  void found_base();
  void end(std::string said, bool notable);

  SearchPlace place_;
  Phase phase_ = Phase::kScanner;
  std::unique_ptr<hokuyo::Connection> as_scanner_;
  std::unique_ptr<pioneer::Connection> as_base_;
  std::optional<FoundScanner> scanner_;
  std::optional<FoundBase> base_;
  std::string said_;
  bool notable_ = false;
};

}  // namespace topo::daemon
