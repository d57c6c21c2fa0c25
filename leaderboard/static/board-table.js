// The board's table with all its rows in the page: sort, filter, search. The state is in the address, behind the #.
"use strict";
window.coliftTable = ({ table, body, field, form, button, columns, choose }, rest) => {
  const data = JSON.parse(field("data").textContent);
  data.rows.push(...rest);
  const names = data.metrics.map((metric) => metric.name), shown = ["rmse", "ratio", ...names];
  const sorts = [...table.tHead.querySelectorAll("button")].map((button) => button.dataset.sort);
  const rows = [...body.rows].map((tr, index) => ({
    tr,
    text: tr.dataset.text,
    stratum: Object.fromEntries(
      sorts.filter((name) => name !== "name").map((name) => [name, tr.querySelector("td." + name)])),
    name: tr.querySelector("th a").textContent,
    dot: tr.querySelector(".dot"),
    off: tr.querySelector(".off"),
    index,
  }));
  // Two people and the references, below the policies.
  const baselines = [...table.querySelectorAll(".baselines tr")].map((tr) => ({
    tr,
    reference: tr.dataset.reference,
    stratum: Object.fromEntries(shown.map((name) => [name, tr.querySelector("td." + name)])),
    dot: tr.querySelector(".dot"),
    off: tr.querySelector(".off"),
  }));
  const drawn = [...rows, ...baselines];
  for (const row of drawn) {
    row.whole = {};
    for (const name of shown) {
      const stratum = row.stratum[name];
      row.whole[name] = { value: stratum.dataset.value, html: [...stratum.childNodes] };
    }
    row.at = row.dot.getAttribute("cx");
    row.away = [row.dot, row.off].map((part) => part.classList.contains("away"));
  }
  const lines = (name) => [...document.querySelectorAll(`#backdrop .${name}, .board .scale .${name}`)].map((line) => ({
    line, at: line.getAttribute("x1") || line.getAttribute("x"),
  }));
  const humanHumanLines = lines("human-human"), references = lines("reference");
  const bands = [...document.querySelectorAll("#backdrop .band")];
  const [query, behaviour, choice, status, more] =
    ["q", "behaviour", "sort", "status", "more"].map(field);
  const whole = `${rows.length} ${rows.length === 1 ? "policy" : "policies"}, scored on hidden lifts.`;
  const filters = { q: query, behaviour, columns };
  let sort = "rank", order = rows, limit = 200;  // Rows that are laid out at once.

  const write = (value, places) => (value === null ? "–" : value.toFixed(places).replace("-", "−"));
  const at = (mm) => (100 * Math.min(mm / data.top, 1)).toFixed(2) + "%";

  // Means over the public lifts of the chosen behaviour.
  function scores(row, chosen) {
    const [rmse, ratio, ...metrics] =
      data.rows[row.index][chosen] || [null, null, ...names.map(() => [null, 0])];
    return { rmse, ratio, metrics: metrics.map(([mean, missing]) => ({ mean, missing })) };
  }

  // The order of the whole table: the best first, then values that are missing in some lifts.
  function sortKey(metric, { mean, missing }) {
    if (mean === null) return null;
    const place = { less: mean, more: -mean, "near zero": Math.abs(mean) }[metric.better];
    return place + (metric.missing === "worst" ? 1000 * missing : 0);
  }

  function show(stratum, value, text, small) {
    stratum.dataset.value = value === null ? "" : value;
    stratum.replaceChildren(text);
    if (small) {
      const note = document.createElement("small");
      note.textContent = small;
      stratum.append(note);
    }
  }

  function draw(row, rmse, place) {
    row.dot.setAttribute("cx", place);
    row.dot.classList.toggle("away", rmse === null || rmse > data.top);
    row.off.classList.toggle("away", rmse === null || rmse <= data.top);
  }

  // Near an end of the scale the label stays within it, as in the template.
  function within(label, place) {
    const [anchor, dx] = place > 85 ? ["end", 14] : place < 15 ? ["start", -14] : ["middle", 0];
    label.setAttribute("text-anchor", anchor);
    label.setAttribute("dx", dx);
  }

  function move(moved, mm) {
    for (const { line, at: usual } of moved) {
      const x = mm === null ? usual : at(mm);
      for (const name of line.tagName === "text" ? ["x"] : ["x1", "x2"]) line.setAttribute(name, x);
      if (line.matches("text.human-human")) within(line, parseFloat(x));
    }
  }

  function moveLines(humanHuman, reference) {
    move(humanHumanLines, humanHuman);
    move(references, reference);
    for (const band of bands) band.classList.toggle("away", humanHuman !== null);
  }

  function part() {
    const chosen = data.behaviours.findIndex(([name]) => name === behaviour.value);
    const humanHuman = data.behaviours[chosen][1];
    table.classList.add("part");
    for (const row of rows) {
      const found = scores(row, chosen);
      show(row.stratum.rmse, found.rmse, write(found.rmse, 1));
      show(row.stratum.ratio, found.ratio, write(found.ratio, 2));
      found.metrics.forEach((each, i) => show(row.stratum[names[i]], sortKey(data.metrics[i], each),
        write(each.mean, data.metrics[i].digits), each.mean !== null && each.missing ? "none in " + each.missing : ""));
      draw(row, found.rmse, at(found.rmse || 0));
    }
    let bestKnown = null;
    for (const row of baselines) {
      const [rmse, ratio] = row.reference === undefined ?
        [humanHuman, humanHuman === null ? null : 1] : data.references[row.reference][chosen];
      show(row.stratum.rmse, rmse, write(rmse, 1));
      show(row.stratum.ratio, null, write(ratio, 2));
      for (const name of names) show(row.stratum[name], null, "–");
      draw(row, rmse, at(rmse || 0));
      if (row.tr.dataset.trained !== undefined) bestKnown = rmse;
    }
    moveLines(humanHuman, bestKnown);
  }

  function all() {
    if (!table.classList.contains("part")) return;
    table.classList.remove("part");
    for (const row of drawn) {
      for (const [name, { value, html }] of Object.entries(row.whole)) {
        row.stratum[name].dataset.value = value;
        row.stratum[name].replaceChildren(...html);
      }
      row.dot.setAttribute("cx", row.at);
      [row.dot, row.off].forEach((part, i) => part.classList.toggle("away", row.away[i]));
    }
    moveLines(null, null);
  }

  function key(row, name) {
    if (name === "name") return row.name.toLowerCase();
    const value = row.stratum[name].dataset.value;
    if (value === "" || value === undefined) return Infinity;
    return name === "licence" ? value : Number(value);
  }

  function arrange() {
    const down = sort.startsWith("-"), name = sort.replace("-", "");
    const sign = down ? -1 : 1;
    const keyed = rows.map((row) => [key(row, name), row]);
    keyed.sort(([a, x], [b, y]) => {
      if (a === b) return x.index - y.index;
      if (a === Infinity || b === Infinity) return a === Infinity ? 1 : -1;  // Missing values are last either way.
      return (a < b ? -1 : 1) * sign;
    });
    const next = keyed.map(([, row]) => row);
    if (next.some((row, i) => row !== order[i])) {
      const sorted = document.createDocumentFragment();
      for (const row of next) sorted.append(row.tr);
      body.append(sorted);
      order = next;
    }
    table.dataset.sorted = sort;
    for (const button of table.querySelectorAll("thead button")) {
      const header = button.closest("th");
      if (button.dataset.sort === name) header.setAttribute("aria-sort", down ? "descending" : "ascending");
      else header.removeAttribute("aria-sort");
    }
    choice.value = name;
  }

  function search() {
    const words = query.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of order) {
      const fits = words.every((word) => row.text.includes(word));
      count += fits;
      row.tr.hidden = !fits || count > limit;
    }
    more.hidden = count <= limit;
    more.textContent = `Show all ${count}`;
    return count;
  }

  function update() {
    choose();
    (behaviour.value ? part : all)();
    arrange();
    const count = search();
    if (!behaviour.value && count === rows.length) status.textContent = whole;
    else {
      const where = behaviour.value ? `means over the public lifts of ${behaviour.selectedOptions[0].text}; ` +
        "ranks and gaps are over all hidden lifts" : "scored on hidden lifts";
      status.textContent = `${count} of ${rows.length} policies, ${where}.`;
    }
  }

  function remember() {
    const state = new URLSearchParams();
    for (const [name, input] of Object.entries(filters)) if (input.value) state.set(name, input.value);
    if (sort !== "rank") state.set("sort", sort);
    const text = state.toString();
    history.replaceState(null, "", text ? "#" + text : location.pathname + location.search);
  }

  function recall() {
    const state = new URLSearchParams(location.hash.slice(1));
    for (const [name, input] of Object.entries(filters)) {
      input.value = state.get(name) || "";
      if (input.selectedIndex === -1) input.value = "";
    }
    const wanted = state.get("sort") || "rank";
    sort = [...choice.options].some((option) => option.value === wanted.replace("-", "")) ? wanted : "rank";
    update();
  }

  table.tHead.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    event.preventDefault();
    sort = sort === button.dataset.sort ? "-" + sort : button.dataset.sort;
    update();
    remember();
  });
  choice.addEventListener("change", () => { sort = choice.value; update(); remember(); });
  for (const input of Object.values(filters)) input.addEventListener("input", () => { update(); remember(); });
  more.addEventListener("click", () => {
    const next = body.querySelector("tr[hidden] a");
    limit = Infinity;
    update();
    if (next) next.focus();
  });
  addEventListener("hashchange", recall);
  // Only what is compared is sent.
  for (const input of [...Object.values(filters), choice]) input.removeAttribute("name");
  form.addEventListener("submit", (event) => { if (event.submitter !== button) event.preventDefault(); });
  recall();
};
