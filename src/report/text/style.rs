//! Colour and wrapping.

use crate::report::words::Tone;
use anstyle::{AnsiColor, Style};

/// Of names and headings.
pub const BOLD: Style = Style::new().bold();
/// Of what matters less.
pub const DIM: Style = Style::new().dimmed();
/// As it should be.
pub const GOOD: Style = AnsiColor::Green.on_default();
/// Wrong.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// Open.
pub const DOUBT: Style = AnsiColor::Yellow.on_default();
/// Not known before.
pub const NEW: Style = AnsiColor::Cyan.on_default();
/// No style.
pub const PLAIN: Style = Style::new();

/// The style of a tone.
pub fn of(tone: Tone) -> Style {
    match tone {
        Tone::Good => GOOD,
        Tone::Bad => BAD,
        Tone::Doubt => DOUBT,
        Tone::New => NEW,
        Tone::Plain => PLAIN,
    }
}

/// `text` without its styles.
pub fn plain(text: &str) -> String {
    anstream::adapter::strip_str(text).to_string()
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
    fn only_a_style_and_a_text_make_escapes() {
        assert_eq!(paint(PLAIN, "x"), "x");
        assert_eq!(paint(BAD, ""), "");
        let bad = paint(BAD, "x");
        assert!(bad.len() > 1 && plain(&bad) == "x");
    }

    #[test]
    fn a_line_is_as_long_as_the_width_and_no_longer() {
        for (width, due) in [
            (11, "aaa bbb ccc"),
            (10, "aaa bbb\nccc"),
            (7, "aaa bbb\nccc"),
            (6, "aaa\nbbb\nccc"),
        ] {
            assert_eq!(wrap("aaa  bbb\nccc", 0, width), due, "{width}");
        }
        assert_eq!(wrap("aaa bbb", 2, 9), "aaa bbb");
        assert_eq!(wrap("aaa bbb", 2, 8), "aaa\n  bbb");
        assert_eq!(wrap("φφφ ψψψ", 0, 7), "φφφ ψψψ");
        assert_eq!(wrap("", 3, 9), "");
        assert_eq!(paragraph("aaa bbb", 2, 8), "  aaa\n  bbb\n");
    }

    #[test]
    fn every_tone_has_its_style() {
        let tones = [Tone::Good, Tone::Bad, Tone::Doubt, Tone::New, Tone::Plain];
        assert_eq!(tones.map(of), [GOOD, BAD, DOUBT, NEW, PLAIN]);
    }
}
