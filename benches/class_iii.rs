//! Class-III linkage: one crank angle in a sweep (positions on the branch, rates, reduced
//! quantities), all assembly modes, and certified rows.
//!
//! `cargo bench --bench class_iii`. Items are crank angles.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::solvers::class_iii::{ClassIii, Geometry, State};
use mechaudit::solvers::reduction::{Body, Masses, MomentOfInertia, Row};
use mechaudit::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use std::f64::consts::TAU;

fn main() {
    divan::main();
}

/// The linkage and masses of Zinchenko (2008), centres of mass as recovered.
fn sand_screen() -> (ClassIii, Masses, State) {
    let cm = Length::from_cm;
    let linkage = ClassIii::new(Geometry {
        l1: cm(10.0),
        l2: cm(104.0),
        l3: cm(60.0),
        l4: cm(64.0),
        l5: cm(48.5),
        lb: cm(22.0),
        phi_b: Angle::from_deg(-39.3),
        x3: cm(75.0),
        y3: cm(93.0),
        x5: cm(128.5),
        y5: cm(103.5),
    })
    .expect("a valid geometry");
    let body = |mass: f64, inertia: MomentOfInertia, radius: f64, angle: f64| Body {
        mass: Mass::from_kg(mass),
        inertia,
        radius: cm(radius),
        angle: Angle::from_deg(angle),
    };
    let centre = |j| MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(j));
    let pivot = |j| MomentOfInertia::AboutPivot(Inertia::from_kg_m2(j));
    let masses = Masses::new(
        [
            body(0.0, pivot(0.0), 0.0, 0.0),
            body(10.0, centre(0.8), 50.0, 0.0),
            body(5.0, pivot(0.5), 30.0, 0.0),
            body(550.0, centre(18.0), 25.0, -12.0),
            body(3.5, pivot(0.2), 20.0, 0.0),
        ],
        Acceleration::from_m_per_s2(9.81),
    )
    .expect("valid masses");
    let phi1 = 14.426f64.to_radians();
    let mode = linkage.assembly_modes(phi1).modes[2];
    let start = linkage.state_near(phi1, mode).expect("closed");
    (linkage, masses, start)
}

fn angles(start: &State, n: usize) -> Vec<f64> {
    (0..n)
        .map(|k| start.phi1 + TAU * k as f64 / n as f64)
        .collect()
}

/// A full row at each of n crank angles over a turn, one core.
#[divan::bench(args = [48, 1000, 100_000])]
fn rows(bencher: Bencher, n: usize) {
    let (linkage, masses, start) = sand_screen();
    let angles = angles(&start, n);
    bencher.counter(ItemsCount::new(n)).bench(|| -> Vec<Row> {
        linkage
            .rows(&masses, &start, angles.iter().copied())
            .expect("a crank that turns")
    });
}

/// The same on all cores.
#[divan::bench(args = [100_000])]
fn rows_parallel(bencher: Bencher, n: usize) {
    let (linkage, masses, start) = sand_screen();
    let angles = angles(&start, n);
    bencher.counter(ItemsCount::new(n)).bench(|| {
        let states = linkage
            .sweep_parallel(&start, &angles)
            .expect("a crank that turns");
        masses.reduce_parallel(&states)
    });
}

/// All assembly modes at one crank angle.
#[divan::bench]
fn assembly_modes(bencher: Bencher) {
    let (linkage, _, start) = sand_screen();
    bencher
        .counter(ItemsCount::new(1usize))
        .bench(|| linkage.assembly_modes(divan::black_box(start.phi1)));
}

#[cfg(feature = "oracle")]
mod certified {
    use super::*;
    use mechaudit::reference::Decimal;
    use mechaudit::reference::class_iii as exact;
    use rug::Rational;

    fn q(text: &str) -> Rational {
        Decimal::parse(text).expect("a decimal").value
    }

    fn geometry() -> exact::Geometry {
        let m = |cm: &str| q(cm) / 100;
        exact::Geometry {
            l1: m("10"),
            l2: m("104"),
            l3: m("60"),
            l4: m("64"),
            l5: m("48.5"),
            lb: m("22"),
            phi_b: exact::ExactAngle::Degrees(q("-39.3")),
            o3: [m("75"), m("93")],
            o5: [m("128.5"), m("103.5")],
        }
    }

    fn masses() -> exact::Masses {
        let body =
            |mass: &str, inertia: &str, about_pivot, radius_cm: &str, angle: &str| exact::Body {
                mass: q(mass),
                inertia: q(inertia),
                about_pivot,
                radius: q(radius_cm) / 100,
                angle: exact::ExactAngle::Degrees(q(angle)),
            };
        exact::Masses {
            bodies: [
                body("0", "0", true, "0", "0"),
                body("10", "0.8", false, "50", "0"),
                body("5", "0.5", true, "30", "0"),
                body("550", "18", false, "25", "-12"),
                body("3.5", "0.2", true, "20", "0"),
            ],
            gravity: q("9.81"),
        }
    }

    /// Certified rows over a turn, each followed with proof from the one before.
    #[divan::bench(args = [(48, 50), (1000, 50), (1000, 16), (100, 1000)])]
    fn rows(bencher: Bencher, (n, digits): (usize, u32)) {
        let bits = (f64::from(digits) * 3.33) as u32 + 48;
        let linkage = exact::Linkage::new(&geometry(), bits);
        let masses = masses();
        let angle = |k: usize| {
            let degrees = q("14.426") + Rational::from((360 * k as u32, n as u32));
            exact::ExactAngle::Degrees(degrees).to_ball(bits)
        };
        let start = linkage
            .modes(&angle(0))
            .expect("decided")
            .swap_remove(2)
            .configuration;
        bencher.counter(ItemsCount::new(n)).bench(|| {
            let mut here = start.clone();
            let mut at = angle(0);
            let mut worst = i64::MAX;
            for k in 1..=n {
                let next = angle(k);
                here = linkage.follow(&here, &at, &next).expect("decided");
                let kinematics = linkage.kinematics(&here).expect("decided");
                let reduced = linkage.reduce(&kinematics, &masses);
                worst = worst.min(reduced.inertia.accuracy_bits());
                at = next;
            }
            assert!(
                worst as f64 > f64::from(digits) * std::f64::consts::LOG2_10,
                "{worst} bits"
            );
            worst
        });
    }

    /// Every assembly mode with the proof that there are no others.
    #[divan::bench]
    fn assembly_modes(bencher: Bencher) {
        let linkage = exact::Linkage::new(&geometry(), 192);
        let phi1 = exact::ExactAngle::Degrees(q("14.426")).to_ball(192);
        bencher
            .counter(ItemsCount::new(1usize))
            .bench(|| linkage.modes(divan::black_box(&phi1)).expect("decided"));
    }
}
