// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/device_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "daemon/setup/search_notes.hpp"
#include "daemon/setup/shared_address.hpp"
#include "drivers/io/neighbours.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using types::Duration;
using types::Stamp;

constexpr Duration kTurn = std::chrono::milliseconds(5);  ///< of one device
constexpr Duration kArpPatience = std::chrono::milliseconds(500);
constexpr Duration kCloseLimit = std::chrono::milliseconds(300);
constexpr int kScansAtOnce = 20;

/// "192.168.0.10" of "tcp:192.168.0.10:10940".
std::string host_of(std::string_view address) {
  constexpr std::string_view kTcp = "tcp:";
  if (!address.starts_with(kTcp)) return {};
  address.remove_prefix(kTcp.size());
  return std::string(address.substr(0, address.rfind(':')));
}

/// Hosts of Ethernet devices, each once.
std::set<std::string> hosts_of(const std::vector<SearchPlace>& places) {
  std::set<std::string> out;
  for (const SearchPlace& place : places)
    if (std::string host = host_of(place.address); !host.empty() && !host.starts_with("127."))
      out.insert(std::move(host));
  return out;
}

/// Who answers for these hosts, as far as it may be asked.
std::vector<io::Neighbour> ask_all(const std::set<std::string>& hosts) {
  std::vector<io::Neighbour> out;
  for (const std::string& host : hosts)
    if (const auto asked = io::ask_neighbours(host, kArpPatience))
      out.insert(out.end(), asked->begin(), asked->end());
  return out;
}

/// Two devices at one address, by who answered and by what the kernel has heard since.
void note_shared_addresses(const std::set<std::string>& hosts, std::vector<io::Neighbour> answered,
                           Found& found) {
  const std::vector<io::Neighbour> known = io::known_neighbours();
  answered.insert(answered.end(), known.begin(), known.end());
  for (const std::string& host : hosts)
    if (std::string note = shared_address(host, answered); !note.empty())
      found.notes.push_back(std::move(note));
}

void note_the_rest(const std::vector<DeviceProbe>& probes, Found& found) {
  std::vector<Fruitless> fruitless;
  for (const DeviceProbe& probe : probes) {
    if (probe.scanner() || probe.base()) continue;
    fruitless.push_back({probe.address(), !probe.done(), probe.is_notable() ? probe.said() : std::string()});
  }
  std::vector<std::string> notes = notes_of(fruitless);
  found.notes.insert(found.notes.end(), notes.begin(), notes.end());
}

void note_watchdogs(Found& found) {
  for (const FoundBase& base : found.bases)
    if (base.watchdog_ms == 0)
      found.notes.push_back(fmt::format(
          "{}: the firmware tells no watchdog: it is not driven before base.watchdog_ms says which",
          base.address));
}

}  // namespace

void LiveScanner::step(Duration timeout) {
  for (int i = 0; i < kScansAtOnce; ++i) {
    const auto outcome = connection_->step(*latest_, i == 0 ? timeout : Duration::zero());
    if (outcome == hokuyo::StepOutcome::kNothing) return;
    if (outcome == hokuyo::StepOutcome::kScan) taker_.add(*latest_);
  }
}

void LiveScanner::close() { connection_->close(kCloseLimit); }

SearchResult search_devices(const SearchPlaces& places, Duration limit, const std::function<bool()>& stop) {
  const std::vector<SearchPlace> addresses = addresses_of(places);
  const std::set<std::string> hosts = hosts_of(addresses);
  const std::vector<io::Neighbour> answered = ask_all(hosts);  // before anything streams
  std::vector<DeviceProbe> probes;
  probes.reserve(addresses.size());
  for (const SearchPlace& place : addresses) probes.emplace_back(place);
  const auto scratch = std::make_unique<types::Scan>();
  const Stamp end = io::monotonic_now() + limit;
  SearchResult out;
  const auto pending = [](const DeviceProbe& probe) { return !probe.done(); };
  while (io::monotonic_now() < end && !stop() && std::any_of(probes.begin(), probes.end(), pending)) {
    for (DeviceProbe& probe : probes) {
      if (probe.done()) continue;
      probe.step(*scratch, kTurn);
      if (!probe.scanner()) continue;
      out.found.scanners.push_back(*probe.scanner());
      out.scanners.emplace_back(probe.take_connection());
    }
    for (LiveScanner& scanner : out.scanners) {
      scanner.step(Duration::zero());
      scanner.begin_picture();
    }
  }
  for (const DeviceProbe& probe : probes)
    if (probe.base()) out.found.bases.push_back(*probe.base());
  note_the_rest(probes, out.found);
  note_shared_addresses(hosts, answered, out.found);
  note_watchdogs(out.found);
  return out;
}

}  // namespace topo::daemon
