"use strict";
// Frames of the table as they arrive, and the picture of any moment: never a predicted picture, and
// always with both ends at the same moment.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const FRAME_MS = 10;
  const FIRST_MS = 12; // playout before anything was measured
  const SPARE_MS = 2;
  const SHORTEST_MS = 5;
  const LONGEST_MS = 150;

  // The value below which a share of the values lies; null if there are none.
  play.quantile = function (values, share) {
    if (!values.length) return null;
    const sorted = Float64Array.from(values).sort();
    return sorted[Math.max(Math.ceil(share * sorted.length) - 1, 0)];
  };

  class Frames {
    constructor() {
      this.wish = FIRST_MS;
      this.picture = { frame: 0, place: 0, human: 0, robot: 0, used: 0, starved: false, over: false };
      this.clear();
    }

    clear() {
      this.last = 0;
      this.count = 0;
      this.at = null;
      this.lateness = [];
    }

    // at: room time of frame 0 in ms; playout: how much later frames are shown.
    begin(at, count, playout) {
      this.clear();
      this.at = at;
      this.count = count;
      this.playout = playout;
      this.human = new Float64Array(count + 1);
      this.robot = new Float64Array(count + 1);
      this.used = new Uint32Array(count + 1);
    }

    get running() {
      return this.at !== null;
    }

    // arrived: room time in ms.
    add(frame, arrived) {
      const n = frame.frame;
      if (!this.running || n <= this.last || n > this.count) return;
      this.human[n] = frame.human;
      this.robot[n] = frame.robot;
      this.used[n] = frame.used;
      this.last = n;
      // A frame that was made late says nothing about its travel time.
      if (!frame.late) this.lateness.push(arrived - this.at - FRAME_MS * n);
    }

    // The picture at a room time: interpolated between two frames; after the newest frame it stands
    // still. The object is reused.
    look(now) {
      const { picture } = this;
      const wanted = (now - this.playout - this.at) / FRAME_MS;
      const place = Math.min(Math.max(wanted, 0), this.last);
      const frame = Math.floor(place);
      const next = Math.min(frame + 1, this.last);
      const part = place - frame;
      picture.frame = frame;
      picture.place = place;
      picture.human = this.human[frame] + part * (this.human[next] - this.human[frame]);
      picture.robot = this.robot[frame] + part * (this.robot[next] - this.robot[frame]);
      picture.used = this.used[frame];
      picture.lateMs = Math.max(Math.min(wanted, this.count) - place, 0) * FRAME_MS;
      picture.starved = wanted > 0 && picture.lateMs > 0;
      picture.over = this.last >= this.count && wanted >= this.count;
      return picture;
    }

    // Time until a frame is shown, in ms.
    until(frame, now) {
      return this.at + this.playout + FRAME_MS * frame - now;
    }

    // After a lift: the playout at which nearly every frame would have been there in time.
    learn() {
      const late = play.quantile(this.lateness, 0.99);
      if (late === null) return;
      this.wish = Math.round(Math.min(Math.max(late + SPARE_MS, SHORTEST_MS), LONGEST_MS) * 10) / 10;
    }
  }

  play.Frames = Frames;
})();
