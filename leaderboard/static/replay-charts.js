"use strict";
// The charts of a lift in the replay player, and their curves.
(function () {
  const colift = (window.coliftReplay = window.coliftReplay || {});

  // Options for colift.Chart: heights, error and, if the policy reports them, its own prediction and confidence.
  colift.chartsOf = function (now) {
    const times = (values) => values.map((_, i) => (i + 1) * now.frame_s);
    const steps = (values) => values.map((_, i) => i * now.period_s);
    const mm = (values) => values.map((value) => (value === null ? null : 1000 * value));
    const error = mm(now.error.values);
    const humanHuman = mm(now.error.ghost);
    const series = (kind, style, when, values, dot) => ({ kind, style, times: when(values), values, dot });
    const span = (...lists) => {
      const all = lists.flat().filter((value) => value !== null);
      return [Math.min(0, ...all), Math.max(50, ...all)];
    };
    const lines = [
      series("human-human", "line", times, mm(now.ghost.robot)),
      series("target", "line", times, mm(now.target)),
      series("human", "line", times, mm(now.human), true),
      series("robot", "line", times, mm(now.robot), true),
    ];
    const keys = [
      ["human", "human's end", "human"],
      ["robot", "robot's end", "robot"],
      ["target", now.goals ? "goal" : "human's intention", now.goals ? "goal" : "intention"],
      ["human-human", now.ghost.team ? "two simulated people, same goals" : "two people", "two people"],
    ];
    const added = now.drawn.filter((each) => each.where !== "place");
    for (const each of added) {
      lines.push(series(`added-${each.where}`, "line", times, mm(each.values)));
      keys.push([`added-${each.where}`, each.label]);
    }
    if (now.prediction) {
      lines.push(series("prediction", "dots", steps, mm(now.prediction)));
      keys.push(["prediction", "prediction of the human, drawn when it was made", "prediction"]);
    }
    // An outlying prediction must not flatten the curves of the lift.
    const hurdles = now.hurdles.map((each) => ({
      where: each.where,
      height: 1000 * each.height,
      base: 1000 * now.target[each.start],
      start: each.start * now.frame_s,
      stop: each.stop * now.frame_s,
      stay: each.nearest === null ? null : [each.nearest, each.nearest + each.stay].map((frame) => frame * now.frame_s),
      words: colift.hurdleWords(each),
    }));
    const bars = hurdles.map((each) => each.height);
    const [least, most] = span(mm(now.human), mm(now.robot), mm(now.target), mm(now.ghost.robot), bars, ...added.map((each) => mm(each.values)));
    const room = most - least;
    const within = (value) => value !== null && value > least - 0.15 * room && value < most + 0.15 * room;
    if (now.prediction) {
      const last = lines[lines.length - 1];
      last.values = last.values.map((value) => (within(value) ? value : null));
    }
    // What a real person did has no names: only the goals have.
    const goals = (now.goals || []).map(([frame, height]) => [height ? "a goal" : "back to rest", frame * now.frame_s]);
    const events = now.goals ? goals : now.events.map(([name, frame]) => [colift.eventWords(name), frame * now.frame_s]);
    const reach = Math.min(Math.max(15, ...error.map(Math.abs), ...humanHuman.map(Math.abs)), 120) * 1.1;
    const charts = [
      {
        name: "heights",
        title: "Height [mm]",
        summary: `Heights of both ends over ${(now.horizon * now.frame_s).toFixed(1)} s`,
        keys,
        low: least - 0.07 * room,
        high: most + 0.22 * room,
        height: 250,
        series: lines,
        hurdles,
        events,
      },
      {
        name: "error",
        title: `${now.error.scored ? "Error" : "Height difference"}: ${now.error.words} [mm]`,
        brief: `${now.error.scored ? "Error" : "Difference"} [mm]`,
        summary: `${now.drawn.length ? "Error" : "Height difference"}, RMSE ${colift.number(now.scores.rmse_mm, 1)} mm`,
        keys: [["robot", "with the robot", "robot"], ["human-human", now.ghost.team ? "two simulated people" : "two people", "two people"]],
        low: -reach,
        high: reach,
        height: 150,
        series: [series("robot", "area", times, error, true), series("human-human", "line", times, humanHuman)],
        last: !(now.confidence || now.role) && added.length === now.drawn.length,
      },
    ];
    const places = now.drawn.filter((each) => each.where === "place");
    const placed = (each) => (each.goal ? "added-aim" : "added-place");
    if (places.length) {
      const reach = Math.max(50, ...places.flatMap((each) => mm(each.values).map(Math.abs))) * 1.1;
      charts.push({
        name: "place",
        title: "Place on the table, from its middle towards the robot [mm]",
        brief: "Place [mm]",
        summary: `Places on the table: ${places.map((each) => each.label).join(", ")}`,
        keys: places.map((each) => [placed(each), each.label]),
        low: -reach,
        high: reach,
        height: 130,
        series: places.map((each) => series(placed(each), "line", times, mm(each.values), !each.goal)),
        last: !(now.confidence || now.role),
      });
    }
    if (now.confidence || now.role) {
      const same = now.confidence && now.role && now.confidence.every((c, i) => c === now.role[i]);
      const curves = [];
      const keys = [];
      if (now.confidence) {
        curves.push(series("confidence", "line", steps, now.confidence));
        keys.push(["confidence", same ? "confidence, and so its role" : "confidence in its prediction"]);
      }
      if (now.role && !same) {
        curves.push(series("role", "line", steps, now.role));
        keys.push(["role", "role"]);
      }
      charts.push({
        name: "confidence",
        title: "What the policy reports",
        summary: "Confidence and role of the policy, from 0 to 1",
        keys,
        low: -0.06,
        high: 1.06,
        height: 110,
        labels: [[0, now.role ? "follows" : "0"], [0.5, "½"], [1, now.role ? "leads" : "1"]],
        series: curves,
        last: true,
      });
    }
    return charts;
  };
})();
