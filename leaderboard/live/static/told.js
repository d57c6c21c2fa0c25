"use strict";
// What a person is told: a sentence on the state of things, faults, and ways out of dead ends.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const FAULT_MS = 6000;

  const at = (id) => document.getElementById(id);

  class Told {
    // A screen reader reads each new sentence once.
    say(sentence) {
      if (at("status").textContent !== sentence) at("status").textContent = sentence;
    }

    // The server did not take something; the session goes on.
    fault(sentence) {
      at("fault").textContent = `${sentence[0].toUpperCase()}${sentence.slice(1)}.`;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => (at("fault").textContent = ""), FAULT_MS);
    }

    // A button that leads on; null takes it away.
    offer(words, does) {
      const button = at("action");
      button.hidden = words === null;
      button.textContent = words || "";
      button.onclick = () => {
        button.hidden = true;
        does();
      };
    }
  }

  play.Told = Told;
})();
