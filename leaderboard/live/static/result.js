"use strict";
// After a lift: its score, the scores of others with the same movement, and its replay.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});
  const { element, number } = window.coliftReplay;

  const KEPT = "colift-play-best";
  const mm = (value) => (value === null || value === undefined ? "–" : `${number(value, 1)} mm`);

  // The sentence on the age of the pictures.
  play.delayWords = function (median, p95) {
    if (median === null) return "";
    return `What you saw was ${Math.round(median)} ms old (95 % of it less than ${Math.ceil(p95)} ms).`;
  };

  // The sentence of a standing; partner: the name of the policy at the far end, if there was one.
  play.standingWords = function (standing, partner, score) {
    const [best] = standing.policies;
    if (!best) return "";
    if (best.name === partner) return `No other policy would have been better with your movement than ${partner}.`;
    const than = score > best.rmse_mm ? "" : ", which is more";
    return `With your movement, ${best.name} would have kept the table level to ${mm(best.rmse_mm)}${than}.`;
  };

  class Result {
    // root: its section; connection: has the replays; geometry: the scene's.
    constructor(root, connection, geometry) {
      this.root = root;
      this.connection = connection;
      this.geometry = geometry;
      this.part = (name) => root.querySelector(`[data-part=${name}]`);
      this.dialog = document.getElementById("replay");
      this.part("watch").addEventListener("click", () => this.watch());
      this.dialog.addEventListener("close", () => this.player && this.player.pause());
    }

    hide() {
      this.root.hidden = true;
    }

    // watched: whether this person only watched, and is told no comparison.
    show(end, partner, delays, watched = false) {
      this.end = end;
      this.partner = partner;
      this.root.hidden = false;
      this.part("score").textContent = mm(end.rmse_mm);
      this.part("ghost").textContent = mm(end.ghost_rmse_mm);
      this.part("failure").textContent = end.failure ? `The lift failed: ${end.failure}.` : "";
      this.part("delay").textContent = play.delayWords(delays.median, delays.p95);
      const late = end.late || {};
      this.part("late").textContent = late.marked
        ? `This machine was busy: the table was late by ${Math.round(late.worst_ms)} ms once. The lift is marked.`
        : "";
      this.part("best").textContent = this.best(end, partner);
      this.part("standing").textContent = "";
      this.part("policies").replaceChildren();
      this.part("watching").textContent = "";
      this.part("comparing").hidden = watched || !end.compared;
    }

    best(end, partner) {
      const session = this.connection.place.session;
      const kept = play.read(sessionStorage, KEPT);
      const before = kept.session === session ? kept : null;
      if (end.failure) return before ? `Best of this session: ${mm(before.rmse_mm)} with ${before.partner}.` : "";
      if (before && before.rmse_mm <= end.rmse_mm) {
        return `Best of this session: ${mm(before.rmse_mm)} with ${before.partner}.`;
      }
      play.write(sessionStorage, KEPT, { session, partner, rmse_mm: end.rmse_mm });
      return before ? "This is the best of this session." : "";
    }

    compare(standing) {
      if (!this.end || this.root.hidden || standing.lift !== this.end.lift) return;
      this.part("comparing").hidden = true;
      this.part("standing").textContent = play.standingWords(standing, this.partner, this.end.rmse_mm);
      const rows = [...standing.policies];
      if (typeof standing.human_human_mm === "number") {
        rows.push({ name: "simulated person", rmse_mm: standing.human_human_mm });
      }
      rows.sort((a, b) => a.rmse_mm - b.rmse_mm);
      // A policy that never moves must not make all others look alike.
      const most = Math.max(Math.min(rows[rows.length - 1].rmse_mm, 3 * this.end.rmse_mm), 1e-9);
      this.part("policies").replaceChildren(
        ...rows.map((row) => {
          const bar = element("progress", { max: most, value: Math.min(row.rmse_mm, most), "aria-hidden": "true" });
          const line = element("li", {}, element("span", {}, row.name), bar, element("b", {}, mm(row.rmse_mm)));
          line.classList.toggle("own", row.name === this.partner);
          return line;
        })
      );
    }

    async watch() {
      const told = this.part("watching");
      told.textContent = "Fetching the replay …";
      try {
        const replay = await this.connection.replay(this.end.lift);
        told.textContent = "";
        this.dialog.showModal();
        const data = { geometry: this.geometry, replays: [replay] };
        if (this.player) {
          this.player.replays = data.replays;
          this.player.choose(0);
        } else this.player = new window.coliftReplay.Player(document.getElementById("player"), data, "lift");
      } catch (error) {
        told.textContent = error.message;
      }
    }
  }

  play.Result = Result;
})();
