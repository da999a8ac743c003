//! Text for people: width, wrapping, colour and aligned tables.

use anstyle::{AnsiColor, Style};
use std::io::IsTerminal;

/// Width where the terminal does not say.
const DEFAULT_WIDTH: usize = 100;

pub const BOLD: Style = Style::new().bold();
pub const DIM: Style = Style::new().dimmed();
pub const GOOD: Style = AnsiColor::Green.on_default();
pub const BAD: Style = AnsiColor::Red.on_default().bold();
pub const DOUBT: Style = AnsiColor::Yellow.on_default();
pub const NEW: Style = AnsiColor::Cyan.on_default();
pub const PLAIN: Style = Style::new();

/// Columns to write in: those of the terminal, between 60 and 140.
pub fn width() -> usize {
    if !std::io::stdout().is_terminal() {
        return DEFAULT_WIDTH;
    }
    match terminal_size::terminal_size() {
        Some((terminal_size::Width(w), _)) => usize::from(w).clamp(60, 140),
        None => DEFAULT_WIDTH,
    }
}

/// `text` in a style.
pub fn paint(style: Style, text: &str) -> String {
    if style.is_plain() || text.is_empty() {
        return text.into();
    }
    format!("{}{text}{}", style.render(), style.render_reset())
}

/// Breaks `text` into lines of at most `width` columns, the first after `indent` columns that
/// are already written, the others indented by as much.
pub fn wrap(text: &str, indent: usize, width: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    let mut fresh = true;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if !fresh && column + 1 + length > width {
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            column = indent;
            fresh = true;
        }
        if !fresh {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
        fresh = false;
    }
    out
}

/// An indented, wrapped paragraph.
pub fn paragraph(text: &str, indent: usize, width: usize) -> String {
    format!("{}{}\n", " ".repeat(indent), wrap(text, indent, width))
}

/// A number for a table: three or four figures, exponents only where they are needed.
pub fn short(x: f64) -> String {
    let size = x.abs();
    if !x.is_finite() {
        return x.to_string();
    }
    match size {
        0.0 => "0".into(),
        s if !(1e-3..1e6).contains(&s) => format!("{x:.2e}"),
        s if s < 1.0 => format!("{x:.3}"),
        s if s < 100.0 => format!("{x:.2}"),
        s if s < 1000.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// A share in per cent.
pub fn percent(x: f64) -> String {
    if x.is_finite() {
        format!("{} %", short(x * 100.0))
    } else {
        x.to_string()
    }
}

/// A table with aligned columns. Columns named in `left` are flush left, others right.
pub struct Table {
    header: Vec<&'static str>,
    left: Vec<usize>,
    rows: Vec<Vec<(String, Style)>>,
}

impl Table {
    pub fn new(header: &[&'static str], left: &[usize]) -> Table {
        Table {
            header: header.to_vec(),
            left: left.to_vec(),
            rows: Vec::new(),
        }
    }

    pub fn row(&mut self, cells: Vec<(String, Style)>) {
        self.rows.push(cells);
    }

    /// The lines, each indented.
    pub fn render(&self, indent: usize) -> String {
        let widths: Vec<usize> = (0..self.header.len())
            .map(|i| {
                let cells = self.rows.iter().map(|r| r[i].0.chars().count());
                cells
                    .chain([self.header[i].chars().count()])
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let line = |cells: Vec<(&str, Style)>| {
            let mut out = " ".repeat(indent);
            for (i, (text, style)) in cells.into_iter().enumerate() {
                let gap = " ".repeat(widths[i] - text.chars().count());
                if i > 0 {
                    out.push_str("  ");
                }
                if self.left.contains(&i) {
                    out.push_str(&paint(style, text));
                    if i + 1 < widths.len() {
                        out.push_str(&gap);
                    }
                } else {
                    out.push_str(&gap);
                    out.push_str(&paint(style, text));
                }
            }
            out.push('\n');
            out
        };
        let mut out = line(self.header.iter().map(|h| (*h, DIM)).collect());
        for r in &self.rows {
            out.push_str(&line(r.iter().map(|c| (c.0.as_str(), c.1)).collect()));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrapping_keeps_within_the_width() {
        let text = wrap("one two three four five six", 4, 14);
        assert_eq!(text, "one two\n    three four\n    five six");
        assert!(text.lines().all(|l| l.len() <= 14));
        assert_eq!(wrap("incompressible", 2, 5), "incompressible");
    }

    #[test]
    fn tables_align() {
        let mut t = Table::new(&["name", "value"], &[0]);
        t.row(vec![("φ2".into(), PLAIN), ("1.5".into(), PLAIN)]);
        t.row(vec![("longer".into(), PLAIN), ("10".into(), PLAIN)]);
        let text = anstream::adapter::strip_str(&t.render(2)).to_string();
        assert_eq!(text, "  name    value\n  φ2        1.5\n  longer     10\n");
    }

    #[test]
    fn short_numbers() {
        for (x, text) in [
            (0.0, "0"),
            (0.5, "0.500"),
            (1.0, "1.00"),
            (123.456, "123.5"),
            (12345.6, "12346"),
            (1e-9, "1.00e-9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(x), text);
        }
        assert_eq!(percent(0.25), "25.00 %");
    }
}
