//! Steps to zeros of components, points beside them, W to twelve digits.

use super::*;

fn component(x: f64, y: f64, part: Part) -> f64 {
    let w = w_f64(x, y, 30).unwrap();
    match part {
        Part::Re => w.re.to_f64(),
        Part::Im => w.im.to_f64(),
    }
}

/// Of 100 lines parallel to the real axis at least 90 meet a curve, and a component changes its
/// sign within two places of where they do.
#[test]
fn zeros_on_lines_are_those_of_f64() {
    for part in [Part::Re, Part::Im] {
        let mut found = 0;
        for i in 0..100 {
            let mut d = Draw::new(2, "m", "r", i);
            let b = d.log_uniform(0.5, 1e4);
            let z = C::new(b * (1.0 - d.unit() * (20.0 / (b * b)).min(0.9)), -b);
            let turn = PI / (4.0 * b);
            let line = Line {
                part,
                along: Along::Re,
                z,
                most: turn,
            };
            let rough = |z| Some(with_slope(z, w_roughly(z)));
            let Some(x) = line.beside(Beside::Places(3), rough, w_and_slope) else {
                continue;
            };
            let ends = [x.next_down().next_down(), x.next_up().next_up()];
            let [p, q] = ends.map(|x| component(x, -b, part));
            assert!(p * q <= 0.0, "{x:e} {b:e}: {p:e} {q:e}");
            found += 1;
        }
        assert!(found >= 90, "{found}");
    }
}

#[test]
fn the_flat_curve_far_out() {
    let mut next = 0;
    for i in 0..100 {
        // Squares of steps do not underflow there.
        let x = Draw::new(4, "m", "r", i).uniform(6.5, 15.0);
        let y = flat_zero_far_out(x);
        let off = (y - flat_zero(x)).abs() / (y.next_up() - y);
        assert!(off <= 6.0, "{x}: {y:e} {off}");
        next += i32::from(off <= 3.0);
    }
    assert!(next >= 90, "{next}");
}

#[test]
fn the_points_lie_beside_the_curves() {
    let mut found = 0;
    for i in 0..100 {
        let mut d = Draw::new(1, "m", "r", i);
        for part in [Part::Re, Part::Im] {
            let z = beside_curve(&mut d, part);
            let [re, im] = [Part::Re, Part::Im].map(|p| component(z[0], z[1], p));
            let (small, size) = match part {
                Part::Re => (re, im),
                Part::Im => (im, re),
            };
            found += usize::from(small.abs() < 0.3 * size.abs());
        }
        let z = beside_flat_curve(&mut d);
        let re = component(z[0], z[1], Part::Re);
        assert!(re.abs() < 0.2 * (-z[0] * z[0]).exp(), "{z:?} {re}");
    }
    assert!(found > 150, "{found}");
}

#[test]
fn twelve_digits() {
    for i in 0..1000 {
        let mut d = Draw::new(3, "m", "r", i);
        let (x, y) = (d.uniform(-12.0, 12.0), d.uniform(-9.0, 12.0));
        let w = w_f64(x, y, 60).unwrap();
        let w = C::new(w.re.to_f64(), w.im.to_f64());
        let rough = w_roughly(C::new(x, y));
        // Next to a node two large terms cancel; |z|^2 places of the exponential's argument are
        // lost.
        assert!((rough - w).norm() < 1e-11 * w.norm(), "{x} {y}");
    }
}

const ALONG_RE: Line = Line {
    part: Part::Re,
    along: Along::Re,
    z: C::new(1.0, 0.0),
    most: 1.0,
};

/// e^{iz} has the argument Re z and goes on as itself: its real part is zero at π/2, its imaginary
/// part at 0.
#[test]
fn an_exponential_is_solved_by_one_step() {
    let wave = |z: C| {
        let value = exponential(C::i() * z);
        Some([value, C::i() * value])
    };
    let step = ALONG_RE.step(1.0, wave).unwrap();
    assert!((step - (PI / 2.0 - 1.0)).abs() < 1e-15);
    let im = Line {
        part: Part::Im,
        ..ALONG_RE
    };
    assert!((im.step(1.0, wave).unwrap() + 1.0).abs() < 1e-15);
    // e^z along the imaginary axis.
    let upright = Line {
        along: Along::Im,
        z: C::new(3.0, 1.0),
        ..ALONG_RE
    };
    assert_eq!((ALONG_RE.begin(), upright.begin()), (1.0, 1.0));
    let grows = |z: C| Some([exponential(z); 2]);
    let step = upright.step(1.0, grows).unwrap();
    assert!((step - (PI / 2.0 - 1.0)).abs() < 1e-15);
    assert_eq!(ALONG_RE.step(1.0, |_| Some([C::default(); 2])), None);
    assert_eq!(ALONG_RE.step(1.0, |_| None), None);
}

