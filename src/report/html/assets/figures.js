"use strict";
// Histograms and errors against inputs. Observable Plot draws; what can be read out and opened are items
// with a place on the drawing.
const figures = (() => {
  const ulps = (x) => (x === null || x === undefined ? "no number" : `${d3.format(".3~g")(x)} ulps`);
  const ten = (v) => `10${power(Math.round(Math.log10(v))).slice(1)}`;
  const power = (k) => `2${String(k).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d])}`;

  function plot(options) {
    const svg = Plot.plot({
      style: { background: "transparent", fontSize: "12px", overflow: "visible" }, ...options,
    });
    svg.setAttribute("role", "img");
    for (const e of mechaudit.all("[aria-label]", svg)) e.removeAttribute("aria-label");
    svg.setAttribute("aria-label", options.label);
    indices(svg);
    return svg;
  }

  // A symbol's index stands lower: that of I_n, but not of omega_crank.
  const INDEX = /(?<!\w)([dD]?\p{L})_([\p{L}\d]+)(?!\w)/u;
  function indices(svg) {
    for (const text of mechaudit.all("text", svg)) {
      const found = text.childElementCount === 0 && INDEX.exec(text.textContent);
      if (!found) continue;
      const [whole, symbol, index] = found;
      const before = text.textContent.slice(0, found.index) + symbol;
      const parts = [[index, "0.3em", "75%"], [text.textContent.slice(found.index + whole.length), "-0.225em", null]];
      text.textContent = before;
      for (const [words, dy, size] of parts) {
        const part = d3.select(text).append("tspan").attr("dy", dy).text(words);
        if (size) part.attr("font-size", size);
      }
    }
  }

  // Round numbers within a range, and one format in which each is told from the others.
  function axisOf([low, high], count) {
    const ticks = d3.ticks(low, high, count);
    const largest = d3.max(ticks, Math.abs) ?? 0;
    const step = ticks.length > 1 ? ticks[1] - ticks[0] : largest;
    const plain = largest === 0 || (largest >= 1e-3 && largest < 1e6);
    const write = (v, n) => (plain ? v.toFixed(n) : v.toExponential(n).replace("e+", "e"));
    let digits = 0;
    while (digits < 12 && ticks.some((v) => Math.abs(write(v, digits) - v) > 1e-6 * step)) digits += 1;
    return { ticks, tickFormat: (v) => (v === 0 ? "0" : write(v, digits).replace("-", "−")) };
  }

  // Reading out by pointer and by arrow keys; a click or Enter opens the case of the item.
  function reading(svg, items, open, note = "") {
    const read = document.createElement("output");
    read.className = "read";
    read.textContent = note;
    if (items.length === 0) return read;
    svg.tabIndex = 0;
    const ring = d3.select(svg).append("circle").attr("r", 6).attr("fill", "none").attr("stroke", "var(--fg)")
      .attr("stroke-width", 2).attr("pointer-events", "none").attr("visibility", "hidden");
    let now = -1;
    const show = (k) => {
      now = k;
      ring.attr("visibility", k < 0 ? "hidden" : "visible");
      if (k >= 0) ring.attr("cx", items[k].x).attr("cy", items[k].y);
      read.textContent = k < 0 ? note : items[k].text;
    };
    const near = (event) => {
      const [x, y] = d3.pointer(event, svg);
      const far = (p) => (p.wide ? Math.abs(p.x - x) * 3 + Math.abs(p.y - y) * 0.05 : Math.hypot(p.x - x, p.y - y));
      const k = d3.leastIndex(items, (a, b) => far(a) - far(b));
      return far(items[k]) < 40 ? k : -1;
    };
    svg.addEventListener("pointermove", (event) => show(near(event)));
    svg.addEventListener("pointerleave", () => show(-1));
    svg.addEventListener("click", (event) => {
      const k = near(event);
      if (k >= 0) open(items[k].open);
    });
    svg.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (step) show((now + step + items.length) % items.length);
      else if (event.key === "Enter" && now >= 0) open(items[now].open);
      else return;
      event.preventDefault();
    });
    return read;
  }

  function figure(caption, svg, read, wide = false) {
    const box = document.createElement("figure");
    box.classList.toggle("wide", wide);
    const words = document.createElement("figcaption");
    words.textContent = caption;
    box.append(words, svg, read);
    return box;
  }

  // The axis that all outputs of a method share: octaves from 2^-12 or less to at most 2^64; what is
  // beyond stands at the ends.
  function octaves(method) {
    const all = method.outputs.flatMap((o) => o.octaves.map((b) => b[0]).filter((e) => e !== null));
    const low = Math.max(-12, Math.min(-2, ...all));
    const high = Math.min(64, Math.max(3, ...all));
    return { low, high, step: Math.ceil((high - low + 1) / 48) };
  }

  function histogram(method, output, width, open) {
    const { low, high, step } = octaves(method);
    const bars = new Map();
    for (const [e, n, worst] of output.octaves) {
      // Exact values have a bar of their own, apart from the least errors.
      const k = e === null ? -2 : Math.floor((Math.min(Math.max(e, low), high) - low) / step);
      const old = bars.get(k) ?? { k, n: 0, top: -Infinity };
      const later = e === null || e >= old.top ? { worst, top: e ?? 0 } : {};
      bars.set(k, { ...old, ...later, n: old.n + n });
    }
    const from = (k) => low + k * step;
    const data = [...bars.values()].sort((a, b) => a.k - b.k)
      .map((b) => ({ ...b, x1: from(b.k) + 0.04 * step, x2: from(b.k + 1) - 0.04 * step }));
    const ends = [from(-2), from(Math.floor((high - low) / step) + 1)];
    const most = Math.max(2, ...data.map((b) => b.n));
    const limit = output.limit && Math.log2(output.limit);
    // None so near to "exact" that the two words would touch.
    const apart = ((ends[1] - ends[0]) * 40) / (width - 66);
    const ticks = d3.ticks(low, high, Math.max(3, Math.floor(width / 60)))
      .filter((e) => Number.isInteger(e) && e - from(-1.5) > apart);
    const svg = plot({
      label: `Errors of ${output.name}, counted by octaves; arrow keys read, Enter opens the worst case`,
      width, height: 190, marginLeft: 46, marginBottom: 34,
      x: { domain: ends, ticks: [from(-1.5), ...ticks], tickFormat: (e) => (e < low ? "exact" : power(e)),
        label: "error, ulps" },
      y: { type: "log", domain: [0.7, most * 1.4], grid: true, label: "values", ticks: decades(1, most, 5), tickFormat: ten },
      marks: [
        Plot.rect(data, { x1: "x1", x2: "x2", y1: () => 0.7, y2: "n", fill: "var(--blue)" }),
        ...(limit ? [Plot.ruleX([limit], { stroke: "var(--bad)", strokeDasharray: "4 3", strokeWidth: 1.5 })] : []),
      ],
    });
    const x = svg.scale("x");
    const y = svg.scale("y");
    const spoken = (b) => {
      if (b.k < 0) return "exact";
      const least = from(b.k) <= low ? "0" : power(from(b.k));
      const beyond = from(b.k + 1) > high && high === 64;
      return beyond ? `${power(from(b.k))} ulps and more` : `${least} to ${power(from(b.k + 1))} ulps`;
    };
    const items = data.map((b) => ({
      x: x.apply((b.x1 + b.x2) / 2), y: y.apply(b.n), wide: true,
      text: `${spoken(b)}: ${b.n} values`, open: { number: b.worst },
    }));
    const wrong = output.wrong ? `; ${output.wrong} values of the wrong kind are not in it` : "";
    const budget = output.limit ? `; the line is the budget, ${output.limit} ulps` : "";
    return figure(`${output.name}: errors by octaves${budget}${wrong}`, svg, reading(svg, items, open));
  }

  // Where a number stands on an axis: in proportion, or, where sizes differ by orders of magnitude,
  // logarithmically to both sides of zero. Plot's own symlog overflows near the largest number.
  function axis(values, width) {
    const sizes = values.map(Math.abs).filter((v) => v > 0).sort((a, b) => a - b);
    if (sizes.length === 0 || sizes.at(-1) < 1e3 * d3.quantileSorted(sizes, 0.5)) {
      return { at: (v) => v, options: axisOf(d3.extent(values), Math.floor(width / 80)) };
    }
    // Four decades below the median and eight above; what is beyond stands at the ends.
    const middle = Math.floor(Math.log10(d3.quantileSorted(sizes, 0.5)));
    const low = Math.max(middle - 4, Math.floor(Math.log10(d3.quantileSorted(sizes, 0.05))));
    const high = Math.min(middle + 8, Math.ceil(Math.log10(sizes.at(-1))));
    const at = (v) => (v === 0 ? 0 : Math.sign(v) * Math.min(1.3 + high - low, Math.max(0.05, 1 + Math.log10(Math.abs(v)) - low)));
    const sides = [Math.min(...values) < 0 ? -1 : 0, Math.max(...values) > 0 ? 1 : 0].filter(Boolean);
    const every = Math.max(1, Math.ceil((high - low) / Math.max(1, Math.floor(width / (55 * sides.length)))));
    const powers = d3.range(low + every, high + 1, every);
    const ticks = [0, ...sides.flatMap((s) => powers.map((e) => s * (1 + e - low)))];
    const name = (t) => (t === 0 ? "0" : `${t < 0 ? "−" : ""}10${power(Math.abs(t) - 1 + low).slice(1)}`);
    return { at, options: { ticks, tickFormat: name } };
  }
  // Powers of ten from a to b, at most so many.
  function decades(a, b, most) {
    const [low, high] = [Math.ceil(Math.log10(a)), Math.floor(Math.log10(b))];
    return d3.range(low, high + 1, Math.max(1, Math.ceil((high - low + 1) / most))).map((e) => Number(`1e${e}`));
  }

  function scatter(method, input, k, width, open) {
    const output = method.outputs[k];
    const [name, place] = method.inputs[input];
    const at = (p) => method.cases[p[0]][3][place] ?? p[2][input];
    const points = method.points.filter((p) => typeof at(p) === "number");
    const top = Math.max(8, ...points.map((p) => p[3][k] ?? 0));
    const ceiling = Math.min(top, 1e20) * 4;
    const along = axis(points.map(at), width);
    const rows = points.map((p) => ({
      p, x: along.at(at(p)), wrong: p[3][k] === null,
      y: p[3][k] === null ? ceiling : Math.min(Math.max(p[3][k], 1e-3), ceiling),
    }));
    const colour = { "t-good": "var(--blue)", "t-bad": "var(--bad)", "t-doubt": "var(--doubt)" };
    const mark = { x: "x", y: "y", stroke: (r) => colour[r.p[1]] ?? "var(--blue)" };
    const svg = plot({
      label: `Error of ${output.name} against ${name}; arrow keys read, Enter opens the case`,
      width, height: 220, marginLeft: 52, marginBottom: 34,
      x: { label: name, ...along.options },
      y: { type: "log", domain: [1e-3, ceiling * 1.5], grid: true, label: `${output.name}, ulps`,
        ticks: decades(1e-3, ceiling, 6), tickFormat: ten },
      marks: [
        ...(output.limit ? [Plot.ruleY([output.limit], { stroke: "var(--bad)", strokeDasharray: "4 3" })] : []),
        Plot.dot(rows.filter((r) => !r.wrong), { ...mark, r: 2.2, strokeOpacity: 0.75 }),
        Plot.dot(rows.filter((r) => r.wrong), { ...mark, symbol: "times", r: 3.5 }),
      ],
    });
    const x = svg.scale("x");
    const y = svg.scale("y");
    const items = rows.map((r) => ({
      x: x.apply(r.x), y: y.apply(r.y), open: { number: r.p[0], ulps: r.p[3] },
      text: `${name} = ${at(r.p)}: ${ulps(r.p[3][k])}, ${method.regions[method.cases[r.p[0]][0]]}`,
    })).sort((a, b) => a.x - b.x);
    return figure(`${output.name} against ${name}, ${rows.length} cases of all regions; ✕: no error in ulps`,
      svg, reading(svg, items, open));
  }

  return { axisOf, figure, histogram, plot, reading, scatter, ulps };
})();
