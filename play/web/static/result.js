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

  // The sentence on a lift that counts: how level it was, and how well its goals were reached.
  play.scoreWords = function (end) {
    if (end.failure) return "The lift failed.";
    return `The ends differed by ${mm(end.rmse_mm)} (RMSE); the hand was ${mm(end.goal_error_mm)} from the goals.`;
  };

  // The sentence of a standing; partner: the name of the policy at the far end, if there was one.
  // leads: whether this person's hand made the movement.
  play.standingWords = function (standing, partner, score, leads = true) {
    const movement = `${leads ? "your" : "the leader's"} movement`;
    const [best] = standing.policies;
    if (!best) return "";
    if (best.name === partner) return `Of all policies, ${partner} is the best with ${movement}.`;
    return `${best.name} would have managed ${mm(best.rmse_mm)} with ${movement} (you and ${play.partnerWords(partner)}: ${mm(score)}).`;
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

    // role: "leader" or "follower"; null of somebody who only watched, and is told no comparison.
    show(end, partner, delays, role = "leader") {
      this.end = end;
      this.partner = partner;
      this.role = role;
      this.root.hidden = false;
      this.part("score").textContent = mm(end.rmse_mm);
      this.part("goals").textContent = mm(end.goal_error_mm);
      this.part("ghost").textContent = mm(end.ghost_rmse_mm);
      this.part("failure").textContent = end.failure ? `The lift failed: ${end.failure}.` : "";
      const age = play.delayWords(delays.median, delays.p95);
      this.part("delay").textContent = age;
      this.part("delay").parentNode.hidden = !age;
      const late = end.late || {};
      this.part("late").textContent = late.marked
        ? `This machine was busy: the table was late by ${Math.round(late.worst_ms)} ms once. The lift is marked.`
        : "";
      this.part("best").textContent = this.best(end, partner);
      this.part("standing").textContent = "";
      this.part("policies").replaceChildren();
      this.together(end.session);
      this.part("watching").textContent = "";
      this.part("comparing").hidden = role === null || !end.compared;
    }

    // The lifts in a row with this partner, which may have learned from them; open when all are done.
    together({ lifts, rmse_mm }) {
      const done = rmse_mm.length;
      const section = this.part("together");
      section.hidden = done < 2;
      section.open = done >= lifts;
      this.part("together-title").textContent = `Lift by lift: ${done} of ${lifts} with ${play.partnerWords(this.partner)}`;
      this.bars(
        "together-lifts",
        rmse_mm.map((value, i) => ({ name: `lift ${i + 1}`, rmse_mm: value, own: i === done - 1 })),
        Math.max(...rmse_mm, 1e-9)
      );
    }

    // A list of names with errors as bars, as long as most at most.
    bars(part, rows, most) {
      this.part(part).replaceChildren(
        ...rows.map((row) => {
          const bar = element("progress", { max: most, value: Math.min(row.rmse_mm, most), "aria-hidden": "true" });
          const line = element("li", {}, element("span", {}, row.name), bar, element("b", {}, mm(row.rmse_mm)));
          line.classList.toggle("own", row.own);
          return line;
        })
      );
    }

    // Of the lifts that count in this session; what was kept without a goal error may be void.
    best(end, partner) {
      const session = this.connection.place.session;
      const kept = play.read(sessionStorage, KEPT);
      const before = kept.session === session && typeof kept.goal_error_mm === "number" ? kept : null;
      if (end.failure || typeof end.goal_error_mm !== "number" || (before && before.rmse_mm <= end.rmse_mm)) {
        if (!before) return "";
        return `Best of this session: ${mm(before.rmse_mm)} with ${play.partnerWords(before.partner)}, ${mm(before.goal_error_mm)} from the goals.`;
      }
      play.write(sessionStorage, KEPT, { session, partner, rmse_mm: end.rmse_mm, goal_error_mm: end.goal_error_mm });
      return before ? "This is the best of this session." : "";
    }

    compare(standing) {
      if (!this.end || this.root.hidden || standing.lift !== this.end.lift) return;
      this.part("comparing").hidden = true;
      this.part("standing").textContent = play.standingWords(standing, this.partner, this.end.rmse_mm, this.role === "leader");
      const rows = [...standing.policies];
      if (typeof standing.human_human_mm === "number") {
        rows.push({ name: "simulated person", rmse_mm: standing.human_human_mm });
      }
      rows.sort((a, b) => a.rmse_mm - b.rmse_mm);
      // A policy that never moves must not make all others look alike.
      const most = Math.max(Math.min(rows[rows.length - 1].rmse_mm, 3 * this.end.rmse_mm), 1e-9);
      this.bars("policies", rows.map((row) => ({ ...row, own: row.name === this.partner })), most);
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
        told.textContent = error instanceof TypeError ? "The server cannot be reached." : error.message;
      }
    }
  }

  play.Result = Result;
})();