/// Where the argument turns by 1/4 on the way of 1, a quarter turn is too far for one step.
#[test]
fn eight_steps_of_bounded_length_are_taken() {
    for (turn, direction) in [(0.25, 1.0), (-0.25, -1.0)] {
        let f = |_: C| Some([C::new(1.0, 0.0), C::new(0.0, turn)]);
        let asked = std::cell::Cell::new(0);
        let found = ALONG_RE.steps(0.0, f, |step, _| {
            asked.set(asked.get() + 1);
            // Not cut short.
            assert!((step - 2.0 * PI).abs() < 1e-12);
            false
        });
        assert_eq!((found, asked.get()), (None, 8));
        let eighth = ALONG_RE.steps(0.0, f, |_, t| t == 8.0 * direction);
        assert_eq!(eighth, Some(8.0 * direction));
    }
}

/// A point that is moved by more than what the rough function may be off is not looked for again.
#[test]
fn the_certified_function_is_asked_where_it_matters() {
    let wave = |z: C| {
        let value = exponential(C::i() * z);
        Some([value, C::i() * value])
    };
    let zero = PI / 2.0;
    let far = ALONG_RE.beside(Beside::Shift(0.5), wave, |_| panic!("asked"));
    assert!((far.unwrap() - 1.5 * zero).abs() < 1e-14);
    for close in [Beside::Places(3), Beside::Shift(1e-10)] {
        assert_eq!(ALONG_RE.beside(close, wave, |_| None), None);
        let found = ALONG_RE.beside(close, wave, wave).unwrap();
        assert!((found - zero).abs() < 1e-9);
    }
    assert!(ALONG_RE.beside(Beside::Places(3), |_| None, wave).is_none());
}

#[test]
fn numbers_are_moved_by_places_or_by_a_part_of_themselves() {
    let x = 2.0f64;
    assert_eq!(Beside::Places(3).of(x), x);
    assert_eq!(
        Beside::Places(0).of(x),
        x.next_down().next_down().next_down()
    );
    assert_eq!(Beside::Places(6).of(x), x.next_up().next_up().next_up());
    assert_eq!(
        (Beside::Shift(0.5).of(x), Beside::Shift(-0.25).of(-x)),
        (3.0, -1.5)
    );
    assert!(Beside::Places(6).is_close());
    for (shift, close) in [(0.9e-9, true), (1e-9, false), (0.1, false)] {
        assert_eq!(Beside::Shift(shift).is_close(), close, "{shift}");
        assert_eq!(Beside::Shift(-shift).is_close(), close, "-{shift}");
    }
}

#[test]
fn a_quarter_of_a_step_off_an_axis() {
    let line = Line {
        part: Part::Re,
        along: Along::Re,
        z: C::new(0.0, -1.0),
        most: 1.0,
    };
    for t in [0.2, 0.25] {
        assert_eq!([t, -t].map(|t| line.off_axis(t)), [None, None]);
    }
    assert_eq!(
        [0.3, -0.3].map(|t| line.off_axis(t)),
        [Some(0.3), Some(-0.3)]
    );
}

/// Where e^{-z²} leads W changes by 2|z| places from one number to the next.
#[test]
fn arguments_are_taken_to_the_last_bit() {
    let (x, y) = (17.0f64.next_up(), 18.0f64.next_up());
    for z in [C::new(x, -18.0), C::new(17.0, -y)] {
        let [w, _] = w_and_slope(z).unwrap();
        let due = w_f64(z.re, z.im, 60).unwrap();
        let due = C::new(due.re.to_f64(), due.im.to_f64());
        assert!((w - due).norm() < 1e-15 * due.norm(), "{z}: {w} {due}");
    }
}

#[test]
fn the_first_zero() {
    // DLMF table 7.13.1: erfc has its first zero at -1.3548101281 + 1.9914668428 i.
    let z = zero(1);
    assert!((z[0] - 1.991_466_842_8).abs() < 1e-9 && (z[1] + 1.354_810_128_1).abs() < 1e-9);
}
