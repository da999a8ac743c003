//! Tests of `seams`.

use super::*;

#[test]
fn a_rise_is_more_than_a_hundred_times_rounding() {
    let least = 100.0 * LEAST;
    assert!(!rises(0.0, least, 1.0) && rises(0.0, least.next_up(), 1.0));
    assert!(rises(1.0, 1.0 + 2.1e-12, 2.0) && !rises(1.0, 1.0 + 1.9e-12, 2.0));
    assert!(!rises(1.0, 0.5, 1.0));
}

/// Values and formulas of a code of that many parts that is constant between seams.
fn planted(
    parts: Parts,
    w: fn(Complex64) -> Complex64,
    formula: Option<fn(Complex64) -> u8>,
) -> Algorithm {
    let any = mechaudit_atlas::find("humlicek-1982").unwrap();
    Algorithm {
        parts,
        w,
        formula,
        ..any
    }
}

/// Formula 3 within |Re z| < 10, formula 1 without, formula 7 above Im z = 5.
fn formula(z: Complex64) -> u8 {
    match z {
        _ if z.im > 5.0 => 7,
        _ if z.re < 10.0 => 3,
        _ => 1,
    }
}

#[test]
fn each_pair_of_formulas_has_its_largest_jump() {
    let up = |z| match formula(z) {
        7 => Complex::new(2.0, 1.5),
        3 => Complex::new(2.0, 1.0),
        _ => Complex::new(2.5, 1.0),
    };
    let found = jumps(&planted(Parts::Both, up, Some(formula)), 1);
    let pairs: Vec<Option<[u8; 2]>> = found.iter().map(|j| j.between).collect();
    assert_eq!(pairs, [Some([1, 3]), Some([1, 7]), Some([3, 7])]);
    let [level, _, upright] = &found[..] else {
        panic!("three seams")
    };
    // 0.5 of 2 from within, of 2.5 from without; of the norms √5 and √7.25.
    assert_eq!((level.norm, level.re), (Some(0.224), 0.25));
    assert!(
        level.at[0] == 10f64.next_down() && level.at[1] < 5.0,
        "{level:?}"
    );
    assert_eq!(
        (upright.norm, upright.re, upright.crossings),
        (Some(0.224), 0.0, 0)
    );
    assert!(upright.at[0] < 10.0 && (upright.at[1] - 5.0).abs() < 1e-14);
    // Level segments whose ends lie on either side, below the seam at Im z = 5.
    let crossed = (0..SEGMENTS).filter(|k| {
        let mut d = Draw::new(1, "atlas", "seams", *k);
        let level = d.chance(0.6);
        let (p, q) = segment(&mut d, level);
        level && p.im < 5.0 && (p.re < 10.0) != (q.re < 10.0)
    });
    let crossed = crossed.count() as u64;
    assert_eq!((level.crossings, level.rising), (crossed, crossed));
}

#[test]
fn a_fall_is_no_rise_and_a_real_part_is_its_own_norm() {
    let down = |z: Complex64| Complex::new(if z.re < 10.0 { 2.5 } else { 2.0 }, z.im);
    let formula = |z: Complex64| if z.re < 10.0 { 3 } else { 1 };
    let found = jumps(&planted(Parts::Real, down, Some(formula)), 1);
    let [jump] = &found[..] else {
        panic!("one seam")
    };
    // 0.5 of 2 from without.
    assert_eq!((jump.norm, jump.re, jump.rising), (Some(0.25), 0.25, 0));
    // 0.6 of 3000 segments are level; ends are log-uniform on 0.1..300.
    assert!((790..970).contains(&jump.crossings), "{jump:?}");
    assert_eq!(jumps(&planted(Parts::Both, down, None), 1), []);
    // Nothing is told of a seam without a jump.
    let smooth = |_| Complex::new(1.0, 1.0);
    assert_eq!(jumps(&planted(Parts::Both, smooth, Some(formula)), 1), []);
}

#[test]
fn segments_are_level_or_upright() {
    let mut ends = Vec::new();
    let mut others = Vec::new();
    for k in 0..6000 {
        let level = k % 2 == 0;
        let (p, q) = segment(&mut Draw::new(1, "atlas", "segments", k), level);
        let turned = |z: Complex64| if level { [z.re, z.im] } else { [z.im, z.re] };
        let ([a, y], [b, z]) = (turned(p), turned(q));
        assert_eq!(y, z);
        ends.extend([a, b]);
        others.push((a > b, y));
    }
    let range = |all: &mut dyn Iterator<Item = f64>| {
        all.fold([f64::INFINITY, 0.0], |[a, b], x| [a.min(x), f64::max(b, x)])
    };
    let [least, most] = range(&mut ends.into_iter());
    assert!((0.0999..0.102).contains(&least) && (294.0..300.1).contains(&most));
    // Next to the axis as often as not.
    for (small, due) in [(true, [1e-12, 1.0]), (false, [0.1, 300.0])] {
        let own = others.iter().filter(|o| o.0 == small).map(|o| o.1);
        let [least, most] = range(&mut own.into_iter());
        assert!(
            (0.999 * due[0]..1.05 * due[0]).contains(&least),
            "{least:e}"
        );
        assert!((0.95 * due[1]..1.001 * due[1]).contains(&most), "{most}");
    }
}

#[test]
fn a_segment_is_halved_down_to_neighbours() {
    let formula = |z: Complex64| u8::from(z.re >= 1.0);
    let at = |x: f64| Complex::new(x, 2.0);
    assert_eq!(halved(formula, at(1.5), at(9.0)), None);
    let due = (at(1f64.next_down()), at(1.0));
    assert_eq!(halved(formula, at(0.25), at(7.0)), Some(due));
    assert_eq!(halved(formula, at(7.0), at(0.25)), Some((due.1, due.0)));
}
