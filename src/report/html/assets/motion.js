"use strict";
// The mechanism at the slider's position, beside its quantities. Everything shown was computed when the page
// was written.
document.addEventListener("DOMContentLoaded", () => {
  const motion = mechaudit.data("motion-data");
  const slider = document.getElementById("drive");
  const play = document.getElementById("play");
  const box = document.getElementById("courses");
  const place = (p, k) => {
    const path = motion.points[p];
    const i = path.length > 2 ? 2 * k : 0;
    return [path[i], path[i + 1]];
  };
  const shapes = mechaudit.all("#mechanism [data-points]")
    .map((e) => ({ e, points: e.dataset.points.split(" ").map(Number) }));
  const placed = mechaudit.all("#mechanism [data-at]").map((e) => ({ e, point: Number(e.dataset.at) }));
  const buttons = mechaudit.all("button[data-course]");
  const drive = (k) => `${motion.drive[k].toFixed(motion.unit === "°" ? 3 : 5)}${motion.unit === "°" ? "°" : ` ${motion.unit}`}`.trim();
  const axis = motion.symbol + (motion.unit && `, ${motion.unit === "°" ? "degrees" : motion.unit}`);

  let charts = [];
  function draw() {
    const width = Math.max(280, Math.min(700, box.clientWidth));
    const shown = motion.courses.filter((c) => c.drawn);
    charts = shown.map((course, i) => {
      // An angle that jumps by a turn begins a new line.
      const piece = (k) => course.breaks.filter((b) => b <= k).length;
      // What is far off the chart is drawn just off it: axe-core does not end on a path that is very much larger than the page.
      const [low, high] = course.range;
      const near = (v) => v === null ? null : Math.min(Math.max(v, 2 * low - high), 2 * high - low);
      const rows = course.variants.map((values) =>
        values.map((value, k) => ({ at: motion.drive[k], value: near(value), piece: piece(k) })));
      const line = (data, extra) => Plot.line(data, { x: "at", y: "value", z: "piece", clip: true, ...extra });
      const last = i + 1 === shown.length;
      const unit = course.unit && `, ${course.unit}`;
      const domain = d3.nice(low, high, 5);
      const chart = figures.plot({
        width, height: last ? 190 : 165, marginLeft: 60, marginBottom: last ? 36 : 22,
        label: `${course.name} over ${motion.symbol}`,
        x: { label: last ? axis : null, ...figures.axisOf(d3.extent(motion.drive), Math.floor(width / 70)) },
        y: { label: `${course.name}${unit}`, grid: true, domain, ...figures.axisOf(domain, 5) },
        marks: [
          ...(course.range[0] <= 0 && course.range[1] >= 0 ? [Plot.ruleY([0], { stroke: "var(--edge)" })] : []),
          ...(rows[1] ? [line(rows[1], { stroke: "var(--orange)", strokeDasharray: "5 4" })] : []),
          line(rows[0], { stroke: "var(--blue)", strokeWidth: 2 }),
          Plot.dot(course.printed, { x: (p) => p[0], y: (p) => p[1], r: 2.2, stroke: "var(--fg)" }),
        ],
      });
      const x = chart.scale("x");
      const y = chart.scale("y");
      const cursor = d3.select(chart).append("g").attr("class", "cursor").attr("pointer-events", "none");
      cursor.append("line").attr("y1", y.range[1]).attr("y2", y.range[0]).attr("stroke", "var(--fg)");
      cursor.append("circle").attr("r", 4).attr("fill", "var(--blue)");
      // A press or a drag on a curve moves the slider.
      const seek = (event) => {
        if (!(event.buttons & 1)) return;
        const at = x.invert(d3.pointer(event, chart)[0]);
        slider.value = d3.leastIndex(motion.drive, (a, b) => Math.abs(a - at) - Math.abs(b - at));
        show();
      };
      chart.addEventListener("pointerdown", seek);
      chart.addEventListener("pointermove", seek);
      return { chart, move: (k) => {
        const value = course.variants[0][k];
        const within = value !== null && value >= y.domain[0] && value <= y.domain[1];
        cursor.attr("transform", `translate(${x.apply(motion.drive[k])},0)`);
        cursor.select("circle").attr("cy", within ? y.apply(value) : 0).attr("visibility", within ? null : "hidden");
      } };
    });
    box.replaceChildren(...charts.map((c) => c.chart));
    show();
  }

  function show() {
    const k = Number(slider.value);
    for (const { e, points } of shapes) e.setAttribute("points", points.map((p) => place(p, k).join(",")).join(" "));
    for (const { e, point } of placed) e.setAttribute("transform", `translate(${place(point, k).join(" ")})`);
    for (const c of charts) c.move(k);
    for (const e of mechaudit.all("#drive-value, #drawn-at")) e.textContent = drive(k);
    slider.setAttribute("aria-valuetext", drive(k));
    motion.courses.forEach((course, i) => {
      const value = course.variants[0][k];
      const text = value === null ? "–" : `${value.toPrecision(5)} ${course.unit}`;
      document.getElementById(`now-${i}`).textContent = text;
    });
  }

  for (const b of buttons) {
    b.addEventListener("click", () => {
      const course = motion.courses[b.dataset.course];
      course.drawn = !course.drawn;
      b.setAttribute("aria-pressed", String(course.drawn));
      draw();
    });
  }

  // Round and round, or to and fro where the last position does not lead to the first.
  let timer = null;
  let step = 2;
  const turn = () => {
    const n = motion.drive.length;
    let next = Number(slider.value) + step;
    if (motion.closed) next = (next + n) % n;
    else if (next < 0 || next >= n) {
      step = -step;
      next = Math.min(Math.max(Number(slider.value) + step, 0), n - 1);
    }
    slider.value = next;
    show();
  };
  play.addEventListener("click", () => {
    if (timer === null) timer = setInterval(turn, 33);
    else timer = clearInterval(timer) ?? null;
    play.textContent = timer === null ? "Play" : "Pause";
    play.setAttribute("aria-pressed", String(timer !== null));
  });
  slider.addEventListener("input", show);
  let width = 0;
  new ResizeObserver(() => {
    if (box.clientWidth === width) return;
    width = box.clientWidth;
    draw();
  }).observe(box);
});
