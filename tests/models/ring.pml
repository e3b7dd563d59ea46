/* SPDX-FileCopyrightText: 2026 The Topometric authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * core/sync/ring.hpp and, with -DEVENTS, core/sync/event_ring.hpp on top of it: VALUES values through N slots. A value
 * that finds no room is rejected and counted. -DCOMMIT_FIRST hands a slot over before it is filled: found wrong.
 */
#ifndef N
#define N 2
#endif
#ifndef VALUES
#define VALUES 6
#endif

byte head, tail;           /* slots ever committed, ever given back */
byte rejected, skipped;    /* one writer each */
byte slot[N];

/* What the proof looks at, and the program has not. */
bool writing[N], reading[N];
byte taken;
bool ended;

proctype Producer() {
  byte value, tail_seen;
  for (value : 1 .. VALUES) {
    /* try_acquire */
    if
    :: head - tail_seen == N -> tail_seen = tail
    :: else
    fi;
    assert(head - tail_seen <= N);
    if
    :: head - tail_seen == N -> rejected++
    :: else ->
#ifdef COMMIT_FIRST
       head++;
       slot[(head - 1) % N] = value
#else
       atomic { assert(!reading[head % N]); writing[head % N] = true }
       slot[head % N] = value;
       writing[head % N] = false;
       head++
#endif
    fi
  }
  ended = true
}

byte head_seen, last;

/* front: `there` says whether there is a value. */
inline front() {
  if
  :: tail == head_seen -> head_seen = head
  :: else
  fi;
  there = tail != head_seen
}

inline take() {
  atomic { assert(!writing[tail % N]); reading[tail % N] = true }
  assert(slot[tail % N] > last && slot[tail % N] <= VALUES); /* in order, none twice, none torn */
  atomic { last = slot[tail % N]; taken++; reading[tail % N] = false }
  tail++ /* pop */
}

inline skip_to_newest() {
  head_seen = head;
  if
  :: head_seen - tail >= 2 -> atomic { skipped = skipped + (head_seen - tail - 1) } tail = head_seen - 1
  :: else
  fi
}

proctype Consumer() {
  bool there, all;
  byte burst;
  do
  :: all = ended; /* before it looks: what comes later is seen in the next round */
     burst = 0;
     front();
     do
#ifdef EVENTS
     :: there && burst < N -> take(); burst++; front() /* drain: N at most, whatever is posted meanwhile */
     :: !there || burst == N -> break
#else
     :: there -> take(); front()
     :: there && !all -> skip_to_newest(); front(); assert(there) /* the newest is left */
     :: !there -> break
#endif
     od;
     assert(burst <= N);
     if
     :: all && !there -> break
     :: else
     fi
  od;
  assert(head == tail);
  assert(head + rejected == VALUES);   /* what was refused is counted */
  assert(taken + skipped == head)      /* nothing accepted is lost, nothing doubled */
}

init {
  atomic { run Producer(); run Consumer() }
}
