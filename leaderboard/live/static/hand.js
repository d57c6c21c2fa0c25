"use strict";
// The hand: samples of its height, with the time of each, from the start of a lift to its end.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const LOWEST = -0.08; // m; the arms reach no further
  const HIGHEST = 0.38;
  const GAP_MS = 6; // between two messages: the server takes 200 a second
  const STILL_MS = 10;

  class Hand {
    // send(first, samples) takes [[time, height], ...]; soon(do, ms) is setTimeout.
    constructor(send, soon = (what, ms) => setTimeout(what, ms)) {
      this.send = send;
      this.soon = soon;
      this.open();
    }

    open() {
      this.closed = false;
      this.started = false;
      this.raw = 0;
      this.height = 0;
    }

    // rests: whether it is silent while it rests, as pointers are; see still().
    close(rests) {
      this.open();
      this.closed = true;
      this.rests = rests;
    }

    // The lift begins: heights count from here, wherever the hand has been while it waited.
    start(now) {
      this.started = true;
      this.zero = this.raw;
      this.times = [];
      this.waiting = [];
      this.sent = -Infinity;
      this.due = false;
      this.moves = 0;
      this.sample(now, now);
    }

    // Where the hand was at a time of the page's clock, in m above the grip.
    place(time, height, now) {
      if (!this.closed) return;
      this.raw = height;
      if (!this.started) return;
      this.moves += 1;
      this.sample(time, now);
    }

    // A pointer that rests has no events. `age` is how late its events can be.
    still(now, age) {
      if (!this.started || !this.rests) return;
      if (now - age - this.times[this.times.length - 1] >= STILL_MS) this.sample(now - age, now);
    }

    sample(time, now) {
      this.height = Hand.within(this.raw - this.zero);
      // After a sample of stillness, an event may come that is a little older.
      const last = this.times.length ? this.times[this.times.length - 1] + 0.01 : -Infinity;
      this.times.push(Math.max(time, last));
      this.waiting.push([this.times[this.times.length - 1], this.height]);
      if (now - this.sent >= GAP_MS) this.flush(now);
      else if (!this.due) {
        this.due = true;
        this.soon(() => this.flush(performance.now()), GAP_MS - (now - this.sent));
      }
    }

    flush(now) {
      this.due = false;
      if (!this.started || !this.waiting.length) return;
      this.sent = now;
      while (this.waiting.length) {
        const samples = this.waiting.splice(0, play.MOST_SAMPLES);
        this.send(this.times.length - this.waiting.length - samples.length, samples);
      }
    }

    // Height that the arms can reach [m].
    static within(height) {
      return Math.min(Math.max(height, LOWEST), HIGHEST);
    }

    // Events a second over the whole lift; null if there were too few.
    get rate() {
      if (!this.times || this.moves < 20) return null;
      return Math.round((1000 * this.moves) / (this.times[this.times.length - 1] - this.times[0]));
    }
  }

  play.Hand = Hand;
})();
