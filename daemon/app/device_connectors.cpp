// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/device_connectors.hpp"

#include "drivers/io/make_connector.hpp"
#include "drivers/io/tap.hpp"
#include "drivers/pioneer/base_connector.hpp"

namespace topo::daemon {

ConnectorFactory device_connectors(Recorder* recorder) {
  return [recorder](const std::string& channel,
                    const std::string& address) -> types::Result<std::unique_ptr<io::Connector>> {
    auto connector = channel == "base" ? pioneer::make_base_connector(address) : io::make_connector(address);
    if (!connector || recorder == nullptr) return connector;
    io::ByteTap* tap = recorder->tap(channel);
    if (tap == nullptr) return connector;
    return std::make_unique<io::TappedConnector>(std::move(*connector), tap);
  };
}

ConnectorFactory replay_connectors(std::shared_ptr<Replay> replay) {
  return [replay = std::move(replay)](const std::string& channel, const std::string& address) {
    const bool has_speed = !address.starts_with("tcp:") && !address.starts_with("can:");
    return Replay::connector(replay, channel, has_speed);
  };
}

}  // namespace topo::daemon
