// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/mapping_step.hpp"

#include <utility>

#include "core/pipeline/mapping_memory.hpp"

namespace topo::pipeline {

void MappingState::Impl::run(MappingOutput& output, bool flush, bool looks_back) {
  // Heights first: a keyframe takes the columns collected until then.
  while (const auto paired = pairing.next_coronal(flush))
    columns.add(paired->scan, paired->first, paired->last);
  while (const auto paired = pairing.next_front(flush)) place(*paired, looks_back, output);
}

void MappingState::Impl::place(const PairedScan& paired, bool looks_back, MappingOutput& output) {
  const slam::SweepMotion motion{paired.last.inverse() * paired.first, {}};
  slam::make_cloud(paired.scan, params.T_base_laser, motion, params.cloud, cloud);
  cloud.stamp = end_of(paired.scan);
  placed = cloud.stamp;
  output.matches.push_back(mapper.add(cloud, paired.last, columns));
  const slam::MatchReport& match = output.matches.back();
  if (trial) trial->add(cloud, match.T_map_base, match.T_odom_base, match.matched);
  drawing.redraw(mapper, placed);
  // A standing robot makes no keyframes, but its map grows with the data of team-mates and is corrected.
  if (output.matches.back().keyframe || (has_news() && placed - drawn >= step.news_wait))
    pass_boundary(output);
  else if (looks_back && placed - looked >= step.idle_after)
    look_back(output);
}

/// Nothing is asked while a correction is on its way: a search needs settled poses.
void MappingState::Impl::look_back(MappingOutput& output) {
  looked = placed;
  if (!mapper.is_solving() && !output.alignment_query) output.alignment_query = mapper.take_idle_query();
}

void MappingState::Impl::join_news(MappingOutput& output) {
  for (const auto& [key, relation] : news.known) output.joined += mapper.relate(key, relation);
  output.joined += mapper.join(news.mates_keyframes, news.mates_relations);
  news = {};
}

void MappingState::Impl::pass_boundary(MappingOutput& output) {
  if (auto query = mapper.take_query()) output.loop_queries.push_back(std::move(*query));
  for (const slam::LoopAnswer& answer : std::exchange(news.answers, {}))
    output.loop_verdicts.push_back(mapper.apply(answer));
  news.has_mates_answer = false;
  if (has_news()) join_news(output);
  if (auto query = mapper.take_second_query()) output.loop_queries.push_back(std::move(*query));
  for (slam::LoopQuery& query : mapper.take_mate_queries(step.mate_queries_max))
    output.loop_queries.push_back(std::move(query));
  if (auto query = mapper.take_alignment_query()) output.alignment_query = std::move(query);
  drawn = looked = placed;
  output.corrected = drawing.draw(mapper, placed) || output.corrected;
  if (auto query = mapper.take_graph_query()) output.graph_query = std::move(query);
  ++revision;
  output.keyframe_added = true;
}

MappingOutput mapping_step(MappingState& state, const MappingInput& input) {
  MappingOutput output;
  ScanPairing& pairing = state.impl_->pairing;
  pairing.add(input.odometry);
  if (input.coronal != nullptr) pairing.add_coronal(*input.coronal);
  if (input.front != nullptr) pairing.add_front(*input.front);
  state.impl_->run(output, false, !input.is_searching);
  return output;
}

}  // namespace topo::pipeline
