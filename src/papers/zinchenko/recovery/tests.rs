//! Tests of `recovery`.

use super::super::tables::printed;
use super::*;

#[test]
fn the_inertia_columns_give_s2_and_s4() {
    let printed = printed();
    let model = Model::new(&printed);
    let r = model.recover(&[1.0; 4], &SEEN);
    let deviation = r.covariance[(0, 0)].sqrt();
    assert!((r.values[0] - 0.5).abs() < 4.0 * deviation && deviation < 1e-3);
    let (x, y) = (r.values[1], r.values[2]);
    assert!((x.hypot(y) - 0.25).abs() < 1e-4);
    assert!((y.atan2(x).to_degrees() + 12.0).abs() < 0.02);
    assert!((0.8..1.3).contains(&r.misfit), "{}", r.misfit);
    // s3 and s5 leave no trace in I_n.
    assert_eq!(model.rank(4, &SEEN), 3);
    assert_eq!(model.rank(4, &FIVE), 3);
}

#[test]
fn the_moment_columns_add_s3_and_s5() {
    let printed = printed();
    let (r, _) = Model::new(&printed).recover_with_moment(&FIVE);
    assert!((r.values[1] - 0.30).abs() < 0.01 && (r.values[4] - 0.20).abs() < 0.01);
}

#[test]
fn parameters_have_the_paper_s_names_units_and_values() {
    let all = Parameters::new(&data::recovered());
    for (parameter, name, unit, value) in [
        (0, "m2", "kg", 10.0),
        (13, "I5", "kg m^2", 0.2),
        (6, "s3 along the link", "cm", 30.0),
        (
            11,
            "s4 across the link",
            "cm",
            -25.0 * 12f64.to_radians().sin(),
        ),
        (GRAVITY, "g", "m/s^2", 9.81),
    ] {
        let (found, of, per_si) = shown(parameter);
        assert_eq!((found.as_str(), of), (name, unit));
        assert!((all.0[parameter] * per_si - value).abs() < 1e-12, "{name}");
    }
    let [x, y] = [10, 11].map(|k| Parameters::new(&data::printed()).0[k]);
    assert!(
        (x.hypot(y) - 0.055).abs() < 1e-15 && (y / x + 39.3f64.to_radians().tan()).abs() < 1e-14
    );
}

/// The solvers' masses are those of the example, whatever way they come.
#[test]
fn parameters_are_the_masses() {
    let own = Parameters::new(&data::recovered()).masses();
    let (_, due, start) = data::solver_start();
    let [own, due] = [own, due].map(|m| m.reduce(&start));
    assert!((own.inertia_kg_m2 / due.inertia_kg_m2 - 1.0).abs() < 1e-12);
    assert!((own.moment_n_m - due.moment_n_m).abs() < 1e-10);
}

/// The model is linear in a mass, in an inertia and in gravity: a step of any size is the
/// derivative times it.
#[test]
fn the_jacobian_is_the_model_s_slope() {
    let printed = printed();
    let model = Model::new(&printed);
    let p = Parameters::new(&data::recovered());
    let which = [8, 5, GRAVITY];
    let j = model.jacobian(&p, 6, &which);
    let here = model.columns(&p, 6);
    assert_eq!((here.len(), j.shape()), (6 * TURN, (6 * TURN, 3)));
    for (k, parameter) in which.into_iter().enumerate() {
        let off = model.columns(&p.moved(parameter, 0.5), 6) - &here - j.column(k) * 0.5;
        assert!(off.amax() < 1e-6, "{k}: {}", off.amax());
        assert!(j.column(k).amax() > 1e-3);
    }
    // Columns of I_n do not know gravity, those of M_o nothing else of a rocker than its weight.
    assert_eq!(j.column(2).rows(0, 4 * TURN).amax(), 0.0);
    assert_eq!(j.column(1).rows(4 * TURN, 2 * TURN).amax(), 0.0);
}

/// Half of them are smaller than the median, which is 0.6745 of a deviation.
#[test]
fn the_typical_size_is_a_median() {
    let sizes = DVector::from_column_slice(&[3.0 * 0.6745, -0.6745, 1e9, 0.0, -2.0 * 0.6745]);
    assert!((typical_size(&sizes) - 2.0).abs() < 1e-14);
}

/// With others known a parameter is determined by the norm of its column: two columns of ones and
/// of a fault each.
#[test]
fn what_is_known_alone_is_known_better_than_together() {
    let printed = printed();
    let model = Model::new(&printed);
    let which = [8, 9, 10];
    let found = model.identifiability(&[1.0; 4], &which);
    let doubled = model.identifiability(&[2.0; 4], &which);
    for ([alone, together], [a, b]) in found.iter().zip(&doubled) {
        assert!(*alone > 0.0 && alone < together && together.is_finite());
        assert!((a / alone - 2.0).abs() < 1e-9 && (b / together - 2.0).abs() < 1e-6);
    }
}

/// Against each of the rows 0, 4, … 44, and no others. I_n is up to 5.63 in centimetres, nearly all
/// of it of masses that move.
#[test]
fn metres_are_off_by_ten_thousand_times_what_moves_at_the_nodes() {
    let states = data::states(NODES);
    let with = |row: Option<usize>| {
        let mut printed = printed();
        if let Some(row) = row {
            printed[INERTIA][row].value.value += 1_000_000_000;
        }
        off_in_metres(&states, &printed)
    };
    let worst = with(None);
    assert!((2e4..5.7e4).contains(&worst), "{worst}");
    assert!((0..49).all(|row| (with(Some(row)) > 1e8) == (row < 48 && row % 4 == 0)));
}
