use super::*;
use crate::pinned::{bit_by_bit, counted, largest};
use crate::truncation::rows::{STORED, places};

/// `Σ |e_n| Dⁿ` and Cauchy's estimate of the tail.
#[test]
fn errors_of_coefficients_add_up() {
    for kind in [Kind::Cell, Kind::Disc, Kind::RealAxis] {
        let (centre, row) = match kind {
            Kind::Disc => disc_at(0.5, 0.5),
            Kind::Cell => cell_at(2.0, 2.3),
            Kind::RealAxis => {
                let (x, row) = real_axis_at(3.0);
                ((x, 0.0), row)
            }
        };
        let found = RowWithErrors::of(row, centre, kind).expect("decided");
        // 2e⁹ about centres on or above the axis, 2e¹⁶ down to Im z = −4.
        let most = if kind == Kind::Disc {
            2.0 * 16f64.exp()
        } else {
            2.0 * 9f64.exp()
        };
        assert!(found.most >= most && found.most < 1.01 * most);
        for d in [0.1f64, 0.3, 1.0] {
            let sum: f64 = found
                .errors
                .iter()
                .zip(0..)
                .map(|(e, n)| e * d.powi(n))
                .sum();
            let due = sum + 100.0 * found.most * (d / 3.0).powi(40);
            let within = found.within(d);
            assert!(
                within >= due * (1.0 - 1e-12) && within <= due * (1.0 + 1e-9),
                "{kind:?} {d}"
            );
        }
        assert_eq!(found.within(1.0f64.next_up()), f64::INFINITY);
        assert_eq!(found.within(f64::NAN), f64::INFINITY);
    }
}

/// As many rows as the solver has for these parts of the plane: one that is not gathered would
/// leave the proof open.
#[test]
fn rows_of_the_solver_are_counted() {
    let rows = Rows::of_the_solver().expect("decided");
    let count = |of: Kind| rows.0.keys().filter(|(kind, ..)| *kind == of).count();
    assert_eq!(
        [Kind::Cell, Kind::Disc, Kind::RealAxis].map(count),
        [417, 25, 127]
    );
}

#[test]
fn rows_of_the_solver_bit_by_bit() {
    let rows = Rows::of_the_solver().expect("decided");
    let order = |kind: Kind| {
        [Kind::Cell, Kind::Disc, Kind::RealAxis]
            .iter()
            .position(|k| *k == kind)
    };
    let mut keys: Vec<Key> = rows.0.keys().copied().collect();
    keys.sort_unstable_by_key(|&(kind, x, y)| (order(kind), x, y));
    let some = keys.iter().step_by(25).map(|k| &rows.0[k]);
    let errors: Vec<f64> = some.clone().flat_map(|r| r.errors.clone()).collect();
    let within = some.flat_map(|r| [0.0, 1e-3, 0.125, 0.5, 1.0].map(|d| r.within(d)));
    let found = [
        counted("keys", &keys),
        largest("errors", errors),
        largest("within", within),
        counted("places", (0..STORED).map(places)),
        counted(
            "signs of zero",
            [0.0, -0.0].map(|y| key(Kind::Disc, (0.5, y))),
        ),
    ];
    let due = [
        ("keys", 0xee90b7c7d57190ef, 569.0),
        ("errors", 0xc6137dcbdfc50094, 1.1462834441048806),
        ("within", 0x56fb3259e73523f3, 5.031253298578219),
        ("places", 0xd19ce18f3595f3e7, 18.0),
        ("signs of zero", 0x86f5bb921141d0fd, 2.0),
    ];
    bit_by_bit(&found, &due);
}
