"use strict";
// Errors over the complex plane: cells of one colour each, outlines of the solver's formulas, marks.
const errorMap = (() => {
  // Upper ends in ulps and colours, the same in both schemes; the last is for no number.
  const ENDS = [0.25, 0.5, 0.75, 1, 4, 1000];
  const COLOURS = ["#26456e", "#3a7ab8", "#6ab0c9", "#b5d99c", "#f5d76e", "#ef8a3c", "#b3261e", "#ff4fd8"];
  const colour = (end) => (end === null ? COLOURS[7] : COLOURS[d3.bisectLeft(ENDS, end)]);

  function keys() {
    const box = document.createElement("p");
    box.className = "keys";
    const names = [...ENDS.map((e) => `≤ ${e} ulps`), "more", "no number, or wrong in kind"];
    names.forEach((name, k) => {
      const key = document.createElement("span");
      const swatch = document.createElement("i");
      swatch.style.background = COLOURS[k];
      key.append(swatch, name);
      box.append(key);
    });
    return box;
  }

  // Where two neighbours differ, the edge between them.
  function outlines(map, cells) {
    const [left, below] = map.corner;
    const at = (c, r) => [left + c * map.side, below + r * map.side];
    const edges = [];
    for (let r = 0; r < map.rows; r += 1) {
      for (let c = 0; c < map.columns; c += 1) {
        const own = cells[r * map.columns + c];
        if (c + 1 < map.columns && cells[r * map.columns + c + 1] !== own) edges.push([...at(c + 1, r), ...at(c + 1, r + 1)]);
        if (r + 1 < map.rows && cells[(r + 1) * map.columns + c] !== own) edges.push([...at(c, r + 1), ...at(c + 1, r + 1)]);
      }
    }
    return edges;
  }

  function draw(method, k, width, open) {
    const { map } = method;
    const [name, cells] = map.outputs[k];
    const [left, below] = map.corner;
    const [right, above] = [left + map.columns * map.side, below + map.rows * map.side];
    const formulas = map.branches && map.branches[1].flatMap(([k, n]) => Array(n).fill(k));
    const levels = [...cells].map((c) => map.levels.indexOf(c));
    const inside = ([x, y]) => x > left && x < right && y > below && y < above;
    const places = (numbers) => numbers.map((n) => method.cases[n][3]).filter(inside);
    // What was found worst, and the cases sampled beside zeros and seams.
    const layers = [["worst cases", places(d3.range(method.cases.length).filter((n) => method.cases[n][4] !== null)), true]];
    for (const [word, regions] of method.marks) {
      const sampled = method.points.map((p) => p[0]).filter((n) => regions.includes(method.cases[n][0]));
      layers.push([`cases beside ${word}s`, places(sampled), false]);
    }
    const ring = (points, extra) => Plot.dot(points, { x: (p) => p[0], y: (p) => p[1], ...extra });
    const svg = figures.plot({
      label: `Errors of ${name} over the complex plane; arrow keys read, Enter opens the point`,
      width, aspectRatio: 1, marginLeft: 40, marginBottom: 34,
      x: { domain: [left, right], label: "Re z" }, y: { domain: [below, above], label: "Im z" },
      marks: [
        Plot.raster(levels, { width: map.columns, height: map.rows, x1: left, x2: right, y1: below, y2: above,
          fill: (n) => colour(map.ends[n]), imageRendering: "pixelated" }),
        Plot.ruleX([0], { stroke: "#fff", strokeOpacity: 0.5 }), Plot.ruleY([0], { stroke: "#fff", strokeOpacity: 0.5 }),
        ...(map.branches ? [Plot.link(outlines(map, formulas), { x1: "0", y1: "1", x2: "2", y2: "3", stroke: "#fff", strokeWidth: 1.4, className: "layer-branches" })] : []),
        ...layers.map(([, points], n) => ring(points, { r: 4, fill: "none", stroke: n ? "#fff" : "#000", strokeWidth: 1.6, className: `layer-${n}` })),
        ...layers.slice(0, 1).map(([, points]) => ring(points, { r: 5.5, fill: "none", stroke: "#fff", strokeWidth: 1.2, className: "layer-0" })),
      ],
    });
    const x = svg.scale("x");
    const y = svg.scale("y");
    const items = levels.map((n, i) => {
      const z = [map.at[0][i % map.columns], map.at[1][Math.floor(i / map.columns)]];
      const end = map.ends[n];
      const error = end === null ? "no number, or wrong in kind" : n + 1 === map.levels.length ? "1000 ulps and more" : `at most ${d3.format(".2~g")(end)} ulps`;
      const formula = map.branches ? `, ${map.branches[0][formulas[i]]}` : "";
      return { x: x.apply(z[0]), y: y.apply(z[1]), text: `z = ${z[0].toFixed(3)} ${z[1] < 0 ? "−" : "+"} ${Math.abs(z[1]).toFixed(3)}i: ${error}${formula}`,
        open: { point: z, error } };
    });
    const box = figures.figure(`${name} at ${levels.length} points of the plane`, svg, figures.reading(svg, items, open), true);
    const marks = document.createElement("div");
    marks.className = "marks";
    const toggle = (label, layer, on) => {
      const parts = mechaudit.all(`.${layer}`, svg);
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = label;
      const set = (state) => {
        button.setAttribute("aria-pressed", String(state));
        for (const e of parts) e.setAttribute("visibility", state ? "visible" : "hidden");
      };
      button.addEventListener("click", () => set(button.getAttribute("aria-pressed") !== "true"));
      set(on);
      marks.append(button);
    };
    if (map.branches) toggle("formulas", "layer-branches", true);
    layers.forEach(([label, points, on], n) => points.length > 0 && toggle(`${label} (${points.length})`, `layer-${n}`, on));
    box.prepend(marks);
    box.append(keys());
    return box;
  }
  return { draw };
})();
