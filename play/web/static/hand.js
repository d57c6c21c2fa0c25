"use strict";
// The hand: samples of its height, with the time of each, from the start of a lift to its end.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const LOWEST = -0.08; // m; the arms reach no further
  const HIGHEST = 0.38;
  const GAP_MS = 3; // between two messages: the server takes 400 a second
  const STILL_MS = 10; // between two samples of a hand that rests
  const SILENT_MS = 40; // without an event, a pointer rests: those that move have 25 a second
  const BEFORE_MS = 16;
  // How old the events of a pointer are when the page gets them: a browser keeps those of a finger,
  // and some those of a mouse, for the next picture. Before anything was measured:
  const RAW = "onpointerrawupdate" in window;
  const FIRST_AGES_MS = { mouse: RAW ? 6 : 25, touch: 50, pen: 50 };
  const YOUNGEST_MS = 4;
  const OLDEST_MS = 80;
  const SPARE_MS = 2;
  const LEAST_EVENTS = 50;

  class Hand {
    // send(first, samples) takes [[time, height], ...]; soon(do, ms) is setTimeout.
    constructor(send, soon = (what, ms) => setTimeout(what, ms)) {
      this.send = send;
      this.soon = soon;
      this.ages = { ...FIRST_AGES_MS };
      this.open();
    }

    open() {
      if (this.started) this.learn();
      this.closed = false;
      this.started = false;
      this.raw = 0;
      this.height = 0;
    }

    // preset: the kind of the input. Pointers are silent while they rest; keys and gamepads are not.
    close(preset) {
      this.open();
      this.closed = true;
      this.preset = preset;
      this.silent = preset in this.ages;
    }

    // The lift begins: heights count from here, wherever the hand has been while it waited.
    start(now) {
      this.started = true;
      this.zero = this.raw;
      this.times = [];
      this.waiting = [];
      this.sent = -Infinity;
      this.due = false;
      this.resting = false;
      this.seen = [];
      this.sample(now, now);
    }

    // Where the hand was at a time of the page's clock, in m above the grip.
    place(time, height, now) {
      if (!this.closed) return;
      if (this.started) {
        this.seen.push(now - time);
        // There were no events of the pointer, so it lay still until this movement.
        if (this.resting && time - this.last > BEFORE_MS) this.sample(time - BEFORE_MS, now);
        this.resting = false;
      }
      this.raw = height;
      if (this.started) this.sample(time, now);
    }

    // A pointer at rest has no events: report the rest as soon as no earlier event can still come.
    still(now) {
      if (!this.started || !this.silent) return;
      const time = now - this.ages[this.preset];
      if (time - this.last < (this.resting ? STILL_MS : SILENT_MS)) return;
      this.resting = true;
      this.sample(time, now);
    }

    // After a lift: the age that almost no event exceeded.
    learn() {
      if (!this.silent || this.seen.length < LEAST_EVENTS) return;
      const age = play.quantile(this.seen, 0.99) + SPARE_MS;
      this.ages[this.preset] = Math.min(Math.max(age, YOUNGEST_MS), OLDEST_MS);
    }

    get last() {
      return this.times.length ? this.times[this.times.length - 1] : -Infinity;
    }

    sample(time, now) {
      this.height = Hand.within(this.raw - this.zero);
      // After a sample of stillness, an event may come that is a little older.
      this.times.push(Math.max(time, this.last + 0.01));
      this.waiting.push([this.last, this.height]);
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
      if (!this.seen || this.seen.length < 20) return null;
      return Math.round((1000 * this.seen.length) / (this.last - this.times[0]));
    }
  }

  play.Hand = Hand;
})();
