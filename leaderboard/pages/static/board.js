// The board's table: sort, filter, search. The state is in the address, behind the #.
"use strict";
(() => {
  const table = document.querySelector("table.board");
  if (!table) return;
  const data = JSON.parse(document.getElementById("data").textContent);
  const body = table.tBodies[0];
  const rows = [...body.rows].map((tr) => ({
    tr,
    text: tr.dataset.text,
    cell: Object.fromEntries(
      ["rank", "rmse", "ratio", "sparc", "force", "step", "gap"].map((name) => [name, tr.querySelector("td." + name)])),
    name: tr.querySelector("th a").textContent,
    dot: tr.querySelector(".dot"),
    interval: tr.querySelector(".ci"),
    off: tr.querySelector(".off"),
    index: Number(tr.dataset.row),
  }));
  for (const row of rows) {
    row.whole = {};
    for (const name of ["rmse", "ratio", "sparc", "force"]) {
      const cell = row.cell[name];
      row.whole[name] = { value: cell.dataset.value, html: [...cell.childNodes] };
    }
    row.at = row.dot && row.dot.getAttribute("cx");
  }
  const teams = [...document.querySelectorAll("#backdrop .team, .scale .team")].map((line) => ({
    line, at: line.getAttribute("x1") || line.getAttribute("x"),
  }));
  const bands = [...document.querySelectorAll("#backdrop .band")];
  const field = (id) => document.getElementById(id);
  const [query, behaviour, subject, order, told] = ["q", "behaviour", "subject", "sort", "told"].map(field);
  const whole = told.textContent;
  const filters = { q: query, behaviour, subject };
  let sort = "rank";

  const write = (value, places) => (value === null ? "–" : value.toFixed(places).replace("-", "−"));
  const at = (mm) => (100 * Math.min(mm / data.top, 1)).toFixed(2) + "%";

  // Means over the public lifts of the chosen cells; what is missing weighs nothing.
  function mean(pairs) {
    let sum = 0, weight = 0;
    for (const [value, count] of pairs) if (value !== null) { sum += value * count; weight += count; }
    return weight ? sum / weight : null;
  }

  function scores(row, chosen) {
    const cells = chosen.map((i) => [data.rows[row.index][i], data.cells[i]]);
    if (cells.some(([cell]) => !cell)) return { rmse: null, ratio: null, sparc: null, force: null, missing: 0 };
    const rmse = mean(cells.map(([cell, [, , lifts]]) => [cell[0], lifts]));
    const team = mean(cells.map(([, [, , lifts, mm]]) => [mm, lifts]));
    return {
      rmse, team, ratio: team ? rmse / team : null,
      sparc: mean(cells.map(([cell, [, , lifts]]) => [cell[1], lifts - cell[2]])),
      missing: cells.reduce((sum, [cell]) => sum + cell[2], 0),
      force: mean(cells.map(([cell, [, , lifts]]) => [cell[3], lifts])),
    };
  }

  function show(cell, value, text, small) {
    cell.dataset.value = value === null ? "" : value;
    cell.replaceChildren(text);
    if (small) {
      const note = document.createElement("small");
      note.textContent = small;
      cell.append(note);
    }
  }

  function moveTeam(mm) {
    for (const { line, at: usual } of teams) {
      const x = mm === null ? usual : at(mm);
      for (const name of line.tagName === "text" ? ["x"] : ["x1", "x2"]) line.setAttribute(name, x);
    }
    for (const band of bands) band.classList.toggle("away", mm !== null);
  }

  function part() {
    const chosen = [];
    data.cells.forEach(([b, s], i) => {
      if ((!behaviour.value || b === behaviour.value) && (!subject.value || s === subject.value)) chosen.push(i);
    });
    table.classList.add("part");
    let team = null;
    for (const row of rows) {
      const found = scores(row, chosen);
      team = team === null ? found.team ?? null : team;
      show(row.cell.rmse, found.rmse, write(found.rmse, 1));
      show(row.cell.ratio, found.ratio, write(found.ratio, 2));
      show(row.cell.sparc, found.sparc === null ? null : found.missing * 1000 - found.sparc, write(found.sparc, 2),
        found.sparc !== null && found.missing ? "none in " + found.missing : "");
      show(row.cell.force, found.force, write(found.force, 2));
      if (row.dot) {
        row.dot.setAttribute("cx", at(found.rmse || 0));
        row.dot.classList.toggle("away", found.rmse === null);
      }
    }
    moveTeam(team);
    return chosen;
  }

  function all() {
    if (!table.classList.contains("part")) return;
    table.classList.remove("part");
    for (const row of rows) {
      for (const [name, { value, html }] of Object.entries(row.whole)) {
        row.cell[name].dataset.value = value;
        row.cell[name].replaceChildren(...html);
      }
      if (row.dot) {
        row.dot.setAttribute("cx", row.at);
        row.dot.classList.remove("away");
      }
    }
    moveTeam(null);
  }

  function key(row, name) {
    if (name === "name") return row.name.toLowerCase();
    const value = row.cell[name].dataset.value;
    return value === "" || value === undefined ? Infinity : Number(value);
  }

  function arrange() {
    const down = sort.startsWith("-"), name = sort.replace("-", "");
    const sign = down ? -1 : 1;
    const keyed = rows.map((row) => [key(row, name), row]);
    keyed.sort(([a, x], [b, y]) => {
      if (a === b) return x.index - y.index;
      if (a === Infinity || b === Infinity) return a === Infinity ? 1 : -1;  // What has none is last either way.
      return (a < b ? -1 : 1) * sign;
    });
    const sorted = document.createDocumentFragment();
    for (const [, row] of keyed) sorted.append(row.tr);
    body.append(sorted);
    table.dataset.sorted = sort;
    for (const button of table.querySelectorAll("thead button")) {
      const header = button.closest("th");
      if (button.dataset.sort === name) header.setAttribute("aria-sort", down ? "descending" : "ascending");
      else header.removeAttribute("aria-sort");
    }
    order.value = name;
  }

  function search() {
    const words = query.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of rows) {
      const fits = words.every((word) => row.text.includes(word));
      row.tr.hidden = !fits;
      count += fits;
    }
    return count;
  }

  function update() {
    const chosen = behaviour.value || subject.value ? part() : (all(), null);
    arrange();
    const count = search();
    if (chosen === null && count === rows.length) told.textContent = whole;
    else {
      const where = chosen === null ? "scored on hidden lifts" :
        `means over the public lifts of ${behaviour.selectedOptions[0].text} with ${subject.selectedOptions[0].text}; ranks and gaps are over all`;
      told.textContent = `${count} of ${rows.length} policies, ${where}.` +
        (chosen && !chosen.length ? " The suite has no such lifts." : "");
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
    sort = [...order.options].some((option) => option.value === wanted.replace("-", "")) ? wanted : "rank";
    update();
  }

  table.tHead.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (!button) return;
    sort = sort === button.dataset.sort ? "-" + sort : button.dataset.sort;
    update();
    remember();
  });
  order.addEventListener("change", () => { sort = order.value; update(); remember(); });
  for (const input of Object.values(filters)) input.addEventListener("input", () => { update(); remember(); });
  addEventListener("hashchange", recall);

  // Two to four may be compared.
  const form = field("compare"), button = form.querySelector("button");
  function count() {
    const boxes = [...body.querySelectorAll("input[name=p]")];
    const picked = boxes.filter((box) => box.checked).length;
    button.textContent = picked ? `Compare ${picked}` : "Compare";
    button.disabled = picked < 2;
    button.title = picked < 2 ? "tick two to four policies" : "";
    for (const box of boxes) box.disabled = picked >= 4 && !box.checked;
  }
  body.addEventListener("change", count);
  addEventListener("pageshow", count);
  count();
  recall();
})();
