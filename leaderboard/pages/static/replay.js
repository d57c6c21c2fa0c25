"use strict";
// The player of replays: fills every element with data-replay="ID", ID that of a JSON script
// {"geometry": ..., "replays": [...]} (see replays/geometry.py and replays/replay.py).
// Keys: space plays and pauses, arrows go by a step (with shift by a second), Home and End,
// comma and full stop go by a frame, G shows or hides the human-human team.
(function () {
  const SPEEDS = [0.25, 0.5, 1, 2, 4];
  const UNIT = 1e-4; // m
  const WHICH = { best: "best", median: "typical", worst: "worst" };
  const SHOWN = { best: "the best", median: "a typical one (the median)", worst: "the worst" };
  const BEHAVIOURS = {
    smooth: "lifts and lowers smoothly",
    pause: "stops on the way, and goes on",
    jerky: "lifts in jerks",
    changing_goal: "changes the goal on the way",
    recorded: "repeats a recorded lift",
  };
  const EVENTS = {
    ready: "waits",
    rise: "lifts",
    brake: "brakes",
    pause: "stands still",
    resume: "goes on",
    reverse: "turns back",
    undershoot: "aims lower",
    overshoot: "aims higher",
    replan: "heads for the new goal",
    hold: "holds",
    lower: "lowers",
    rest: "rests",
  };

  const colift = (window.coliftReplay = window.coliftReplay || {});

  const number = (value, places) => value.toFixed(places).replace(/^-(?=0\.?0*$)/, "").replace("-", "−");
  const words = (text) => text.replaceAll("_", " ");

  colift.differenceWords = function (millimetres) {
    const whole = Math.round(Math.abs(millimetres));
    if (!whole) return "level";
    return `robot ${whole} mm too ${millimetres < 0 ? "low" : "high"}`;
  };

  function element(name, attributes, ...children) {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
      if (key === "class") node.className = value;
      else node.setAttribute(key, value);
    }
    node.append(...children);
    return node;
  }

  // From the first height and the changes to heights in m.
  function heights(changes) {
    let sum = 0;
    return changes.map((change) => (sum += change) * UNIT);
  }

  function decoded(replay) {
    const scaled = (values, unit) => values && values.map((v) => (v === null ? null : v * unit));
    return {
      ...replay,
      human: heights(replay.human),
      robot: heights(replay.robot),
      target: heights(replay.target),
      command: scaled(replay.command, UNIT),
      prediction: scaled(replay.prediction, UNIT),
      confidence: scaled(replay.confidence, 1e-3),
      role: scaled(replay.role, 1e-3),
      ghost: { ...replay.ghost, human: heights(replay.ghost.human), robot: heights(replay.ghost.robot) },
    };
  }

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
      return [replay.behaviour, replay.which, replay.subject, replay.seed].filter((x) => x !== null).join("-");
    }

    // The replay that the address asks for, or the first.
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
      select.addEventListener("change", () => this.pick(select.value, this.now.which));
      this.root.append(
        element("div", { class: "replay-picker" }, element("label", {}, "The human: ", select), this.whichButtons)
      );
    }

    pick(behaviour, which) {
      const of = this.replays.map((r, i) => [r, i]).filter(([r]) => r.behaviour === behaviour);
      const [, index] = of.find(([r]) => r.which === which) || of[0];
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
          const button = element("button", { type: "button", "aria-pressed": r.which === this.now.which });
          button.append(WHICH[r.which] || r.subject, " ", element("span", {}, `${r.scores.rmse_mm.toFixed(1)} mm`));
          button.addEventListener("click", () => this.pick(r.behaviour, r.which));
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
      const what = BEHAVIOURS[now.behaviour] || words(now.behaviour);
      const lift = now.trial ? `recording ${now.trial}` : `seed ${now.seed}`;
      const chosen = now.which ? `${SHOWN[now.which]} of its lifts with this behaviour: ` : "";
      const text = element("p", {});
      text.append(
        element("b", {}, now.policy),
        " (orange end) lifts a table with a person (blue end) who ",
        element("b", {}, what),
        `. This is ${chosen}subject ${now.subject}, ${lift}.`
      );
      const score = (label, value, kind) =>
        element("div", { class: kind }, element("dt", {}, label), element("dd", {}, value));
      const mm = (value) => (value === null ? "none" : `${value.toFixed(1)} mm`);
      const scores = element(
        "dl",
        { class: "replay-scores" },
        score("error (RMSE)", mm(now.scores.rmse_mm), "robot"),
        score("two people", mm(now.ghost.rmse_mm), "team")
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
      const times = (values) => values.map((_, i) => (i + 1) * now.frame_s);
      const steps = (values) => values.map((_, i) => i * now.period_s);
      const mm = (values) => values.map((value) => (value === null ? null : 1000 * value));
      const both = (a, b) => a.map((value, i) => 1000 * (value - b[i]));
      const error = both(now.robot, now.human);
      const team = both(now.ghost.robot, now.ghost.human);
      const series = (kind, style, when, values, dot) => ({ kind, style, times: when(values), values, dot });
      const span = (...lists) => {
        const all = lists.flat().filter((value) => value !== null);
        return [Math.min(0, ...all), Math.max(50, ...all)];
      };
      const lines = [
        series("team", "line", times, mm(now.ghost.robot)),
        series("target", "line", times, mm(now.target)),
        series("human", "line", times, mm(now.human), true),
        series("robot", "line", times, mm(now.robot), true),
      ];
      const keys = [
        ["human", "human's end"],
        ["robot", "robot's end"],
        ["target", "human's intention"],
        ["team", "a second human in the robot's place"],
      ];
      if (now.prediction) {
        lines.push(series("prediction", "dots", steps, mm(now.prediction)));
        keys.push(["prediction", "prediction of the human, drawn when it was made"]);
      }
      // A wild prediction must not flatten the lift.
      const [least, most] = span(mm(now.human), mm(now.robot), mm(now.target), mm(now.ghost.robot));
      const room = most - least;
      const within = (value) => value !== null && value > least - 0.15 * room && value < most + 0.15 * room;
      if (now.prediction) {
        const last = lines[lines.length - 1];
        last.values = last.values.map((value) => (within(value) ? value : null));
      }
      const events = now.events.map(([name, frame]) => [EVENTS[name] || words(name), frame * now.frame_s]);
      const reach = Math.min(Math.max(15, ...error.map(Math.abs), ...team.map(Math.abs)), 120) * 1.1;
      const charts = [
        {
          name: "heights",
          title: "Height [mm]",
          summary: `Heights of both ends over ${this.duration.toFixed(1)} s`,
          keys,
          low: least - 0.07 * room,
          high: most + 0.22 * room,
          height: 250,
          series: lines,
          events,
        },
        {
          name: "error",
          title: "Error: robot's end above the human's [mm]",
          summary: `Height difference, RMSE ${number(now.scores.rmse_mm, 1)} mm`,
          keys: [["robot", "with the robot"], ["team", "with a second human"]],
          low: -reach,
          high: reach,
          height: 150,
          series: [series("robot", "area", times, error, true), series("team", "line", times, team)],
          last: !(now.confidence || now.role),
        },
      ];
      if (now.confidence || now.role) {
        const same = now.confidence && now.role && now.confidence.every((c, i) => c === now.role[i]);
        const curves = [];
        const told = [];
        if (now.confidence) {
          curves.push(series("confidence", "line", steps, now.confidence));
          told.push(["confidence", same ? "confidence, and so its role" : "confidence in its prediction"]);
        }
        if (now.role && !same) {
          curves.push(series("role", "line", steps, now.role));
          told.push(["role", "role"]);
        }
        charts.push({
          name: "confidence",
          title: "What the policy says of itself",
          summary: "Confidence and role of the policy, from 0 to 1",
          keys: told,
          low: -0.06,
          high: 1.06,
          height: 110,
          labels: [[0, now.role ? "follows" : "0"], [0.5, "½"], [1, now.role ? "leads" : "1"]],
          series: curves,
          last: true,
        });
      }
      this.drawn = charts.map((options) => new colift.Chart(this.charts, options, this));
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

    // The state at a time; a height between two frames is on the line between them.
    state() {
      const { now } = this;
      const place = Math.max(this.time / now.frame_s - 1, 0);
      const at = (values) => {
        if (!values.length) return 0;
        const i = Math.min(Math.floor(place), values.length - 1);
        const next = values[Math.min(i + 1, values.length - 1)];
        return values[i] + Math.min(place - i, 1) * (next - values[i]);
      };
      const step = Math.floor(this.time / now.period_s + 1e-9);
      const said = (values) => (values && values.length ? values[Math.min(step, values.length - 1)] : null);
      return {
        human: at(now.human),
        robot: at(now.robot),
        target: at(now.target),
        ghostHuman: at(now.ghost.human),
        ghostRobot: at(now.ghost.robot),
        prediction: said(now.prediction),
        confidence: said(now.confidence),
        role: said(now.role),
        command: said(now.command),
        over: this.frames < now.horizon && this.time > this.frames * now.frame_s,
      };
    }

    show() {
      if (!this.now) return;
      const { now } = this;
      const state = this.state();
      this.scene.pose(state);
      const index = Math.max(Math.round(this.time / now.frame_s) - 1, 0);
      for (const chart of this.drawn) chart.at(this.time, index);
      this.slider.value = this.time;
      this.clock.textContent = `${this.time.toFixed(2)} / ${this.duration.toFixed(1)} s`;
      const event = now.events.filter(([, frame]) => frame * now.frame_s <= this.time + 1e-9).pop();
      const { over } = state;
      const difference = 1000 * (state.robot - state.human);
      const rows = [
        ["human", "the human", over ? "the lift is over" : event ? EVENTS[event[0]] || words(event[0]) : "waits"],
        ["human", "human's end", `${number(1000 * state.human, 0)} mm`],
        ["robot", "robot's end", `${number(1000 * state.robot, 0)} mm`],
        ["error", "difference", over ? "counts as 250 mm" : `${number(difference, 1)} mm`],
        ["team", "two people", `${number(1000 * (state.ghostRobot - state.ghostHuman), 1)} mm`],
        ["target", "human's intention", `${number(1000 * state.target, 0)} mm`],
        ["command", "robot's command", state.command === null ? "none" : `${number(1000 * state.command, 0)} mm`],
      ];
      if (now.prediction) {
        const told = state.prediction === null ? "none" : `${number(1000 * state.prediction, 0)} mm`;
        rows.push(["prediction", "robot's prediction", told]);
      }
      if (now.confidence) {
        rows.push(["confidence", "confidence", state.confidence === null ? "none" : number(state.confidence, 2)]);
      }
      this.showRows(rows);
      if (!this.playing) {
        this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(2)} s, ${colift.differenceWords(difference)}`);
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
      this.root.classList.toggle("no-team", !shown);
      this.scene.showGhost(shown);
    }

    toggle() {
      if (this.playing) this.pause();
      else this.play();
    }

    play() {
      if (this.time >= this.duration - 1e-6) this.time = 0;
      this.playing = true;
      let before = null;
      const tick = (stamp) => {
        if (!this.playing) return;
        if (before !== null && !this.held) {
          this.time = Math.min(this.time + (this.speed * (stamp - before)) / 1000, this.duration);
          if (this.time >= this.duration) this.playing = false;
          this.show();
        }
        before = stamp;
        window.requestAnimationFrame(tick);
      };
      window.requestAnimationFrame(tick);
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

  function start() {
    document.querySelectorAll("[data-replay]").forEach((root, index) => {
      const data = JSON.parse(document.getElementById(root.dataset.replay).textContent);
      root.coliftPlayer = new Player(root, data, `replay${index}`);
    });
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
})();
