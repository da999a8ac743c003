//! Aligned tables.

use super::style::{DIM, paint};
use anstyle::Style;

/// A table with aligned columns. Columns named in `left` are flush left, others right.
#[derive(Clone)]
pub struct Table {
    header: Vec<String>,
    left: Vec<usize>,
    rows: Vec<Vec<(String, Style)>>,
}

impl Table {
    /// A table without rows.
    pub fn new(header: &[&str], left: &[usize]) -> Table {
        Table {
            header: header.iter().map(|h| h.to_string()).collect(),
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
        let of = |(i, head): (usize, &String)| {
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
        let mut out = line(self.header.iter().map(|h| (h.as_str(), DIM)).collect());
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

    /// Of three columns the gaps are four characters; what is left of a flush column stays flush.
    #[test]
    fn columns_are_left_out_one_by_one() {
        let mut t = Table::new(&["a", "bb", "cc", "dd", "e"], &[0, 3]);
        t.row(
            ["1", "2", "3", "4444", "5"]
                .map(|c| (c.to_string(), PLAIN))
                .to_vec(),
        );
        let first = |width, names: &[&str]| {
            let text = plain(&t.clone().fitted(width, names).render(0));
            text.lines().next().unwrap().to_string()
        };
        assert_eq!(first(18, &["bb", "cc"]), "a  bb  cc  dd    e");
        assert_eq!(first(17, &["bb", "cc"]), "a  cc  dd    e");
        assert_eq!(first(14, &["bb", "cc"]), "a  cc  dd    e");
        assert_eq!(first(13, &["bb", "cc"]), "a  dd    e");
        assert_eq!(first(1, &["dd"]), "a  bb  cc  e");
        assert_eq!(first(1, &["a", "e"]), "bb  cc  dd");
        let empty = Table::new(&[], &[]).fitted(0, &["a"]).render(1);
        assert_eq!(plain(&empty), " \n");
    }

    #[test]
    fn the_head_is_dim_and_cells_have_their_style() {
        let mut t = Table::new(&["a", "b"], &[0]);
        t.row(vec![("1".into(), PLAIN), ("2".into(), super::DIM)]);
        let text = t.render(0);
        let due = format!(
            "{}  {}\n1  {}\n",
            paint(DIM, "a"),
            paint(DIM, "b"),
            paint(DIM, "2")
        );
        assert_eq!(text, due);
    }
}
