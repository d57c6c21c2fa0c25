"use strict";
// The room's clock as this page knows it: room time = page time + offset, both in ms.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const DRIFT = 5e-5; // of two clocks: the uncertainty of an old answer, besides its travel time
  const MOST = 200;
  const EVERY_MS = 25;
  const LONGEST_MS = 4_000;

  // The ways there and back take the same time only if nothing waited: the answer with the shortest
  // round trip is used, unless it is old.
  class Clock {
    constructor() {
      this.reset();
    }

    // The room is another one, with another clock, or was busy until now.
    reset() {
      if (this.waiting) this.waiting.done();
      this.answers = [];
      this.waiting = null;
    }

    add(sent, room, received) {
      this.answers.push({ rtt: received - sent, offset: room - (sent + received) / 2, received });
      if (this.answers.length > MOST) this.answers.shift();
      const error = (each) => each.rtt / 2 + DRIFT * (received - each.received);
      this.best = this.answers.reduce((a, b) => (error(b) < error(a) ? b : a));
      if (this.waiting && (this.waiting.left -= 1) <= 0) this.waiting.done();
    }

    get known() {
      return this.answers.length > 0;
    }

    get offset() {
      return this.known ? this.best.offset : 0;
    }

    get rtt() {
      return this.known ? this.best.rtt : Infinity;
    }

    // Ask a number of times; resolves when all are answered, or after a few seconds.
    measure(send, count) {
      if (this.waiting) this.waiting.done();
      return new Promise((resolve) => {
        let asked = 0;
        const timer = setInterval(() => {
          if (asked++ < count) send({ type: "ping", t: performance.now() });
        }, EVERY_MS);
        const limit = setTimeout(() => this.waiting && this.waiting.done(), LONGEST_MS);
        this.waiting = {
          left: count,
          done: () => {
            clearInterval(timer);
            clearTimeout(limit);
            this.waiting = null;
            resolve();
          },
        };
      });
    }
  }

  play.Clock = Clock;
})();
