//! The width of the terminal.

use std::io::IsTerminal;

/// Width where there is no terminal, or it does not say.
pub const DEFAULT_WIDTH: usize = 80;

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
