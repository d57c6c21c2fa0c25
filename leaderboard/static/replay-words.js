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
    pivot: "moves only the human's end, as if to pour",
    counter: "turns the table about its middle",
    switching: "changes the intent halfway",
    abreast: "has a hurdle to pass while the robot has another",
    ahead: "has a hurdle to pass a little before the robot's",
    behind: "has a hurdle to pass a little after the robot's",
    own_hurdle: "has a hurdle to pass, while the robot has none",
    other_hurdle: "has no hurdle, while the robot has one",
    no_hurdle: "has no hurdle to pass, like the robot",
    ball_smooth: "lifts smoothly, and alone knows where the ball should be",
    ball_pause: "stops on the way, and alone knows where the ball should be",
    ball_smooth_shared: "lifts smoothly, and knows, like the robot, where the ball should be",
    ball_pause_shared: "stops on the way, and knows, like the robot, where the ball should be",
    habitual: "lifts as usual, and remembers the lifts before",
    recorded: "repeats a recorded lift",
    as_recorded: "repeats a recorded lift at its own size and pace",
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
    target: "new target",
  };

  // The goals of a live lift, and the people in it, by the names in its files.
  const KINDS = { smooth: "up and down", pause: "with a stop", changing_goal: "that change" };
  const PARTNERS = { person: "another person", person_as_robot: "a person as robot", simulated_person: "a simulated person" };

  colift.words = (text) => text.replaceAll("_", " ");

  // Of a live lift: its number and its goals, from its trial, such as 001-smooth; and its partner.
  colift.liveWords = function (trial) {
    const [, number, kind] = /^(\d+)-(.+)$/.exec(trial) || [];
    return number ? `live lift ${Number(number)}, with goals ${KINDS[kind] || colift.words(kind)}` : `live lift ${trial}`;
  };
  colift.partnerWords = (name) => PARTNERS[name] || name;

  colift.eventWords = (name) => EVENTS[name] || colift.words(name);

  colift.number = (value, places) => value.toFixed(places).replace(/^-(?=0\.?0*$)/, "").replace("-", "−");

  colift.differenceWords = function (millimetres, none = "level") {
    const whole = Math.round(Math.abs(millimetres));
    if (!whole) return none;
    return `robot ${whole} mm too ${millimetres < 0 ? "low" : "high"}`;
  };

  colift.hurdleWords = ({ label, missed }) =>
    missed === null ? `${label} not reached` : `${label} missed by ${Math.round(1000 * missed)} mm`;

  // When a hurdle opens; its height while it is open; then by how much it was missed.
  colift.hurdleState = function ({ height, missed, opens, closes }) {
    if (opens > 0) return `in ${opens.toFixed(1)} s`;
    if (closes > 0) return `${Math.round(1000 * height)} mm`;
    return missed === null ? "missed" : `off ${Math.round(1000 * missed)} mm`;
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
