// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/sender_numbers.hpp"

#include "daemon/link/radio_filter.hpp"

namespace topo::daemon {
namespace {

/// Writers that are kept: all robots of a team, with some that began anew.
constexpr std::size_t kWritersMax = 4U * kRobotMax;

std::uint16_t number_in(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(qos, &count, &names)) return 0;
  const std::uint16_t number = count == 1 ? robot_of_partition(names[0]) : std::uint16_t{0};
  for (std::uint32_t i = 0; i < count; ++i) dds_free(names[i]);
  dds_free(names);
  return number;
}

}  // namespace

std::uint16_t SenderNumbers::of(dds_instance_handle_t writer) {
  if (const auto known = numbers_.find(writer); known != numbers_.end()) return known->second;
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader_, writer);
  if (endpoint == nullptr) return 0;
  const std::uint16_t number = number_in(endpoint->qos);
  dds_builtintopic_free_endpoint(endpoint);
  if (numbers_.size() >= kWritersMax) numbers_.clear();  // they are asked for again
  numbers_.emplace(writer, number);
  return number;
}

}  // namespace topo::daemon
