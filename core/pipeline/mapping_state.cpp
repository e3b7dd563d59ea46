// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "core/pipeline/mapping_memory.hpp"

namespace topo::pipeline {

MappingState::MappingState(const slam::MapperParams& params, const slam::Origin& origin,
                           const types::Se2& start, const MappingStepParams& step)
    : impl_(std::make_unique<Impl>(params, origin, start, step)) {}
MappingState::MappingState(const slam::MapperParams& params, const slam::Session& session,
                           const slam::Arrival& arrival, const slam::Origin& origin,
                           const MappingStepParams& step)
    : MappingState(params, origin, {}, step) {
  impl_->mapper.resume(session, arrival);
  impl_->trial.emplace(session, arrival, params);
  impl_->cloud = arrival.cloud;
  impl_->placed = arrival.cloud.stamp;
  impl_->drawing.update(impl_->mapper);
}
MappingState::~MappingState() = default;

void MappingState::follow(std::uint64_t revision) { impl_->revision = revision + 1; }

void MappingState::adopt() { impl_->drawing.adopt(); }

void MappingState::offer(slam::LoopAnswer answer) {
  const slam::Keyframe& asked = *impl_->mapper.keyframes()[answer.node];
  MappingNews& news = impl_->news;
  news.has_mates_answer = news.has_mates_answer || asked.id.robot != impl_->mapper.origin().robot;
  news.answers.push_back(std::move(answer));
}

void MappingState::offer(const slam::Alignment& alignment) {
  if (!alignment.found()) return;
  std::vector<std::pair<slam::RelationKey, slam::Relation>>& known = impl_->news.known;
  known.insert(known.end(), alignment.closures.begin(), alignment.closures.end());
}

void MappingState::offer(slam::GraphSolution solution) {
  slam::Mapper& mapper = impl_->mapper;
  if (!mapper.is_solving()) return;
  if (!solution.report.solved) return mapper.give_up_solving();
  impl_->drawing.correct(mapper, std::move(solution));
}

void MappingState::join(std::span<const slam::KeyframePtr> keyframes,
                        std::span<const slam::FoundRelation> relations) {
  MappingNews& news = impl_->news;
  news.mates_keyframes.insert(news.mates_keyframes.end(), keyframes.begin(), keyframes.end());
  news.mates_relations.insert(news.mates_relations.end(), relations.begin(), relations.end());
}

void MappingState::relate(const slam::RelationKey& key, const slam::Relation& relation) {
  impl_->news.known.emplace_back(key, relation);
}

MappingOutput MappingState::finish() {
  MappingOutput output;
  Impl& state = *impl_;
  state.run(output, true, true);
  for (const slam::LoopAnswer& answer : std::exchange(state.news.answers, {}))
    output.loop_verdicts.push_back(state.mapper.apply(answer));
  if (state.mapper.keyframes().empty()) return output;
  if (state.has_news()) state.join_news(output);
  state.drawing.drop_correction();
  (void)state.mapper.optimise();
  state.drawing.update(state.mapper);
  ++state.revision;
  output.keyframe_added = true;
  return output;
}

std::optional<slam::AlignmentQuery> MappingState::take_idle_query() {
  return impl_->mapper.take_idle_query();
}

std::unique_ptr<MapSnapshot> MappingState::make_snapshot() {
  return impl_->drawing.make_snapshot(impl_->mapper, impl_->revision, impl_->placed);
}

const slam::Mapper& MappingState::mapper() const { return impl_->mapper; }
std::uint64_t MappingState::revision() const { return impl_->revision; }
const slam::Cloud& MappingState::cloud() const { return impl_->cloud; }
slam::TrialCount MappingState::trial() const {
  return impl_->trial ? impl_->trial->count() : slam::TrialCount{};
}
const MappingLosses& MappingState::losses() const { return impl_->pairing.losses(); }

}  // namespace topo::pipeline
