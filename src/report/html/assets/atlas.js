"use strict";
// Small error maps of all codes on one colour scale, and time against accuracy.
document.addEventListener("DOMContentLoaded", () => {
  const { levels, maps, work } = mechaudit.data("atlas-data");
  const NONE = "#ff4fd8";
  // Level 1 ends at 1e-17; each further one is a third of a decade; what is beyond 1 is as bad as 1.
  const power = (level) => -17 + (level - 1) / 3;
  const colour = (level) => (level === 0 ? NONE : d3.interpolateTurbo(0.08 + 0.84 * Math.min(1, Math.max(0, (power(level) + 16.5) / 16.5))));
  const superscript = (k) => String(k).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
  const shown = (level) => (level === 0 ? "no number" : level === 1 ? "at most 10⁻¹⁷" : `at most ${d3.format(".1~e")(10 ** power(level))}`);

  const keys = document.getElementById("atlas-keys");
  if (!keys) return;
  const ramp = keys.appendChild(document.createElement("p"));
  ramp.className = "ramp";
  const key = (text, fill) => {
    const span = ramp.appendChild(document.createElement("span"));
    const swatch = span.appendChild(document.createElement("i"));
    swatch.style.background = fill;
    span.append(text);
  };
  for (const e of d3.range(-16, 1, 2)) key(`10${superscript(e)}`, colour(1 + 3 * (e + 17)));
  key("no number", NONE);

  const box = document.getElementById("atlas-maps");
  const choose = box.appendChild(document.createElement("div"));
  choose.className = "choose";
  let part = "norm";
  const open = () => {};
  function one([name, map]) {
    const cells = [...map[part]].map((c) => levels.indexOf(c));
    const svg = figures.plot({
      label: `Relative errors of ${name}: Re z across, log Im z up; arrow keys read`,
      width: 260, height: 190, marginLeft: 44, marginBottom: 26, marginTop: 6, marginRight: 6,
      x: { domain: [0, 16], label: null, ticks: [0, 4, 8, 12, 16] },
      y: { domain: [-16, 2], label: null, ticks: [-16, -12, -8, -4, 0], tickFormat: (e) => `10${superscript(e)}` },
      marks: [Plot.raster(cells, { width: map.columns, height: map.rows, x1: 0, x2: 16, y1: -16, y2: 2, fill: colour, imageRendering: "pixelated" })],
    });
    const x = svg.scale("x");
    const y = svg.scale("y");
    const items = cells.map((level, i) => {
      const re = ((i % map.columns) + 0.527864) * 16 / map.columns;
      const im = -16 + (Math.floor(i / map.columns) + 0.527864) / 3;
      return { x: x.apply(re), y: y.apply(im), text: `${re.toFixed(2)} + ${(10 ** im).toExponential(1)}i: ${shown(level)}` };
    });
    return figures.figure(name, svg, figures.reading(svg, items, open));
  }
  const draw = () => {
    for (const old of mechaudit.all("figure", box)) old.remove();
    box.append(...maps.map(one));
  };
  for (const [which, words] of [["norm", "of the norm"], ["parts", "of each part"]]) {
    const button = choose.appendChild(document.createElement("button"));
    button.type = "button";
    button.textContent = words;
    button.setAttribute("aria-pressed", String(which === part));
    button.addEventListener("click", () => {
      part = which;
      for (const b of mechaudit.all("button", choose)) b.setAttribute("aria-pressed", String(b === button));
      draw();
    });
  }
  draw();

  // Names beside their points; one that would cover another goes below it, with a line to its point.
  function beside(svg, points) {
    const taken = [];
    const layer = d3.select(svg).append("g").attr("font-size", 10).attr("text-anchor", "start").attr("fill", "var(--fg)");
    for (const p of points.sort((a, b) => a.y - b.y || a.x - b.x)) {
      const wide = 12 + 6 * p.name.length;
      let y = p.y;
      const covered = () => taken.find((t) => Math.abs(t.y - y) < 11 && p.x < t.x + t.wide && t.x < p.x + wide);
      for (let t = covered(); t; t = covered()) y = t.y + 11.5;
      taken.push({ x: p.x, y, wide });
      if (y !== p.y) layer.append("path").attr("d", `M${p.x + 4},${p.y}L${p.x + 8},${y}`).attr("stroke", "var(--soft)").attr("fill", "none");
      layer.append("text").attr("x", p.x + 9).attr("y", y + 3.5).text(p.name);
    }
  }

  // Time against the worst error found; names stand beside their points where there is room.
  const place = document.getElementById("atlas-work");
  const diagrams = [["of the norm, ordinary region", 2], ["of Re W, ordinary region", 3], ["of Re W beside the axis, Im z = 1e-8..0.1", 4]];
  for (const [words, k] of diagrams) {
    const rows = work.filter((r) => r[k] !== null).map((r) => ({ name: r[0], ns: r[1], error: Math.min(Math.max(r[k], 1e-17), 10) }));
    if (rows.length === 0) continue;
    const width = Math.max(320, Math.min(960, place.clientWidth || 640));
    const svg = figures.plot({
      label: `Nanoseconds a value against the worst relative error ${words}; arrow keys read`,
      width, height: 380, marginLeft: 56, marginBottom: 40, marginRight: width > 600 ? 170 : 24,
      x: { type: "log", domain: [1e-17, 10], reverse: false, label: `worst relative error ${words}`, ticks: [-16, -12, -8, -4, 0].map((e) => 10 ** e),
        tickFormat: (v) => `10${superscript(Math.round(Math.log10(v)))}` },
      y: { type: "log", grid: true, label: "ns a value", nice: true, ticks: [0, 1, 2, 3, 4, 5, 6, 7].map((e) => 10 ** e), tickFormat: (v) => `10${superscript(Math.round(Math.log10(v)))}` },
      marks: [
        Plot.dot(rows, { x: "error", y: "ns", r: 4, fill: "var(--blue)" }),
      ],
    });
    const x = svg.scale("x");
    const y = svg.scale("y");
    if (width > 600) beside(svg, rows.map((r) => ({ name: r.name, x: x.apply(r.error), y: y.apply(r.ns) })));
    const items = rows.map((r) => ({ x: x.apply(r.error), y: y.apply(r.ns), text: `${r.name}: ${d3.format(".3~g")(r.ns)} ns, ${r.error.toExponential(1)}` }))
      .sort((a, b) => a.x - b.x);
    place.append(figures.figure(words, svg, figures.reading(svg, items, open), true));
  }
});
