//! Tests of `certified`.

use super::*;
use crate::audit::{Case, Cases, Settings};
use crate::methods::find;
use crate::reference::{Decimal, nearest_f64};

fn exact(text: &str) -> Vec<Rational> {
    let numbers = text.split(',');
    let exact = |number: &str| Decimal::parse(number).unwrap().value;
    numbers.map(exact).collect()
}

fn digits(name: &str, text: &str, digits: u32) -> Result<Vec<Option<String>>, Uncertified> {
    let method = find(name).unwrap();
    let found = certified_digits(&*method, &exact(text), digits, |_| true)?;
    Ok(found.into_iter().map(|v| v.decimal).collect())
}

#[test]
fn precisions_double() {
    let of = |digits| precisions(digits).collect::<Vec<_>>();
    assert_eq!(of(1), [64, 128, 256, 512, 1024]);
    assert_eq!(of(60), [210, 420, 840, 1680]);
    assert_eq!(of(1000), [3333, 6666, 13_332, 26_664]);
}

/// The reference is undecided with the bits of two digits and decides with more.
#[test]
fn few_digits_are_certified_where_many_are() {
    let linkage = "0.1,1.04,0.6,0.64,0.485,0.22,-0.6859,0.75,0.93,1.285,1.035,0.25178";
    let few = digits("class-iii-assembly-modes", linkage, 2).unwrap();
    let many = digits("class-iii-assembly-modes", linkage, 20).unwrap();
    assert_eq!(few.len(), many.len());
    let number = |text: &Option<String>| text.as_ref().unwrap().parse::<f64>().unwrap();
    for (few, many) in few.iter().zip(&many) {
        let off = (number(few) / number(many) - 1.0).abs();
        assert!(off < 0.06, "{few:?}, {many:?}");
    }
}

/// At every check point of a method that needs no seconds, and at a case of each region, three
/// digits are certified where twenty are, and what is refused with many digits is refused with
/// few.
#[test]
fn digits_do_not_depend_on_how_many_are_asked_for() {
    let settings = Settings {
        cases_per_region: 2,
        ..Settings::default()
    };
    for name in [
        "class-iii-assembly-modes",
        "class-iii",
        "four-bar",
        "slider-crank",
    ] {
        let method = find(name).unwrap();
        let cases = Cases::new(&*method, &settings);
        let mut answered = 0;
        for Case { input, .. } in (0..cases.len()).map(|i| cases.get(i)) {
            let Some(x) = super::super::definition::exact(&input) else {
                continue;
            };
            let of = |digits| certified_digits(&*method, &x, digits, |_| true);
            match (of(3), of(20)) {
                (Ok(few), Ok(many)) => {
                    answered += 1;
                    let there = |all: &[CertifiedValue]| {
                        all.iter().map(|v| v.decimal.is_some()).collect::<Vec<_>>()
                    };
                    assert_eq!(there(&few), there(&many), "{name}: {input:?}");
                }
                (few, many) => assert_eq!(few.err(), many.err(), "{name}: {input:?}"),
            }
        }
        assert!(answered > 3, "{name}: {answered}");
    }
}

/// Checks what a value that is exactly zero is.
#[test]
fn zeros_are_proved() {
    let zeros = |name, text: &str, places: &[usize]| {
        let found = digits(name, text, 12).unwrap();
        for (i, value) in found.iter().enumerate() {
            let value = value.as_deref();
            assert!(value.is_some(), "{name} at {text}: value {i}");
            assert_eq!(
                value == Some("0"),
                places.contains(&i),
                "{name} at {text}: value {i} is {value:?}"
            );
        }
    };
    // Acceleration in the middle of a symmetric stroke.
    zeros("cam-law", "0.5,0,0.5,2,0.25,0.75", &[3]);
    // The crank along the guide, no offset: x', phi2 and phi2'' change their signs.
    zeros("slider-crank", "0.1,0.3,0,0,0,1", &[1, 3, 5]);
    // The coupler of a parallelogram is parallel to the frame.
    zeros("four-bar", "2,3,2,3,0.5,1", &[0, 2, 4, 5]);
    // The joint rests on the crank's pivot.
    zeros("four-bar", "2,2,3,3,0.5,-1", &[3, 4, 5, 7, 8]);
    // Crank and frame on one line: a second derivative of the coupler or the rocker, or the joint
    // above the crank's pivot.
    zeros("four-bar", "1,5,3,5,0,1", &[4]);
    zeros("four-bar", "1,3,5,5,0,1", &[5]);
    zeros("four-bar", "1,4,8,7,0,1", &[7]);
    // The slider behind the crank: on its pivot where 3, 4 and 5 are a triangle.
    zeros("slider-crank", "3,5,4,0,0,-1", &[0]);
    zeros("slider-crank", "1,1,0,0.25,0.5,1", &[3, 5]);
}

/// Values that are not wanted do not raise the precision.
#[test]
fn what_is_not_wanted_stays_open() {
    let method = find("erf").unwrap();
    let z = exact("1,1e-40");
    let found = certified_digits(&*method, &z, 5, |i| i == 0).unwrap();
    let due = nearest_f64(&exact("0.84270")[0]);
    assert_eq!(found[0].decimal.as_deref().map(str::parse), Some(Ok(due)));
}
