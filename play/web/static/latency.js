"use strict";
// Hand-to-picture delay: from a sample's own time to the first picture that shows its effect.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const VALUES = 250; // in one message, which must be shorter than 4 KiB

  const rounded = (values) => values.map((value) => Math.round(value * 10) / 10);

  class Delays {
    constructor() {
      this.clear();
    }

    clear() {
      this.delays = [];
      this.late = [];
      this.starved = 0;
      this.used = 0;
      this.stamps = [];
    }

    // times: those of all samples since the grip; now: when the picture was drawn.
    drawn(picture, times, now) {
      if (this.stamps.length < 600) this.stamps.push(now);
      this.late.push(picture.lateMs);
      if (picture.starved) this.starved += 1;
      if (picture.used > this.used && picture.used <= times.length) {
        this.delays.push(now - times[picture.used - 1]);
        this.used = picture.used;
      }
    }

    get median() {
      return play.quantile(this.delays, 0.5);
    }

    get p95() {
      return play.quantile(this.delays, 0.95);
    }

    // Pictures per second, from the median time between two.
    get refresh() {
      const gaps = this.stamps.slice(1).map((stamp, i) => stamp - this.stamps[i]);
      const gap = play.quantile(gaps, 0.5);
      return gap ? Math.round(1000 / gap) : null;
    }

    // The messages that report the delays to the room.
    reports(lift) {
      const parts = Math.max(Math.ceil(Math.max(this.delays.length, this.late.length) / VALUES), 1);
      return Array.from({ length: parts }, (_, part) => {
        const piece = (values) => rounded(values.slice(part * VALUES, (part + 1) * VALUES));
        return {
          type: "report",
          lift,
          part,
          parts,
          delays_ms: piece(this.delays),
          shown_late_ms: piece(this.late),
          dropped: this.starved,
          refresh_hz: this.refresh,
        };
      });
    }
  }

  play.Delays = Delays;
})();
