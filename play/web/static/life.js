"use strict";
// The life of a page: hidden, asleep, gone and back again; the screen stays on, and may be filled.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const LOOK_MS = 500;
  const SLEPT_MS = 3000;

  class Life {
    // told: {hidden(), left(), back()}.
    constructor(told) {
      document.addEventListener("visibilitychange", () => {
        if (document.hidden) told.hidden();
        else this.awake();
      });
      window.addEventListener("pagehide", () => told.left());
      window.addEventListener("pageshow", (event) => event.persisted && told.back());
      let before = Date.now();
      setInterval(() => {
        const now = Date.now();
        if (now - before > SLEPT_MS) told.hidden();
        before = now;
      }, LOOK_MS);
      const button = document.getElementById("fullscreen");
      const coarse = window.matchMedia("(pointer: coarse)").matches;
      button.hidden = !(coarse && document.fullscreenEnabled);
      button.addEventListener("click", () => this.fill());
      document.addEventListener("fullscreenchange", () => {
        button.textContent = document.fullscreenElement ? "Leave full screen" : "Full screen";
      });
    }

    // While somebody is at the table, the screen does not go dark.
    async awake(wanted = this.wanted) {
      this.wanted = wanted;
      if (!navigator.wakeLock) return;
      try {
        if (wanted && !document.hidden) this.lock = await navigator.wakeLock.request("screen");
        else if (!wanted && this.lock) await this.lock.release();
      } catch {
        // For example, a low battery; a lift is short enough.
      }
    }

    async fill() {
      try {
        if (document.fullscreenElement) await document.exitFullscreen();
        else await document.documentElement.requestFullscreen();
      } catch {
        document.getElementById("fullscreen").hidden = true;
      }
    }
  }

  play.Life = Life;
})();
