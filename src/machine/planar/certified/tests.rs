//! Tests of `certified`.

use super::*;
use crate::machine::Source;
use crate::machine::planar::{Columns, certified_names, names, values};
use std::f64::consts::TAU;

const WATT: &str = include_str!("../../../../examples/watt-1.toml");

fn read(text: &str) -> Machine {
    Machine::read(&Source::toml(text)).unwrap()
}

/// A four-bar linkage of points in the frames of its bodies, with the rocker's pivot where it is
/// said.
fn four_bar(crank: &str, rest: [&str; 2], pivot: [&str; 2], more: &str) -> Machine {
    let pins =
        ["A", "B", "C", "D"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    let [coupler, rocker] = rest;
    let [x, y] = pivot;
    read(&format!(
        "type = \"planar\"\n[ground.points]\nA = [\"0 m\", \"0 m\"]\nD = [\"{x}\", \"{y}\"]\n\
         [[body]]\nname = \"crank\"\nends = [\"A\", \"B\"]\nlength = \"{crank}\"\n\
         [[body]]\nname = \"coupler\"\nends = [\"B\", \"C\"]\nlength = \"{coupler}\"\n\
         [[body]]\nname = \"rocker\"\nends = [\"D\", \"C\"]\nlength = \"{rocker}\"\n\
         {}[drive]\nbody = \"crank\"\n{more}",
        pins.concat()
    ))
}

#[test]
fn what_has_no_certified_digits_is_named() {
    let refused = |text: &str| {
        let machine = read(text);
        Certifier::new(&machine, 10).err().unwrap().to_string()
    };
    // Two points of the drawing that are one when rounded.
    let close = WATT
        .replace(
            "[points]\n",
            "[points]\nX = [\"5.00000000000000000001 cm\", \"3.5 cm\"]\n",
        )
        .replace("[\"B\", \"C\", \"E\"]", "[\"B\", \"C\", \"E\", \"X\"]");
    let due = "two points of body coupler differ, and are one when rounded to 64-bit numbers";
    assert_eq!(refused(&close), due);
    // One point by two names is one.
    let twice = close.replace("5.00000000000000000001 cm", "5 cm");
    assert!(Certifier::new(&read(&twice), 10).is_ok());
    // Sides that make a triangle only when rounded; a guide along it.
    let jansen = include_str!("../../../../examples/jansen-leg.toml");
    let flat = |longest: &str| {
        let sides = "sides = [\"41.5 cm\", \"55.8 cm\", \"40.1 cm\"]";
        let most = format!("sides = [\"{longest}\", \"20 cm\", \"21.5 cm\"]");
        let text = jansen.replace(sides, &most);
        assert_ne!(text, jansen);
        let crank_alone = text.split("[start]").next().unwrap();
        format!("{crank_alone}[start]\nmode = 0\n")
    };
    assert!(Certifier::new(&read(&flat("41.5 cm")), 10).is_ok());
    let due = "no triangle has exactly the sides of body bde";
    assert_eq!(refused(&flat("41.50000000000000000001 cm")), due);
    let slotted = |longest: &str| {
        format!(
            "type = \"planar\"\n[ground.points]\nO = [\"0 m\", \"0 m\"]\nC = [\"0 m\", \"3 m\"]\n\
             [[body]]\nname = \"crank\"\nends = [\"C\", \"A\"]\nlength = \"1 m\"\n\
             [[body]]\nname = \"plate\"\nends = [\"O\", \"B\", \"T\"]\n\
             sides = [\"{longest}\", \"1 m\", \"2 m\"]\n\
             [[joint]]\nkind = \"pin\"\npoint = \"O\"\n[[joint]]\nkind = \"pin\"\npoint = \"C\"\n\
             [[joint]]\nkind = \"slot\"\nname = \"slot\"\nbody = \"crank\"\npoint = \"A\"\non = \"plate\"\n\
             through = \"O\"\ntoward = \"T\"\n[drive]\nbody = \"crank\"\n[start]\nmode = 0\n"
        )
    };
    assert!(Certifier::new(&read(&slotted("3 m")), 10).is_ok());
    let due =
        "the guide of joint slot has no exact direction: its two points are one, or no triangle";
    assert_eq!(refused(&slotted("3.0000000000000000001 m")), due);
}

/// Where branches meet, positions are exact or proved beside exact ones, and derivatives are
/// missing.
#[test]
fn change_points_have_exact_positions() {
    let half = std::f64::consts::PI;
    let text = |row: &CertifiedRow, k: usize| row.digits[3 * k].clone();
    // A double crank with its links in line.
    let machine = four_bar("1 m", ["2 m", "4 m"], ["5 m", "0 m"], "");
    let state = |degrees: f64| {
        let modes = machine.solver.assembly_modes(degrees.to_radians()).states;
        modes.into_iter().next().unwrap()
    };
    let certifier = Certifier::new(&machine, 20).unwrap();
    let names = certified_names(&machine, true);
    let due = |row: &CertifiedRow, name: &str| {
        let k = names.iter().position(|n| n == name).unwrap();
        row.digits[k - 2].clone().unwrap()
    };
    let row = certifier.singular_row(&180.into(), &[half, 0.0, half], &state(179.0), true);
    for (name, exact) in [
        ("crank_deg", "180"),
        ("coupler_deg", "0"),
        ("rocker_deg", "180"),
        ("x_C_m", "1"),
        ("y_C_m", "0"),
        ("x_B_m", "-1"),
    ] {
        let found = due(&row, name);
        assert_eq!(
            found.parse::<f64>().unwrap(),
            exact.parse::<f64>().unwrap(),
            "{name}"
        );
    }
    let missing = row.digits.iter().filter(|d| d.is_none()).count();
    // First and second derivatives of two angles and of the coordinates of two points.
    assert_eq!((missing, row.reason.as_deref()), (12, Some(SINGULAR)));
    // Not a position: nothing is proved, and the reason is told.
    let off = certifier.singular_row(&180.into(), &[half, 0.01, half], &state(179.0), false);
    assert!(off.digits.iter().all(Option::is_none));
    assert!(off.reason.unwrap().contains("no simple numbers"));
    // Every position of the screen's parallelograms has its links in line at 0 degrees.
    let rhombus = read(include_str!("../../../../examples/n-four-bar.toml"));
    let modes = rhombus.solver.assembly_modes(0.1).states;
    let certifier = Certifier::new(&rhombus, 15).unwrap();
    for angles in [[0.0; 5], [0.0, 0.0, half, 0.0, half]] {
        let row = certifier.singular_row(&0.into(), &angles, &modes[0], false);
        assert_eq!(
            text(&row, 1).as_deref(),
            Some("0"),
            "{angles:?} {:?}",
            row.reason
        );
        let crank2 = text(&row, 2).unwrap().parse::<f64>().unwrap();
        assert_eq!(crank2, angles[2].to_degrees());
    }
}

/// A zero at a regular position is told by exact algebra.
#[test]
fn zeros_of_regular_positions_are_exact() {
    // The coupler of a parallelogram.
    let machine = four_bar("1 m", ["2 m", "1 m"], ["2 m", "0 m"], "");
    let modes = machine.solver.assembly_modes(TAU / 4.0).states;
    let certifier = Certifier::new(&machine, 15).unwrap();
    let level = modes
        .iter()
        .find(|s| machine.line(s, 2).abs() < 1e-9)
        .unwrap();
    let row = certifier.row(&90.into(), level, true);
    let names = certified_names(&machine, true);
    let of = |name: &str| {
        let k = names.iter().position(|n| n == name).unwrap();
        let text = row.digits[k - 2].as_deref();
        text.map(|t| t.parse::<f64>().unwrap())
    };
    assert_eq!(
        (of("coupler_deg"), of("rocker_deg")),
        (Some(0.0), Some(90.0))
    );
    assert_eq!((of("x_B_m"), of("dcoupler_dphi")), (Some(0.0), Some(0.0)));
    assert_eq!(
        (of("drocker_dphi"), of("d2rocker_dphi_2_per_rad")),
        (Some(1.0), Some(0.0))
    );
    // The crank's end moves along x.
    assert_eq!(of("dy_B_dphi_m_per_rad"), Some(0.0));
    assert_eq!(row.reason, None);
    // At any angle, without roots or fractions.
    for degrees in [37, 123, 166] {
        let next = machine
            .solver
            .follow(level, f64::from(degrees).to_radians())
            .unwrap();
        let row = certifier.row(&degrees.into(), &next, false);
        assert_eq!(row.reason, None, "{degrees}");
        assert_eq!(row.digits[3..6], ["0"; 3].map(|d| Some(d.to_string())));
    }
}

/// Each certified value is the solver's in the column of its name, with paths and without, on every
/// branch, and after turns.
#[test]
fn certified_values_stand_in_their_columns() {
    let columns = Columns {
        paths: true,
        reactions: false,
    };
    let screen = four_bar("1 m", ["3 m", "3 m"], ["4 m", "1 m"], "");
    let against = four_bar("1 m", ["3 m", "3 m"], ["4 m", "1 m"], "from = \"rocker\"\n");
    let mut checked = 0;
    for (machine, degrees) in [
        (&read(WATT), [50, 50 + 360]),
        (&screen, [190, -170]),
        (&screen, [-200, -200 - 720]),
        (&against, [35, 35 - 360]),
    ] {
        let certifier = Certifier::new(machine, 18).unwrap();
        let at = f64::from(degrees[0]).to_radians();
        let modes = machine.solver.assembly_modes(machine.inner(at)).states;
        assert!(modes.len() >= 2);
        for state in &modes {
            let floats = values(machine, None, state, columns);
            let names = names(machine, columns);
            for degrees in degrees {
                let found = certifier.values(&degrees.into(), state, true);
                let due = certified_names(machine, true);
                assert_eq!(found.len() + 2, due.len());
                for (name, digits) in due[2..].iter().zip(&found) {
                    let k = names.iter().position(|n| n == name).expect(name) - 2;
                    let x: f64 = digits.as_deref().expect(name).parse().unwrap();
                    let apart = (x - floats[k]).abs();
                    assert!(apart < 1e-9 * (1.0 + x.abs()), "{name}: {x} {}", floats[k]);
                    checked += 1;
                }
                let few = certifier.values(&degrees.into(), state, false);
                assert_eq!(few[..], found[..3 * (machine.bodies.len() - 1)]);
            }
        }
    }
    assert!(checked > 300, "{checked}");
}

/// The driven angle is what it is, within half a turn of zero, and the drive's derivatives are 1
/// and 0.
#[test]
fn the_driven_angle_is_exact() {
    let machine = four_bar("1 m", ["3 m", "3 m"], ["4 m", "1 m"], "");
    let certifier = Certifier::new(&machine, 10).unwrap();
    for (degrees, due) in [
        ((1, 8), "0.125"),
        ((361, 1), "1"),
        ((190, 1), "-170"),
        ((-1439, 2), "0.5"),
        ((-170, 1), "-170"),
    ] {
        let degrees = Rational::from(degrees);
        let state = &machine
            .solver
            .assembly_modes(degrees.to_f64().to_radians())
            .states[0];
        let found = certifier.values(&degrees, state, false);
        let driven: Vec<&str> = found[..3].iter().map(|d| d.as_deref().unwrap()).collect();
        let value: f64 = driven[0].parse().unwrap();
        assert_eq!(value, due.parse::<f64>().unwrap());
        assert_eq!(
            driven[1..]
                .iter()
                .map(|d| d.parse().unwrap())
                .collect::<Vec<f64>>(),
            [1.0, 0.0]
        );
    }
}

/// A frame that is lower by δ on the rocker's side: with the crank upright a parallelogram's
/// coupler is turned by δ/2 within δ². The eightfold of the first bits tells 1e-190 from zero, and
/// not 1e-250.
#[test]
fn digits_are_looked_for_at_eight_times_the_first_bits() {
    for (exponent, proved) in [(1, true), (80, true), (190, true), (250, false)] {
        let delta = format!("1e-{exponent} m");
        let machine = four_bar("1 m", ["2 m", "1 m"], ["2 m", &delta], "");
        let modes = machine.solver.assembly_modes(TAU / 4.0).states;
        let upright = |s: &&State| machine.line(s, 3) > 0.0 && machine.line(s, 2).abs() < 0.1;
        let state = modes.iter().find(upright).unwrap();
        let certifier = Certifier::new(&machine, 10).unwrap();
        let found = certifier.values(&90.into(), state, false);
        // Crank and rocker, and the coupler's derivatives, whatever its angle.
        assert!(found[0].is_some() && found[6].is_some());
        assert_eq!(found[3].is_some(), proved, "{exponent}");
        if exponent > 8 && proved {
            let text = found[3].as_deref().unwrap();
            let x: f64 = text.parse().unwrap();
            let due = 0.5 * 10f64.powi(-exponent).to_degrees();
            assert!((x / due - 1.0).abs() < 1e-9, "{text} {due}");
        }
    }
}

#[test]
fn modes_are_counted_where_the_loop_closes() {
    let rocker = ["3 m", "3 m", "3.5 m"];
    let swings = four_bar("3 m", [rocker[0], rocker[1]], [rocker[2], "0 m"], "");
    let turned = four_bar("1 m", ["3 m", "3 m"], ["4 m", "1 m"], "from = \"rocker\"\n");
    let watt = read(WATT);
    for (machine, degrees) in [
        (&swings, 20),
        (&swings, 180),
        (&turned, 35),
        (&watt, 50),
        (&watt, 90),
    ] {
        let at = machine.inner(f64::from(degrees).to_radians());
        let due = machine.solver.assembly_modes(at).states.len();
        let certifier = Certifier::new(machine, 10).unwrap();
        let found = certifier.modes(&degrees.into()).unwrap();
        assert_eq!(found.len(), due, "{degrees}");
    }
}
