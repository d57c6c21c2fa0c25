// Draws two policies lift by lift, and the same lift with both; saves the single lifts as CSV.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const byId = Object.fromEntries(data.policies.map((each) => [each.p, each]));
  const field = (id) => document.getElementById(id);
  const words = (name) => name.replaceAll("_", " ");

  function make(parent, tag, attributes, text) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }

  // Each behaviour has a colour and a shape.
  function marker(svg, behaviour, x, y, size) {
    const transform = `translate(${x.toFixed(1)} ${y.toFixed(1)}) scale(${size})`;
    return make(svg, "use", { class: "lift k" + behaviour % 5, href: "#s" + behaviour % 4, transform });
  }

  function option(select, value, text) {
    const each = document.createElement("option");
    each.value = value;
    each.textContent = text;
    select.append(each);
  }

  // The scatter plot: logarithmic, with the same scale on both axes, so that the diagonal is "equal".
  function scatter(a, b) {
    const svg = field("scatter");
    svg.replaceChildren();
    const [left, right, top, bottom] = [62, 508, 12, 388];
    const values = [...a.rmse, ...b.rmse].map((mm) => Math.max(mm, 0.1));
    const [low, high] = [Math.log10(Math.min(...values)) - 0.06, Math.log10(Math.max(...values)) + 0.06];
    const share = (mm) => (Math.log10(Math.max(mm, 0.1)) - low) / (high - low);
    const x = (mm) => left + (right - left) * share(mm), y = (mm) => bottom - (bottom - top) * share(mm);
    for (let power = -1; power < 3; power++) for (const digit of [1, 2, 5]) {
      const mm = digit * 10 ** power;
      if (share(mm) < 0 || share(mm) > 1) continue;
      make(svg, "line", { class: "grid", x1: x(mm), x2: x(mm), y1: top, y2: bottom });
      make(svg, "line", { class: "grid", x1: left, x2: right, y1: y(mm), y2: y(mm) });
      make(svg, "text", { x: x(mm), y: bottom + 17, "text-anchor": "middle" }, +mm.toPrecision(1));
      make(svg, "text", { x: left - 8, y: y(mm) + 4, "text-anchor": "end" }, +mm.toPrecision(1));
    }
    make(svg, "line", { class: "equal", x1: left, y1: bottom, x2: right, y2: top });
    make(svg, "text", { class: "title", x: (left + right) / 2, y: bottom + 40, "text-anchor": "middle" }, `${a.name}, mm`);
    make(svg, "text", { class: "title", transform: `translate(15 ${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, `${b.name}, mm`);
    const behaviours = [...new Set(data.lifts.map(([behaviour]) => behaviour))];
    let better = 0;
    data.lifts.forEach(([behaviour, subject, seed], i) => {
      if (a.rmse[i] < b.rmse[i]) better += 1;
      const dot = marker(svg, behaviours.indexOf(behaviour), x(a.rmse[i]), y(b.rmse[i]), 0.7);
      make(dot, "title", {}, `${words(behaviour)}, ${subject}, seed ${seed}: ${a.rmse[i].toFixed(1)} and ${b.rmse[i].toFixed(1)} mm`);
    });
    behaviours.forEach((behaviour, i) => {
      marker(svg, i, left + 14, top + 14 + 17 * i, 0.9);
      make(svg, "text", { x: left + 24, y: top + 18 + 17 * i }, words(behaviour));
    });
    svg.setAttribute("aria-label", `RMSE of ${data.lifts.length} lifts: ${a.name} is ${svg.dataset.better} than ${b.name} in ${better}.`);
  }

  // The same lift with both.
  function curves(a, b, name) {
    const svg = field("curves");
    svg.replaceChildren();
    const [left, right, top, bottom] = [52, 508, 10, 320];
    const both = [a, b].map((each) => each.curves[name].map((tenths) => tenths / 10));
    const reach = Math.max(10, ...both.flat().map(Math.abs)) * 1.05;
    const length = Math.max(...both.map((curve) => curve.length)) - 1;
    const x = (i) => left + (right - left) * i / length, y = (mm) => (top + bottom) / 2 - (bottom - top) / 2 * mm / reach;
    const step = [1, 2, 5, 10, 20, 50, 100, 200].find((each) => each >= reach / 3) || 500;
    for (let mm = -step * Math.floor(reach / step); mm <= reach; mm += step) {
      make(svg, "line", { class: mm ? "grid" : "zero", x1: left, x2: right, y1: y(mm), y2: y(mm) });
      make(svg, "text", { x: left - 8, y: y(mm) + 4, "text-anchor": "end" }, String(mm).replace("-", "−"));
    }
    for (let s = 0; s <= length * data.step; s++)
      make(svg, "text", { x: x(s / data.step), y: bottom + 18, "text-anchor": "middle" }, s + " s");
    both.forEach((curve, i) => make(svg, "polyline", {
      class: i ? "second" : "first", points: curve.map((mm, at) => `${x(at).toFixed(1)},${y(mm).toFixed(1)}`).join(" "),
    }));
    for (const [i, each] of [a, b].entries()) document.querySelector("#same b." + ["first", "second"][i]).textContent = each.name;
    const most = both.map((curve) => Math.max(...curve.map(Math.abs)).toFixed(0));
    svg.setAttribute("aria-label", `Error over time: at most ${most[0]} mm with ${a.name}, ${most[1]} mm with ${b.name}.`);
  }

  function draw(a, b) {
    scatter(a, b);
    const names = Object.keys(a.curves).filter((name) => name in b.curves);
    field("same").hidden = !names.length;
    const select = field("lift");
    select.replaceChildren();
    for (const name of names) {
      const [behaviour, subject, seed] = name.split(" ");
      option(select, name, `${words(behaviour)}, ${subject}, seed ${seed}`);
    }
    select.onchange = () => curves(a, b, select.value);
    if (names.length) curves(a, b, names[0]);
  }

  // A text that a spreadsheet would take for a formula has an apostrophe before it.
  const cell = (text) => `"${(/^[=+\-@\t\r]/.test(text) ? "'" : "") + text.replaceAll('"', '""')}"`;

  function save(chosen) {
    const head = ["behaviour", "subject", "seed", ...chosen.map((each) => `rmse_mm of ${each.name}`)].map(cell);
    const lines = data.lifts.map((lift, i) => [...lift, ...chosen.map((each) => each.rmse[i])].join(","));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([[head.join(","), ...lines].join("\n") + "\n"], { type: "text/csv" }));
    link.download = "lifts.csv";
    link.click();
    URL.revokeObjectURL(link.href);
  }

  window.coliftDraw = (digests) => {
    const chosen = digests.map((digest) => byId[digest]).filter((each) => each && each.rmse.length === data.lifts.length);
    if (chosen.length < 2 || !data.lifts.length) return;
    const pairs = chosen.flatMap((a, i) => chosen.slice(i + 1).map((b) => [a, b]));
    const select = field("pair");
    pairs.forEach(([a, b], i) => option(select, i, `${a.name} and ${b.name}`));
    field("which").hidden = pairs.length < 2;
    select.onchange = () => draw(...pairs[select.value]);
    field("drawn").hidden = false;
    draw(...pairs[0]);
    const button = field("export");
    button.hidden = false;
    button.onclick = () => save(chosen);
  };
})();
