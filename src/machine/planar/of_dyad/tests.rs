use super::*;
use crate::machine::dyad::{ASSEMBLIES, Shape, floating};
use crate::machine::{Linkage, Source};
use crate::solvers::run_up::{FourBarModel, ReducedModel, SliderCrankModel};

fn read(text: &str) -> Dyad {
    match Linkage::read(&Source::toml(text)).unwrap() {
        Linkage::Dyad(dyad) => *dyad,
        _ => unreachable!("a dyad"),
    }
}

const FOUR_BAR: &str = "type = \"four-bar\"\ngravity = \"9.81 m/s^2\"\ncrank_speed = \"3 rad/s\"\n\
    crank_acceleration = \"-2 rad/s^2\"\n[geometry]\ncrank = \"10 cm\"\ncoupler = \"40 cm\"\nrocker = \"30 cm\"\n\
    frame = \"35 cm\"\n[points.coupler]\nP = [\"20 cm\", \"5 cm\"]\n[bodies.crank]\nmass = \"1 kg\"\n\
    inertia = \"0.02 kg m^2\"\ninertia_about = \"pivot\"\nradius = \"4 cm\"\n[bodies.coupler]\nmass = \"4 kg\"\n\
    inertia = \"0.05 kg m^2\"\nradius = \"20 cm\"\nangle = \"7 deg\"\n[bodies.rocker]\nmass = \"3 kg\"\n\
    inertia = \"0.15 kg m^2\"\ninertia_about = \"pivot\"\nradius = \"14 cm\"\nangle = \"-12 deg\"\n";

const SLIDER: &str = "type = \"slider-crank\"\ncrank_speed = \"3 rad/s\"\n[geometry]\ncrank = \"1 m\"\nrod = \"3 m\"\n\
    offset = \"-0.5 m\"\ndirection = \"30 deg\"\n[points.rod]\nP = [\"1 m\", \"0.25 m\"]\n[bodies.crank]\nmass = \"1 kg\"\n\
    inertia = \"0.5 kg m^2\"\nradius = \"40 cm\"\n[bodies.rod]\nmass = \"2 kg\"\ninertia = \"0.3 kg m^2\"\n\
    radius = \"1.25 m\"\nangle = \"5 deg\"\n[bodies.slider]\nmass = \"5 kg\"\n";

const ALL: Columns = Columns {
    paths: true,
    reactions: true,
};

fn named(dyad: &Dyad, degrees: f64, assembly: usize) -> impl Fn(&str) -> f64 {
    let further = Further::of(dyad, ALL).unwrap().unwrap();
    let at = Rational::from_f64(degrees).unwrap();
    let row = floating(dyad, &at, ASSEMBLIES[assembly]).unwrap().unwrap();
    let values = further.values(degrees, &row);
    let names = further.names();
    assert_eq!(names.len(), values.len());
    move |name: &str| {
        let k = names.iter().position(|n| n == name);
        values[k.unwrap_or_else(|| panic!("{name} among {names:?}"))]
    }
}

fn assert_near(found: f64, due: f64, what: &str) {
    assert!(
        (found - due).abs() < 1e-9 * (1.0 + due.abs()),
        "{what}: {found} {due}"
    );
}

/// The reduced masses are those of a run-up, which has formulas of its own.
#[test]
fn reduced_masses_are_those_of_a_run_up() {
    for text in [FOUR_BAR, SLIDER] {
        let dyad = read(text);
        for (k, assembly) in ASSEMBLIES.into_iter().enumerate() {
            let model: Box<dyn ReducedModel> = match &dyad.shape {
                Shape::FourBar { solver, bodies, .. } => Box::new(
                    FourBarModel::new(*solver, assembly, bodies.unwrap(), dyad.gravity).unwrap(),
                ),
                Shape::SliderCrank { solver, bodies, .. } => {
                    let (links, slider) = bodies.unwrap();
                    Box::new(
                        SliderCrankModel::new(*solver, assembly, links, slider, dyad.gravity)
                            .unwrap(),
                    )
                }
            };
            for degrees in [-100.0, 12.5, 40.0, 200.0] {
                let due = model.coefficients(f64::to_radians(degrees)).unwrap();
                let value = named(&dyad, degrees, k);
                assert_near(value("I_n_kg_m2"), due.inertia, "I_n");
                assert_near(
                    value("dI_n_dphi_kg_m2_per_rad"),
                    due.inertia_derivative,
                    "dI_n/dphi",
                );
                assert_near(value("M_o_N_m"), due.moment, "M_o");
            }
        }
    }
}

