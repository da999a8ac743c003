//! The style sheet of an audit's page.

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
