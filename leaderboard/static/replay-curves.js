"use strict";
// Curves over the time of a lift, all with one cursor, which a press or a drag moves.
(function () {
  const MARGIN = { left: 54, right: 22, top: 10, bottom: 8, axis: 30 };

  const ROW = 14; // height of a row of words, in pixels

  const { make, element } = window.coliftReplay;

  // Round steps of an axis: about `count` of them.
  function ticks(low, high, count) {
    const raw = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= raw * 0.999);
    const found = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9; i++) found.push(i * step);
    return found;
  }

  class Chart {
    // options: title, keys [[kind, words, short words]], low, high, height, series, hurdles, labels, last
    // series: {kind, style: "line" | "dots" | "area", times, values}; a null value is a gap.
    constructor(host, options, player) {
      this.options = options;
      this.player = player;
      const figure = document.createElement("figure");
      figure.className = "replay-chart";
      this.caption = element("figcaption", {}, element("b", {}, ...wording(options.title, options.brief)));
      for (const each of options.keys) this.caption.appendChild(key(...each));
      figure.appendChild(this.caption);
      this.svg = make("svg", { role: "img", "aria-label": options.summary });
      figure.appendChild(this.svg);
      host.appendChild(figure);
      this.listen();
    }

    listen() {
      const seek = (event) => {
        const box = this.svg.getBoundingClientRect();
        const share = (event.clientX - box.left - MARGIN.left) / (this.width - MARGIN.left - MARGIN.right);
        this.player.seek(share * this.player.duration);
      };
      this.svg.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        this.svg.setPointerCapture(event.pointerId);
        this.player.hold();
        seek(event);
      });
      this.svg.addEventListener("pointermove", (event) => {
        if (this.svg.hasPointerCapture(event.pointerId)) seek(event);
      });
      for (const end of ["pointerup", "pointercancel"]) {
        this.svg.addEventListener(end, () => this.player.release());
      }
    }

    x(time) {
      const room = this.width - MARGIN.left - MARGIN.right;
      return MARGIN.left + (time / this.player.duration) * room;
    }

    y(value) {
      const { low, high } = this.options;
      const room = this.bottom - MARGIN.top;
      return this.bottom - ((value - low) / (high - low)) * room;
    }

    // Draw everything anew for the available width.
    fit() {
      const width = Math.round(this.svg.parentNode.clientWidth);
      if (!width || width === this.width) return;
      this.width = width;
      this.shorten();
      const { height, last } = this.options;
      const whole = height + (last ? MARGIN.axis : 0);
      this.bottom = height - MARGIN.bottom;
      this.svg.replaceChildren();
      this.svg.setAttribute("viewBox", `0 0 ${width} ${whole}`);
      this.svg.setAttribute("height", whole);
      this.axes();
      const clip = `${this.player.id}-${this.options.name}`;
      this.past = make("rect", { x: 0, y: 0, width: 0, height: whole }, make("clipPath", { id: clip }, this.svg));
      this.curves(make("g", { class: "future" }, this.svg));
      this.curves(make("g", { "clip-path": `url(#${clip})` }, this.svg));
      this.words();
      this.cursor = make("line", { class: "cursor", y1: MARGIN.top - 4, y2: this.bottom }, this.svg);
      this.dots = this.options.series
        .filter((series) => series.dot)
        .map((series) => [make("circle", { r: 4.5, class: "dot " + series.kind }, this.svg), series]);
    }

    axes() {
      const { low, high, labels, last, events } = this.options;
      const right = this.width - MARGIN.right;
      const grid = make("g", { class: "grid" }, this.svg);
      for (const [value, words] of labels || ticks(low, high, 5).map((v) => [v, `${v}`.replace("-", "−")])) {
        const y = this.y(value);
        make("line", { x1: MARGIN.left, x2: right, y1: y, y2: y, class: value === 0 ? "zero" : "" }, grid);
        make("text", { x: MARGIN.left - 7, y: y + 4, "text-anchor": "end" }, grid).textContent = words;
      }
      const every = Math.max(2, this.width / 90);
      for (const second of ticks(0, this.player.duration, every)) {
        const x = this.x(second);
        make("line", { x1: x, x2: x, y1: MARGIN.top, y2: this.bottom }, grid);
        if (last) {
          const text = make("text", { x, y: this.bottom + 17, "text-anchor": "middle" }, grid);
          text.textContent = second ? `${+second.toFixed(1)} s` : "0";
        }
      }
      this.phases(grid, events || [], right);
    }

    // The names of phases, in two rows: one without room has a line only, which begins below both.
    phases(grid, events, right) {
      const free = [0, 0];
      for (const [words, start] of events) {
        const x = this.x(start);
        const text = make("text", { x: x + 4, class: "event" }, grid);
        text.textContent = words;
        const end = x + 12 + text.getComputedTextLength();
        // The line of a name in the upper row runs through the lower one.
        const row = end - 8 > right ? 2 : x >= Math.max(...free) ? 0 : x >= free[1] ? 1 : 2;
        if (row < 2) free[row] = end;
        else text.remove();
        text.setAttribute("y", MARGIN.top + 9 + row * ROW);
        const top = MARGIN.top + row * ROW;
        if (start) make("line", { x1: x, x2: x, y1: top, y2: this.bottom, class: "event" }, grid);
      }
    }

    // A caption that does not fit into a line has shorter words.
    shorten() {
      const { classList, firstElementChild, lastElementChild } = this.caption;
      classList.remove("short");
      classList.toggle("short", lastElementChild.offsetTop > firstElementChild.offsetTop + ROW);
    }

    // By how much each hurdle is missed: beside its bar, away from another one that is open meanwhile.
    words() {
      const hurdles = this.options.hurdles || [];
      for (const each of hurdles) {
        const others = hurdles.filter((other) => other !== each && other.start < each.stop && each.start < other.stop);
        const above = each.height > Math.max(each.base, ...others.map((other) => other.height));
        const x = (this.x(each.start) + this.x(each.stop)) / 2;
        const text = make("text", { x, y: this.y(each.height) + (above ? -8 : 17), "text-anchor": "middle", class: `words ${each.where}` }, this.svg);
        text.textContent = each.words;
      }
    }

    curves(group) {
      for (const { where, height, start, stop, stay } of this.options.hurdles || []) {
        for (const [kind, from, to] of [["window", start, stop], ...(stay ? [["stay", ...stay]] : [])]) {
          const box = { x: this.x(from), y: this.y(height) - 3, width: this.x(to) - this.x(from), height: 6 };
          make("rect", { ...box, class: `hurdle ${where} ${kind}` }, group);
        }
      }
      for (const { kind, style, times, values } of this.options.series) {
        if (style === "dots") {
          values.forEach((value, i) => {
            if (value !== null) make("circle", { cx: this.x(times[i]), cy: this.y(value), r: 2, class: "point " + kind }, group);
          });
          continue;
        }
        let path = "";
        let pen = false;
        values.forEach((value, i) => {
          if (value !== null) path += (pen ? "L" : "M") + this.x(times[i]).toFixed(1) + " " + this.y(value).toFixed(1);
          pen = value !== null;
        });
        if (style === "area" && path) {
          const base = this.y(0).toFixed(1);
          const [from, to] = [times[0], times[times.length - 1]].map((t) => this.x(t).toFixed(1));
          make("path", { d: `${path}L${to} ${base}L${from} ${base}Z`, class: "area " + kind }, group);
        }
        make("path", { d: path, class: "curve " + kind }, group);
      }
    }

    at(time, index) {
      if (!this.width) return;
      const x = this.x(time);
      this.past.setAttribute("width", x);
      this.cursor.setAttribute("x1", x);
      this.cursor.setAttribute("x2", x);
      for (const [dot, { values }] of this.dots) {
        const value = values[Math.min(index, values.length - 1)];
        dot.setAttribute("cx", x);
        dot.setAttribute("cy", value === undefined ? -99 : this.y(value));
      }
    }
  }

  // The key of a line of a chart.
  function key(kind, words, brief) {
    const item = element("span", { class: "replay-key key-" + kind });
    const sample = make("svg", { viewBox: "0 0 22 10", width: 22, height: 10, "aria-hidden": "true" }, item);
    if (kind === "prediction") {
      for (const cx of [4, 11, 18]) make("circle", { cx, cy: 5, r: 2, class: "point " + kind }, sample);
    } else {
      make("path", { d: "M1 5H21", class: "curve " + kind }, sample);
    }
    item.append(...wording(words, brief));
    return item;
  }

  // Words, and shorter ones, if there are any, for a line in which they do not fit.
  function wording(words, brief) {
    return brief && brief !== words ? [element("span", { class: "long" }, words), element("span", { class: "brief" }, brief)] : [words];
  }

  window.coliftReplay.Chart = Chart;
})();
