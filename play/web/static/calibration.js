"use strict";
// The input: its kind, its gain, and the true size of this screen.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const KEPT = "colift-play-input";
  const CARD_MM = 85.6; // ISO/IEC 7810 ID-1: every bank card
  const COUNTS_PER_METRE_800 = 800 / 0.0254; // an ordinary mouse
  const STEERED = ["keyboard", "gamepad"];

  const read = (store, key) => {
    try {
      return JSON.parse(store.getItem(key)) || {};
    } catch {
      return {}; // Storage may be forbidden.
    }
  };
  const write = (store, key, value) => {
    try {
      store.setItem(key, JSON.stringify(value));
    } catch {
      // The page works without it.
    }
  };
  Object.assign(play, { read, write });

  class Input {
    // form: the inputs; stage: knows the pixels of a metre; steer(): a person has chosen to lift by
    // keys or a gamepad.
    constructor(form, stage, steer) {
      this.form = form;
      this.stage = stage;
      this.card = null;
      const kept = read(localStorage, KEPT);
      const coarse = window.matchMedia("(pointer: coarse)").matches;
      const wanted = ["mouse", "touch", "keyboard", "gamepad"].includes(kept.preset) ? kept.preset : coarse ? "touch" : "mouse";
      form.elements.preset.value = wanted;
      form.elements.gain.value = Math.log2(kept.gain || 1);
      if (kept.card_px) {
        this.card = kept.card_px;
        form.elements.card.value = kept.card_px;
      }
      form.addEventListener("input", (event) => {
        if (event.target === form.elements.card) this.card = Number(form.elements.card.value);
        write(localStorage, KEPT, { preset: this.preset, gain: this.gain, card_px: this.card });
        this.show();
      });
      form.addEventListener("submit", (event) => event.preventDefault());
      this.listen(steer);
      this.show();
    }

    // A pointer, Space or Enter makes a choice. The arrow keys only go through the choices: browsers
    // report that as a click, too.
    listen(steer) {
      let passing = false;
      const made = (event) => event.target.name === "preset" && this.steered && steer();
      this.form.addEventListener("pointerdown", () => (passing = false));
      this.form.addEventListener("keydown", (event) => {
        passing = event.key.startsWith("Arrow");
        if (![" ", "Enter"].includes(event.key) || !event.target.checked) return;
        event.preventDefault();
        made(event);
      });
      this.form.addEventListener("click", (event) => passing || made(event));
    }

    // Whether the keys of the stage, or a gamepad, move the table.
    get steered() {
      return STEERED.includes(this.preset);
    }

    get preset() {
      return this.form.elements.preset.value;
    }

    get gain() {
      return 2 ** Number(this.form.elements.gain.value);
    }

    show() {
      const { form, preset } = this;
      form.querySelector("[data-for=gain]").hidden = preset !== "mouse";
      form.querySelector("[data-for=card]").hidden = preset !== "touch";
      const counts = 0.2 / (0.0002 * this.gain);
      const centimetres = (100 * counts) / COUNTS_PER_METRE_800;
      form.querySelector("#gain-says").textContent =
        `20 cm of the table are ${Math.round(counts)} counts: about ${centimetres.toFixed(1)} cm with an 800 dpi mouse.`;
      const card = form.querySelector("#card-size");
      const px = Number(form.elements.card.value);
      card.setAttribute("width", px);
      card.setAttribute("height", px * (53.98 / CARD_MM));
      const scale = this.stage() && this.stage().pixelsPerMetre;
      form.querySelector("#card-says").textContent =
        this.card && scale
          ? `20 cm of the table are ${((0.2 * scale * CARD_MM) / this.card / 10).toFixed(1)} cm of your finger.`
          : "Not set yet; lifts also count without it.";
      for (const each of document.querySelectorAll("[data-how]")) each.hidden = each.dataset.how !== preset;
    }
  }

  play.Input = Input;
})();
