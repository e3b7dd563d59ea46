/* SPDX-FileCopyrightText: 2026 The Topometric authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * core/sync/estop_line.hpp and motion::update_latch: operators press and clear in any order, one thread serves them;
 * the base reads once a period and latches. -DBUTTON_FIRST reads the button before the count of clears, and
 * -DCOUNT_FIRST counts a clear before it releases the button: both found wrong.
 */
#ifndef ACTS
#define ACTS 5
#endif

bool pressed;
byte clears;

/* What the proof looks at, and the program has not. */
byte presses_ended, clears_begun, clears_ended; /* acts of operators, for good */
bool last_is_press;                             /* the newest act that has ended */
bool busy, ended;
bool latched;

proctype Operators() {
  byte act;
  for (act : 1 .. ACTS) {
    if
    :: true ->
       d_step { pressed = true; presses_ended++; last_is_press = true }
    :: true ->
       d_step { clears_begun++; busy = true }
#ifdef COUNT_FIRST
       clears++;
       pressed = false;
#else
       pressed = false;
       clears++;
#endif
       d_step { clears_ended++; busy = false; last_is_press = false }
    fi
  }
  ended = true
}

proctype Base() {
  byte seen, now_seen, presses_before, begun_before;
  bool cleared, reads_pressed, was_press, quiet, all;
  do
  :: d_step {
       all = ended;
       presses_before = presses_ended;
       begun_before = clears_begun;
       was_press = last_is_press;
       quiet = !busy
     }
#ifdef BUTTON_FIRST
     reads_pressed = pressed;
     now_seen = clears;
#else
     now_seen = clears;
     reads_pressed = pressed;
#endif
     d_step {
       cleared = now_seen != seen;
       seen = now_seen;
       if
       :: cleared -> latched = false
       :: else
       fi;
       if
       :: reads_pressed -> latched = true
       :: else
       fi;
       /* Pressed before this period and no clear begun since: the robot is stopped. */
       assert(!(quiet && was_press && clears_begun == begun_before) || latched);
       /* Cleared before this period and not pressed since: it is not. */
       assert(!(quiet && !was_press && presses_ended == presses_before && clears_begun == begun_before) || !latched);
       cleared = false; reads_pressed = false; now_seen = 0
     }
     if
     :: all -> break
     :: else
     fi
  od;
  /* Whatever came between, the newest act holds. */
  assert(latched == last_is_press)
}

init {
  atomic { run Operators(); run Base() }
}
