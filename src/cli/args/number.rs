//! Numbers on the command line and their errors.

use mechaudit::reference::Decimal;
use std::ops::RangeInclusive;

/// Integers up to here are exact as `f64`.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// No bound of a rounded value is below this, in units in its last place.
const HALF: f64 = 0.5;

/// The rule that an argument breaks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refused {
    #[error("must be a whole number, {0} or more")]
    Whole(u64),
    #[error("must be a whole number from {0} to {1}")]
    Within(u64, u64),
    #[error("must be at most {0}")]
    AtMost(u64),
    #[error("must be a positive number")]
    Positive,
    #[error("must be at least {HALF}: rounding the exact value alone is off by up to half a unit")]
    HalfUnit,
    #[error("must be a positive number of seconds")]
    Seconds,
}

/// A whole number, also as `1e6`.
pub fn whole(text: &str) -> Result<u64, Refused> {
    match text.parse::<u64>() {
        Ok(n) => Ok(n),
        Err(_) => match Decimal::nearest(text).ok() {
            Some(x) if (0.0..=EXACT).contains(&x) && x.fract() == 0.0 => Ok(x as u64),
            Some(x) if x > EXACT && x.is_finite() => Err(Refused::AtMost(u64::MAX)),
            _ => Err(Refused::Whole(0)),
        },
    }
}

/// A whole number within limits.
pub fn within<T>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, Refused> + Clone + Send + Sync
where
    T: TryFrom<u64> + 'static,
{
    move |text| {
        let number = whole(text).ok().filter(|n| range.contains(n));
        let number = number.and_then(|n| T::try_from(n).ok());
        number.ok_or(match (*range.start(), *range.end()) {
            (least, u64::MAX) => Refused::Whole(least),
            (least, most) => Refused::Within(least, most),
        })
    }
}

/// A whole number, one or more.
pub fn counting<T>() -> impl Fn(&str) -> Result<T, Refused> + Clone + Send + Sync
where
    T: TryFrom<u64> + 'static,
{
    within(1..=u64::MAX)
}

/// A whole number that counts or numbers things.
pub fn index(text: &str) -> Result<usize, Refused> {
    whole(text)?
        .try_into()
        .map_err(|_| Refused::AtMost(usize::MAX as u64))
}

/// A positive number.
pub fn positive(text: &str) -> Result<f64, Refused> {
    match Decimal::nearest(text) {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Refused::Positive),
    }
}

/// A bound that rounding leaves room for, in units in the last place.
pub fn bound(text: &str) -> Result<f64, Refused> {
    let bound = positive(text)?;
    (bound >= HALF).then_some(bound).ok_or(Refused::HalfUnit)
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
            assert_eq!(whole(text), Err(Refused::Whole(0)), "{text}");
        }
        let large = whole("99999999999999999999");
        assert_eq!(large, Err(Refused::AtMost(u64::MAX)));
    }

    #[test]
    fn numbers_within_limits() {
        let digits = within::<u32>(1..=1000);
        assert_eq!(digits("40"), Ok(40));
        for text in ["0", "1001", "-1", "x", "1e30"] {
            assert_eq!(digits(text), Err(Refused::Within(1, 1000)), "{text}");
        }
        assert_eq!(counting::<u64>()("0"), Err(Refused::Whole(1)));
        assert!(positive("1e-9").is_ok() && positive("0").is_err() && positive("x").is_err());
    }

    /// With an exponent or a point as far as every whole number is an `f64`.
    #[test]
    fn whole_numbers_are_exact() {
        assert_eq!(whole("9007199254740992.0"), Ok(9_007_199_254_740_992));
        assert_eq!(
            whole("9.007199254740994e15"),
            Err(Refused::AtMost(u64::MAX))
        );
        assert_eq!(whole("1e300"), Err(Refused::AtMost(u64::MAX)));
        assert_eq!(whole("0.0"), Ok(0));
        assert_eq!((index("3"), index("x")), (Ok(3), Err(Refused::Whole(0))));
        assert_eq!(
            (counting::<u64>()("1"), counting::<u32>()("1")),
            (Ok(1), Ok(1))
        );
        assert_eq!(counting::<u32>()("4294967296"), Err(Refused::Whole(1)));
        assert_eq!(
            (within::<u32>(1..=7)("1"), within::<u32>(1..=7)("7")),
            (Ok(1), Ok(7))
        );
    }

    #[test]
    fn no_bound_is_below_half_a_unit() {
        assert_eq!((bound("0.5"), bound("1e3")), (Ok(0.5), Ok(1e3)));
        assert_eq!(bound("1e-9"), Err(Refused::HalfUnit));
        assert_eq!(bound("0.4999"), Err(Refused::HalfUnit));
        assert_eq!(bound("0"), Err(Refused::Positive));
    }

    #[test]
    fn positive_numbers() {
        assert_eq!((positive("0.5"), positive("1e300")), (Ok(0.5), Ok(1e300)));
        for text in ["0", "-0", "-1", "inf", "-inf", "nan", "1e999", "", "x"] {
            assert_eq!(positive(text), Err(Refused::Positive), "{text}");
        }
    }
}
