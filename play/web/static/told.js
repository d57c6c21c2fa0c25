"use strict";
// Messages to the person: the state, faults, and buttons that lead on.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const FAULT_MS = 6000;

  const at = (id) => document.getElementById(id);

  const NEAR = 0.001; // m: no way to go

  // What to do when a goal appears; both heights in m above rest.
  play.goalWords = function (goal, hand) {
    if (Math.abs(goal) < NEAR) return "Back to rest.";
    return `${goal < hand ? "Lower" : "Lift"} to the line.`;
  };

  class Told {
    // A screen reader reads each new sentence once.
    say(sentence) {
      if (at("status").textContent !== sentence) at("status").textContent = sentence;
    }

    // The server refused something; the session goes on.
    fault(sentence) {
      at("fault").textContent = `${sentence[0].toUpperCase()}${sentence.slice(1)}.`;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => (at("fault").textContent = ""), FAULT_MS);
    }

    // A button that leads on; null hides it.
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
