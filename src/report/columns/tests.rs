//! Tests of `columns`.

use super::*;

fn of(names: &[&str], units: &str, certified: bool) -> Result<Columns, String> {
    let names = names.iter().map(|n| n.to_string()).collect();
    let units: Vec<String> = units.split(',').map(String::from).collect();
    Columns::of(names, &units, certified).map_err(|e| e.to_string())
}

#[test]
fn names_and_values_change_together() {
    for (name, units, new, x, due) in [
        ("slider_m", "mm", "slider_mm", 0.25, 250.0),
        ("slider_m", "inch", "slider_inch", 0.0254, 1.0),
        ("slider_m", "μm", "slider_um", 0.25, 250_000.0),
        ("phi1_deg", "rad", "phi1_rad", 180.0, std::f64::consts::PI),
        ("phi1_deg", "rev", "phi1_rev", 90.0, 0.25),
        (
            "omega_rad_per_s",
            "°",
            "omega_deg_per_s",
            std::f64::consts::PI,
            180.0,
        ),
        (
            "omega_rad_per_s",
            "rpm",
            "omega_rpm",
            std::f64::consts::TAU,
            60.0,
        ),
        (
            "omega_rad_per_s",
            "min^-1",
            "omega_1_per_min",
            std::f64::consts::TAU,
            60.0,
        ),
        (
            "omega_rad_per_s",
            "Hz,ms",
            "omega_Hz",
            std::f64::consts::TAU,
            1.0,
        ),
        ("I_kg_m2", "g,cm", "I_g_cm2", 2.0, 2e7),
        (
            "dM_o_dphi_N_m_per_rad",
            "kN,mm",
            "dM_o_dphi_kN_mm_per_rad",
            3.0,
            3.0,
        ),
        ("a_m_per_s2", "mm,ms", "a_mm_per_ms2", 1000.0, 1.0),
        ("det_J_m4", "cm", "det_J_cm4", 1e-8, 1.0),
        (
            "d2phi2_dphi1_2_per_rad",
            "deg",
            "d2phi2_dphi1_2_per_deg",
            180.0,
            std::f64::consts::PI,
        ),
    ] {
        let others = ["t_s", "phi_deg", "w_rad_per_s"];
        let columns = of(&[&[name], &others[..]].concat(), units, false).unwrap();
        assert_eq!(columns.names[0], new, "{units}");
        let Cell::Float(y) = *columns.cell(0, &Cell::Float(x)) else {
            panic!("{name}");
        };
        assert!((y - due).abs() <= 1e-15 * due, "{name}: {y}");
    }
    let columns = of(&["work_J", "condition", "t_s"], "ms", false).unwrap();
    assert_eq!(columns.names, ["work_J", "condition", "t_ms"]);
}

#[test]
fn certified_digits_stay() {
    let columns = of(&["x_m", "phi_deg"], "mm,deg", true).unwrap();
    let cell = |d: &str| columns.cell(0, &Cell::Decimal(d.into())).text();
    for (d, due) in [
        ("0.10037863300", "100.37863300"),
        ("-0.00012", "-0.12"),
        ("12", "12000"),
        ("1.50e-7", "1.50e-4"),
        ("0", "0"),
    ] {
        assert_eq!(cell(d), due);
    }
    assert_eq!(shifted("12.5", -3), "0.0125");
    let e = of(&["x_m", "phi_deg"], "inch", true).err().unwrap();
    assert!(e.contains("no power of ten"), "{e}");
}

#[test]
fn units_of_no_use_are_refused() {
    for (units, part) in [
        ("kg", "no column can be in kg; the columns are x_m, phi_deg"),
        ("mm,cm", "mm and cm measure the same"),
        ("furlong", "\"furlong\" is not a unit known here"),
        ("m/s", "is a product"),
        ("mm^2", "is a product"),
        ("N·m", "is a product"),
        ("rpm", "no column can be in rpm"),
        ("", "; there are "),
    ] {
        let e = of(&["x_m", "phi_deg"], units, false).err().unwrap();
        assert!(e.contains(part), "{units}: {e}");
    }
}

/// A unit at the end of a name is none of its stem, nor is the whole name a unit.
#[test]
fn a_name_ends_with_its_unit() {
    for (name, stem, unit) in [
        ("x_m", "x", "m"),
        ("phi_1_deg", "phi_1", "°"),
        ("I_kg_m2", "I", "kg·m²"),
        ("a_m_per_s2", "a", "m/s²"),
        ("w_deg_per_s", "w", "°/s"),
        ("dM_o_dphi_N_m_per_rad", "dM_o_dphi", "N·m/rad"),
        ("d2phi2_dphi1_2_per_rad2", "d2phi2_dphi1_2", "1/rad²"),
        ("det_J_m4", "det_J", "m^4"),
        ("work_J", "work", "J"),
        ("power_J_per_s", "power_J", "1/s"),
        ("condition", "condition", ""),
        ("branch_id", "branch_id", ""),
        ("m", "m", ""),
        ("s_m", "s", "m"),
    ] {
        let columns = Columns::from(vec!["first_s".to_string(), name.to_string()]);
        assert_eq!((columns.stem(1), &*columns.unit(1)), (stem, unit), "{name}");
        assert_eq!(columns.value(1, 0.75), 0.75);
        assert_eq!(*columns.cell(1, &Cell::Float(0.75)), Cell::Float(0.75));
    }
}

