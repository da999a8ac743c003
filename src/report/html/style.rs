//! The style sheet of the page, for light and dark.

/// Of every page; colours are variables that the dark scheme sets anew.
pub const CSS: &str = "
:root { color-scheme: light dark; --bg: #fcfcfa; --fg: #1d2125; --soft: #5b646d; --line: #d8dcdf;
  --card: #ffffff; --agrees: #dff0e1; --rounding: #eef3d0; --misprint: #f8dcc0;
  --unexplained: #f6c9cb; --good: #1e7a34; --bad: #b3261e; --doubt: #8a5a00; --new: #0a6178; }
@media (prefers-color-scheme: dark) { :root { --bg: #15181b; --fg: #e4e7ea; --soft: #9aa4ad;
  --line: #343b41; --card: #1c2125; --agrees: #1c3a25; --rounding: #3a3e1a; --misprint: #573718;
  --unexplained: #5d2327; --good: #6fd08a; --bad: #ff8a80; --doubt: #e6b450; --new: #67cbe3; } }
* { box-sizing: border-box; } a { color: var(--new); }
body { margin: 0 auto; padding: 2rem 1.25rem 5rem; max-width: 76rem; background: var(--bg);
  color: var(--fg); font: 16px/1.55 system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 .25rem; }
h2 { font-size: 1.2rem; margin: 2.5rem 0 .75rem; padding-bottom: .25rem;
  border-bottom: 1px solid var(--line); }
p { margin: .4rem 0; max-width: 46rem; }
.soft { color: var(--soft); }
.verdict { max-width: none; font-size: 1.05rem; } .sign { color: var(--tone); font-weight: 700; }
.finding { background: var(--card); border: 1px solid var(--line); border-left: .3rem solid
  var(--tone); border-radius: .3rem; padding: .7rem 1rem; margin: .8rem 0; }
.finding h3 { font-size: 1rem; margin: 0; }
.tag { color: var(--tone); font-size: .85rem; font-weight: 600; }
.alarm { color: var(--bad); font-weight: 700; }
.t-good { --tone: var(--good); } .t-bad { --tone: var(--bad); }
.t-doubt { --tone: var(--doubt); } .t-new { --tone: var(--new); }
.scroll { overflow-x: auto; padding-bottom: .5rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .85rem; }
th, td { padding: .2rem .55rem; border: 1px solid var(--line); text-align: right;
  white-space: nowrap; }
th { background: var(--card); font-weight: 600; }
th.left, td.left { text-align: left; }
.entries td { position: relative; }
.agrees { background: var(--agrees); } .rounding { background: var(--rounding); }
.misprint { background: var(--misprint); } .unexplained { background: var(--unexplained); }
.entries td[data-tip]:hover::after, .entries td[data-tip]:focus::after { content: attr(data-tip);
  position: absolute; z-index: 2; left: 0; top: 100%; padding: .4rem .6rem; text-align: left;
  white-space: pre; background: var(--fg); color: var(--bg); border-radius: .25rem;
  pointer-events: none; }
.side { display: flex; flex-wrap: wrap; gap: 1rem 2rem; }
.side details:last-child td[data-tip]:nth-last-child(-n+2)::after { left: auto; right: 0; }
details { margin: .6rem 0; } summary { cursor: pointer; font-weight: 600; padding: .2rem 0; }
.legend span { padding: .1rem .5rem; border: 1px solid var(--line); border-radius: .25rem;
  margin-right: .4rem; }
";

/// What the pages of papers have besides: contents beside the text, cards side by side as far as
/// there is room, and nothing wider than its card.
pub const PAPER_CSS: &str = "
body { max-width: 125rem; } p { max-width: 60rem; }
.page { display: grid; grid-template-columns: minmax(0, 1fr); gap: 0 2rem; margin-top: 1rem; }
.toc { font-size: .85rem; line-height: 1.4; max-height: 40vh; overflow-y: auto; padding: .5rem .8rem;
  border: 1px solid var(--line); border-radius: .3rem; background: var(--card); }
.toc ul { list-style: none; margin: 0; padding: 0; } .toc ul ul { padding-left: .8rem; }
.toc li { margin: .25rem 0; } .toc a { color: inherit; text-decoration: none; }
.toc a:hover, .toc a:focus { text-decoration: underline; }
@media (min-width: 64rem) { .page { grid-template-columns: 15rem minmax(0, 1fr); }
  .toc { position: sticky; top: 1rem; max-height: calc(100vh - 2rem); align-self: start; }
  main > h2:first-child { margin-top: 0; } }
.cards { display: grid; gap: .8rem; margin: .8rem 0;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 27rem), 1fr)); }
.cards > .wide { grid-column: 1 / -1; }
.flow { columns: 27rem; column-gap: .8rem; margin: .8rem 0; }
.flow > .finding { break-inside: avoid; margin: 0 0 .8rem; } .flow > .wide { column-span: all; margin-top: .8rem; }
.cards > .finding { margin: 0; } .finding { min-width: 0; overflow-wrap: break-word; scroll-margin-top: 1rem; }
h2 { scroll-margin-top: 1rem; }
.figures { display: grid; grid-template-columns: fit-content(50%) minmax(0, 1fr); gap: .1rem 1.2rem;
  margin: .5rem 0 0; font-size: .85rem; font-variant-numeric: tabular-nums; }
