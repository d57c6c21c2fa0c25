"use strict";
// The lift from the side: robot, table, person, and the second of two people as a ghost.
// Lengths are in m; x goes from the robot to the human, z upwards (see replays/geometry.py).
(function () {
  const VIEW = { left: -0.66, right: 1.72, top: 0.93, bottom: -0.95 };
  const LEVEL = { x: 0.56, z: 0.7, half: 0.36, height: 0.085, full: 40 };
  const LETTERS = 13; // pixels
  const NARROW = 480; // pixels: below it there is no room for numbers in the scene

  const colift = window.coliftReplay;
  const { make, Nao, Chain, NaoArm, Person } = colift;

  // The table between its two ends, with one shape for the board and one for each end's colour.
  class Table {
    constructor(parent, geometry, kind) {
      this.right = geometry.grip[0] + geometry.table;
      this.rest = geometry.grip[1];
      this.length = geometry.table;
      this.group = make("g", { class: "replay-table " + kind }, parent);
      const bar = (x, width, paint) =>
        make("rect", { x, y: -0.011, width, height: 0.022, rx: 0.008, class: paint }, this.group);
      bar(-geometry.table - 0.03, geometry.table + 0.06, "paint-wood");
      if (kind === "real") {
        bar(-geometry.table - 0.03, 0.08, "paint-robot-end");
        bar(-0.05, 0.08, "paint-human-end");
      }
    }

    pose(human, robot) {
      const sine = Math.min(Math.max((human - robot) / this.length, -1), 1);
      const turn = (-Math.asin(sine) * 180) / Math.PI;
      this.group.setAttribute(
        "transform",
        `translate(${this.right} ${-(this.rest + human)}) rotate(${turn})`
      );
    }
  }

  // A spirit level: its bubble goes to the higher end, far enough to be visible.
  class Level {
    constructor(parent) {
      const { x, z, half, height } = LEVEL;
      const group = (this.group = make("g", { class: "replay-level" }, parent));
      const tube = { x: x - half, y: -z - height / 2, width: 2 * half, height, rx: height / 2 };
      make("rect", { ...tube, class: "tube" }, group);
      for (const mm of [-20, -10, 10, 20]) {
        const at = x + (mm / LEVEL.full) * (half - height / 2);
        make("line", { x1: at, x2: at, y1: tube.y, y2: tube.y + height, class: "mark" }, group);
      }
      const bubble = (kind) =>
        make("ellipse", { cy: -z, rx: 0.052, ry: height / 2 - 0.009, class: kind }, group);
      this.real = bubble("bubble real");
      this.ghost = bubble("bubble ghost");
      this.text = make("text", { x, y: -z - height / 2 - 0.03, "text-anchor": "middle" }, group);
    }

    pose(difference, ghost, over) {
      const at = (mm) => {
        const share = Math.min(Math.max(-mm / LEVEL.full, -1), 1);
        return LEVEL.x + share * (LEVEL.half - LEVEL.height / 2 - 0.01);
      };
      this.real.setAttribute("cx", at(difference));
      this.ghost.setAttribute("cx", at(ghost));
      this.real.classList.toggle("none", over);
      const words = over ? "the lift is over" : colift.differenceWords(difference);
      if (this.words !== words) this.text.textContent = this.words = words;
    }
  }

  class Scene {
    constructor(host, geometry) {
      this.svg = make("svg", {
        class: "replay-scene",
        role: "img",
        "aria-label": "The robot, the table and the person from the side",
      });
      host.appendChild(this.svg);
      this.look(VIEW);
      const svg = this.svg;
      const { floor, pedestal, grip, table } = geometry;
      const robotX = grip[0];
      const humanX = robotX + table;
      const shadow = (cx, rx) =>
        make("ellipse", { cx, cy: -floor, rx, ry: 0.028, class: "shadow" }, svg);
      make("ellipse", { cx: 0.53, cy: -floor, rx: 1.12, ry: 0.075, class: "stage" }, svg);
      shadow(0, 0.27);
      shadow(humanX + 0.42, 0.3);
      this.rulers(svg, robotX, humanX, grip[1]);
      this.ghost = make("g", { class: "replay-ghost" }, svg);
      this.partner = new Person(this.ghost, geometry, robotX, 1, "partner");
      const stone = { x: -0.15, y: -floor - pedestal, width: 0.28, height: pedestal, rx: 0.012 };
      this.pedestal = make("rect", { ...stone, class: "stone" }, svg);
      new Nao(svg, geometry);
      this.second = new Person(svg, geometry, robotX, 1, "partner");
      this.unknown = make("text", { x: -0.6, y: 0.12, class: "none" }, svg);
      this.person = new Person(svg, geometry, humanX, -1, "human");
      this.ghostTable = new Table(make("g", { class: "replay-ghost" }, svg), geometry, "ghost");
      this.table = new Table(svg, geometry, "real");
      this.arm = new NaoArm(svg, geometry);
      this.chains = new Map();
      for (const [name, robot] of Object.entries(geometry.robots)) {
        this.chains.set(name, new Chain(svg, robot, floor));
      }
      svg.appendChild(this.person.front); // The hands hold the table from both sides.
      this.intention = make("path", { d: "M0 0h.13", class: "intention" }, svg);
      this.intended = make("line", { class: "intended-pose none" }, svg);
      this.meant = make("path", { d: "M0 0h-.13", class: "intention none" }, svg);
      this.marks = {
        human: make("path", { d: "M0 0h.13", class: "mark human none" }, svg),
        robot: make("path", { d: "M0 0h-.13", class: "mark robot none" }, svg),
      };
      this.hurdles = make("g", {}, svg);
      this.aim = make("path", { d: "M-.03-.11h.06l-.03.05z", class: "aim none" }, this.table.group);
      const ball = (group) => make("circle", { r: 0.03, cy: -0.041, class: "ball none" }, group);
      this.ghostBall = ball(this.ghostTable.group);
      this.ball = ball(this.table.group);
      this.prediction = make("circle", { r: 0.017, class: "prediction" }, svg);
      this.level = new Level(svg);
      this.rest = grip[1];
      this.robotX = robotX;
      this.humanX = humanX;
      this.hold("");
    }

    // The visible part of the scene.
    look(view) {
      const { left, right, top, bottom } = view;
      this.view = view;
      this.svg.setAttribute("viewBox", `${left} ${-top} ${right - left} ${top - bottom}`);
    }

    // A scale at each end of the table.
    rulers(svg, robotX, humanX, rest) {
      this.labels = [];
      const group = make("g", { class: "replay-ruler" }, svg);
      for (const [x, way] of [[robotX + 0.07, 1], [humanX - 0.07, -1]]) {
        make("line", { x1: x, x2: x, y1: -rest, y2: -rest - 0.3, class: "pole" }, group);
        for (const mm of [0, 50, 100, 150, 200, 250, 300]) {
          const y = -rest - mm / 1000;
          const long = mm % 100 === 0;
          make("line", { x1: x, x2: x + way * (long ? 0.03 : 0.018), y1: y, y2: y }, group);
          if (mm % 300) continue;
          const anchor = way > 0 ? "start" : "end";
          const text = make("text", { x: x + way * 0.04, y, "text-anchor": anchor }, group);
          text.textContent = mm ? `${mm} mm` : "rest";
          this.labels.push(text);
        }
      }
    }

    // Letters keep their size in pixels, whatever the size of the picture.
    fit() {
      const width = this.svg.getBoundingClientRect().width;
      if (!width) return;
      const pixel = (this.view.right - this.view.left) / width;
      const size = (pixels) => Math.min(pixels * pixel, 0.075).toFixed(4);
      for (const label of this.labels) {
        label.classList.toggle("none", width < NARROW);
        label.setAttribute("font-size", size(LETTERS - 3));
        label.setAttribute("dy", 0.35 * size(LETTERS - 3));
      }
      for (const text of [this.level.text, this.unknown]) text.setAttribute("font-size", size(LETTERS + 1));
    }

    // The body at the robot's end: a NAO, "person", another robot by its name, or words on one
    // without a picture.
    hold(holder) {
      this.svg.classList.toggle("no-nao", Boolean(holder));
      const chain = this.chains.get(holder);
      for (const each of this.chains.values()) each.group.classList.toggle("none", each !== chain);
      this.held = chain || this.arm;
      const words = holder && !chain && holder !== "person" ? holder : "";
      this.second.group.classList.toggle("none", holder !== "person");
      this.pedestal.classList.toggle("none", holder === "person" || Boolean(chain));
      this.unknown.classList.toggle("none", !words);
      this.unknown.textContent = words;
    }

    // Hurdles, as bars beside the table: bold while they are open.
    bars(hurdles) {
      const ends = { x1: this.robotX + 0.05, x2: this.humanX - 0.05 };
      while (this.hurdles.children.length > hurdles.length) this.hurdles.lastChild.remove();
      hurdles.forEach(({ where, height, opens, closes }, i) => {
        const bar = this.hurdles.children[i] || make("line", ends, this.hurdles);
        const y = -(this.rest + height);
        bar.setAttribute("y1", y);
        bar.setAttribute("y2", y);
        bar.setAttribute("class", `hurdle ${where} ${opens <= 0 && closes > 0 ? "open" : "closed"}`);
      });
    }

    showGhost(shown) {
      this.svg.classList.toggle("no-ghost", !shown);
    }

    // Heights in m above rest; prediction may be null.
    pose(now) {
      this.table.pose(now.human, now.robot);
      this.person.pose(now.human);
      this.held.pose(now.robot);
      this.second.pose(now.robot);
      this.ghostTable.pose(now.ghostHuman, now.ghostRobot);
      this.partner.pose(now.ghostRobot);
      const humanHuman = now.ghostRobot - now.ghostHuman;
      this.level.pose(1000 * (now.robot - now.human), 1000 * humanHuman, now.over);
      const put = (node, x, height) =>
        node.setAttribute("transform", `translate(${x} ${-(this.rest + height)})`);
      this.intention.classList.toggle("none", now.target === null);
      if (now.target !== null) put(this.intention, this.humanX + 0.035, now.target);
      const drawn = now.drawn || [];
      const goal = colift.farGoal(drawn);
      const [place, aim] = colift.places(drawn);
      const [ghostPlace] = colift.places(now.ghostDrawn || []);
      for (const node of [this.meant, this.intended]) node.classList.toggle("none", !goal);
      if (goal) {
        put(this.meant, this.robotX - 0.035, goal.value);
        const ends = { x1: this.robotX, y1: -(this.rest + goal.value), x2: this.humanX, y2: -(this.rest + now.target) };
        for (const [name, value] of Object.entries(ends)) this.intended.setAttribute(name, value);
      }
      this.level.group.classList.toggle("none", Boolean(goal || aim));
      for (const [node, there] of [[this.ball, place], [this.ghostBall, ghostPlace]]) {
        node.classList.toggle("none", !there);
        if (there) node.setAttribute("cx", -this.table.length / 2 - there.value);
      }
      this.aim.classList.toggle("none", !aim);
      if (aim) this.aim.setAttribute("transform", `translate(${-this.table.length / 2 - aim.value} 0)`);
      for (const [end, x] of [["human", this.humanX + 0.035], ["robot", this.robotX - 0.035]]) {
        const mark = drawn.find((each) => each.where === end && !each.goal);
        this.marks[end].classList.toggle("none", !mark);
        if (mark) put(this.marks[end], x, mark.value);
      }
      this.bars(now.hurdles || []);
      this.prediction.classList.toggle("none", now.prediction === null);
      if (now.prediction !== null) put(this.prediction, this.humanX - 0.07, now.prediction);
    }
  }

  colift.Scene = Scene;
})();
