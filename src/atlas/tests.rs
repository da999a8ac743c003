//! Each algorithm reaches about what its paper claims at ordinary points: its constants are those
//! of the paper.

use crate::{Algorithm, Parts, Plane, all, find};
use mechaudit_solvers::faddeeva::faddeeva;
use num_complex::{Complex, Complex32, Complex64};
use std::collections::HashSet;

/// A lattice of ordinary points, off simple fractions.
fn ordinary(from: f64) -> impl Iterator<Item = Complex64> {
    let place = |k: i32| 0.41 * f64::from(k) + 0.013;
    (0..20).flat_map(move |i| (0..14).map(move |j| Complex::new(place(i), from + place(j))))
}

/// The largest relative errors of w, Re w and Im w.
fn worst(a: &Algorithm, from: f64) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for z in ordinary(from) {
        let (got, due) = ((a.w)(z), faddeeva(z));
        let errors = match a.parts {
            Parts::Both => [
                (got - due).norm() / due.norm(),
                ((got.re - due.re) / due.re).abs(),
                ((got.im - due.im) / due.im).abs(),
            ],
            Parts::Real => [0.0, ((got.re - due.re) / due.re).abs(), 0.0],
        };
        for (w, e) in worst.iter_mut().zip(errors) {
            *w = if e.is_nan() { f64::INFINITY } else { w.max(e) };
        }
    }
    worst
}

/// By name: the largest error in the norm and of the real part where y ≥ 0.1, as the papers have it
/// or as the formula gives.
const REACHED: [(&str, f64, f64); 31] = [
    ("gautschi-1970", 1e-9, 2e-8),
    ("cernlib-wwerf", 1e-9, 2e-8),
    ("matta-reichel-1971", 1e-13, 1e-13),
    ("hunter-regan-1972", 1e-15, 1e-15),
    ("hui-armstrong-wray-1978", 1e-5, 3e-4),
    ("humlicek-1979", 2e-6, 4e-6),
    ("humlicek-1982", 1e-4, 2e-4),
    ("thompson-cox-hastings-1987", 0.0, 0.3),
    ("poppe-wijers-1990", 1e-14, 1e-13),
    ("mclean-1994", 0.0, 0.1),
    ("weideman-1994-16", 1e-6, 2e-5),
    ("weideman-1994-24", 1e-9, 2e-8),
    ("weideman-1994-32", 3e-13, 2e-11),
    ("wells-1999-r2", 1e-2, 1e-2),
    ("wells-1999-r3", 1e-3, 1e-3),
    ("wells-1999-r4", 1e-4, 1e-4),
    ("wells-1999-r5", 1e-4, 1e-4),
    ("zaghloul-ali-2011", 1e-14, 1e-13),
    ("zaghloul-ali-2011-1e-8", 1e-7, 1e-7),
    ("zaghloul-ali-2011-1e-4", 1e-3, 1e-3),
    ("tran-ngo-hartmann-2013-cpf", 2e-6, 4e-6),
    ("abrarov-quine-2011", 2e-15, 1e-14),
    ("abrarov-quine-2016", 2e-15, 1e-14),
    ("karbach-raven-schiller-2014", 2e-15, 1e-14),
    ("karbach-raven-schiller-2014-fast", 1e-6, 1e-5),
    ("zaghloul-2017", 4e-5, 4e-5),
    ("schreier-2011-hum1wei24", 1e-9, 2e-8),
    ("schreier-2018-16", 1e-5, 1e-5),
    ("schreier-2018-16-1.31183", 1e-5, 1e-5),
    ("schreier-2018-20", 1e-6, 1e-6),
    ("schreier-2018-hum2zpf16", 1e-6, 1e-6),
];

#[test]
fn all_reach_what_their_papers_say() {
    let mut names: HashSet<&str> = all().iter().map(|a| a.name).collect();
    for (name, norm, re) in REACHED {
        let a = find(name).expect(name);
        let found = worst(&a, 0.1);
        assert!(found[0] <= norm && found[1] <= re, "{name}: {found:?}");
        names.remove(name);
    }
    names.remove("al-azah-chandler-wilde-2021");
    assert!(names.is_empty(), "{names:?}");
    let bounded = worst(&find("al-azah-chandler-wilde-2021").unwrap(), 0.0);
    assert!(bounded[0] < 3e-15, "{bounded:?}");
}

