//! Numbers on the command line, and what is said of those that are none.

use mechaudit::reference::Decimal;
use std::ops::RangeInclusive;

/// Integers up to here are exact as `f64`.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// A whole number, also as `1e6`.
pub fn whole(text: &str) -> Result<u64, String> {
    match text.parse::<u64>() {
        Ok(n) => Ok(n),
        Err(_) => match Decimal::nearest(text).ok() {
            Some(x) if (0.0..=EXACT).contains(&x) && x.fract() == 0.0 => Ok(x as u64),
            Some(x) if x > EXACT && x.is_finite() => Err(format!("must be at most {}", u64::MAX)),
            _ => Err("must be a whole number, 0 or more".into()),
        },
    }
}

/// A whole number within limits.
pub fn within<T>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync
where
    T: TryFrom<u64> + 'static,
{
    move |text| {
        let (least, most) = (range.start(), range.end());
        let number = whole(text).ok().filter(|n| range.contains(n));
        number
            .and_then(|n| T::try_from(n).ok())
            .ok_or_else(|| match *most {
                u64::MAX => format!("must be a whole number, {least} or more"),
                most => format!("must be a whole number from {least} to {most}"),
            })
    }
}

/// A whole number, one or more.
pub fn counting<T>() -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync
where
    T: TryFrom<u64> + 'static,
{
    within(1..=u64::MAX)
}

/// A whole number that counts or numbers things.
pub fn index(text: &str) -> Result<usize, String> {
    whole(text).and_then(|n| usize::try_from(n).map_err(|e| e.to_string()))
}

/// A positive number.
pub fn positive(text: &str) -> Result<f64, String> {
    match Decimal::nearest(text) {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("must be a positive number".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers() {
        for (text, due) in [("0", 0), ("17", 17), ("1e6", 1_000_000), ("2.5e1", 25)] {
            assert_eq!(whole(text), Ok(due), "{text}");
        }
        assert_eq!(whole(&u64::MAX.to_string()), Ok(u64::MAX));
        for text in ["-1", "x", "", "1.5", "nan", "inf", "1e-3", "0x10"] {
            let due = Err("must be a whole number, 0 or more".into());
            assert_eq!(whole(text), due, "{text}");
        }
        assert!(
            whole("99999999999999999999")
                .unwrap_err()
                .contains("at most")
        );
    }

    #[test]
    fn numbers_within_limits() {
        let digits = within::<u32>(1..=1000);
        assert_eq!(digits("40"), Ok(40));
        for text in ["0", "1001", "-1", "x", "1e30"] {
            let due = Err("must be a whole number from 1 to 1000".into());
            assert_eq!(digits(text), due, "{text}");
        }
        let due = Err("must be a whole number, 1 or more".into());
        assert_eq!(counting::<u64>()("0"), due);
        assert!(positive("1e-9").is_ok() && positive("0").is_err() && positive("x").is_err());
    }
}
