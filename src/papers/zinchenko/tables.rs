//! Tables 2 and 3 as printed.

use crate::papers::number::Number;

const TABLE_2: &str = include_str!("../../../reference/published/zinchenko-table-2.csv");
const TABLE_3: &str = include_str!("../../../reference/published/zinchenko-table-3.csv");

/// Rows of each table; row 48 is row 0 again, a turn later.
pub(super) const ROWS: usize = 49;

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Column {
    /// Table 2, I_n.
    Inertia,
    /// Table 2, S'_In.
    InertiaSlope,
    /// Table 2, dI_n/dφ.
    Derivative,
    /// Table 2, S'_dIn.
    DerivativeSlope,
    /// Table 3, M_o.
    Moment,
    /// Table 3, S'_Mo.
    MomentSlope,
    /// Table 3, dI_n/dφ.
    Derivative3,
    /// Table 3, S'_In.
    InertiaSlope3,
    /// Table 3, the difference of the two before.
    Difference,
}

/// A quantity whose spline fills a column, and whether it is the spline or its derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Spline of I_n; `true` for its derivative.
    Inertia(bool),
    /// Spline of dI_n/dφ.
    Derivative(bool),
    /// Spline of M_o.
    Moment(bool),
    /// Spline of dI_n/dφ minus derivative of the spline of I_n.
    Difference,
}

impl Column {
    pub(super) const ALL: [Column; 9] = [
        Column::Inertia,
        Column::InertiaSlope,
        Column::Derivative,
        Column::DerivativeSlope,
        Column::Moment,
        Column::MomentSlope,
        Column::Derivative3,
        Column::InertiaSlope3,
        Column::Difference,
    ];

    pub(super) fn table(self) -> u32 {
        if (self as usize) < 4 { 2 } else { 3 }
    }

    /// The name of the column in the published file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Column::Inertia => "I_n",
            Column::InertiaSlope | Column::InertiaSlope3 => "S1_I_n",
            Column::Derivative | Column::Derivative3 => "dI_n_dphi",
            Column::DerivativeSlope => "S1_dI_n",
            Column::Moment => "M_o",
            Column::MomentSlope => "S1_M_o",
            Column::Difference => "error",
        }
    }

    pub(super) fn source(self) -> Source {
        match self {
            Column::Inertia => Source::Inertia(false),
            Column::InertiaSlope | Column::InertiaSlope3 => Source::Inertia(true),
            Column::Derivative | Column::Derivative3 => Source::Derivative(false),
            Column::DerivativeSlope => Source::Derivative(true),
            Column::Moment => Source::Moment(false),
            Column::MomentSlope => Source::Moment(true),
            Column::Difference => Source::Difference,
        }
    }

    /// The column of the other table that prints the same quantity.
    pub(super) fn twin(self) -> Option<Column> {
        match self {
            Column::InertiaSlope => Some(Column::InertiaSlope3),
            Column::InertiaSlope3 => Some(Column::InertiaSlope),
            Column::Derivative => Some(Column::Derivative3),
            Column::Derivative3 => Some(Column::Derivative),
            _ => None,
        }
    }
}

/// One printed entry.
#[derive(Clone, Debug)]
pub(super) struct Printed {
    pub column: Column,
    pub row: usize,
    pub number: Number,
}

impl Printed {
    /// One unit of the last printed digit.
    pub(super) fn unit(&self) -> f64 {
        10f64.powi(-(self.number.value.places as i32))
    }

    pub(super) fn to_f64(&self) -> f64 {
        self.number.value.value.to_f64()
    }
}

/// Every printed entry, column by column, rows in order.
pub(super) fn printed() -> Vec<Printed> {
    let mut all = Vec::new();
    for (text, columns) in [(TABLE_2, &Column::ALL[..4]), (TABLE_3, &Column::ALL[4..])] {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let headers = reader.headers().expect("a published table").clone();
        let records: Vec<csv::StringRecord> = reader
            .records()
            .map(|r| r.expect("a published table"))
            .collect();
        assert_eq!(records.len(), ROWS, "rows of a published table");
        for &column in columns {
            let at = headers.iter().position(|h| h == column.name());
            let at = at.expect("a column of a published table");
            for (row, record) in records.iter().enumerate() {
                let number = Number::read(&record[at]);
                all.push(Printed {
                    column,
                    row,
                    number,
                });
            }
        }
    }
    all
}

/// The entries of one column, in order of the rows.
pub(super) fn column(printed: &[Printed], column: Column) -> Vec<&Printed> {
    printed.iter().filter(|p| p.column == column).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_entries_are_there() {
        let all = printed();
        assert_eq!(all.len(), 441);
        for c in Column::ALL {
            assert_eq!(column(&all, c).len(), ROWS);
        }
        let entry = |c, row: usize| column(&all, c)[row].number.text.clone();
        assert_eq!(entry(Column::DerivativeSlope, 11), "-10.553");
        assert_eq!(entry(Column::Moment, 41), "-110.0421");
        assert_eq!(entry(Column::Difference, 1), "-0.119");
        assert_eq!(entry(Column::Derivative3, 44), "-5.26");
        // The last row repeats the first.
        for c in Column::ALL {
            assert_eq!(entry(c, 0), entry(c, 48));
        }
    }
}
