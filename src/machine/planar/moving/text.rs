//! Formulas as texts, without zeros and ones.

use crate::reference::class_iii::ExactAngle;
use crate::reference::planar::Real;
use rug::Rational;

/// A vector of formulas.
pub(super) type Vector = [String; 2];

pub(super) fn zero(a: &str) -> bool {
    a == "0"
}

pub(super) fn rational(q: &Rational) -> String {
    Real::from(q.clone()).formula()
}

pub(super) fn add(a: &str, b: &str) -> String {
    match (zero(a), zero(b)) {
        (true, _) => b.into(),
        (_, true) => a.into(),
        _ => format!("({a} + {b})"),
    }
}

pub(super) fn sub(a: &str, b: &str) -> String {
    match (zero(a), zero(b)) {
        (_, true) => a.into(),
        (true, _) => format!("(-{b})"),
        _ => format!("({a} - {b})"),
    }
}

pub(super) fn mul(a: &str, b: &str) -> String {
    match (a, b) {
        ("0", _) | (_, "0") => "0".into(),
        ("1", x) | (x, "1") => x.into(),
        _ => format!("{a}*{b}"),
    }
}

pub(super) fn sum(parts: impl IntoIterator<Item = String>) -> String {
    let parts: Vec<String> = parts.into_iter().filter(|p| !zero(p)).collect();
    match &parts[..] {
        [] => "0".into(),
        [one] => one.clone(),
        _ => format!("({})", parts.join(" + ")),
    }
}

pub(super) fn dot(a: &[String; 2], b: &[String; 2]) -> String {
    sum([mul(&a[0], &b[0]), mul(&a[1], &b[1])])
}

pub(super) fn angle(a: &ExactAngle) -> String {
    match a {
        ExactAngle::Radians(q) => rational(q),
        ExactAngle::Degrees(q) => mul(&rational(&Rational::from(q / 180u32)), "pi"),
    }
}
