/* SPDX-FileCopyrightText: 2026 The Topometric authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * core/sync/snapshot_cell.hpp: one writer, READERS readers of two hazard slots each, PUBLISHES values. Addresses are
 * used again as soon as they are free, as an allocator does. -DSCAN_PER_VALUE is the scan that reads the slots anew
 * for each retired value: its list of retired values overflows.
 */
#ifndef READERS
#define READERS 1
#endif
#ifndef PUBLISHES
#define PUBLISHES 5
#endif
#define SLOTS (2 * READERS)
#define CAPACITY (SLOTS + 1)
#define ADDRESSES (CAPACITY + 2) /* the current one, and one that is being made */
#define NOTHING 0                /* the null pointer; addresses are 1..ADDRESSES */

byte current = NOTHING;
byte hazard[SLOTS];
byte retired[CAPACITY];
byte retired_count;

/* What the proof looks at, and the program has not. */
bool alive[ADDRESSES + 1];
byte number[ADDRESSES + 1]; /* which publish made the value */
byte pinned[SLOTS];         /* what a pin that was handed out refers to */
byte published;             /* values made */
byte exchanges;             /* times that the current one changed */
byte readers_left = READERS;
hidden byte each; /* a loop's */

inline destroy(address) {
  assert(alive[address]);
  for (each : 0 .. SLOTS - 1) {
    assert(pinned[each] != address); /* no use after free */
  }
  each = 0;
  alive[address] = false;
  number[address] = 0;
}

inline make(address) {
  address = 1;
  do
  :: alive[address] -> address++; assert(address <= ADDRESSES)
  :: else -> break
  od;
  alive[address] = true;
  published++;
  number[address] = published;
}

inline retire(address) {
  assert(retired_count < CAPACITY); /* the check that all builds make */
  retired[retired_count] = address;
  retired_count++;
}

#ifdef SCAN_PER_VALUE
inline reclaim() {
  kept = 0;
  i = 0;
  do
  :: i < retired_count ->
     found = false;
     s = 0;
     do
     :: s < SLOTS && !found ->
        if /* a step of its own: the slot may change before the next value is compared */
        :: hazard[s] == retired[i] -> found = true
        :: else
        fi;
        s++
     :: else -> break
     od;
     skip;
     d_step {
       if
       :: found -> retired[kept] = retired[i]; kept++
       :: else -> destroy(retired[i])
       fi;
       i++
     }
  :: else -> break
  od;
  skip;
  d_step { retired_count = kept; i = 0; s = 0; found = false; kept = 0 }
}
#else
inline reclaim() {
  s = 0;
  do /* each slot is read once, a step each */
  :: s < SLOTS -> atomic { shown[s] = hazard[s]; s++ }
  :: else -> break
  od;
  skip;
  d_step {
    kept = 0;
    for (i : 0 .. retired_count - 1) {
      found = false;
      for (s : 0 .. SLOTS - 1) {
        if
        :: shown[s] == retired[i] -> found = true
        :: else
        fi
      }
      if
      :: found -> retired[kept] = retired[i]; kept++
      :: else -> destroy(retired[i])
      fi
    }
    retired_count = kept;
    for (s : 0 .. SLOTS - 1) { shown[s] = NOTHING }
    i = 0; s = 0; found = false; kept = 0
  }
}
#endif

proctype Writer() {
  byte fresh, i, s, kept;
  bool found;
#ifndef SCAN_PER_VALUE
  byte shown[SLOTS];
#endif
  do
  :: published < PUBLISHES ->
     d_step { make(fresh) }
     d_step { /* exchange */
       i = current;
       current = fresh;
       exchanges++;
       fresh = i;
       i = 0
     }
     if
     :: fresh != NOTHING -> d_step { retire(fresh); fresh = 0 }
     :: else
     fi;
     reclaim();
     assert(retired_count <= SLOTS)
  :: else -> break
  od;
  /* When all readers are gone nothing but the current value stays. */
  readers_left == 0;
  reclaim();
  assert(retired_count == 0);
  d_step {
    s = 0;
    for (i : 1 .. ADDRESSES) {
      if
      :: alive[i] -> s++
      :: else
      fi
    }
    assert(s == 1)
  }
}

/* Takes the newest value while it holds the one before, then drops the old one; a few times, or not at all. */
proctype Reader(byte index) {
  byte seen, again, held_slot, slot, tries, at_start, newest;
  bool holds;
  do
  :: true ->
     slot = 2 * index;
     if
     :: hazard[slot] != NOTHING -> slot++
     :: else
     fi;
     assert(hazard[slot] == NOTHING);
     atomic { seen = current; tries = 0; at_start = exchanges }
     do
     :: true ->
        hazard[slot] = seen;
        d_step {
          again = current;
          tries++;
          assert(tries <= 1 + exchanges - at_start); /* lock-free: again only when a publish came between */
          if
          :: again == seen -> pinned[slot] = seen
          :: else -> skip
          fi
        }
        if
        :: again == seen -> break
        :: else -> seen = again
        fi
     od;
     skip; /* spin: no loop may end where a d_step begins */
     d_step {
       tries = 0; at_start = 0; again = 0;
       assert(seen == NOTHING || (alive[seen] && number[seen] >= newest)); /* never back to an older one */
       if
       :: seen != NOTHING -> newest = number[seen]
       :: else
       fi
     }
     if
     :: seen != NOTHING && holds -> /* the old one goes */
        atomic { pinned[held_slot] = NOTHING; hazard[held_slot] = NOTHING; held_slot = slot }
     :: seen != NOTHING && !holds -> atomic { held_slot = slot; holds = true }
     :: else
     fi;
     atomic { seen = 0; slot = 0 }
     if
     :: holds -> atomic { pinned[held_slot] = NOTHING; hazard[held_slot] = NOTHING; holds = false; held_slot = 0 }
     :: true
     fi
  :: !holds -> break
  od;
  readers_left--
}

init {
  atomic {
    byte r;
    run Writer();
    for (r : 0 .. READERS - 1) { run Reader(r) }
  }
}
