"use strict";
// The hand by arrow keys or by the stick of a gamepad: a velocity that changes smoothly, as samples
// at a fixed rate.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const SPEED = 0.15; // m/s
  const FASTER = 0.75; // m/s2
  const SLOWER = 1.5;
  const STEP_MS = 10;
  const DEAD = 0.12; // of a stick's range: it does not return exactly to 0
  const LONGEST_MS = 100; // a page that slept does not catch up

  // The movement: pure, so that it can be tested.
  class Steering {
    constructor(time) {
      this.time = time;
      this.height = 0;
      this.velocity = 0;
      this.wanted = 0; // -1 to 1
    }

    // Yield the samples up to a time.
    *until(now) {
      if (now - this.time > LONGEST_MS) this.time = now - STEP_MS;
      while (this.time + STEP_MS <= now) {
        this.time += STEP_MS;
        const goal = SPEED * this.wanted;
        const rate = Math.abs(goal) < Math.abs(this.velocity) ? SLOWER : FASTER;
        const most = (rate * STEP_MS) / 1000;
        this.velocity += Math.min(Math.max(goal - this.velocity, -most), most);
        this.height = play.Hand.within(this.height + (this.velocity * STEP_MS) / 1000);
        yield [this.time, this.height];
      }
    }
  }

  class Keys {
    // asked and told: as of Pointer.
    constructor(area, asked, told) {
      this.asked = asked;
      this.told = told;
      this.steering = null;
      this.pressed = { up: false, down: false };
      this.button = false;
      area.addEventListener("keydown", (event) => this.key(event, true));
      area.addEventListener("keyup", (event) => this.key(event, false));
      area.addEventListener("blur", () => (this.pressed = { up: false, down: false }));
      window.addEventListener("gamepadconnected", () => told.pad());
      setInterval(() => this.tick(), STEP_MS);
    }

    key(event, down) {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const way = { ArrowUp: "up", ArrowDown: "down" }[event.key];
      const lets = event.key === "Escape" && this.steering;
      if (way) this.pressed[way] = down;
      else if (event.key !== " " && !lets) return;
      event.preventDefault();
      if (!way && down && !event.repeat) this.toggle("keyboard");
    }

    toggle(preset) {
      if (this.steering) {
        this.end();
        this.told.release();
      } else this.grip(preset);
    }

    grip(preset) {
      if (!this.asked.may()) return;
      const now = performance.now();
      this.steering = new Steering(now);
      this.told.grip(now, { preset, unit: "s", metres_per_unit: SPEED, unadjusted: false });
    }

    pad() {
      const pads = this.asked.pad() && navigator.getGamepads ? navigator.getGamepads() : [];
      return [...pads].find((pad) => pad && pad.connected) || null;
    }

    tick() {
      const pad = this.pad();
      const pressed = Boolean(pad && pad.buttons[0] && pad.buttons[0].pressed);
      if (pressed && !this.button) this.toggle("gamepad");
      this.button = pressed;
      if (!this.steering) return;
      const stick = pad && Math.abs(pad.axes[1]) > DEAD ? -pad.axes[1] : 0;
      this.steering.wanted = stick || Number(this.pressed.up) - Number(this.pressed.down);
      for (const [time, height] of this.steering.until(performance.now())) this.told.move(time, height);
    }

    end() {
      this.steering = null;
    }
  }

  play.Steering = Steering;
  play.Keys = Keys;
})();
