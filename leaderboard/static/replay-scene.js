"use strict";
// The lift from the side: robot, table, person, and the human-human baseline as a ghost.
// Lengths are in m; x goes from the robot to the human, z upwards (see replays/geometry.py).
(function () {
  const SVG = "http://www.w3.org/2000/svg";
  const VIEW = { left: -0.66, right: 1.72, top: 0.93, bottom: -0.95 };
  const LEVEL = { x: 0.56, z: 0.7, half: 0.36, height: 0.085, full: 40 };
  const LETTERS = 13; // pixels
  const NARROW = 480; // pixels: below it there is no room for numbers in the scene
  const ARC = 20; // pieces of a half circle

  function make(name, attributes, parent) {
    const node = document.createElementNS(SVG, name);
    for (const key of Object.keys(attributes || {})) node.setAttribute(key, attributes[key]);
    if (parent) parent.appendChild(node);
    return node;
  }

  // A tapered rod between two balls, as a path; `depth` is its width as a fraction.
  function rod(a, b, depth) {
    const length = Math.hypot(b.x - a.x, b.z - a.z);
    const slope = length > Math.abs(a.r - b.r) ? Math.asin((a.r - b.r) / length) : 0;
    const along = length ? { x: (b.x - a.x) / length, z: (b.z - a.z) / length } : { x: 0, z: 1 };
    const points = [];
    for (const [ball, from, to] of [
      [{ v: length, r: b.r }, slope, Math.PI - slope],
      [{ v: 0, r: a.r }, Math.PI - slope, 2 * Math.PI + slope],
    ]) {
      for (let i = 0; i <= ARC; i++) {
        const angle = from + ((to - from) * i) / ARC;
        const u = depth * ball.r * Math.cos(angle);
        const v = ball.v + ball.r * Math.sin(angle);
        points.push([a.x + u * along.z + v * along.x, a.z - u * along.x + v * along.z]);
      }
    }
    return "M" + points.map(([x, z]) => x.toFixed(4) + " " + (-z).toFixed(4)).join("L") + "Z";
  }

  // Neighbours of one colour: drawn with all outlines first, they melt into one shape.
  function groups(body) {
    const found = [];
    for (const part of body) {
      const last = found[found.length - 1];
      if (last && last[0][7] === part[7]) last.push(part);
      else found.push([part]);
    }
    return found;
  }

  // Where the joints of an arm are when its hands are at a height above rest.
  function armAt(arm, height) {
    const last = arm.rows.length - 1;
    const place = Math.min(Math.max((height - arm.lowest) / arm.step, 0), last);
    const row = Math.min(Math.floor(place), last - 1);
    const part = place - row;
    return arm.rows[row].map((low, i) => {
      const high = arm.rows[row + 1][i];
      return { x: low[0] + part * (high[0] - low[0]), z: low[1] + part * (high[1] - low[1]) };
    });
  }

  class Person {
    constructor(parent, geometry, x, facing, kind) {
      this.group = make("g", { class: "replay-person " + kind }, parent);
      this.arm = geometry.person.arm;
      this.at = (p) => ({ x: x + facing * p.x, z: geometry.floor + p.z });
      for (const parts of groups(geometry.person.body)) {
        const paths = parts.map(([x0, z0, r0, x1, z1, r1, depth]) =>
          rod({ ...this.at({ x: x0, z: z0 }), r: r0 }, { ...this.at({ x: x1, z: z1 }), r: r1 }, depth)
        );
        const paint = "paint-" + parts[0][7];
        for (const kind of ["outline", paint]) {
          for (const d of paths) make("path", { d, class: kind }, this.group);
        }
      }
      const part = (paint) => make("path", { class: "paint-" + paint }, this.front);
      this.front = make("g", { class: "replay-front" }, this.group);
      this.limbs = ["shirt", "skin", "skin"].map(part);
    }

    pose(height) {
      const [shoulder, elbow, wrist, hand] = armAt(this.arm, height).map(this.at);
      const draw = (limb, a, ra, b, rb) =>
        limb.setAttribute("d", rod({ ...a, r: ra }, { ...b, r: rb }, 1));
      draw(this.limbs[0], shoulder, 0.066, elbow, 0.046);
      draw(this.limbs[1], elbow, 0.042, wrist, 0.03);
      draw(this.limbs[2], wrist, 0.035, hand, 0.033);
    }
  }

  class Nao {
    constructor(parent, geometry) {
      for (const link of geometry.nao.body) {
        const group = make("g", { class: "replay-nao" }, parent);
        for (const kind of ["outline", ""]) {
          for (const [x, z, w, h, turn, rx, paint] of link) {
            const place = { x: x - w / 2, y: -z - h / 2, width: w, height: h, rx };
            const turned = { transform: `rotate(${turn} ${x} ${-z})` };
            make("rect", { ...place, ...turned, class: kind || "paint-" + paint }, group);
          }
        }
      }
    }
  }

  class NaoArm {
    constructor(parent, geometry) {
      this.arm = geometry.nao.arm;
      const group = make("g", { class: "replay-nao" }, parent);
      const part = (paint) => make("path", { class: "paint-" + paint }, group);
      this.parts = ["white", "orange", "grey", "white", "orange", "white"].map(part);
    }

    pose(height) {
      const [shoulder, elbow, wrist, hand] = armAt(this.arm, height);
      const between = (a, b, t) => ({ x: a.x + t * (b.x - a.x), z: a.z + t * (b.z - a.z) });
      const draw = (i, a, ra, b, rb) =>
        this.parts[i].setAttribute("d", rod({ ...a, r: ra }, { ...b, r: rb }, 1));
      draw(0, shoulder, 0.036, elbow, 0.026);
      draw(1, shoulder, 0.019, shoulder, 0.019);
      draw(2, elbow, 0.0255, elbow, 0.0255);
      draw(3, between(elbow, wrist, 0.25), 0.027, wrist, 0.025);
      draw(4, between(wrist, hand, 0.05), 0.022, between(wrist, hand, 0.2), 0.022);
      draw(5, between(wrist, hand, 0.45), 0.02, hand, 0.017);
    }
  }

  // The table between its two ends; with one shape for the board and one for each end's colour.
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

  // A spirit level: its bubble goes to the higher end, far enough to be seen.
  class Level {
    constructor(parent) {
      const { x, z, half, height } = LEVEL;
      const group = make("g", { class: "replay-level" }, parent);
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
      this.text.textContent = over ? "the lift is over" : coliftReplay.differenceWords(difference);
    }
  }

  class Scene {
    constructor(host, geometry) {
      const { left, right, top, bottom } = VIEW;
      this.svg = make("svg", {
        class: "replay-scene",
        viewBox: `${left} ${-top} ${right - left} ${top - bottom}`,
        role: "img",
        "aria-label": "The robot, the table and the person from the side",
      });
      host.appendChild(this.svg);
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
      make(
        "rect",
        { x: -0.15, y: -floor - pedestal, width: 0.28, height: pedestal, rx: 0.012, class: "stone" },
        svg
      );
      new Nao(svg, geometry);
      this.person = new Person(svg, geometry, humanX, -1, "human");
      this.ghostTable = new Table(make("g", { class: "replay-ghost" }, svg), geometry, "ghost");
      this.table = new Table(svg, geometry, "real");
      this.arm = new NaoArm(svg, geometry);
      svg.appendChild(this.person.front); // The hands hold the table from both sides.
      this.intention = make("path", { d: "M0 0h.13", class: "intention" }, svg);
      this.prediction = make("circle", { r: 0.017, class: "prediction" }, svg);
      this.level = new Level(svg);
      this.rest = grip[1];
      this.robotX = robotX;
      this.humanX = humanX;
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
      const pixel = (VIEW.right - VIEW.left) / width;
      const size = (pixels) => Math.min(pixels * pixel, 0.075).toFixed(4);
      for (const label of this.labels) {
        label.classList.toggle("none", width < NARROW);
        label.setAttribute("font-size", size(LETTERS - 3));
        label.setAttribute("dy", 0.35 * size(LETTERS - 3));
      }
      this.level.text.setAttribute("font-size", size(LETTERS + 1));
    }

    showGhost(shown) {
      this.svg.classList.toggle("no-ghost", !shown);
    }

    // Heights in m above rest; prediction may be null.
    pose(now) {
      this.table.pose(now.human, now.robot);
      this.person.pose(now.human);
      this.arm.pose(now.robot);
      this.ghostTable.pose(now.ghostHuman, now.ghostRobot);
      this.partner.pose(now.ghostRobot);
      const humanHuman = now.ghostRobot - now.ghostHuman;
      this.level.pose(1000 * (now.robot - now.human), 1000 * humanHuman, now.over);
      const put = (node, x, height) =>
        node.setAttribute("transform", `translate(${x} ${-(this.rest + height)})`);
      put(this.intention, this.humanX + 0.035, now.target);
      this.prediction.classList.toggle("none", now.prediction === null);
      if (now.prediction !== null) put(this.prediction, this.humanX - 0.07, now.prediction);
    }
  }

  window.coliftReplay = window.coliftReplay || {};
  window.coliftReplay.Scene = Scene;
  window.coliftReplay.make = make;
})();
