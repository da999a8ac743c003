"use strict";
// The mechanism at the slider's crank angle, beside its reduced quantities. Everything shown was computed
// when the page was written.
document.addEventListener("DOMContentLoaded", () => {
  const motion = mechaudit.data("motion-data");
  const slider = document.getElementById("phi1");
  const play = document.getElementById("play");
  const box = document.getElementById("courses");
  const { scale, left, top } = motion.view;
  const place = (p, k) => {
    const path = motion.points[p].path;
    const [x, y] = path[k % path.length];
    return [left + x * scale, top - y * scale].map((v) => v.toFixed(2));
  };
  const corners = (points, k) => points.map((p) => place(p, k).join(",")).join(" ");
  const parts = (name) => mechaudit.all(`#mechanism [data-${name}]`);
  const degrees = (k) => `${motion.crank_deg[k].toFixed(3)}°`;

  let charts = [];
  function draw() {
    const width = Math.max(280, Math.min(700, box.clientWidth));
    charts = motion.courses.map((course, i) => {
      const rows = course.variants.map(([, values]) =>
        values.map((value, k) => ({ deg: motion.crank_deg[k], value })));
      const line = (data, extra) => Plot.line(data, { x: "deg", y: "value", ...extra });
      const last = i + 1 === motion.courses.length;
      const chart = figures.plot({
        width, height: last ? 190 : 165, marginLeft: 60, marginBottom: last ? 36 : 22,
        label: `${course.name} over the crank angle`,
        x: { label: last ? "crank angle φ1, degrees" : null, ticks: Math.floor(width / 70) },
        y: { label: `${course.name}, ${course.unit}`, grid: true, nice: true },
        marks: [
          Plot.ruleY([0], { stroke: "var(--edge)" }),
          ...(rows[1] ? [line(rows[1], { stroke: "var(--orange)", strokeDasharray: "5 4" })] : []),
          line(rows[0], { stroke: "var(--blue)", strokeWidth: 2 }),
          Plot.dot(course.printed, { x: (p) => p[0], y: (p) => p[1], r: 2.2, stroke: "var(--fg)" }),
        ],
      });
      const x = chart.scale("x");
      const y = chart.scale("y");
      const cursor = d3.select(chart).append("g").attr("pointer-events", "none");
      cursor.append("line").attr("y1", y.range[1]).attr("y2", y.range[0]).attr("stroke", "var(--fg)");
      cursor.append("circle").attr("r", 4).attr("fill", "var(--blue)");
      // A press or a drag on a curve moves the slider.
      const seek = (event) => {
        if (!(event.buttons & 1)) return;
        const at = x.invert(d3.pointer(event, chart)[0]);
        slider.value = d3.leastIndex(motion.crank_deg, (a, b) => Math.abs(a - at) - Math.abs(b - at));
        show();
      };
      chart.addEventListener("pointerdown", seek);
      chart.addEventListener("pointermove", seek);
      return { chart, course, move: (k) => {
        cursor.attr("transform", `translate(${x.apply(motion.crank_deg[k])},0)`);
        cursor.select("circle").attr("cy", y.apply(course.variants[0][1][k]));
      } };
    });
    box.replaceChildren(...charts.map((c) => c.chart));
    show();
  }

  function show() {
    const k = Number(slider.value);
    for (const e of parts("link")) e.setAttribute("points", corners(motion.links[e.dataset.link], k));
    for (const e of parts("plate")) e.setAttribute("points", corners(motion.plates[e.dataset.plate], k));
    for (const e of parts("joint")) {
      const [x, y] = place(e.dataset.joint, k);
      e.setAttribute("transform", `translate(${x} ${y})`);
    }
    for (const c of charts) c.move(k);
    document.getElementById("phi1-value").textContent = degrees(k);
    slider.setAttribute("aria-valuetext", degrees(k));
    motion.courses.forEach((course, i) => {
      const value = course.variants[0][1][k];
      document.getElementById(`now-${i}`).textContent = `${value.toPrecision(5)} ${course.unit}`;
    });
  }

  let timer = null;
  const turn = () => {
    slider.value = (Number(slider.value) + 2) % motion.crank_deg.length;
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
