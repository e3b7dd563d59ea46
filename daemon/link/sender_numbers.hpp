// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <map>

namespace topo::daemon {

/// Numbers of robots by the writers of the topic. A robot writes in the partition of its number
/// (robot_partition); with credentials, every reader's DDS Security holds it to the partition that its
/// permissions name, so that nobody speaks under another one's number. For one thread.
class SenderNumbers {
 public:
  explicit SenderNumbers(dds_entity_t reader) : reader_(reader) {}

  /// `writer`: dds_sample_info_t::publication_handle. 0: the writer is gone, or in no robot's partition.
  [[nodiscard]] std::uint16_t of(dds_instance_handle_t writer);

 private:
  dds_entity_t reader_;
  std::map<dds_instance_handle_t, std::uint16_t> numbers_;
};

}  // namespace topo::daemon
