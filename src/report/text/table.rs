//! Aligned tables.

use super::style::{DIM, paint};
use anstyle::Style;

/// A table with aligned columns. Columns named in `left` are flush left, others right.
#[derive(Clone)]
pub struct Table {
    header: Vec<&'static str>,
    left: Vec<usize>,
    rows: Vec<Vec<(String, Style)>>,
}

impl Table {
    /// A table without rows.
    pub fn new(header: &[&'static str], left: &[usize]) -> Table {
        Table {
            header: header.to_vec(),
            left: left.to_vec(),
            rows: Vec::new(),
        }
    }

    /// One more row.
    pub fn row(&mut self, cells: Vec<(String, Style)>) {
        self.rows.push(cells);
    }

    /// Leaves out columns, in this order, until the lines are no longer than that.
    pub fn fitted(mut self, width: usize, dispensable: &[&str]) -> Table {
        for name in dispensable {
            let widths = self.widths();
            let gaps = 2 * widths.len().saturating_sub(1);
            if widths.iter().sum::<usize>() + gaps <= width {
                break;
            }
            let Some(k) = self.header.iter().position(|h| h == name) else {
                continue;
            };
            self.header.remove(k);
            self.rows.iter_mut().for_each(|r| drop(r.remove(k)));
            self.left.retain(|i| *i != k);
            let later = self.left.iter_mut().filter(|i| **i > k);
            later.for_each(|i| *i -= 1);
        }
        self
    }

    fn widths(&self) -> Vec<usize> {
        let of = |(i, head): (usize, &&str)| {
            let cells = self.rows.iter().map(|r| r[i].0.chars().count());
            cells.chain([head.chars().count()]).max().unwrap_or(0)
        };
        self.header.iter().enumerate().map(of).collect()
    }

    /// The lines, each indented.
    pub fn render(&self, indent: usize) -> String {
        let widths = self.widths();
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
    use super::super::style::{PLAIN, plain};
    use super::*;

    #[test]
    fn tables_align() {
        let mut t = Table::new(&["name", "value"], &[0]);
        t.row(vec![("φ2".into(), PLAIN), ("1.5".into(), PLAIN)]);
        t.row(vec![("longer".into(), PLAIN), ("10".into(), PLAIN)]);
        let text = plain(&t.render(2));
        assert_eq!(text, "  name    value\n  φ2        1.5\n  longer     10\n");
    }

    #[test]
    fn columns_give_way_to_the_width() {
        let mut t = Table::new(&["name", "much", "verdict"], &[0, 2]);
        let cells = ["a", "1", "pass"].map(|c| (c.to_string(), PLAIN));
        t.row(cells.to_vec());
        let lines = |t: Table| plain(&t.render(0));
        assert_eq!(lines(t.clone().fitted(19, &["much"])), lines(t.clone()));
        let narrow = lines(t.fitted(18, &["none", "much", "name"]));
        assert_eq!(narrow, "name  verdict\na     pass\n");
    }
}
