"use strict";
// One lift, over and over, without its numbers, in the element with data-glance="ID", where ID is
// that of a JSON script as for the player (see replay.js), with the time at which it stands still.
(function () {
  const colift = window.coliftReplay;
  const VIEW = { left: -0.62, right: 1.72, top: 0.94, bottom: -1.2 };
  const REST_S = 1; // between two lifts

  class Glance {
    constructor(root, { geometry, replays, raised_s }, button) {
      this.now = colift.decoded(replays[0]);
      this.end = this.now.human.length * this.now.frame_s;
      this.time = raised_s;
      this.button = button;
      root.replaceChildren();
      this.scene = new colift.Scene(root, geometry);
      this.scene.look(VIEW);
      this.scene.hold(this.now.holder);
      this.scene.showGhost(false);
      new ResizeObserver(() => this.scene.fit()).observe(root);
      button.hidden = false;
      button.addEventListener("click", () => this.go(!this.playing));
      this.show();
      this.go(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
    }

    show() {
      this.scene.pose(colift.stateAt(this.now, Math.min(this.time, this.end)));
    }

    go(playing) {
      this.playing = playing;
      this.button.textContent = playing ? "Pause" : "Play";
      if (!playing) return;
      colift.eachFrame((seconds) => {
        if (!this.playing) return false;
        this.time += seconds;
        if (this.time > this.end + REST_S) this.time = 0;
        this.show();
        return true;
      });
    }
  }

  for (const root of document.querySelectorAll("[data-glance]")) {
    const data = JSON.parse(document.getElementById(root.dataset.glance).textContent);
    root.coliftGlance = new Glance(root, data, document.getElementById("glance-play"));
  }
})();
