"use strict";
// Figures are drawn where they come into view; cells, bars and points open their case.
document.addEventListener("DOMContentLoaded", () => {
  const { methods } = mechaudit.data("audit-data");
  const dialog = document.getElementById("case");
  const element = (name, text, ...classes) => {
    const e = document.createElement(name);
    if (text !== undefined) e.textContent = text;
    e.classList.add(...classes);
    return e;
  };

  function table(heads, rows, left) {
    const box = element("div", undefined, "scroll");
    const body = box.appendChild(document.createElement("table"));
    const head = body.createTHead().insertRow();
    heads.forEach((h, k) => {
      const th = head.appendChild(element("th", h));
      th.classList.toggle("left", left.includes(k));
    });
    const into = body.createTBody();
    for (const row of rows) {
      const tr = into.insertRow();
      row.forEach((text, k) => (tr.insertCell().textContent = text) && tr.cells[k].classList.toggle("left", left.includes(k)));
    }
    return box;
  }

  // What is open is `{ number, ulps }` of a case, or `{ point, error }` of a map.
  function open(m, what) {
    const method = methods[m];
    const [region, head, last, input, number] = what.point ? [] : method.cases[what.number];
    const whole = number === null || number === undefined ? null : method.whole[number];
    const place = what.point ? `--at ${what.point.join(",")}` : `${method.heads[head]} ${last}`;
    const parts = [element("button", "Close", "close"), element("h2", `${method.name}, ${what.point ? "point of the map" : method.regions[region]}`)];
    parts[0].type = "button";
    parts[0].addEventListener("click", () => dialog.close());
    parts[1].id = "case-title";
    const meaning = document.querySelector(`section[data-m="${m}"] .meaning[data-r="${region}"]`);
    if (meaning) parts.push(element("p", meaning.textContent, "soft"));
    if (whole) {
      const verdict = parts.at(parts.push(element("p")) - 1);
      verdict.append(element("span", whole.verdict, "sign", whole.tone), whole.reason ? `: ${whole.reason}` : "");
      parts.push(table(["input", "unit", "decimal", "hexadecimal"], whole.input, [0, 1]));
      if (whole.answer !== null) parts.push(element("p", `Got: ${whole.answer}`));
      if (whole.values.length > 0) {
        const heads = ["output", "due", "got", "hexadecimal", "ulps", "u(1+cond)", "of budget", "condition"];
        parts.push(element("h3", "Values"), table(heads, whole.values, [0]));
      }
      if (whole.left_out > 0) parts.push(element("p", `${whole.left_out} more numbers are left out.`, "soft"));
      const facts = [whole.branch, whole.proof && `reference: ${whole.proof}`, `decided at ${whole.bits} bits`];
      parts.push(element("p", facts.filter(Boolean).join("; "), "soft", "small"));
    } else {
      const numbers = what.point ?? input;
      const named = numbers.map((x, k) => [method.inputs.find((i) => i[1] === k)?.[0] ?? `[${k}]`, String(x)]);
      if (named.length > 0) parts.push(table(["input", "decimal"], named, [0]));
      if (what.error) parts.push(element("p", `${what.error}.`));
      if (what.ulps) parts.push(table(["output", "error"], method.outputs.map((o, k) => [o.name, figures.ulps(what.ulps[k])]), [0]));
    }
    const command = element("div", undefined, "command");
    const code = element("code", `${method.command[0]}${place}${method.command[1]}`);
    const copy = element("button", "Copy the command", "copy");
    copy.type = "button";
    command.append(code, copy);
    parts.push(element("h3", "Run it again"), command);
    dialog.replaceChildren(...parts);
    dialog.showModal();
  }
  // A click beside the dialog closes it.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  document.addEventListener("click", (event) => {
    const button = event.target.closest?.("button[data-c]");
    if (button) open(Number(button.closest("[data-m]").dataset.m), { number: Number(button.dataset.c) });
  });

  function chooser(names, label, chosen) {
    const box = element("div", undefined, "choose");
    const select = document.createElement("select");
    names.forEach((name, k) => select.add(new Option(name, k)));
    const text = element("label", `${label} `);
    text.append(select);
    box.append(text);
    select.addEventListener("change", () => chosen(Number(select.value)));
    return box;
  }

  // Histograms of the first outputs, errors of the chosen one against each input, its map.
  function draw(box, m) {
    const method = methods[m];
    const shown = (what) => open(m, what);
    const column = Math.min(box.clientWidth, 460);
    const few = method.outputs.slice(0, 6);
    const histograms = few.map((o) => figures.histogram(method, o, column, shown));
    const of = (k) => [
      ...(method.points.length ? method.inputs.map((_, i) => figures.scatter(method, i, k, column, shown)) : []),
      ...(method.map ? [errorMap.draw(method, k, Math.min(box.clientWidth, 990), shown)] : []),
    ];
    let chosen = of(0);
    const names = method.outputs.map((o) => o.name);
    const choose = chooser(names, "Errors of", (k) => {
      const next = of(k);
      chosen.forEach((e) => e.remove());
      box.append(...next);
      chosen = next;
    });
    box.replaceChildren(...histograms, ...(chosen.length && names.length > 1 ? [choose] : []), ...chosen);
  }
  const seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      draw(target, Number(target.dataset.figures));
    }
  }, { rootMargin: "400px" });
  const boxes = mechaudit.all("[data-figures]");
  boxes.forEach((box) => seen.observe(box));
  // On paper every figure is there.
  addEventListener("beforeprint", () => boxes.forEach((box) => box.childElementCount || draw(box, Number(box.dataset.figures))));
  mechaudit.open = open;
});
