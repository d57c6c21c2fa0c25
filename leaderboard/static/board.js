// The board's table. If the page has all rows, board-table.js sorts and searches them. Otherwise the service does; files
// load the other rows when they are asked to.
"use strict";
(() => {
  const table = document.querySelector("table.board");
  if (!table) return;
  const body = table.tBodies[0], field = (id) => document.getElementById(id);
  // On a telephone a tap unfolds a row, or the filters.
  body.addEventListener("click", (event) => {
    const button = event.target.closest(".unfold");
    if (!button) return;
    const open = button.closest("tr").classList.toggle("open");
    button.setAttribute("aria-expanded", open);
  });
  const narrow = matchMedia("(max-width: 46rem)");
  const fold = () => { field("filters").open = !narrow.matches; };
  narrow.addEventListener("change", fold);
  fold();

  // Two to four may be compared.
  const form = field("compare"), button = form.querySelector("button");
  function count() {
    const boxes = [...document.querySelectorAll("input[name=p]")];
    const picked = boxes.filter((box) => box.checked).length;
    button.textContent = picked ? `Compare ${picked}` : "Compare";
    button.disabled = picked < 2;
    button.title = picked < 2 ? "tick two to four policies" : "";
    for (const box of boxes) box.disabled = picked >= 4 && !box.checked;
  }
  document.addEventListener("change", count);
  addEventListener("pageshow", count);
  count();

  const columns = field("columns");
  const choose = () => {
    for (const option of columns.options) if (option.value) table.classList.toggle("show-" + option.value, option.selected);
  };

  const start = (rest) => window.coliftTable({ table, body, field, form, button, columns, choose }, rest);
  if (table.dataset.complete !== undefined) start([]);
  else if (table.dataset.rest) offer();
  else ask();

  // The service sorts and searches: a choice is sent at once.
  function ask() {
    columns.addEventListener("input", choose);
    for (const id of ["behaviour", "sort"]) field(id).addEventListener("input", () => form.requestSubmit(field("go")));
    const inputs = [...form.elements].filter((input) => input.matches("select, [type=search]"));
    form.addEventListener("submit", () => {  // Empty choices are left out of the address.
      for (const input of inputs) input.disabled = !input.value;
    });
    addEventListener("pageshow", () => { for (const input of inputs) input.disabled = false; });
  }

  // Files: the other rows are a script of their own.
  function offer() {
    const load = field("load");
    load.hidden = false;
    load.addEventListener("click", () => {
      load.disabled = true;
      const script = document.createElement("script");
      script.src = table.dataset.rest;
      script.addEventListener("load", () => {
        body.insertAdjacentHTML("beforeend", window.coliftRows.html);
        for (const part of document.querySelectorAll("[data-later]")) part.hidden = false;
        for (const part of table.tHead.querySelectorAll("button")) part.disabled = false;
        for (const part of document.querySelectorAll(".pager, #load")) part.hidden = true;
        start(window.coliftRows.rows);
      });
      script.addEventListener("error", () => { load.disabled = false; });
      document.head.append(script);
    });
    if (location.hash.length > 1) load.click();
  }
})();
