/* SPDX-FileCopyrightText: 2026 The Topometric authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * core/sync/latest.hpp: three slots, one of which belongs to neither side. A value is written in two halves.
 * -DNO_FRESH leaves the mark away by which the reader tells a new value from its own old one: found wrong.
 */
#ifndef VALUES
#define VALUES 5
#endif
#define FRESH 4
#define SLOT(word) ((word) & 3)

byte half_a[3], half_b[3];
byte middle = 2;
byte overwritten;

/* What the proof looks at, and the program has not. */
byte writer_slot = 0, reader_slot = 1;
byte taken;
bool ended;

proctype Writer() {
  byte value, before;
  for (value : 1 .. VALUES) {
    half_a[writer_slot] = value;
    half_b[writer_slot] = value;
    d_step { /* exchange */
      before = middle;
      middle = writer_slot | FRESH;
      writer_slot = SLOT(before);
      assert(writer_slot != SLOT(middle) && writer_slot != reader_slot && writer_slot < 3)
    }
    if
    :: before & FRESH -> overwritten++
    :: else
    fi
  }
  ended = true
}

proctype Reader() {
  byte newest, last;
  bool all;
  do
  :: all = ended;
     if
#ifdef NO_FRESH
     :: true ->
#else
     :: middle & FRESH -> /* a load of its own: the exchange may already take a newer one */
#endif
        d_step {
          newest = middle;
          middle = reader_slot;
          reader_slot = SLOT(newest);
          assert(reader_slot != SLOT(middle) && reader_slot != writer_slot && reader_slot < 3)
        }
        taken++;
        assert(half_a[reader_slot] > last); /* newer than the one before: none twice, none out of order */
        last = half_a[reader_slot];
        assert(half_b[reader_slot] == last) /* whole */
#ifndef NO_FRESH
     :: else
#endif
     fi;
     if
     :: all -> break
     :: else
     fi
  od;
  assert(last == VALUES);                  /* the last one arrives */
  assert(taken + overwritten == VALUES)    /* and what did not is counted */
}

init {
  atomic { run Writer(); run Reader() }
}