#[test]
fn the_lower_half_plane_is_reached_by_reflection() {
    for a in all().iter().filter(|a| a.plane == Plane::Whole) {
        let z = Complex::new(0.7, -0.9);
        let error = ((a.w)(z) - faddeeva(z)).norm();
        assert!(error < 1e-3, "{}: {error}", a.name);
        let left = ((a.w)(-z.conj()) - (a.w)(z).conj()).norm();
        assert!(left < 1e-13, "{}", a.name);
    }
}

#[test]
fn single_precision_is_of_single_precision() {
    for a in all() {
        let Some(single) = a.single else { continue };
        for z in ordinary(0.1) {
            let rounded = Complex32::new(z.re as f32, z.im as f32);
            let z = Complex::new(f64::from(rounded.re), f64::from(rounded.im));
            let (got, due) = (single(rounded), (a.w)(z));
            let got = Complex::new(f64::from(got.re), f64::from(got.im));
            let error = (got - due).norm() / due.norm();
            assert!(error < 2e-4, "{} at {z}: {error:e}", a.name);
        }
    }
}

/// FNV-1a over 64-bit words.
#[derive(Clone, Copy)]
struct Checksum(u64);

impl Checksum {
    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3);
    }

    fn add_number(&mut self, x: f64) {
        // One kind of NaN.
        self.add(if x.is_nan() { 1 } else { x.to_bits() });
    }
}

/// Points of every size, on the axes too; half of them left of the imaginary axis, and below the
/// real one where an algorithm is defined there.
fn everywhere(plane: Plane) -> Vec<Complex64> {
    let mut sizes = vec![0.0, 1e-300, 1e-20, 1e-9, 1e-5, 1e-3, 0.03];
    sizes.extend((1..90).map(|k| 0.1003 * f64::from(k)));
    sizes.extend((0..12).map(|k| 9.1 * 1.5f64.powi(k)));
    sizes.extend([1e4, 1e6, 1e9, 1e20, 1e160, 4e-4, 1.5e4]);
    let mut all = Vec::new();
    for (i, x) in sizes.iter().enumerate() {
        for (j, y) in sizes
            .iter()
            .enumerate()
            .filter(|(j, _)| *j < 8 || (i + j) % 3 == 0)
        {
            let x = if (i + j) % 2 == 0 { *x } else { -x };
            all.push(Complex::new(x, *y));
            if plane == Plane::Whole && j % 5 == 1 && *y < 20.0 {
                all.push(Complex::new(x, -y));
            }
        }
    }
    all
}

/// Values, in single precision too, and numbers of formulas by their bits: they are the same on
/// every machine.
fn checksum(a: &Algorithm) -> u64 {
    let mut sum = Checksum(0xcbf2_9ce4_8422_2325);
    for z in everywhere(a.plane) {
        let w = (a.w)(z);
        sum.add_number(w.re);
        sum.add_number(w.im);
        if let Some(single) = a.single {
            let w = single(Complex32::new(z.re as f32, z.im as f32));
            sum.add_number(w.re.into());
            sum.add_number(w.im.into());
        }
        if let Some(formula) = a.formula {
            sum.add(formula(z).into());
        }
    }
    sum.0
}

