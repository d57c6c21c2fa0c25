"use strict";
// A lift as the replay player shows it, from the data of replays/replay.py.
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
    const series = (drawn) => (drawn || []).map((each) => ({ ...each, values: heights(each.values) }));
    const metres = (value) => (value === null ? null : value * UNIT);
    const now = {
      ...replay,
      human: heights(replay.human),
      robot: heights(replay.robot),
      target: replay.goals ? goalsOf(replay) : heights(replay.target),
      command: scaled(replay.command, UNIT),
      prediction: scaled(replay.prediction, UNIT),
      confidence: scaled(replay.confidence, 1e-3),
      role: scaled(replay.role, 1e-3),
      drawn: series(replay.drawn),
      hurdles: (replay.hurdles || []).map((each) => ({ ...each, height: metres(each.height), missed: metres(each.missed) })),
      ghost: {
        ...replay.ghost,
        human: heights(replay.ghost.human),
        robot: heights(replay.ghost.robot),
        drawn: series(replay.ghost.drawn),
      },
    };
    return { ...now, error: errorOf(now) };
  };

  // The goal in each frame of a live lift, in m; null before the first one appears.
  function goalsOf({ goals, horizon }) {
    const shown = (frame) => goals.filter(([first]) => first <= frame).pop();
    return Array.from({ length: horizon }, (_, i) => (shown(i + 1) ? shown(i + 1)[1] * UNIT : null));
  }

  // The height that the robot's end should have; and the place of a ball, with its target place.
  const farGoal = (colift.farGoal = (drawn) => drawn.find((each) => each.goal && each.where !== "place"));
  const places = (colift.places = (drawn) =>
    [false, true].map((goal) => drawn.find((each) => each.where === "place" && each.goal === goal)));

  // The error over time, of the robot and of two people, in m, and its name (episode/drawn.py).
  function errorOf(now) {
    const less = (a, b) => a.slice(0, b.length).map((value, i) => value - b[i]);
    const goal = farGoal(now.drawn);
    const [ball, target] = places(now.drawn);
    const missed = (lift) => {
      if (ball && target) return less(lift.drawn.find((each) => each.name === ball.name).values, target.values);
      return less(lift.robot, goal ? goal.values : lift.human);
    };
    const words =
      ball && target ? `${ball.label} from the ${target.label}, towards the robot` : `robot's end above ${goal ? "the " + goal.label : "the human's"}`;
    // If several quantities count, the height difference is not the error.
    const scored = Boolean(goal || (ball && target)) || !(now.drawn.length || now.hurdles.length);
    return { values: missed(now), ghost: missed(now.ghost), words, scored };
  }

  // A lift's state at a time; heights are interpolated between two frames.
  colift.stateAt = function (now, time) {
    const place = Math.max(time / now.frame_s - 1, 0);
    const at = (values) => {
      if (!values.length) return 0;
      const i = Math.min(Math.floor(place), values.length - 1);
      const next = values[Math.min(i + 1, values.length - 1)];
      return values[i] + Math.min(place - i, 1) * (next - values[i]);
    };
    // A goal appears at once, and is not there before.
    const stepped = (values) => values[Math.min(Math.floor(place), values.length - 1)];
    const step = Math.floor(time / now.period_s + 1e-9);
    const until = (frame) => frame * now.frame_s - time;
    const reported = (values) => (values && values.length ? values[Math.min(step, values.length - 1)] : null);
    return {
      human: at(now.human),
      robot: at(now.robot),
      target: now.goals ? stepped(now.target) : at(now.target),
      ghostHuman: at(now.ghost.human),
      ghostRobot: at(now.ghost.robot),
      prediction: reported(now.prediction),
      confidence: reported(now.confidence),
      role: reported(now.role),
      command: reported(now.command),
      drawn: now.drawn.map((each) => ({ ...each, value: at(each.values) })),
      ghostDrawn: now.ghost.drawn.map((each) => ({ ...each, value: at(each.values) })),
      hurdles: now.hurdles.map((each) => ({ ...each, opens: until(each.start), closes: until(each.stop) })),
      error: at(now.error.values),
      ghostError: at(now.error.ghost),
      over: now.human.length < now.horizon && time > now.human.length * now.frame_s,
    };
  };

  // Calls `step` with the time since the last call [s], whenever the browser draws, until it
  // returns false.
  colift.eachFrame = function (step) {
    let before = null;
    const frame = (stamp) => {
      if (!step(before === null ? 0 : (stamp - before) / 1000)) return;
      before = stamp;
      window.requestAnimationFrame(frame);
    };
    window.requestAnimationFrame(frame);
  };
})();
