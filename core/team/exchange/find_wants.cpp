// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>

#include "core/team/exchange/wants.hpp"

namespace topo::team {
namespace {

/// Neighbouring numbers are had from one source: their runs are short to write.
constexpr std::uint32_t kShareRun = 16;

/// What is wanted of one stream.
class StreamSearch {
 public:
  StreamSearch(const StreamKey& key, const ItemStore& store, const Assemblies& assemblies)
      : key_(key), held_(store.stream(key)), assemblies_(assemblies) {}

  void add_source(const slam::Origin& peer, const StreamSummary& summary) {
    holders_.emplace_back(peer, &summary);
    end_ = std::max(end_, std::min(summary.end, summary.first_gap + 1 + kSummaryBits));
  }

  /// The oldest that are lacking, then the newest; ascending by source.
  void find(std::size_t oldest, std::size_t newest, std::map<slam::Origin, std::vector<StreamWants>>& wants) {
    std::uint32_t number = held_ != nullptr ? held_->first_gap() : 0;
    std::size_t found = 0;
    for (; number < end_ && found < oldest; ++number) found += add(number, false) ? 1U : 0U;
    const std::uint32_t covered = number;
    std::vector<std::uint32_t> last;
    for (std::uint32_t i = end_; i > covered && last.size() < newest; --i) {
      if (lacks(i - 1) && source_of(i - 1) != nullptr) last.push_back(i - 1);
    }
    for (auto at = last.rbegin(); at != last.rend(); ++at) add(*at, true);
    for (auto& [peer, mine] : found_) {
      mine.key = key_;
      mine.covered = found_.size() == 1 ? covered : 0;
      wants[peer].push_back(std::move(mine));
    }
  }

 private:
  [[nodiscard]] bool lacks(std::uint32_t number) const {
    return held_ == nullptr || !held_->contains(number);
  }

  [[nodiscard]] const slam::Origin* source_of(std::uint32_t number) const {
    const slam::Origin* chosen = nullptr;
    std::uint64_t least = 0;
    for (const auto& [peer, summary] : holders_) {
      if (!summary->holds(number)) continue;
      if (peer == key_.origin) return &peer;
      const std::uint64_t draw = (std::uint64_t{number / kShareRun} * 0x9E3779B97F4A7C15ULL) ^
                                 (std::uint64_t{peer.robot} * 0xC2B2AE3D27D4EB4FULL);
      if (chosen == nullptr || draw < least) {
        chosen = &peer;
        least = draw;
      }
    }
    return chosen;
  }

  /// False when the number is held, or no mate has it.
  bool add(std::uint32_t number, bool known_lacking) {
    if (!known_lacking && !lacks(number)) return false;
    const slam::Origin* source = source_of(number);
    if (source == nullptr) return false;
    std::vector<WantRun>& runs = found_[*source].runs;
    const PieceBits pieces = assemblies_.lacking({key_, number});
    const bool joins = !runs.empty() && pieces == kAllPieces && runs.back().pieces == kAllPieces &&
                       runs.back().first + runs.back().count == number;
    if (joins)
      ++runs.back().count;
    else
      runs.push_back({number, 1, pieces});
    return true;
  }

  StreamKey key_;
  const ItemStream* held_;
  const Assemblies& assemblies_;
  std::vector<std::pair<slam::Origin, const StreamSummary*>> holders_;
  std::uint32_t end_ = 0;
  std::map<slam::Origin, StreamWants> found_;
};

}  // namespace

std::map<slam::Origin, std::vector<StreamWants>> find_wants(const slam::Origin& self, const ItemStore& store,
                                                            const Assemblies& assemblies,
                                                            std::span<const Source> sources,
                                                            const CapParams& caps) {
  std::map<slam::Origin, std::vector<StreamWants>> wants;
  std::set<StreamKey> keys;
  for (const Source& source : sources) {
    for (const auto& [key, summary] : *source.holds) {
      if (key.origin != self) keys.insert(key);
    }
  }
  for (const StreamKey& key : keys) {
    StreamSearch search(key, store, assemblies);
    for (const Source& source : sources) {
      if (const auto at = source.holds->find(key); at != source.holds->end())
        search.add_source(source.peer, at->second);
    }
    const bool large = key.kind == ItemKind::kKeyframe;
    search.find(large ? caps.oldest_wanted : caps.small_wanted, large ? caps.newest_wanted : 0, wants);
  }
  return wants;
}

}  // namespace topo::team
