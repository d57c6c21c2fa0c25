"use strict";
// A lift as the player of replays shows it, from what replays/replay.py packs.
(function () {
  const UNIT = 1e-4; // m

  const colift = (window.coliftReplay = window.coliftReplay || {});

  // From the first height and the changes to heights in m.
  function heights(changes) {
    let sum = 0;
    return changes.map((change) => (sum += change) * UNIT);
  }

  colift.decoded = function (replay) {
    const scaled = (values, unit) => values && values.map((v) => (v === null ? null : v * unit));
    return {
      ...replay,
      human: heights(replay.human),
      robot: heights(replay.robot),
      target: heights(replay.target),
      command: scaled(replay.command, UNIT),
      prediction: scaled(replay.prediction, UNIT),
      confidence: scaled(replay.confidence, 1e-3),
      role: scaled(replay.role, 1e-3),
      drawn: (replay.drawn || []).map((each) => ({ ...each, values: heights(each.values) })),
      ghost: { ...replay.ghost, human: heights(replay.ghost.human), robot: heights(replay.ghost.robot) },
    };
  };

  // Where the robot's end should be, and what that is called: the human's end, or what the task says.
  colift.goalOf = function (now) {
    const goal = now.drawn.find((each) => each.goal);
    return goal ? [goal.values, `the ${goal.label}`] : [now.human, "the human's"];
  };

  // A lift's state at a time; a height between two frames is on the line between them.
  colift.stateAt = function (now, time) {
    const place = Math.max(time / now.frame_s - 1, 0);
    const at = (values) => {
      if (!values.length) return 0;
      const i = Math.min(Math.floor(place), values.length - 1);
      const next = values[Math.min(i + 1, values.length - 1)];
      return values[i] + Math.min(place - i, 1) * (next - values[i]);
    };
    const step = Math.floor(time / now.period_s + 1e-9);
    const reported = (values) => (values && values.length ? values[Math.min(step, values.length - 1)] : null);
    return {
      human: at(now.human),
      robot: at(now.robot),
      target: at(now.target),
      ghostHuman: at(now.ghost.human),
      ghostRobot: at(now.ghost.robot),
      prediction: reported(now.prediction),
      confidence: reported(now.confidence),
      role: reported(now.role),
      command: reported(now.command),
      drawn: now.drawn.map((each) => ({ ...each, value: at(each.values) })),
      over: now.human.length < now.horizon && time > now.human.length * now.frame_s,
    };
  };
})();
