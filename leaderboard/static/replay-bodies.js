"use strict";
// The bodies of the lift from the side: people, the NAO and its arm.
(function () {
  const SVG = "http://www.w3.org/2000/svg";
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

  // The places of the joints of an arm whose hands are at a height above rest.
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

  // A part of an arm. Its outline is drawn once, along x; after that it is only moved, turned and
  // stretched, which is fast in any browser.
  class Limb {
    constructor(parent, paint, ra, rb) {
      this.path = make("path", { class: "paint-" + paint }, parent);
      this.radii = [ra, rb];
      this.length = null;
    }

    pose(a, b) {
      const length = Math.hypot(b.x - a.x, b.z - a.z);
      if (this.length === null) {
        const [ra, rb] = this.radii;
        this.length = length;
        this.path.setAttribute("d", rod({ x: 0, z: 0, r: ra }, { x: length, z: 0, r: rb }, 1));
      }
      const turn = (-Math.atan2(b.z - a.z, b.x - a.x) * 180) / Math.PI;
      const stretch = this.length ? length / this.length : 1;
      const to = `translate(${a.x.toFixed(5)} ${(-a.z).toFixed(5)})`;
      const transform = `${to} rotate(${turn.toFixed(3)}) scale(${stretch.toFixed(5)} 1)`;
      if (transform === this.shown) return;
      this.shown = transform;
      this.path.setAttribute("transform", transform);
    }
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
      this.front = make("g", { class: "replay-front" }, this.group);
      const limb = (paint, ra, rb) => new Limb(this.front, paint, ra, rb);
      this.upper = limb("shirt", 0.066, 0.046);
      this.lower = limb("skin", 0.042, 0.03);
      this.hand = limb("skin", 0.035, 0.033);
    }

    pose(height) {
      const [shoulder, elbow, wrist, hand] = armAt(this.arm, height).map(this.at);
      this.upper.pose(shoulder, elbow);
      this.lower.pose(elbow, wrist);
      this.hand.pose(wrist, hand);
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
      this.parts = [
        ["white", 0.036, 0.026],
        ["orange", 0.019, 0.019],
        ["grey", 0.0255, 0.0255],
        ["white", 0.027, 0.025],
        ["orange", 0.022, 0.022],
        ["white", 0.02, 0.017],
      ].map(([paint, ra, rb]) => new Limb(group, paint, ra, rb));
    }

    pose(height) {
      const [shoulder, elbow, wrist, hand] = armAt(this.arm, height);
      const between = (a, b, t) => ({ x: a.x + t * (b.x - a.x), z: a.z + t * (b.z - a.z) });
      const ends = [
        [shoulder, elbow],
        [shoulder, shoulder],
        [elbow, elbow],
        [between(elbow, wrist, 0.25), wrist],
        [between(wrist, hand, 0.05), between(wrist, hand, 0.2)],
        [between(wrist, hand, 0.45), hand],
      ];
      this.parts.forEach((part, i) => part.pose(...ends[i]));
    }
  }

  // A robot arm as a chain of links, on a pedestal.
  class Chain {
    constructor(parent, robot, floor) {
      this.arm = robot.arm;
      this.group = make("g", { class: "replay-chain none" }, parent);
      const [x, top] = robot.foot;
      const stone = { x: x - 0.14, y: -top, width: 0.28, height: top - floor, rx: 0.012 };
      make("rect", { ...stone, class: "stone" }, this.group);
      const links = robot.arm.rows[0].length - 1;
      const radius = (i) => 0.065 - (0.04 * i) / links;
      this.links = [...Array(links).keys()].map(
        (i) => new Limb(this.group, i % 2 ? "orange" : "grey", radius(i), radius(i + 1))
      );
    }

    pose(height) {
      const places = armAt(this.arm, height);
      this.links.forEach((link, i) => link.pose(places[i], places[i + 1]));
    }
  }

  const colift = (window.coliftReplay = window.coliftReplay || {});
  Object.assign(colift, { make, Chain, Nao, NaoArm, Person });
})();
