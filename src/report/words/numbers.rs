//! Numbers for people.

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

/// [`short`], or a dash where there is no number.
pub fn short_if(there: bool, x: f64) -> String {
    match there {
        true => short(x),
        false => "–".into(),
    }
}

/// A share in per cent; a dash where there is none.
pub fn percent(x: f64) -> String {
    match x {
        x if x.is_nan() => "–".into(),
        x if x.is_infinite() => x.to_string(),
        x => format!("{} %", short(x * 100.0)),
    }
}

/// Returns the number with the name of what is counted, in the plural unless it is one.
pub fn count(n: usize, thing: &str) -> String {
    format!("{n} {thing}{}", if n == 1 { "" } else { "s" })
}

/// A unit as people write it, nothing where there is none.
pub fn unit(unit: &str) -> String {
    if unit == "1" {
        return String::new();
    }
    unit.replace("kg m", "kg·m")
        .replace("N m", "N·m")
        .replace("N cm", "N·cm")
        .replace("^2", "²")
}

/// At most `most` characters, with an ellipsis after them where some are left out.
pub fn clipped(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let head: String = text.chars().take(most).collect();
    format!("{head} …")
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(short_if(false, 1.0), "–");
    }

    #[test]
    fn units_are_those_of_people() {
        for (machine, people) in [
            ("kg m^2/rad", "kg·m²/rad"),
            ("1e-4 N m", "1e-4 N·m"),
            ("cm/s^2", "cm/s²"),
            ("1", ""),
        ] {
            assert_eq!(unit(machine), people);
        }
    }

    #[test]
    fn clipped_texts_end_with_an_ellipsis() {
        assert_eq!(clipped("φab", 3), "φab");
        assert_eq!(clipped("φabc", 3), "φab …");
    }

    #[test]
    fn figures_depend_on_the_size() {
        for (x, text) in [
            (1e-3, "0.001"),
            (9.99e-4, "9.99e-4"),
            (1.5e-3, "0.002"),
            (-0.5, "-0.500"),
            (0.75, "0.750"),
            (1.5, "1.50"),
            (60.0, "60.00"),
            (100.0, "100.0"),
            (150.0, "150.0"),
            (600.0, "600.0"),
            (1000.0, "1000"),
            (1500.0, "1500"),
            (999_999.0, "999999"),
            (1e6, "1.00e6"),
            (-1.5e6, "-1.50e6"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(short(x), text);
        }
        assert_eq!(short_if(true, 1.0), "1.00");
        assert_eq!(percent(f64::INFINITY), "inf");
        assert_eq!(percent(f64::NAN), "–");
        assert_eq!(
            [0, 1, 2].map(|n| count(n, "case")),
            ["0 cases", "1 case", "2 cases"]
        );
    }
}
