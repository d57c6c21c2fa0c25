"use strict";
// The words of the player of replays, and how it makes elements.
(function () {
  const colift = (window.coliftReplay = window.coliftReplay || {});

  colift.WHICH = { best: "best", median: "typical", worst: "worst" };
  colift.SHOWN = { best: "the best", median: "a typical one (the median)", worst: "the worst" };
  colift.BEHAVIOURS = {
    smooth: "lifts and lowers smoothly",
    pause: "stops on the way, and goes on",
    jerky: "lifts in jerks",
    changing_goal: "changes the goal on the way",
    together: "moves both ends alike",
    pivot: "moves the own end alone, as to pour",
    counter: "turns the table about its middle",
    switching: "changes the intent half-way",
    recorded: "repeats a recorded lift",
    cued: "follows cues",
    played: "lifted live",
  };
  const EVENTS = {
    ready: "waits",
    rise: "lifts",
    brake: "brakes",
    pause: "stands still",
    resume: "goes on",
    reverse: "turns back",
    undershoot: "aims lower",
    overshoot: "aims higher",
    replan: "heads for the new goal",
    hold: "holds",
    lower: "lowers",
    rest: "rests",
  };

  colift.words = (text) => text.replaceAll("_", " ");

  colift.eventWords = (name) => EVENTS[name] || colift.words(name);

  colift.number = (value, places) => value.toFixed(places).replace(/^-(?=0\.?0*$)/, "").replace("-", "−");

  colift.differenceWords = function (millimetres, none = "level") {
    const whole = Math.round(Math.abs(millimetres));
    if (!whole) return none;
    return `robot ${whole} mm too ${millimetres < 0 ? "low" : "high"}`;
  };

  colift.element = function (name, attributes, ...children) {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
      if (key === "class") node.className = value;
      else node.setAttribute(key, value);
    }
    node.append(...children);
    return node;
  };
})();
