// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A clock that is wrong, for one process: a library to be preloaded, under which the time of day is
// CLOCK_SHIFT_S seconds off. What measures (CLOCK_MONOTONIC), timers and the clock of the machine stay as
// they are.
#include <dlfcn.h>
#include <sys/time.h>

#include <cstdlib>
#include <ctime>

namespace {

time_t shift_s() {
  static const time_t shift = [] {
    const char* text = std::getenv("CLOCK_SHIFT_S");
    return text == nullptr ? 0 : static_cast<time_t>(std::atoll(text));
  }();
  return shift;
}

using GetTime = int (*)(clockid_t, timespec*);

int true_time(clockid_t clock, timespec* now) {
  static const auto next = reinterpret_cast<GetTime>(::dlsym(RTLD_NEXT, "clock_gettime"));
  return next(clock, now);
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int status = true_time(clock, now);
  if (status == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += shift_s();
  return status;
}

int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  timespec time{};
  if (clock_gettime(CLOCK_REALTIME, &time) != 0) return -1;
  *now = {time.tv_sec, static_cast<suseconds_t>(time.tv_nsec / 1000)};
  return 0;
}

time_t time(time_t* out) noexcept {
  timespec now{};
  if (clock_gettime(CLOCK_REALTIME_COARSE, &now) != 0) return -1;
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}
}
