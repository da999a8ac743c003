//! Tables 2 and 3 as printed.

use crate::papers::number::{Number, records};

const TABLES: [&str; 2] = [
    include_str!("../../../reference/published/zinchenko-table-2.csv"),
    include_str!("../../../reference/published/zinchenko-table-3.csv"),
];

/// Rows of each table; row 48 is row 0 again, a turn later.
pub(super) const ROWS: usize = 49;

/// Columns by table and name. The first six are the splines of I_n, dI_n/dφ and M_o, each followed
/// by its derivative; the last three are the spline of dI_n/dφ, the derivative of that of I_n, and
/// their difference.
pub(super) const COLUMNS: [(u32, &str); 9] = [
    (2, "I_n"),
    (2, "S1_I_n"),
    (2, "dI_n_dphi"),
    (2, "S1_dI_n"),
    (3, "M_o"),
    (3, "S1_M_o"),
    (3, "dI_n_dphi"),
    (3, "S1_I_n"),
    (3, "error"),
];
pub(super) const INERTIA: usize = 0;
pub(super) const INERTIA_SLOPE: usize = 1;
pub(super) const DERIVATIVE_SLOPE: usize = 3;
pub(super) const MOMENT: usize = 4;
pub(super) const DIFFERENCE: usize = 8;

/// The number of the quantity whose spline fills a column, and true for the spline's derivative;
/// none of the difference.
pub(super) fn source(column: usize) -> Option<(usize, bool)> {
    match column {
        0..6 => Some((column / 2, is_slope(column))),
        6 => Some((1, false)),
        7 => Some((0, true)),
        _ => None,
    }
}

/// Returns true if one of the first six columns is the derivative of a spline.
pub(super) fn is_slope(column: usize) -> bool {
    column % 2 == 1
}

/// The column of the other table that prints the same quantity.
pub(super) fn twin(column: usize) -> Option<usize> {
    let same = |other: &usize| *other != column && source(*other) == source(column);
    (0..COLUMNS.len())
        .filter(|c| source(*c).is_some())
        .find(same)
}

/// The printed entries, column by column.
pub(super) fn printed() -> Vec<Vec<Number>> {
    let of = |k: usize| {
        let (text, columns) = (TABLES[k], [0..4, 4..9][k].clone());
        let rows = records(text);
        assert_eq!(rows.len(), ROWS, "rows of a published table");
        let column = |c: usize| rows.iter().map(|r| Number::read(&r[c + 1])).collect();
        (0..columns.len()).map(column).collect::<Vec<_>>()
    };
    [of(0), of(1)].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_entries_are_there() {
        let all = printed();
        assert_eq!(all.iter().map(Vec::len).sum::<usize>(), 441);
        for (column, row, due) in [
            (DERIVATIVE_SLOPE, 11, "-10.553"),
            (MOMENT, 41, "-110.0421"),
            (DIFFERENCE, 1, "-0.119"),
            (6, 44, "-5.26"),
        ] {
            assert_eq!(all[column][row].text, due);
        }
        for (k, text) in TABLES.iter().enumerate() {
            let heads = text.lines().find(|l| l.starts_with("i,")).unwrap();
            let due: Vec<&str> = COLUMNS
                .iter()
                .filter(|c| c.0 == 2 + k as u32)
                .map(|c| c.1)
                .collect();
            assert_eq!(heads[2..].split(',').collect::<Vec<_>>(), due);
        }
        // The last row repeats the first.
        assert!(all.iter().all(|c| c[0].text == c[48].text));
        let twins: Vec<Option<usize>> = (0..9).map(twin).collect();
        let due = [
            None,
            Some(7),
            Some(6),
            None,
            None,
            None,
            Some(2),
            Some(1),
            None,
        ];
        assert_eq!(twins, due);
    }
}
