"use strict";
// The hand by mouse, finger or pen: every sample that the browser has, with its own time.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const METRES_PER_COUNT = 0.0002;
  const RAW = "onpointerrawupdate" in window;
  const MOVES = RAW ? "pointerrawupdate" : "pointermove";
  const AGAIN_MS = 3000;
  const CLICK_MS = 500;
  const HOLD = "This browser does not lock the mouse. Hold its button down on the picture.";

  const samplesOf = (event) => {
    const found = event.getCoalescedEvents ? event.getCoalescedEvents() : [];
    return found.length ? found : [event];
  };

  class Pointer {
    // area: the element that is pressed. asked: {mouse(): whether the mouse is the input, gain(),
    // pixelsPerMetre(), may(): whether a grip is possible now}. told: {grip(time, input),
    // move(time, height), release(), say(sentence)}.
    constructor(area, asked, told) {
      this.area = area;
      this.asked = asked;
      this.told = told;
      this.height = 0;
      this.held = null; // the pointer that is held down on the area
      this.refused = this.opened = -Infinity;
      this.lockable = "requestPointerLock" in area;
      area.addEventListener("pointerdown", (event) => this.down(event));
      area.addEventListener("click", (event) => this.click(event));
      area.addEventListener("contextmenu", (event) => event.preventDefault());
      for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
        area.addEventListener(end, (event) => event.pointerId === this.held && this.let());
      }
      // While the pointer is locked, events also go to the area.
      area.addEventListener(MOVES, (event) => this.move(event));
      document.addEventListener("pointerlockchange", () => this.lockChanged());
    }

    get locked() {
      return document.pointerLockElement === this.area;
    }

    // The button or the click of a mouse: takes the pointer, which closes the hand.
    async lock() {
      if (this.locked || !this.asked.may()) return;
      if (!this.lockable) {
        this.told.say(HOLD);
        return;
      }
      for (const options of [{ unadjustedMovement: true }, undefined]) {
        try {
          this.raw = Boolean(options);
          await this.area.requestPointerLock(options);
          return;
        } catch (error) {
          if (error.name === "NotSupportedError") continue;
          const before = this.refused;
          this.refused = performance.now();
          if (this.refused - before < AGAIN_MS) break;
          this.told.say("The browser did not lock the mouse. Wait a second, then click again.");
          return;
        }
      }
      this.lockable = false;
      this.told.say(HOLD);
    }

    lockChanged() {
      if (this.locked) {
        this.height = 0;
        this.told.grip(performance.now(), {
          preset: "mouse",
          unit: "count",
          metres_per_unit: METRES_PER_COUNT * this.asked.gain(),
          unadjusted: this.raw,
        });
      } else this.told.release();
    }

    click(event) {
      const own = event.timeStamp - this.opened < CLICK_MS; // of the press that let go
      if (event.pointerType === "mouse" && this.asked.mouse() && !own) this.lock();
    }

    down(event) {
      if (this.locked) {
        this.opened = event.timeStamp;
        document.exitPointerLock();
        return;
      }
      const mouse = event.pointerType === "mouse";
      if (event.button !== 0 || this.held !== null || !this.asked.may()) return;
      if (mouse && (!this.asked.mouse() || this.lockable)) return;
      event.preventDefault();
      this.area.focus({ preventScroll: true });
      this.area.setPointerCapture(event.pointerId);
      this.held = event.pointerId;
      this.y = event.clientY;
      this.scale = 1 / this.asked.pixelsPerMetre();
      this.told.grip(event.timeStamp, {
        preset: event.pointerType,
        unit: "px",
        metres_per_unit: this.scale,
        unadjusted: false,
      });
    }

    move(event) {
      if (this.locked) {
        const gain = METRES_PER_COUNT * this.asked.gain();
        for (const each of samplesOf(event)) {
          this.height = play.Hand.within(this.height - each.movementY * gain);
          this.told.move(each.timeStamp, this.height);
        }
      } else if (event.pointerId === this.held) {
        for (const each of samplesOf(event)) {
          this.told.move(each.timeStamp, (this.y - each.clientY) * this.scale);
        }
      }
    }

    let() {
      this.held = null;
      this.told.release();
    }

    // The lift is over: the mouse belongs to the whole page again.
    end() {
      if (this.held !== null && this.area.hasPointerCapture(this.held)) this.area.releasePointerCapture(this.held);
      this.held = null;
      if (this.locked) document.exitPointerLock();
    }
  }

  play.Pointer = Pointer;
})();
