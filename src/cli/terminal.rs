//! The width of the terminal.

use std::io::IsTerminal;

/// Width where there is no terminal, or it does not say.
pub const DEFAULT_WIDTH: usize = 80;

/// Columns to write in: those of the terminal, between 60 and 140.
pub fn width() -> usize {
    let terminal = std::io::stdout().is_terminal();
    let size = terminal.then(terminal_size::terminal_size).flatten();
    size.map_or(DEFAULT_WIDTH, |(width, _)| within(width.0))
}

fn within(columns: u16) -> usize {
    usize::from(columns).clamp(60, 140)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_neither_narrow_nor_wide() {
        for (columns, due) in [
            (0, 60),
            (59, 60),
            (61, 61),
            (100, 100),
            (139, 139),
            (141, 140),
            (u16::MAX, 140),
        ] {
            assert_eq!(within(columns), due, "{columns}");
        }
    }

    /// Tests write to a pipe, or to a terminal of some width.
    #[test]
    fn a_pipe_has_80_columns() {
        if !std::io::stdout().is_terminal() {
            assert_eq!(width(), 80);
        }
    }
}
