//! Inputs that are none, the law of scale, the numbers of an input.

use super::*;

/// Curves are kept by them: two inputs that differ in one number are not the same.
#[test]
fn fractions_are_all_numbers_in_their_order() {
    let fields = ClassIii::fields().len();
    let numbers: Vec<Rational> = (0..fields).map(|k| Rational::from((k as u32, 7))).collect();
    let input = ClassIii::unpack(&numbers).unwrap();
    assert_eq!(input.to_fractions(), numbers);
}

fn refusal(input: &ClassIiiInput) -> Option<&'static str> {
    ClassIii::solve(*input).err()
}

#[test]
fn what_is_no_linkage_is_refused_by_its_name() {
    let good = at_degrees(14.426, 2.0);
    assert_eq!(refusal(&good), None);
    let mut input = good;
    input.geometry.l1 = -0.1;
    assert_eq!(refusal(&input), Some("not positive"));
    for length in 0..6 {
        for value in [0.0, -0.3] {
            let mut numbers = good.to_vec();
            numbers[length] = value;
            let input = ClassIii::unpack(&numbers).unwrap();
            assert_eq!(refusal(&input), Some("not positive"));
            let numbers = exact(&numbers).unwrap();
            let reference = ClassIii::reference(ClassIii::unpack(&numbers).unwrap(), 128);
            let due = Uncertified::Refused("not positive");
            assert_eq!(reference.map(|_| ()), Err(due));
        }
    }
    let mut input = good;
    input.m5 = -1.0;
    assert_eq!(refusal(&input), Some("masses"));
    // Pivots 10 m apart, rockers and coupler 1.725 m long.
    let mut input = good;
    input.geometry.x5 = 10.75;
    assert_eq!(refusal(&input), Some("cannot be assembled"));
    let numbers = exact(&input.to_vec()).unwrap();
    let reference = ClassIii::reference(ClassIii::unpack(&numbers).unwrap(), 128);
    let due = Uncertified::Refused("cannot be assembled");
    assert_eq!(reference.map(|_| ()), Err(due));
}

/// Modes are counted around: of six modes the eighth is the second.
#[test]
fn modes_are_taken_modulo_their_number() {
    let good = at_degrees(14.426, 0.0);
    let linkage = good.geometry.solver().unwrap();
    let count = linkage
        .assembly_modes(Angle::from_rad(good.phi1))
        .modes
        .len();
    let solved = |mode: usize| {
        let mut input = good;
        input.mode = mode as f64;
        ClassIii::solve(input).unwrap()
    };
    let all: Vec<Vec<f64>> = (0..2 * count).map(solved).collect();
    assert_eq!(all[..count], all[count..]);
    assert!((1..count).all(|k| all[k - 1][2] < all[k][2]), "by phi4");
}

#[test]
fn modes_are_counted_and_pivots_are_flags() {
    let method = crate::methods::find("class-iii").unwrap();
    let good = at_degrees(14.426, 2.0);
    let admits = |change: fn(&mut ClassIiiInput)| {
        let mut input = good;
        change(&mut input);
        method.admits(&input.to_vec())
    };
    assert!(admits(|_| ()) && admits(|i| i.pivot1 = 0.0));
    assert!(!admits(|i| i.mode = 1.5));
    assert!(!admits(|i| i.pivot1 = 0.5) && !admits(|i| i.pivot1 = 2.0));
    assert!(!admits(|i| i.pivot3 = 2.0) && !admits(|i| i.pivot5 = -1.0));
}

/// Of links 2 and 4 the moment of inertia is about the centre of mass whatever is said of others.
#[test]
fn the_pivots_are_those_of_links_1_3_and_5() {
    let (yes, no) = (true, false);
    assert_eq!(about_pivot([yes, no, no]), [yes, no, no, no, no]);
    assert_eq!(about_pivot([no, yes, no]), [no, no, yes, no, no]);
    assert_eq!(about_pivot([no, no, yes]), [no, no, no, no, yes]);
}

#[test]
fn one_angle_or_rate_that_differs_breaks_the_law_of_scale() {
    let state = at_degrees(14.426, 2.0).row().unwrap().state;
    assert!(same_turns(&state, &state));
    for change in [
        (|s: &mut State| s.positions.phi2 += 1e-9) as fn(&mut State),
        |s| s.positions.phi5 += 1e-9,
        |s| s.rates.first[0] += 1e-9,
        |s| s.rates.second[3] += 1e-9,
    ] {
        let mut off = state;
        change(&mut off);
        assert!(!same_turns(&state, &off) && !same_turns(&off, &state));
    }
    // Determinants and condition numbers have units of their own.
    let mut larger = state;
    larger.determinant *= 16.0;
    assert!(same_turns(&state, &larger));
}

#[test]
fn laws_apply_to_linkages_alone() {
    let mut input = at_degrees(14.426, 2.0);
    for law in ClassIii::laws() {
        let residual = (law.residual)(&input.to_vec());
        assert!(residual.is_some_and(|r| r <= 1.0), "{}", law.name);
    }
    input.geometry.x5 = 10.75;
    for law in ClassIii::laws() {
        assert_eq!((law.residual)(&input.to_vec()), None, "{}", law.name);
        assert_eq!((law.residual)(&[1.0]), None, "{}", law.name);
    }
}

/// The lengths alone: angles stay.
#[test]
fn a_scaled_geometry_has_its_angle() {
    let geometry = at_degrees(0.0, 0.0).geometry;
    let (here, there) = (geometry.values(), geometry.scaled(2.0).values());
    for k in 0..11 {
        let factor = if k == 6 { 1.0 } else { 2.0 };
        assert_eq!(there[k], factor * here[k], "{k}");
    }
}
