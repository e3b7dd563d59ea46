// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
namespace topo::canary {

class __attribute__((capability("mutex"))) Lock {
 public:
  void lock() __attribute__((acquire_capability()));
  void unlock() __attribute__((release_capability()));
};

class Counter {
 public:
  int count_without_lock() { return ++count_; }

 private:
  Lock lock_;
  int count_ __attribute__((guarded_by(lock_))) = 0;
};

int use(Counter& counter);
int use(Counter& counter) { return counter.count_without_lock(); }

}  // namespace topo::canary