/// States what stands behind what is said of the algorithms: a change of any constant or limit
/// changes a checksum. One that is meant has its new one here.
const CHECKSUMS: [(&str, u64); 35] = [
    ("gautschi-1970", 0x6688_cf8c_8505_e825),
    ("cernlib-wwerf", 0x223f_f956_884e_288a),
    ("matta-reichel-1971", 0x5c1c_4397_951f_5955),
    ("hunter-regan-1972", 0xbcf1_2b15_40cb_aa3e),
    ("hui-armstrong-wray-1978", 0xce68_dbf8_b929_8fdb),
    ("humlicek-1979", 0x3aea_5e69_ddd2_0164),
    ("humlicek-1982", 0x5d77_53c4_7f72_e5e4),
    ("thompson-cox-hastings-1987", 0x8105_35df_1f40_094f),
    ("poppe-wijers-1990", 0x6577_f808_4d62_73e6),
    ("mclean-1994", 0x35bd_4736_1281_7630),
    ("weideman-1994-16", 0xc729_cf7e_e7d6_89ac),
    ("weideman-1994-24", 0x141b_3da7_f89a_84a6),
    ("weideman-1994-32", 0x5eaa_b484_721a_8fec),
    ("wells-1999-r2", 0xc9cb_2fa9_609d_8f9c),
    ("wells-1999-r3", 0x1474_c310_f276_9401),
    ("wells-1999-r4", 0x9ec6_0fad_7d4e_dd9e),
    ("wells-1999-r5", 0xda55_e378_d2f2_3c18),
    ("zaghloul-ali-2011", 0xdacf_fd3d_f532_c753),
    ("zaghloul-ali-2011-1e-8", 0x3c7d_6cf6_35d8_f29e),
    ("zaghloul-ali-2011-1e-4", 0xf18f_2820_44ac_bde9),
    ("abrarov-quine-2011", 0x78aa_f89d_d9b4_2162),
    ("abrarov-quine-2016", 0x4eaa_e402_7039_6d4a),
    ("tran-ngo-hartmann-2013-cpf", 0xdb08_536c_c846_4a7d),
    ("karbach-raven-schiller-2014", 0x0dde_ef8c_96ec_039a),
    ("karbach-raven-schiller-2014-fast", 0xfe03_7208_bd3a_715a),
    ("zaghloul-2017", 0xc642_685b_4c5e_f214),
    ("schreier-2011-hum1wei24", 0xf5c9_87cd_7b8e_ba6f),
    ("schreier-2018-16", 0xcb02_b1ce_7f2b_e652),
    ("schreier-2018-16-1.31183", 0x4093_575c_d4ef_64d7),
    ("schreier-2018-20", 0xd2e8_72b4_3023_4b85),
    ("schreier-2018-hum2zpf16", 0xcea7_a815_df91_13b1),
    ("al-azah-chandler-wilde-2021", 0x8f9c_9607_9468_3de4),
    ("tran-ngo-hartmann-2013", 0x1543_52e8_78fe_7300),
    ("hapi-pcqsdhc", 0x3ad5_980f_e298_c9d0),
    ("schreier-hochstaffl-2021", 0xcf9f_dcec_bd08_2e78),
];

#[test]
fn values_have_their_bits() {
    let mut found: Vec<(&str, u64)> = all().iter().map(|a| (a.name, checksum(a))).collect();
    found.extend(
        crate::PROFILES
            .iter()
            .map(|p| (p.name, checksum_of_profile(p))),
    );
    let listed: Vec<String> = found
        .iter()
        .map(|(name, sum)| format!("    ({name:?}, {sum:#018x}),"))
        .collect();
    assert_eq!(found, CHECKSUMS, "\n{}", listed.join("\n"));
}

/// Lines from Voigt's to all effects at once, with sizes of X and Y on both sides of every limit.
fn checksum_of_profile(p: &crate::Profile) -> u64 {
    let mut sum = Checksum(0xcbf2_9ce4_8422_2325);
    let sizes = [
        0.0, 1e-18, 1e-12, 1e-9, 1e-6, 1e-4, 0.003, 0.05, 0.7, 3.0, 40.0,
    ];
    for width in [0.0, 1e-4, 0.02, 0.3, 2.0] {
        for speed in sizes {
            for (k, more) in [0.0, 0.1, 0.6, 0.3, 1.0].into_iter().enumerate() {
                for detuning in [-1e9, -30.0, -2.5, -0.3, 0.0, 1e-6, 0.04, 0.9, 7.0, 300.0] {
                    let effects = if p.whole { more } else { 0.0 };
                    let line = crate::Line {
                        doppler: [0.01, 0.3, 9.0, 1e-8, 1e-4][k],
                        widths: [width, speed],
                        shifts: [0.1 * effects, 0.07 * effects * speed.min(1.0)],
                        narrowing: more * 0.5,
                        correlation: effects,
                        detuning,
                    };
                    let value = (p.value)(&line);
                    sum.add_number(value.re);
                    sum.add_number(value.im);
                }
            }
        }
    }
    sum.0
}

/// Where all collisions are correlated the mean over the speed has a formula of its own, near its
/// centre and far out: the limit of the others.
#[test]
fn full_correlation_is_a_limit() {
    let authors = &crate::PROFILES[0];
    for (doppler, far) in [(0.3, false), (1e-5, true)] {
        for detuning in [0.0, 0.1, 0.5, -0.3] {
            let at = |correlation| {
                (authors.value)(&crate::Line {
                    doppler,
                    widths: [0.2, 0.3],
                    shifts: [0.02, -0.05],
                    narrowing: 0.1,
                    correlation,
                    detuning,
                })
            };
            let (limit, beside) = (at(1.0), at(1.0 - 1e-5));
            let off = (limit - beside).norm() / limit.norm();
            assert!(off < 1e-3, "{far} {detuning} {limit} {beside} {off:e}");
        }
    }
}
