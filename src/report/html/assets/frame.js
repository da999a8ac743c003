"use strict";
// What every page does: colour scheme, filters, sorting, copying. Pages read without it.
const mechaudit = (() => {
  const root = document.documentElement;
  const all = (query, within = document) => [...within.querySelectorAll(query)];
  root.classList.add("js");

  // Storage is refused to some pages that are opened from disk.
  const stored = (value) => {
    try {
      if (value !== undefined) localStorage.setItem("mechaudit-theme", value);
      return localStorage.getItem("mechaudit-theme");
    } catch {
      return null;
    }
  };
  function theme(button) {
    const schemes = ["system", "light", "dark"];
    const show = (name) => {
      if (name === "system") delete root.dataset.theme;
      else root.dataset.theme = name;
      button.textContent = `Colours: ${name}`;
    };
    let now = schemes.includes(stored()) ? stored() : "system";
    show(now);
    button.addEventListener("click", () => {
      now = schemes[(schemes.indexOf(now) + 1) % schemes.length];
      stored(now);
      show(now);
    });
  }

  // Buttons of verdicts and a search field over the elements that `data-of` selects. No button pressed
  // means every verdict.
  function filter(box) {
    const items = all(box.dataset.of);
    const buttons = all("button[data-verdict]", box);
    const search = box.querySelector("input[type=search]");
    const count = box.querySelector("output");
    const texts = items.map((e) => e.textContent.toLowerCase());
    const links = new Map(all(".toc a[href]").map((a) => [a.hash.slice(1), a.closest("li")]));
    const apply = () => {
      const pressed = buttons.filter((b) => b.getAttribute("aria-pressed") === "true");
      const verdicts = new Set(pressed.map((b) => b.dataset.verdict));
      const words = (search?.value ?? "").toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      items.forEach((e, k) => {
        const fits = verdicts.size === 0 || verdicts.has(e.dataset.verdict);
        e.hidden = !(fits && words.every((w) => texts[k].includes(w)));
        shown += e.hidden ? 0 : 1;
        const link = e.id && links.get(e.id);
        if (link) link.hidden = e.hidden;
      });
      for (const section of all("section[data-filtered]")) {
        const own = items.filter((e) => section.contains(e));
        if (own.length > 0) section.hidden = own.every((e) => e.hidden);
      }
      if (count) count.textContent = `${shown} of ${items.length} shown`;
    };
    for (const b of buttons) {
      b.addEventListener("click", () => {
        b.setAttribute("aria-pressed", String(b.getAttribute("aria-pressed") !== "true"));
        apply();
      });
    }
    search?.addEventListener("input", apply);
    apply();
  }

  // Numbers before words, either way round; rows that are equal keep their order.
  function compare(a, b) {
    const [x, y] = [a, b].map((v) => (v.trim() === "" ? NaN : Number(v)));
    if (Number.isNaN(x) && Number.isNaN(y)) return a.localeCompare(b);
    if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
    return x - y;
  }
  function sortable(table) {
    const heads = all("thead th", table);
    const body = table.tBodies[0];
    const key = (row, k) => row.cells[k]?.dataset.v ?? row.cells[k]?.textContent ?? "";
    heads.forEach((th, k) => {
      if (th.dataset.sort === "none" || th.colSpan > 1) return;
      const button = document.createElement("button");
      button.type = "button";
      button.append(...th.childNodes);
      th.append(button);
      button.addEventListener("click", () => {
        const up = th.getAttribute("aria-sort") !== "ascending";
        heads.forEach((h) => h.removeAttribute("aria-sort"));
        th.setAttribute("aria-sort", up ? "ascending" : "descending");
        const rows = [...body.rows].map((row) => [key(row, k), row]);
        rows.sort((a, b) => (up ? compare(a[0], b[0]) : compare(b[0], a[0])));
        body.append(...rows.map((r) => r[1]));
      });
    });
  }

  // What a card on a phone needs: each cell knows the head of its column, and each element its part in the table.
  function stack(table) {
    const heads = all("thead th", table).map((th) => th.textContent);
    table.classList.add("stack");
    if (table.tBodies[0].rows.length > 12) table.parentElement.classList.add("long");
    table.setAttribute("role", "table");
    for (const row of table.rows) row.setAttribute("role", "row");
    for (const th of all("thead th", table)) th.setAttribute("role", "columnheader");
    for (const row of table.tBodies[0].rows) {
      for (const cell of row.cells) {
        const [k, own] = [cell.cellIndex, cell.tagName === "TH"];
        cell.setAttribute("role", own ? "rowheader" : "cell");
        if (k > 0 && !own && !["", "verdict", "region", "reason, or the command"].includes(heads[k])) cell.dataset.label = heads[k];
      }
    }
  }

  function select(element) {
    const range = document.createRange();
    range.selectNodeContents(element);
    getSelection().removeAllRanges();
    getSelection().addRange(range);
  }
  // The text goes to the clipboard, or stays selected where there is none.
  async function copy(button) {
    const source = document.getElementById(button.dataset.copy) ?? button.previousElementSibling;
    const name = button.textContent;
    select(source);
    try {
      await navigator.clipboard.writeText(source.textContent);
      button.textContent = "copied";
    } catch {
      button.textContent = "selected";
    }
    setTimeout(() => (button.textContent = name), 1500);
  }

  // What scrolls sideways can be reached by keyboard, and only that.
  function reachable() {
    for (const e of all(".scroll, .formula, .ob, .pair > div, pre")) {
      if (e.scrollWidth > e.clientWidth || e.scrollHeight > e.clientHeight + 1) e.tabIndex = 0;
      else e.removeAttribute("tabindex");
    }
  }

  function start() {
    theme(document.getElementById("theme"));
    all(".filter[data-of]").forEach(filter);
    all("table:not(.entries)").forEach(stack);
    all("table.sortable").forEach(sortable);
    document.addEventListener("click", (event) => {
      const button = event.target.closest?.("button.copy");
      if (button) copy(button);
    });
    // On paper nothing is folded.
    addEventListener("beforeprint", () => all("details").forEach((d) => (d.open = true)));
    reachable();
    addEventListener("resize", reachable);
    addEventListener("toggle", reachable, true);
    const contents = document.querySelector(".toc details");
    if (contents && matchMedia("(max-width: 64rem)").matches) contents.open = false;
  }
  const data = (id) => JSON.parse(document.getElementById(id).textContent);
  document.addEventListener("DOMContentLoaded", start);
  return { all, compare, data, select };
})();