.figures dt { color: var(--soft); } .figures dd { margin: 0; overflow-wrap: anywhere; }
.formula { grid-column: 1 / -1; overflow: auto hidden; padding: .2rem 0 .5rem; }
math { font-size: 1.1rem; } code { font-size: .9em; overflow-wrap: anywhere; }
sub, sup { line-height: 0; } .side { gap: 0 2rem; } .side details { min-width: 0; max-width: 100%; }
@media (max-width: 40rem) { body { padding: 1rem .75rem 3rem; } .finding { padding: .6rem .7rem; }
  .figures { grid-template-columns: minmax(0, 1fr); gap: 0; } .figures dd { margin-bottom: .35rem; }
  math { font-size: 1rem; } .side details { overflow-x: auto; } }
";

/// What the page of an audit has besides.
pub const AUDIT_CSS: &str = "
svg { max-width: 100%; height: auto; font: 11px system-ui, sans-serif; fill: var(--fg); }
svg .axis { stroke: var(--soft); fill: none; } svg .grid { stroke: var(--line); fill: none; }
svg .bar { fill: var(--new); } svg .limit { stroke: var(--bad); stroke-dasharray: 4 3; }
svg polyline { fill: none; stroke-width: 1.6; } svg polyline.s0 { stroke-width: 3; } svg text { fill: var(--soft); }
.s0 { stroke: var(--new); stroke-dasharray: 7 4; } .s1 { stroke: var(--doubt); } .s2 { stroke: var(--good); }
.k0 { color: var(--new); } .k1 { color: var(--doubt); } .k2 { color: var(--good); }
.m0 { fill: #26456e; } .m1 { fill: #3a7ab8; } .m2 { fill: #6ab0c9; } .m3 { fill: #b5d99c; }
.m4 { fill: #f5d76e; } .m5 { fill: #ef8a3c; } .m6 { fill: #b3261e; } .m7 { fill: #ff4fd8; }
.keys span { margin-right: .6rem; white-space: nowrap; } .news { padding-left: 1.2rem; }
.key { display: inline-block; width: .8rem; height: .8rem; border-radius: .15rem; }
svg.key path { stroke: none; } figure { margin: 0; min-width: 0; }
.maps, .lines { display: grid; gap: 1rem 2rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 30rem), 1fr)); }
.lines { grid-template-columns: repeat(auto-fill, minmax(min(100%, 21rem), 1fr)); } figure svg { width: 100%; } figcaption { font-size: .85rem; }
pre { background: var(--card); border: 1px solid var(--line); padding: .6rem .8rem; overflow-x: auto;
  font-size: .8rem; line-height: 1.4; }
code.copy { user-select: all; cursor: copy; }
";
