"use strict";
// The picture during a lift: the scene of replays seen from nearer, the goal, and the handle.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});
  const { make, Person, Scene } = window.coliftReplay;

  const ACROSS = 1.3; // m
  const ACROSS_NARROW = 1.1;
  const NARROW = 620; // px
  const LEAST_HEIGHT = 0.72; // m
  const HIGH = 0.945; // m: any height beyond it is added above and below
  const BOTTOM = -0.28;
  const LEVEL_Z = 0.7; // where the scene has its spirit level
  const LEVEL_HIGHEST = 0.58; // not too far from the table to be seen with it
  const LETTERS = 14; // px
  const ASIDE = 0.11; // m: the handle is beside the hand that it pulls

  class Stage {
    constructor(host, geometry) {
      this.host = host;
      this.rest = geometry.grip[1];
      this.middle = geometry.grip[0] + geometry.table / 2;
      this.ends = { human: geometry.grip[0] + geometry.table, far: geometry.grip[0] };
      this.scene = new Scene(host, geometry);
      this.scene.svg.classList.add("play-scene", "no-ghost");
      this.scene.prediction.classList.add("none");
      this.scene.intention.classList.add("none");
      const { svg } = this.scene;
      const far = make("g", { class: "play-far" });
      svg.insertBefore(far, this.scene.table.group);
      this.far = new Person(far, geometry, this.ends.far, 1, "far");
      svg.appendChild(this.far.front);
      this.far.front.classList.add("play-far");
      this.goal = make("g", { class: "play-goal none" }, svg);
      make("path", { d: `M${this.ends.far - 0.1} 0H${this.ends.human + 0.1}` }, this.goal);
      this.goalText = make("text", { x: this.middle, y: -0.018, "text-anchor": "middle" }, this.goal);
      this.countdown = make("g", { class: "play-count none", "aria-hidden": "true" }, svg);
      make("circle", { r: 0.07 }, this.countdown);
      this.countText = make("text", { y: 0.032 }, this.countdown);
      this.countdown.setAttribute("transform", `translate(${this.middle} ${-(this.rest + 0.16)})`);
      this.handle = make("g", { class: "play-handle none" }, svg);
      make("path", { d: "M-.06 0H.06" }, this.handle);
      make("circle", { r: 0.012 }, this.handle);
      this.shown = {};
      this.scene.hold(geometry.robot || "");
      this.holder = this.scene.held;
      this.seat("human");
      this.pose(0, 0);
      new ResizeObserver(() => this.fit()).observe(host);
      this.fit();
    }

    // Fill the available space; a metre has the same number of pixels in both directions.
    fit() {
      const { clientWidth: width, clientHeight: height } = this.host;
      if (!width || !height) return;
      let across = width < NARROW ? ACROSS_NARROW : ACROSS;
      across = Math.max(across, (LEAST_HEIGHT * width) / height);
      this.pixelsPerMetre = width / across;
      const high = height / this.pixelsPerMetre;
      const bottom = BOTTOM - (high - HIGH) / 2.4;
      const top = bottom + high;
      this.scene.look({ left: this.middle - across / 2, right: this.middle + across / 2, top, bottom });
      this.scene.fit();
      const letters = (LETTERS / this.pixelsPerMetre).toFixed(4);
      this.goalText.setAttribute("font-size", letters);
      this.scene.level.text.setAttribute("font-size", letters);
      const lower = LEVEL_Z - Math.min(top - 0.07, LEVEL_HIGHEST);
      this.scene.level.group.setAttribute("transform", `translate(0 ${lower})`);
    }

    // For a screen reader; holds: whether this person has an end of the table.
    name(holds) {
      this.host.setAttribute("aria-label", holds ? "Your end of the table" : "The table");
      if (holds) this.host.setAttribute("aria-describedby", "how");
      else this.host.removeAttribute("aria-describedby");
    }

    // seat: the end that this person holds, "human" or "far"; null for a spectator.
    seat(seat) {
      if (this.at === seat) return;
      this.at = seat;
      this.handle.classList.toggle("far", seat === "far");
      this.shown.handle = undefined;
      this.reach(0);
    }

    // A person holds the far end, or the robot does.
    company(person) {
      this.scene.svg.classList.toggle("far-person", person);
      this.holder = person ? this.far : this.scene.held;
      this.holder.pose(this.shown.robot);
    }

    // Heights in m above rest, both of the same moment.
    pose(human, robot) {
      const { shown, scene } = this;
      if (shown.human === human && shown.robot === robot) return;
      shown.human = human;
      shown.robot = robot;
      scene.table.pose(human, robot);
      scene.person.pose(human);
      this.holder.pose(robot);
      scene.level.pose(1000 * (robot - human), 0, false);
    }

    // Where the hand pulls now: drawn at once, and apart from the table.
    reach(height) {
      if (this.shown.handle === height || !this.at) return;
      this.shown.handle = height;
      const x = this.ends[this.at] + (this.at === "far" ? -ASIDE : ASIDE);
      this.handle.setAttribute("transform", `translate(${x} ${-(this.rest + height)})`);
    }

    grip(closed) {
      this.handle.classList.toggle("none", !closed || !this.at);
    }

    // Seconds until the first goal appears; 0 shows none.
    count(seconds) {
      this.countdown.classList.toggle("none", !seconds);
      this.countText.textContent = seconds || "";
    }

    // The goal is the leader's alone; null hides it.
    aim(height) {
      if (this.shown.goal === height) return;
      this.shown.goal = height;
      this.goal.classList.toggle("none", height === null);
      if (height === null) return;
      this.goal.setAttribute("transform", `translate(0 ${-(this.rest + height)})`);
      this.goalText.textContent = height > 0.001 ? "to this line" : "back to rest";
    }
  }

  play.Stage = Stage;
})();
