"use strict";
// One lift after the other: the hand closes, frames come, pictures are drawn, the hand opens.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const TICK_MS = 10;
  const LONG_HOLD = 4; // pictures that stand still before the page says so
  const LAST_MS = 50;

  // Only the family and the major version of the browser: it must not be a fingerprint.
  play.familyOf = function (navigator) {
    const brands = (navigator.userAgentData && navigator.userAgentData.brands) || [];
    const known = brands.find(({ brand }) => !/not.?a.?brand/i.test(brand) && brand !== "Chromium") || brands.find(({ brand }) => brand === "Chromium");
    if (known) return `${known.brand} ${known.version}`;
    const found = /(Firefox|Edg|Chrome|Version)\/(\d+)/.exec(navigator.userAgent || "");
    return found ? `${found[1].replace("Version", "Safari")} ${found[2]}` : "unknown";
  };

  class Lifting {
    // told: {changed(), finished(end, delays), counted(seconds), cued(height, from), slow(whether)}.
    constructor(stage, connection, clock, told) {
      this.stage = stage;
      this.connection = connection;
      this.clock = clock;
      this.told = told;
      this.frames = new play.Frames();
      this.delays = new play.Delays();
      this.hand = new play.Hand((first, samples) => connection.send(play.packSamples(first, samples)));
      this.cues = [];
      this.first = null;
      this.rate = this.refresh = null;
      this.held = 0;
      // For measurements: ?playout=0&delay=0 shows the least that is possible.
      const asked = new URLSearchParams(window.location.search);
      const wish = (name) => (Number(asked.get(name) || NaN) >= 0 ? Number(asked.get(name)) : null);
      this.playout = wish("playout");
      this.delay = wish("delay");
      this.bar = document.getElementById("progress");
      setInterval(() => this.hand.still(performance.now()), TICK_MS);
      const loop = () => {
        this.draw(performance.now());
        window.requestAnimationFrame(loop);
      };
      window.requestAnimationFrame(loop);
    }

    // The hand closes. input: preset, unit, metres_per_unit, unadjusted; see the adapters.
    grip(input) {
      this.offset = this.clock.offset;
      this.hand.close(input.preset);
      this.stage.grip(true);
      this.stage.pose(0, 0);
      this.connection.send({
        type: "grip",
        offset: this.offset,
        playout: this.playout === null ? this.frames.wish : this.playout,
        ...(this.delay === null ? {} : { delay: this.delay }),
        input: { ...input, rate_hz: this.rate, refresh_hz: this.refresh },
        rtt: this.clock.rtt,
        family: play.familyOf(navigator),
      });
      this.told.changed();
    }

    move(time, height) {
      this.hand.place(time, height, performance.now());
    }

    // The person lets go; during a lift, that ends it. type: "release" or "hidden".
    release(type = "release") {
      if (!this.hand.closed) return;
      this.open();
      this.connection.send({ type });
      this.told.changed();
    }

    open() {
      this.rate = this.hand.rate || this.rate;
      this.hand.open();
      this.stage.grip(false);
    }

    start(message) {
      if (!this.hand.closed) this.offset = this.clock.offset;
      this.lift = message.lift;
      this.frames.begin(message.at, message.frames, message.playout);
      this.delays.clear();
      this.cues = [];
      this.first = null;
      this.held = 0;
      this.stage.aim(null);
      if (this.hand.closed) this.hand.start(performance.now());
    }

    // The first goal will appear with a frame: only the leader is told.
    expect(message) {
      this.first = message.frame;
    }

    cue(message) {
      this.cues.push(message);
    }

    frame(buffer) {
      const frame = play.unpackFrame(buffer);
      if (frame) this.frames.add(frame, performance.now() + this.offset);
    }

    draw(now) {
      this.stage.reach(this.hand.height);
      if (!this.frames.running) return;
      this.count(now + this.offset);
      const picture = this.frames.look(now + this.offset);
      this.stage.pose(picture.human, picture.robot);
      while (this.cues.length && this.cues[0].frame <= picture.place) {
        const { height } = this.cues.shift();
        this.stage.aim(height);
        this.told.cued(height, picture.human);
      }
      this.bar.style.transform = `scaleX(${picture.place / this.frames.count})`;
      if (picture.over || !picture.place) return;
      this.delays.drawn(picture, this.hand.times || [], performance.now());
      this.held = picture.starved ? this.held + 1 : 0;
      if (this.held === LONG_HOLD) this.told.slow(true);
      else if (this.held === 0) this.told.slow(false);
    }

    // Whole seconds until the first goal; none if this person does not see it, or has seen it.
    count(now) {
      const left = this.first === null ? 0 : this.frames.until(this.first, now);
      const seconds = Math.max(Math.ceil(left / 1000), 0);
      if (seconds === this.counted) return;
      this.counted = seconds;
      this.stage.count(seconds);
      this.told.counted(seconds);
    }

    // The room has ended the lift; its last frames are still to be shown.
    end(message) {
      this.frames.count = this.frames.last;
      this.open();
      this.frames.learn();
      setTimeout(() => {
        if (this.lift !== message.lift) return;
        this.refresh = this.delays.refresh;
        this.clear();
        this.told.finished(message, this.delays);
      }, this.frames.playout + LAST_MS);
    }

    // Nothing moves until the next lift.
    clear() {
      this.lift = this.first = null;
      this.count(0);
      this.frames.clear();
      this.cues = [];
      this.stage.aim(null);
      this.bar.style.transform = "scaleX(0)";
      this.told.slow(false);
    }

    // The lift does not count.
    drop() {
      this.open();
      this.clear();
      this.stage.pose(0, 0);
    }
  }

  play.Lifting = Lifting;
})();