/// A coupler point is where its link's angle puts it, and moves with the crank's speed; forces on
/// the crank turn it by the drive's torque.
#[test]
fn points_and_forces_belong_to_the_position() {
    for (text, at) in [(FOUR_BAR, [0.2, 0.05]), (SLIDER, [1.0, 0.25])] {
        let dyad = read(text);
        for k in [0, 1] {
            let (degrees, step) = (40.0, 1e-4);
            let value = named(&dyad, degrees, k);
            let row = floating(&dyad, &40.into(), ASSEMBLIES[k]).unwrap().unwrap();
            let slider = dyad.shape.type_name() == "slider-crank";
            let angle = row[usize::from(slider)].to_radians();
            let length = if slider { 1.0 } else { 0.1 };
            let (s1, c1) = f64::to_radians(degrees).sin_cos();
            let (s2, c2) = angle.sin_cos();
            let [x, y] = [
                length * c1 + at[0] * c2 - at[1] * s2,
                length * s1 + at[0] * s2 + at[1] * c2,
            ];
            assert_near(value("x_P_m"), x, "x");
            assert_near(value("y_P_m"), y, "y");
            let [before, after] = [degrees - step, degrees + step].map(|d| named(&dyad, d, k));
            for (name, rate) in [("x_P_m", "v_x_P_m_per_s"), ("y_P_m", "v_y_P_m_per_s")] {
                let slope = (after(name) - before(name)) / (2.0 * step.to_radians());
                assert!((value(rate) - 3.0 * slope).abs() < 1e-6, "{name}");
            }
            // The crank about its pivot: its own inertia, its weight, and the force that it passes
            // on in A.
            let (mass, radius, inertia) = match slider {
                false => (1.0, 0.04, 0.02),
                true => (1.0, 0.4, 0.5 + 0.16),
            };
            let acceleration = if slider { 0.0 } else { -2.0 };
            let weight = -mass * dyad.gravity.m_per_s2() * radius * c1;
            let middle = if slider { "rod" } else { "coupler" };
            let [fx, fy] = ["x", "y"].map(|c| value(&format!("F{c}_A_{middle}_N")));
            let passed = length * (c1 * -fy - s1 * -fx);
            let drive = value("drive_N_m");
            assert_near(inertia * acceleration, drive + weight + passed, "moments");
        }
    }
}

/// Without bodies paths alone; a singular position has a row without values.
#[test]
fn what_there_is_none_of() {
    let none = Columns::default();
    let bare = read(
        "type = \"four-bar\"\n[geometry]\ncrank = \"1 m\"\ncoupler = \"2 m\"\nrocker = \"4 m\"\nframe = \"5 m\"\n",
    );
    assert!(Further::of(&bare, none).unwrap().is_none());
    assert_eq!(Further::of(&bare, ALL).err(), Some(FurtherError::Reactions));
    let paths = Columns {
        paths: true,
        ..none
    };
    let further = Further::of(&bare, paths).unwrap().unwrap();
    let names = further.names();
    assert_eq!((names.len(), &*names[0]), (14, "x_A_m"));
    let row = floating(&bare, &180.into(), ASSEMBLIES[0])
        .unwrap()
        .unwrap();
    let values = further.values(180.0, &row);
    assert!(values.len() == 14 && values.iter().all(|x| x.is_nan()));
    // 1 kg at 0.5 m has 0.25 kg m² about the pivot.
    let light = FOUR_BAR.replace("radius = \"14 cm\"", "radius = \"50 cm\"");
    let refused = Further::of(&read(&light), none).err().unwrap().to_string();
    assert!(
        refused.starts_with("the inertia of rocker about its pivot"),
        "{refused}"
    );
}

#[test]
fn points_are_on_links_and_have_names_of_their_own() {
    for (from, to, due) in [
        (
            "points.coupler",
            "points.couple",
            "points.couple is no link (did you mean \"coupler\"?): a four-bar has crank, coupler, rocker",
        ),
        ("P = [", "A = [", "points.coupler: the name \"A\" is taken"),
        ("P = [", "\"P,Q\" = [", "must be a name"),
        ("\"5 cm\"]", "\"5 s\"]", "is not a length"),
    ] {
        let text = FOUR_BAR.replace(from, to);
        assert_ne!(text, FOUR_BAR, "{from}");
        let refused = Linkage::read(&Source::toml(text)).err().expect("refused");
        assert!(refused.to_string().contains(due), "{refused}");
    }
}
