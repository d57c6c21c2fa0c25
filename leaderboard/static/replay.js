"use strict";
// The replay player: it fills every element with data-replay="ID", where ID is that of a JSON script
// {"geometry": ..., "replays": [...]} (see replays/geometry.py and replays/replay.py).
// Keys: space plays and pauses, arrows move by a step (with shift by a second), Home and End,
// comma and full stop move by a frame, G shows or hides the second of two people.
(function () {
  const SPEEDS = [0.25, 0.5, 1, 2, 4];

  const colift = window.coliftReplay;
  const { decoded, element, eventWords, number, words } = colift;

  class Player {
    constructor(root, data, id) {
      this.root = root;
      this.id = id;
      this.replays = data.replays;
      this.playing = false;
      this.held = false;
      this.speed = 1;
      this.ghost = true;
      root.classList.add("replay");
      root.replaceChildren();
      if (this.replays.length > 1) this.picker();
      this.about = element("div", { class: "replay-about" });
      const stage = element("div", { class: "replay-stage" });
      this.readout = element("div", { class: "replay-readout" });
      this.list = element("dl", {});
      this.charts = element("div", { class: "replay-charts" });
      const main = element("div", { class: "replay-main" }, stage, this.readout);
      root.append(this.about, main, this.controls(), this.charts);
      this.scene = new colift.Scene(stage, data.geometry);
      document.addEventListener("keydown", (event) => this.key(event));
      new ResizeObserver(() => this.fit()).observe(root);
      this.choose(this.wanted());
      if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.play();
    }

    name(replay) {
      return [replay.behaviour, replay.which || replay.lift || null, replay.subject, replay.seed].filter((x) => x !== null).join("-");
    }

    // The replay in the address, or the first one.
    wanted() {
      const asked = decodeURIComponent(window.location.hash.slice(1));
      const found = this.replays.findIndex((r) => asked && this.name(r).startsWith(asked));
      return Math.max(found, 0);
    }

    picker() {
      const behaviours = [...new Set(this.replays.map((r) => r.behaviour))];
      const select = element("select", { "aria-label": "How the human lifts" });
      for (const each of behaviours) select.append(element("option", { value: each }, words(each)));
      this.whichButtons = element("div", { class: "replay-which", role: "group", "aria-label": "Which lift" });
      this.behaviour = select;
      select.addEventListener("change", () => this.pick(this.alike(select.value)));
      this.root.append(
        element("div", { class: "replay-picker" }, element("label", {}, "The human: ", select), this.whichButtons)
      );
    }

    // The replay of a behaviour that was chosen for the same reason as the present one, or its first.
    alike(behaviour) {
      const of = this.replays.filter((r) => r.behaviour === behaviour);
      return this.replays.indexOf(of.find((r) => r.which === this.now.which) || of[0]);
    }

    pick(index) {
      this.choose(index);
      try {
        window.history.replaceState(null, "", "#" + this.name(this.replays[index]));
      } catch {
        // Some viewers of mailed files forbid it; the address is a convenience.
      }
    }

    showChoice() {
      if (!this.behaviour) return;
      this.behaviour.value = this.now.behaviour;
      const of = this.replays.filter((r) => r.behaviour === this.now.behaviour);
      this.whichButtons.replaceChildren(
        ...of.map((r) => {
          const index = this.replays.indexOf(r);
          const button = element("button", { type: "button", "aria-pressed": index === this.index });
          button.append(colift.WHICH[r.which] || (r.lift ? `lift ${r.lift}` : r.subject), " ", element("span", {}, `${r.scores.rmse_mm.toFixed(1)} mm`));
          button.addEventListener("click", () => this.pick(index));
          return button;
        })
      );
    }

    controls() {
      this.button = element("button", { type: "button", class: "replay-play" });
      this.button.addEventListener("click", () => this.toggle());
      this.slider = element("input", { type: "range", min: 0, step: 0.01, "aria-label": "Time in the lift" });
      this.slider.addEventListener("input", () => {
        const time = Number(this.slider.value);
        this.pause();
        this.seek(time);
      });
      this.clock = element("span", { class: "replay-clock" });
      const speed = element("select", { "aria-label": "Speed" });
      for (const each of SPEEDS) speed.append(element("option", { value: each }, `${each} ×`));
      speed.value = "1";
      speed.addEventListener("change", () => (this.speed = Number(speed.value)));
      const box = element("input", { type: "checkbox" });
      box.checked = true;
      box.addEventListener("change", () => this.showGhost(box.checked));
      this.ghostBox = box;
      const toggle = element("label", { class: "replay-toggle" }, box, "two people");
      return element("div", { class: "replay-controls" }, this.button, this.slider, this.clock, speed, toggle);
    }

    choose(index) {
      this.index = index;
      const now = (this.now = decoded(this.replays[index]));
      this.frames = now.human.length;
      this.duration = Math.max(now.horizon, 1) * now.frame_s;
      this.slider.max = this.duration;
      this.time = 0;
      this.describe();
      this.showChoice();
      this.drawCharts();
      this.fit();
      this.seek(0);
    }

    describe() {
      const { now } = this;
      this.scene.hold(now.holder);
      const what = colift.BEHAVIOURS[now.behaviour] || words(now.behaviour);
      const lift = now.trial ? `recording ${now.trial}` : `seed ${now.seed}`;
      const chosen = now.which ? `${colift.SHOWN[now.which]} of its lifts with this behaviour: ` : "";
      const place = now.lift ? `lift ${now.lift} with ` : "";
      const text = element("p", {});
      if (now.goals) {
        text.append("A person (blue end) and ", element("b", {}, colift.partnerWords(now.policy)), ` (orange end): ${colift.liveWords(now.trial)}.`);
      } else text.append(
        element("b", {}, now.policy),
        " (orange end) lifts a table with a person (blue end) who ",
        element("b", {}, what),
        `. This is ${chosen}${place}subject ${now.subject}, ${lift}.`
      );
      const score = (label, value, kind) =>
        element("div", { class: kind }, element("dt", {}, label), element("dd", {}, value));
      const mm = (value) => (value === null ? "none" : `${value.toFixed(1)} mm`);
      const scores = element(
        "dl",
        { class: "replay-scores" },
        score("error (RMSE)", mm(now.scores.rmse_mm), "robot"),
        ...(now.goals ? [score("from the goals", mm(now.goal_error_mm), "target")] : []),
        score("two people", mm(now.ghost.rmse_mm), "human-human")
      );
      this.about.replaceChildren(text);
      this.readout.replaceChildren(scores, this.list);
      if (now.failure) {
        const after = now.failure && this.frames < now.horizon ? "; the time that is missing counts as 250 mm" : "";
        this.about.append(element("p", { class: "replay-failure" }, `The lift failed: ${now.failure}${after}.`));
      }
    }

    drawCharts() {
      const { now } = this;
      this.charts.replaceChildren();
      this.drawn = colift.chartsOf(now).map((options) => new colift.Chart(this.charts, options, this));
      if (this.frames && !now.prediction && !now.confidence && !now.role) {
        this.charts.append(element("p", { class: "replay-note" }, "This policy reports neither predictions nor confidence."));
      }
    }

    fit() {
      this.scene.fit();
      for (const chart of this.drawn || []) chart.fit();
      this.show();
    }

    seek(time) {
      this.time = Math.min(Math.max(time, 0), this.duration);
      this.show();
    }

    show() {
      if (!this.now) return;
      const { now } = this;
      const state = colift.stateAt(now, this.time);
      this.scene.pose(state);
      const index = Math.max(Math.round(this.time / now.frame_s) - 1, 0);
      for (const chart of this.drawn) chart.at(this.time, index);
      this.slider.value = this.time;
      this.clock.textContent = `${this.time.toFixed(2)} / ${this.duration.toFixed(1)} s`;
      const event = now.events.filter(([, frame]) => frame * now.frame_s <= this.time + 1e-9).pop();
      const { over } = state;
      const goal = now.error.scored && now.drawn.length;
      const difference = 1000 * state.error;
      const ghostGap = 1000 * state.ghostError;
      const rows = [
        ...(now.goals ? [] : [["human", "the human", over ? "the lift is over" : event ? eventWords(event[0]) : "waits"]]),
        ["human", "human's end", `${number(1000 * state.human, 0)} mm`],
        ["robot", "robot's end", `${number(1000 * state.robot, 0)} mm`],
        ["error", goal ? "error" : "difference", over ? "counts as 250 mm" : `${number(difference, 1)} mm`],
        ["human-human", "two people", `${number(ghostGap, 1)} mm`],
        ...state.drawn.map((each) => ["target", each.label, `${number(1000 * each.value, 0)} mm`]),
        ...state.hurdles.map((each) => [each.where, each.label, colift.hurdleState(each)]),
        ["target", now.goals ? "goal" : "human's intention", state.target === null ? "none yet" : `${number(1000 * state.target, 0)} mm`],
        ["command", "robot's command", state.command === null ? "none" : `${number(1000 * state.command, 0)} mm`],
      ];
      if (now.prediction) {
        const text = state.prediction === null ? "none" : `${number(1000 * state.prediction, 0)} mm`;
        rows.push(["prediction", "robot's prediction", text]);
      }
      if (now.confidence) {
        rows.push(["confidence", "confidence", state.confidence === null ? "none" : number(state.confidence, 2)]);
      }
      this.showRows(rows);
      if (!this.playing) {
        this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(2)} s, ${goal ? `error ${number(difference, 0)} mm` : colift.differenceWords(difference)}`);
      }
      const shown = this.playing ? "Pause" : "Play";
      if (this.button.dataset.shows !== shown) {
        this.button.dataset.shows = shown;
        this.button.setAttribute("aria-label", shown);
        this.button.title = `${shown} (space)`;
      }
    }

    showRows(rows) {
      if (this.cells && this.cells.length === rows.length) {
        rows.forEach(([kind, label, value], i) => {
          const [dt, dd] = this.cells[i];
          dt.parentNode.className = "row-" + kind;
          if (dt.textContent !== label) dt.textContent = label;
          if (dd.textContent !== value) dd.textContent = value;
        });
        return;
      }
      this.cells = rows.map(([, label, value]) => [element("dt", {}, label), element("dd", {}, value)]);
      this.list.replaceChildren(...this.cells.map((pair) => element("div", {}, ...pair)));
      this.showRows(rows);
    }

    showGhost(shown) {
      this.ghost = shown;
      this.ghostBox.checked = shown;
      this.root.classList.toggle("no-human-human", !shown);
      this.scene.showGhost(shown);
    }

    toggle() {
      if (this.playing) this.pause();
      else this.play();
    }

    play() {
      if (this.time >= this.duration - 1e-6) this.time = 0;
      this.playing = true;
      colift.eachFrame((seconds) => {
        if (!this.playing) return false;
        if (!this.held) {
          this.time = Math.min(this.time + this.speed * seconds, this.duration);
          if (this.time >= this.duration) this.playing = false;
          this.show();
        }
        return true;
      });
      this.show();
    }

    pause() {
      this.playing = false;
      this.show();
    }

    // While a curve is dragged, time stands still.
    hold() {
      this.held = true;
    }

    release() {
      this.held = false;
    }

    key(event) {
      if (!this.root.getClientRects().length) return; // It is not shown.
      if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
      const { target } = event;
      const typing = target.matches && target.matches("select, textarea, input:not([type=range], [type=checkbox])");
      if (typing) return;
      const pressed = target.matches && target.matches("button, a, summary, input[type=checkbox]");
      const go = (seconds) => () => this.seek(this.time + seconds);
      const step = event.shiftKey ? 1 : this.now.period_s;
      const does = {
        " ": pressed ? null : () => this.toggle(),
        ArrowLeft: go(-step),
        ArrowRight: go(step),
        ",": go(-this.now.frame_s),
        ".": go(this.now.frame_s),
        Home: () => this.seek(0),
        End: () => this.seek(this.duration),
        g: () => this.showGhost(!this.ghost),
        G: () => this.showGhost(!this.ghost),
      }[event.key];
      if (!does) return;
      event.preventDefault();
      if (event.key.startsWith("Arrow") || event.key === "," || event.key === ".") this.pause();
      does();
    }
  }

  colift.Player = Player;

  function start() {
    document.querySelectorAll("[data-replay]").forEach((root, index) => {
      const data = JSON.parse(document.getElementById(root.dataset.replay).textContent);
      root.coliftPlayer = new Player(root, data, `replay${index}`);
    });
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
})();
