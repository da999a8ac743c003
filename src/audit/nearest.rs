//! Finds the known name closest to a misspelt one.

/// The similarity above which a name is suggested.
const ALIKE: f64 = 0.8;

/// Returns the known name most like `name`, if one is similar enough.
pub fn nearest<'a, K: AsRef<str>>(name: &str, known: &'a [K]) -> Option<&'a str> {
    let alike = |k: &str| strsim::jaro_winkler(&name.to_lowercase(), &k.to_lowercase());
    let known = known.iter().map(K::as_ref).map(|k| (k, alike(k)));
    let best = known.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 > ALIKE).then_some(best.0)
}

/// Returns ` (did you mean "…"?)`, or an empty text where no known name is similar.
pub fn did_you_mean(name: &str, known: &[impl AsRef<str>]) -> String {
    nearest(name, known).map_or(String::new(), |n| format!(" (did you mean {n:?}?)"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_and_nothing_else() {
        let known = ["faddeeva", "four-bar", "erf", "erfc", "class-iii", "voigt"];
        for (name, expected) in [
            ("fadeeva", Some("faddeeva")),
            ("Four-Bar", Some("four-bar")),
            ("fourbar", Some("four-bar")),
            ("erff", Some("erf")),
            ("clas-iii", Some("class-iii")),
            ("voight", Some("voigt")),
            ("no-such-method", None),
            ("", None),
        ] {
            assert_eq!(nearest(name, &known), expected, "{name}");
        }
        // Alike to four fifths, and a little more.
        assert_eq!(nearest("abxcdeyz", &["abucdevw"]), None);
        assert_eq!(nearest("abxcdeyz", &["abucdevz"]), Some("abucdevz"));
        assert_eq!(did_you_mean("ercf", &known), " (did you mean \"erfc\"?)");
        assert_eq!(did_you_mean("x", &[""; 0]), "");
    }
}
