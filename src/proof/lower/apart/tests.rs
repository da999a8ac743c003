use super::*;
use crate::pinned::{bit_by_bit, counted, largest, of_binades, units};

#[test]
fn the_first_zeros_are_off_all_numbers_bit_by_bit() {
    let watch = Watch::default();
    let found = Apart::all(Some(64.0), &watch)
        .expect("proved")
        .expect("not stopped");
    let found = [found.boxes as u64, found.zeros, found.lines];
    assert_eq!(found, [86439, 1288, 0]);
}

/// `(a − b)/δ` on the curve `a² − b² = D = ln(2√π |z|)` over a binade of b is within the numbers of
/// its lines; these are those of the smallest D over the largest sum, and the other way round.
#[test]
fn lines_of_a_binade_are_those_that_meet_it() {
    let d_at = |b: f64| {
        let root = 2.0 * std::f64::consts::PI.sqrt();
        (0..50).fold(10.0, |d, _| (root * f64::sqrt(2.0 * b * b + d)).ln())
    };
    for k in LINES..=28 {
        let [first, last] = lines(k).map(|j| j as f64);
        let (binade, unit) = (f64::from(k).exp2(), f64::from(k - 52).exp2());
        for i in 0..=64 {
            let b = binade * (1.0 + f64::from(i) / 64.0);
            let d = d_at(b);
            let j = d / (f64::sqrt(b * b + d) + b) / unit;
            assert!(j.floor() <= last && j.ceil() >= first, "{k} {i} {j}");
        }
        let least = d_at(binade) / (4.0 * binade) / unit;
        let most = d_at(2.0 * binade) / (2.0 * binade) / unit;
        let low = least * (1.0 - 1.2e-4) - 1.0;
        assert!(first >= low.max(1.0) && first <= (least * (1.0 - 0.9e-4)).max(1.0));
        let high = most * (1.0 + 4e-6);
        assert!(
            last >= high.floor() && last <= most * (1.0 + 7e-6),
            "{k} {last} {most}"
        );
    }
    // From here on no line is as near to the diagonal as the curve.
    assert!(lines(26)[1] > 0 && lines(28)[1] == 0);
}

/// Beyond the last zero b is larger than the limit, and few before it are.
#[test]
fn the_last_zero_below_a_limit() {
    for limit in [64.0, 100.5, 1000.0, 4096.0, 8192.0] {
        let b = |m: u64| curve::zero(m, 192).expect("found").mid().to_f64();
        let m = last(limit);
        assert!(b(m + 1) > limit && b(m - 3) < limit, "{limit} {m}");
    }
}

/// Units of b, or halves of them next to a power of two, and a bound of it about a zero.
#[test]
fn units_and_bounds_of_zeros() {
    for k in 6..14 {
        let binade = f64::from(k).exp2();
        let found = [1.0001, 1.002, 1.5, 1.999].map(|b| last_place(b * binade));
        assert_eq!(found, [53 - k, 52 - k, 52 - k, 52 - k]);
    }
    for m in [20u64, 1000, 1_000_000, 20_000_000] {
        let b = curve::zero(m + m / 4, 192).expect("found").mid().to_f64();
        let most = most_of_b(m);
        assert!(most > 1.05 * b && most < 2.0 * b, "{m} {most} {b}");
    }
}

#[test]
#[ignore = "minutes"]
fn all_zeros_are_off_all_numbers() {
    let watch = Watch::default();
    let found = Apart::all(None, &watch)
        .expect("proved")
        .expect("not stopped");
    eprintln!("{found:?}");
    assert!(found.zeros > 20_000_000 && found.lines > 200_000_000);
}

/// Checks what is enumerated below which limit, and the few lines of the last binades.
#[test]
fn what_is_enumerated_bit_by_bit() {
    let watch = Watch::default();
    let limits = [
        None,
        Some(2.0),
        Some(64.0),
        Some(8191.5),
        Some(8192.0),
        Some(8193.0),
        Some(16384.0),
        Some(1e6),
        Some(1e99),
    ];
    let mut unit = units(2);
    let b: Vec<f64> = (0..200).map(|_| of_binades(&mut unit, [2, 14])).collect();
    let limits_of_b = b
        .iter()
        .chain(&[63.0, 64.0, 64.03, 64.07, 65.0, 127.9, 128.1, 128.2]);
    let m = b.iter().map(|b| (b * b) as u64);
    let last_lines = binades(None).split_off(12);
    let value = |_: u64, _: u32| Err("".into());
    let of_lines = on_lines(&value);
    let kinds = [&ZEROS, &of_lines].map(|s| {
        let bounds = [1, 20, 1 << 20].map(s.most);
        (s.few, bounds, [1.0, 100.0, 5000.0].map(s.shift))
    });
    let counts = [0, 1, 2].map(|from| count_lines(&last_lines[from..], &watch));
    let found = [
        counted("lines", (10..30).map(lines)),
        counted("last", b.iter().map(|b| last(*b))),
        counted("units", limits_of_b.map(|b| last_place(*b))),
        largest("most", m.map(most_of_b)),
        counted("zeros", limits.map(of_zeros)),
        counted("binades", limits.map(binades)),
        counted("last lines", counts),
        counted("kinds", kinds),
        counted("first zeros", [ZEROS.stays_off(FIRST, 40, &watch)]),
    ];
    let due = [
        ("lines", 0x2d57ab8df90ea13e, 20.0),
        ("last", 0x4bcd8f09b139f577, 200.0),
        ("units", 0x973418aa9853c012, 208.0),
        ("most", 0x8ee1932399644bbb, 89438.15175304106),
        ("zeros", 0xc30757717f6b2303, 9.0),
        ("binades", 0x06f7ade01ba18542, 9.0),
        ("last lines", 0x1da6965b4ef37fdd, 3.0),
        ("kinds", 0x78bddc6ceb8e5d2a, 2.0),
        ("first zeros", 0x26e4731f81b6da2d, 1.0),
    ];
    bit_by_bit(&found, &due);
}
