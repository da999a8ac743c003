//! Tests of `motor`.

use super::*;

fn motor() -> Kloss {
    let w = AngularVelocity::from_rad_per_s(10.0);
    Kloss::rated(w, Torque::from_n_m(200.0), 2.2, 0.05).unwrap()
}

#[test]
fn kloss_at_its_marked_points() {
    let m = motor();
    assert!((m.critical_slip() - 0.207_979_589_711_327_1).abs() < 1e-14);
    assert!((m.torque(9.5) - 200.0).abs() < 1e-12);
    // No slip: no torque, no 0/0.
    assert_eq!(m.torque(10.0), 0.0);
    let top = 10.0 * (1.0 - m.critical_slip());
    assert!((m.torque(top) - 440.0).abs() < 1e-12);
    assert!(m.slope(top).abs() < 1e-10);
    // Generator: odd about synchronous speed.
    assert!((m.torque(10.7) + m.torque(9.3)).abs() < 1e-12);
    // Plugging: turning backwards the torque still points forward.
    assert!(m.torque(-5.0) > 0.0);
    for w in [-3.0, 0.0, 5.0, 9.0, 10.0, 12.0] {
        let h = 1e-5;
        let d = (m.torque(w + h) - m.torque(w - h)) / (2.0 * h);
        assert!((d - m.slope(w)).abs() < 1e-5 * (1.0 + d.abs()), "{w}: {d}");
    }
}

/// A critical slip of one is that of standstill: no speed of a working motor lies below.
#[test]
fn pull_out_speeds() {
    let speed = |slip: f64| {
        let w = AngularVelocity::from_rad_per_s(8.0);
        let motor = Kloss::critical(w, Torque::from_n_m(5.0), slip).unwrap();
        Motor::Kloss(motor).pull_out_speed()
    };
    assert_eq!(
        (speed(0.25), speed(1.0), speed(2.0)),
        (Some(6.0), None, None)
    );
    assert_eq!(Motor::Off.pull_out_speed(), None);
}

#[test]
fn tables_are_read_as_asked() {
    let points = [(0.0, 10.0), (5.0, 20.0), (9.0, 30.0), (10.0, 0.0)];
    let linear = Motor::Table(TorqueTable::new(&points, TableReading::Linear).unwrap());
    assert_eq!(linear.torque_and_slope(2.5).unwrap(), (15.0, 2.0));
    assert_eq!(linear.torque_and_slope(10.0).unwrap(), (0.0, -30.0));
    assert_eq!(linear.kinks(), [0.0, 5.0, 9.0, 10.0]);
    let cubic = Motor::Table(TorqueTable::new(&points, TableReading::Cubic).unwrap());
    for (x, y) in points {
        assert!((cubic.torque_and_slope(x).unwrap().0 - y).abs() < 1e-12);
    }
    let e = linear.torque_and_slope(10.5).unwrap_err().to_string();
    assert!(
        e.contains("10.5 rad/s") && e.contains("from 0 to 10"),
        "{e}"
    );
    assert!(linear.torque_and_slope(f64::NAN).is_err());
}

#[test]
fn bad_motors_are_refused() {
    let w = AngularVelocity::from_rad_per_s;
    let t = Torque::from_n_m;
    let text = |m: Result<Kloss, MotorError>| m.unwrap_err().to_string();
    assert!(text(Kloss::rated(w(0.0), t(1.0), 2.0, 0.1)).contains("synchronous speed = 0"));
    assert!(text(Kloss::rated(w(1.0), t(-1.0), 2.0, 0.1)).contains("rated torque = -1 N m"));
    assert!(text(Kloss::rated(w(1.0), t(1.0), 0.9, 0.1)).contains("k = 0.9"));
    assert!(text(Kloss::rated(w(1.0), t(1.0), f64::NAN, 0.1)).contains("not a finite"));
    assert!(text(Kloss::rated(w(1.0), t(1.0), 2.0, 1.0)).contains("slip 1"));
    assert!(text(Kloss::rated(w(1.0), t(1.0), 2.0, 0.0)).contains("slip 0"));
    assert!(Motor::constant(t(f64::INFINITY)).is_err());
    assert!(Motor::linear(t(1.0), w(0.0)).is_err());
    for bad in [
        vec![],
        vec![(0.0, 1.0)],
        vec![(1.0, 1.0), (1.0, 2.0)],
        vec![(0.0, f64::NAN), (1.0, 2.0)],
    ] {
        for reading in [TableReading::Linear, TableReading::Cubic] {
            assert!(TorqueTable::new(&bad, reading).is_err(), "{bad:?}");
        }
    }
}
