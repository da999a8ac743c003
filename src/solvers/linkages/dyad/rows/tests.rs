//! Rows beside single positions.

use super::*;
use crate::arithmetic::tests::Random;
use crate::units::{Angle, Length};

/// Bit for bit those of single positions, NaN where there is none: at every place of a vector, in
/// whole vectors and behind them.
#[test]
fn rows_are_single_positions() {
    let mut random = Random(61);
    let mut refused = 0;
    for k in 0..400 {
        let size = 2f64.powi(k % 7 * 100 - 300);
        let mut some = || Length::from_m(size * random.between(0.1, 1.0));
        let lengths = [some(), some(), some(), some()];
        let offset = Length::from_m(size * random.between(-0.3, 0.3));
        let direction = Angle::from_rad(random.between(-4.0, 4.0));
        let n = 1 + random.below(40) as usize;
        let phi: Vec<f64> = (0..n)
            .map(|i| match (k + i as i32) % 37 {
                0 => 2f64.powi(40),
                1 => f64::NAN,
                2 => 0.0,
                _ => random.between(-10.0, 10.0),
            })
            .collect();
        let assembly = [Assembly::Positive, Assembly::Negative][k as usize % 2];
        let mut check = |due: &dyn Fn(Angle) -> Option<[f64; 8]>, got: &[Vec<f64>; 8]| {
            for (i, phi) in phi.iter().enumerate() {
                let due = due(Angle::from_rad(*phi)).unwrap_or([f64::NAN; 8]);
                refused += usize::from(due[0].is_nan());
                for (got, due) in got.iter().zip(due) {
                    let same = got[i].to_bits() == due.to_bits() || got[i].is_nan() && due.is_nan();
                    assert!(same, "{k} {phi}: {} {due}", got[i]);
                }
            }
        };
        let mut columns: [Vec<f64>; 8] = std::array::from_fn(|_| vec![7.0; n]);
        let [a, b, c, d] = lengths;
        if let Ok(bar) = FourBar::new(a, b, c, d) {
            let room = columns.each_mut().map(|column| &mut column[..]);
            bar.rows(&phi, assembly, room).expect("room");
            let due = |phi| {
                let m = bar.position(phi, assembly).ok()?;
                Some([
                    m.coupler.angle.rad(),
                    m.rocker.angle.rad(),
                    m.coupler.first,
                    m.rocker.first,
                    m.coupler.second,
                    m.rocker.second,
                    m.transmission.rad(),
                    m.determinant_m2,
                ])
            };
            check(&due, &columns);
        }
        if let Ok(slide) = SliderCrank::new(a, b, offset, direction) {
            let room = columns.each_mut().map(|column| &mut column[..]);
            slide.rows(&phi, assembly, room).expect("room");
            let due = |phi| {
                let m = slide.position(phi, assembly).ok()?;
                Some([
                    m.slider_m,
                    m.rod.angle.rad(),
                    m.slider_first_m,
                    m.rod.first,
                    m.slider_second_m,
                    m.rod.second,
                    m.transmission.rad(),
                    m.determinant_m,
                ])
            };
            check(&due, &columns);
        }
    }
    assert!(refused > 500, "{refused}");
    let mut short = [0.0; 1];
    let mut long = [[0.0; 2]; 7];
    let [p, q, r, s, t, u, v] = long.each_mut().map(|column| &mut column[..]);
    let l = Length::from_m;
    let bar = FourBar::new(l(1.0), l(4.0), l(3.0), l(3.5)).expect("a four-bar");
    let columns = [p, q, r, &mut short[..], s, t, u, v];
    assert_eq!(
        bar.rows(&[0.0, 1.0], Assembly::Positive, columns),
        Err(DyadError::Room { angles: 2, room: 1 })
    );
}
