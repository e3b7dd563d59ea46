// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/order_desk.hpp"

#include <utility>

namespace topo::daemon {
namespace {

tl::unexpected<types::Error> too_many() {
  return types::fail(types::Errc::kBusy, "too many orders wait for an answer of the daemon");
}

}  // namespace

void OrderDesk::give(const Act& act, Done done) {
  if (act.kind != Act::Kind::kEstop) return give_order(act, std::move(done));
  estop_wanted_ = true;
  if (waiting_.size() < kWaitingMax) {
    waiting_.push_back(std::move(done));
  } else {
    done(too_many());
  }
  if (!estop_under_way_) say_estop(act);
}

void OrderDesk::say_estop(const Act& act) {
  estop_under_way_ = true;
  estop_wanted_ = false;
  said_ = std::exchange(waiting_, {});
  call_(act.method, act.params, [this, act](const types::Result<Json>& answer) {
    estop_under_way_ = false;
    for (const Done& done : std::exchange(said_, {})) done(answer);
    if (estop_wanted_ && !estop_under_way_) say_estop(act);
  });
}

void OrderDesk::give_order(const Act& act, Done done) {
  if (orders_ >= kWaitingMax) return done(too_many());
  ++orders_;
  call_(act.method, act.params, [this, done = std::move(done)](const types::Result<Json>& answer) {
    --orders_;
    done(answer);
  });
}

}  // namespace topo::daemon
