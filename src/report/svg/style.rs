//! Colours of the drawings on light and on dark pages, and what stands at the head of each file.

use maud::{Markup, PreEscaped, html};

/// A colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RGBColor(pub u8, pub u8, pub u8);

pub const PAPER: RGBColor = RGBColor(255, 255, 255);
pub const INK: RGBColor = RGBColor(29, 33, 37);
pub const SOFT: RGBColor = RGBColor(91, 100, 109);
pub const AXIS: RGBColor = RGBColor(120, 128, 136);
pub const GRID: RGBColor = RGBColor(220, 224, 227);
pub const GREY: RGBColor = RGBColor(138, 143, 152);
pub const BLUE: RGBColor = RGBColor(31, 111, 178);
pub const ORANGE: RGBColor = RGBColor(194, 87, 26);
pub const GREEN: RGBColor = RGBColor(47, 143, 78);
pub const PURPLE: RGBColor = RGBColor(122, 79, 163);

/// Each colour and its substitute on a dark page.
const DARK: [(RGBColor, &str); 10] = [
    (PAPER, "#15181b"),
    (INK, "#e4e7ea"),
    (SOFT, "#9aa4ad"),
    (AXIS, "#88929b"),
    (GRID, "#343b41"),
    (GREY, "#a4abb3"),
    (BLUE, "#62b0ee"),
    (ORANGE, "#f0935a"),
    (GREEN, "#68c686"),
    (PURPLE, "#b996dd"),
];

/// The colour as an attribute's value.
pub fn hex(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Title and description for those who do not see the drawing, and its colours on dark pages.
pub fn head(title: &str, description: &str) -> Markup {
    let rules = DARK.map(|(light, dark)| {
        let light = hex(light);
        format!(
            "[fill=\"{light}\" i] {{ fill: {dark} }} [stroke=\"{light}\" i] {{ stroke: {dark} }}\n"
        )
    });
    html! {
        title { (legible(title)) } "\n"
        desc { (legible(description)) } "\n"
        style {
            "@media (prefers-color-scheme: dark) {\n" (PreEscaped(rules.concat())) "}"
        } "\n"
    }
}

/// The text without characters that XML cannot hold.
pub fn legible(text: &str) -> String {
    let kept =
        |c: char| !matches!(c, '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}') || "\t\n\r".contains(c);
    text.chars()
        .map(|c| if kept(c) { c } else { '\u{fffd}' })
        .collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Refuses a drawing without title or description, or with a colour that dark pages keep.
    pub fn whole(svg: &str) {
        for tag in ["title", "desc", "style"] {
            assert_eq!(svg.matches(&format!("<{tag}>")).count(), 1, "{tag}");
            assert!(!svg.contains(&format!("<{tag}></{tag}>")), "{tag} is empty");
        }
        let body = svg.split("</style>").nth(1).unwrap();
        let colours = body.split(['"']).filter(|v| v.starts_with('#'));
        for colour in colours.map(str::to_lowercase) {
            assert!(DARK.iter().any(|(c, _)| hex(*c) == colour), "{colour}");
        }
    }

    #[test]
    fn every_colour_has_contrast_on_its_page() {
        let channel = |v: u8| {
            let s = f64::from(v) / 255.0;
            if s <= 0.04045 {
                s / 12.92
            } else {
                ((s + 0.055) / 1.055).powf(2.4)
            }
        };
        let light =
            |[r, g, b]: [u8; 3]| 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
        let contrast = |a, b| {
            let (a, b): (f64, f64) = (light(a), light(b));
            (a.max(b) + 0.05) / (a.min(b) + 0.05)
        };
        let rgb = |c: RGBColor| [c.0, c.1, c.2];
        let read = |s: &str| [1, 3, 5].map(|i| u8::from_str_radix(&s[i..i + 2], 16).unwrap());
        let pages = (rgb(PAPER), read(DARK[0].1));
        for (colour, dark) in DARK.into_iter().filter(|d| ![PAPER, GRID].contains(&d.0)) {
            let due = if [INK, SOFT].contains(&colour) {
                4.5
            } else {
                3.0
            };
            assert!(contrast(rgb(colour), pages.0) >= due, "{}", hex(colour));
            assert!(contrast(read(dark), pages.1) >= due, "{dark}");
        }
    }
}
