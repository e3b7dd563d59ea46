// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/device_connectors.hpp"

#include "drivers/io/make_connector.hpp"
#include "drivers/io/tap.hpp"

namespace topo::daemon {

ConnectorFactory device_connectors(Recorder* recorder) {
  return [recorder](const std::string& channel,
                    const std::string& address) -> types::Result<std::unique_ptr<io::Connector>> {
    auto connector = io::make_connector(address);
    if (!connector || recorder == nullptr) return connector;
    io::ByteTap* tap = recorder->tap(channel);
    if (tap == nullptr) return connector;
    return std::make_unique<io::TappedConnector>(std::move(*connector), tap);
  };
}

ConnectorFactory replay_connectors(std::shared_ptr<Replay> replay) {
  return [replay = std::move(replay)](const std::string& channel, const std::string& address) {
    return Replay::connector(replay, channel, !address.starts_with("tcp:"));
  };
}

}  // namespace topo::daemon
