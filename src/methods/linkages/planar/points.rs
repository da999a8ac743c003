//! Check points: named linkages at the position of their drawing.

use super::drawn::Linkage;
use super::input::PlanarForcesInput;
use crate::audit::CheckPoint;
use crate::methods::common::point;

type Pins = &'static [([usize; 2], [f64; 2])];

/// A 3-4-5 triangle on the frame.
const TRIANGLE: Pins = &[
    ([0, 1], [0.0, 0.0]),
    ([1, 2], [1.0, 0.0]),
    ([2, 3], [2.8, 2.4]),
    ([0, 3], [6.0, 0.0]),
];

/// `examples/watt-1.toml`.
const WATT: Pins = &[
    ([0, 1], [0.0, 0.0]),
    ([1, 2], [1.0, 2.0]),
    ([2, 3], [5.0, 3.5]),
    ([0, 3], [6.0, 0.0]),
    ([2, 4], [2.5, 5.0]),
    ([3, 5], [7.5, 4.5]),
    ([4, 5], [5.5, 7.0]),
];

/// `examples/stephenson-3.toml`.
const STEPHENSON: Pins = &[
    ([0, 1], [0.0, 0.0]),
    ([1, 2], [1.0, 1.5]),
    ([2, 3], [5.0, 5.0]),
    ([3, 4], [6.5, 3.5]),
    ([3, 5], [7.5, 5.5]),
    ([0, 4], [6.0, 0.0]),
    ([0, 5], [10.0, 1.0]),
];

/// `examples/double-butterfly.toml`.
const DOUBLE_BUTTERFLY: Pins = &[
    ([0, 1], [0.0, 0.0]),
    ([0, 4], [6.17, 0.0]),
    ([1, 2], [-0.21, 1.94]),
    ([1, 5], [1.4, 0.48]),
    ([2, 3], [2.69, 3.37]),
    ([3, 4], [5.84, 3.17]),
    ([3, 6], [5.37, 1.82]),
    ([5, 6], [3.63, 1.03]),
    ([5, 7], [4.67, -1.09]),
    ([4, 7], [4.13, 2.05]),
];

const ALL: [(&str, Pins); 4] = [
    ("triangle-3-4-5", TRIANGLE),
    ("watt-1", WATT),
    ("stephenson-3", STEPHENSON),
    ("double-butterfly", DOUBLE_BUTTERFLY),
];

/// The frame of body k has the drawing's origin and is turned by k/4 rad there, so that no angle is
/// zero; the centre of mass is the mean of a body's pins.
fn drawn(pins: Pins) -> Linkage {
    let bodies = pins.iter().flat_map(|p| p.0).max().unwrap_or(0);
    let angle = |body: usize| body as f64 / 4.0;
    let seen = |body: usize, [x, y]: [f64; 2]| {
        let (s, c) = angle(body).sin_cos();
        [c * x + s * y, c * y - s * x]
    };
    let mut all = Linkage {
        phi: angle(1),
        near: (1..=bodies).map(angle).collect(),
        ..Linkage::default()
    };
    for &([a, b], at) in pins {
        let ([xa, ya], [xb, yb]) = (seen(a, at), seen(b, at));
        all.a.push(a as f64);
        all.b.push(b as f64);
        all.xa.push(xa);
        all.ya.push(ya);
        all.xb.push(xb);
        all.yb.push(yb);
    }
    for body in 1..=bodies {
        let on = || pins.iter().filter(|p| p.0.contains(&body));
        let mean = |i: usize| on().map(|p| p.1[i]).sum::<f64>() / on().count() as f64;
        let [xs, ys] = seen(body, [mean(0), mean(1)]);
        all.xs.push(xs);
        all.ys.push(ys);
    }
    all
}

pub(super) fn of_linkages() -> Vec<CheckPoint> {
    let named = |(name, pins)| point(name, drawn(pins).input().to_vec());
    ALL.map(named).into()
}

pub(super) fn of_forces() -> Vec<CheckPoint> {
    let named = |(name, pins)| {
        let linkage = drawn(pins);
        let bodies = linkage.near.len();
        let (m, j) = (vec![2.0; bodies], vec![0.5; bodies]);
        let all = PlanarForcesInput {
            speed: 1.0,
            acceleration: -3.0,
            gx: 0.0,
            gy: -9.81,
            linkage: linkage.input(),
            m: &m,
            j: &j,
        };
        point(name, all.to_vec())
    };
    ALL.map(named).into()
}
