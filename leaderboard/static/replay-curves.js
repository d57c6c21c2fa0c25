"use strict";
// Curves over the time of a lift, all with one cursor, which a press or a drag moves.
(function () {
  const MARGIN = { left: 54, right: 22, top: 10, bottom: 8, axis: 30 };

  const { make } = window.coliftReplay;

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
    // options: title, keys [[kind, words]], low, high, height, series, labels, last
    // series: {kind, style: "line" | "dots" | "area", times, values}; a null value is a gap.
    constructor(host, options, player) {
      this.options = options;
      this.player = player;
      const figure = document.createElement("figure");
      figure.className = "replay-chart";
      const caption = document.createElement("figcaption");
      const title = document.createElement("b");
      title.textContent = options.title;
      caption.appendChild(title);
      for (const [kind, words] of options.keys) caption.appendChild(key(kind, words));
      figure.appendChild(caption);
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
      let free = 0;
      for (const [words, start] of events || []) {
        const x = this.x(start);
        if (start) make("line", { x1: x, x2: x, y1: MARGIN.top, y2: this.bottom, class: "event" }, grid);
        if (x < free) continue;
        const text = make("text", { x: x + 4, y: MARGIN.top + 9, class: "event" }, grid);
        text.textContent = words;
        free = x + 12 + 6.2 * words.length;
      }
    }

    curves(group) {
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
  function key(kind, words) {
    const item = document.createElement("span");
    item.className = "replay-key key-" + kind;
    const sample = make("svg", { viewBox: "0 0 22 10", width: 22, height: 10, "aria-hidden": "true" }, item);
    if (kind === "prediction") {
      for (const cx of [4, 11, 18]) make("circle", { cx, cy: 5, r: 2, class: "point " + kind }, sample);
    } else {
      make("path", { d: "M1 5H21", class: "curve " + kind }, sample);
    }
    item.append(words);
    return item;
  }

  window.coliftReplay.Chart = Chart;
})();