#[test]
fn people_read_the_unit_that_was_asked_for() {
    let columns = of(&["t_s", "w_rad_per_s", "x_m"], "/min,ms,in", false).unwrap();
    let seen = |k: usize| (columns.names[k].as_str(), columns.stem(k), columns.unit(k));
    assert_eq!(seen(0), ("t_ms", "t", "ms".into()));
    assert_eq!(seen(1), ("w_1_per_min", "w", "1/min".into()));
    assert_eq!(seen(2), ("x_in", "x", "in".into()));
    assert_eq!(columns.value(0, 0.25), 250.0);
    let turn = columns.value(1, std::f64::consts::TAU);
    assert!((turn - 60.0).abs() < 1e-13, "{turn}");
    assert_eq!(columns.value(2, 0.0254), 1.0);
}

#[test]
fn every_spelling_of_a_speed_has_a_name_of_its_own() {
    for (unit, name) in [
        ("rpm", "w_rpm"),
        ("Hz", "w_Hz"),
        ("rad/s", "w_rad_per_s"),
        ("deg/s", "w_deg_per_s"),
        ("/min", "w_1_per_min"),
        ("min^-1", "w_1_per_min"),
        ("min⁻¹", "w_1_per_min"),
    ] {
        let columns = of(&["w_rad_per_s"], unit, false).unwrap();
        assert_eq!(columns.names, [name], "{unit}");
    }
    // A column asked for in its own unit stays as it is.
    let same = of(&["w_rad_per_s", "x_m"], "rad/s,m", false).unwrap();
    assert_eq!(*same.cell(1, &Cell::Float(0.1)), Cell::Float(0.1));
    assert_eq!(same.value(0, 0.1), 0.1);
}

/// A length, a mass and a time may each be asked for at once; two lengths may not, wherever they
/// stand.
#[test]
fn one_unit_is_asked_of_each_quantity() {
    let columns = of(&["a_m_per_s2", "m_kg", "x_m"], "mm, g ,ms", false).unwrap();
    assert_eq!(columns.names, ["a_mm_per_ms2", "m_g", "x_mm"]);
    let e = of(&["x_m", "m_kg"], "mm,g,in", false).err().unwrap();
    assert_eq!(e, "mm and in measure the same: leave one out");
}

#[test]
fn certified_digits_outlive_powers_of_ten_alone() {
    // Nothing changes, a factor of a thousand, one of degrees, and one of a speed.
    assert!(of(&["x_m"], "m", true).is_ok() && of(&["x_m"], "mm", true).is_ok());
    assert!(of(&["t_s"], "ms", true).is_ok());
    for (name, units) in [("phi_rad", "deg"), ("t_s", "min"), ("w_rad_per_s", "Hz")] {
        let e = of(&[name], units, true).err().unwrap();
        assert!(e.starts_with(&format!("from {name} to ")), "{e}");
        assert!(e.contains("is no power of ten"), "{e}");
        let columns = of(&[name], units, false).unwrap();
        let decimal = columns.cell(0, &Cell::Decimal("1.5".into())).into_owned();
        assert_eq!(decimal, Cell::Undecided);
        assert_eq!(*columns.cell(0, &Cell::Count(3)), Cell::Count(3));
    }
}

#[test]
fn a_length_is_any_unit_with_metres_in_it() {
    let any = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(|n| n.to_string()).collect();
        any_length(&names)
    };
    assert!(any(&["t_s", "I_kg_m2"]) && any(&["a_m_per_s2", "t_s"]) && any(&["x_m"]));
    assert!(!any(&["t_s", "phi_deg", "work_J", "m"]) && !any(&[]));
}

#[test]
fn a_decimal_keeps_its_digits_wherever_its_point_goes() {
    for (text, places, due) in [
        ("12.5", 0, "12.5"),
        ("12.5", 1, "125"),
        ("12.5", 3, "12500"),
        ("0.5", 1, "5"),
        ("0.05", 1, "0.5"),
        ("0.050", 2, "5.0"),
        ("5", -1, "0.5"),
        ("12", -1, "1.2"),
        ("12", -2, "0.12"),
        ("12", -4, "0.0012"),
        ("-12.50", 1, "-125.0"),
        ("0", 3, "0"),
        ("0.0", 1, "0"),
        ("1.25e5", 3, "1.25e8"),
        ("-1.25e-3", -2, "-1.25e-5"),
    ] {
        assert_eq!(shifted(text, places), due, "{text} by {places}");
    }
}

#[test]
fn powers_of_ten_are_known_up_to_sixty() {
    let ten = |k: u32| Rational::from(rug::Integer::u_pow_u(10, k));
    let of = |by: Rational, degrees| power_of_ten(&Scale { by, degrees });
    for k in [1, 3, 60] {
        assert_eq!(of(ten(k), 0), Some(k as i32));
        assert_eq!(of(ten(k).recip(), 0), Some(-(k as i32)));
    }
    assert_eq!(of(ten(0), 0), Some(0));
    for (by, degrees) in [
        (ten(61), 0),
        (ten(61).recip(), 0),
        (ten(0), 1),
        (ten(0), -1),
        (Rational::from(2), 0),
        (Rational::from(-10), 0),
    ] {
        assert_eq!(of(by, degrees), None);
    }
}
