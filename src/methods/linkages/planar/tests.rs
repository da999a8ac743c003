//! Audits of planar linkages with another seed, planted faults, inputs that are none.

use super::flow::Flow;
use super::{PlanarLinkage, PlanarReduction};
use crate::audit::{Settings, SolverAnswer, Variant, audit_method};
use crate::methods::definition::Definition;
use crate::methods::find;

fn few() -> Settings {
    Settings {
        seed: 20_261_125,
        cases_per_region: 12,
        ..Settings::default()
    }
}

#[test]
fn all_pass_with_another_seed() {
    for name in ["planar-linkage", "planar-reduction", "planar-reactions"] {
        let report = audit_method(&*find(name).unwrap(), &few(), &|| ());
        let failed = report
            .failures
            .first()
            .map(|f| (&f.case, &f.judgement.reason));
        assert!(report.passed(), "{name}: {failed:?} {:?}", report.laws);
        assert!(report.laws.iter().all(|l| l.cases > 30), "{name}");
    }
}

/// One value of a body that is off by little: angles by 1e-9, rates by a millionth.
#[test]
fn small_faults_fail() {
    let method = find("planar-linkage").unwrap();
    for (place, by) in [
        (9, 1.0 + 1e-9),
        (10, 1.0 + 1e-6),
        (11, 1.0 + 1e-5),
        (14, -1.0),
    ] {
        let faulty = Variant::new(&*method)
            .solver(
                move |x| match PlanarLinkage::solve(PlanarLinkage::unpack(x).unwrap()) {
                    Ok(mut v) => {
                        v[place] *= by;
                        SolverAnswer::Values(v)
                    }
                    Err(word) => SolverAnswer::Refuses(word),
                },
            )
            .region("class-iii")
            .unwrap();
        let report = audit_method(&faulty, &few(), &|| ());
        assert!(!report.passed(), "{place}");
    }
}

#[test]
fn what_is_no_linkage_is_outside() {
    let method = find("planar-linkage").unwrap();
    let good = &method.domain().check_points[0].input;
    assert!(method.admits(good));
    // A body that there is not, a body on itself, a fraction of one, too few pins, angles that are far off.
    for (place, value) in [
        (3, 9.0),
        (4, 2.0),
        (3, 0.5),
        (1, 3.0),
        (good.len() - 1, 1.5),
    ] {
        let mut bad = good.clone();
        bad[place] = value;
        assert!(!method.admits(&bad), "{place} {value}");
    }
    let heavy = find("planar-reduction").unwrap();
    let mut lighter = heavy.domain().check_points[0].input.clone();
    assert!(heavy.admits(&lighter));
    *lighter.last_mut().unwrap() = -1.0;
    assert!(!heavy.admits(&lighter));
    assert_eq!(
        PlanarReduction::solve(PlanarReduction::unpack(&lighter[..]).unwrap()),
        Err("masses")
    );
}

/// What is zero changes nothing, and costs the solution of a system.
#[test]
fn coordinates_of_zero_are_no_data() {
    let method = find("planar-linkage").unwrap();
    let mut zeros = 0;
    for point in method.domain().check_points {
        let i = PlanarLinkage::unpack(&point.input).unwrap();
        let data = Flow::new(&i, i.near).unwrap().data();
        assert!(data.iter().all(|d| d.size > 0.0), "{}", point.name);
        zeros += [i.xa, i.ya, i.xb, i.yb]
            .concat()
            .iter()
            .filter(|x| **x == 0.0)
            .count();
    }
    assert!(zeros > 0);
}
