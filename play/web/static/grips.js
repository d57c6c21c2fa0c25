"use strict";
// All hands of a page: the one that closes makes the lift.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const at = (id) => document.getElementById(id);

  class Hands {
    constructor(page) {
      this.page = page;
      const { input, lifting, stage, told } = page;
      const asked = {
        may: () => page.may,
        mouse: () => input.preset === "mouse",
        pad: () => input.preset === "gamepad",
        gain: () => input.gain,
        pixelsPerMetre: () => stage.pixelsPerMetre,
      };
      const does = {
        grip: (_, device) => {
          page.begins();
          lifting.grip({ ...device, pixels_per_metre: stage.pixelsPerMetre, card_px: input.card });
        },
        move: (time, height) => lifting.move(time, height),
        release: () => lifting.release(),
        say: (sentence) => told.say(sentence),
        pad: () => told.say("A gamepad is connected: choose it as input to lift with its left stick."),
      };
      this.pointer = new play.Pointer(at("stage"), asked, does);
      this.keys = new play.Keys(at("stage"), asked, does);
      at("lift").addEventListener("click", (event) => this.press(event));
    }

    // The button: what it does depends on the input, and on what has pressed it.
    press(event) {
      const { preset } = this.page.input;
      at("stage").focus({ preventScroll: true });
      if (preset === "mouse" && event.detail > 0) this.pointer.lock();
      else if (preset !== "touch") this.keys.grip(preset === "gamepad" ? "gamepad" : "keyboard");
    }

    end() {
      this.pointer.end();
      this.keys.end();
    }
  }

  play.Hands = Hands;
})();
