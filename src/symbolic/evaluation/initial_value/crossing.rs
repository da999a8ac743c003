//! Switching times: where a motion leaves a smooth piece of its rates, and the way across.
//!
//! A piece is proved to hold as long as all its guards have their signs: over a part of a step in
//! balls, or at both ends of a part over which the guard's rate has a sign. Where one fails, the
//! switching time is bracketed by times `a < b`: at a the guard has its sign for all solutions that
//! are enclosed, at b it has the other one.
//!
//! Between a and b nothing is said about the order of events: a solution of `y′ = f_1` or `y′ =
//! f_2` satisfies `y(t) ∈ y(a) + [0, b − a] F` for the hull F of both rates over a box that holds
//! this set in its interior. So does any mean of both, as of a motion that slides along the switch
//! (Filippov, *Differential Equations with Discontinuous Righthand Sides*, 1988, §4); for such a
//! motion the guard is not proved to have the other sign at b.

use super::field::{Guarded, Smooth};
use crate::evaluation::taylor::Switch;
use mechaudit_reference::{Ball, Mag};
use rug::Rational;

/// The way across a switch.
pub(super) struct Crossing {
    /// The last time at which the motion is certainly before the switch.
    pub before: Rational,
    /// The first time at which it is certainly past it.
    pub after: Rational,
    /// The states at all times between.
    pub hull: Vec<Ball>,
    /// The states at the last.
    pub states: Vec<Ball>,
}

pub(super) const TOUCHES: &str = "the motion may touch a switch without crossing it, or stay at it";

/// `[from, to]`, in any order.
pub(super) fn times(bits: u32, from: &Rational, to: &Rational) -> Ball {
    let middle = Rational::from(from + to) / 2u32;
    let half = Rational::from(from - to).abs() / 2u32;
    Ball::rational(bits, &middle).widened(Ball::rational(64, &half).magnitude())
}

/// All of `y + [0, w] f`, and of `y + w f`.
fn moved(y: &Ball, way: &Ball, f: &Ball) -> [Ball; 2] {
    let whole = way * f;
    let half = whole.shift(-1);
    let some = half.widened(half.magnitude());
    [y + some, y + whole]
}

/// Crosses a switch between two pieces from a time on; `width` is the first length that is tried.
///
/// # Errors
/// Why the motion is not proved to cross.
pub(super) fn cross(
    (time, states): (&Rational, &[Ball]),
    pieces: [&Smooth; 2],
    switch: Switch,
    (mut width, is_backward): (Rational, bool),
    bits: u32,
) -> Result<Crossing, &'static str> {
    for _ in 0..4 * bits {
        let after = match is_backward {
            true => Rational::from(time - &width),
            false => Rational::from(time + &width),
        };
        width *= 2;
        let span = times(bits, time, &after);
        let way = Ball::rational(bits, &Rational::from(&after - time));
        let Some((hull, end)) = enclosed(states, pieces, &span, &way) else {
            return Err("the motion is not enclosed while it crosses a switch");
        };
        for piece in pieces {
            let Ok(guards) = piece.guards(&span, &hull) else {
                return Err(TOUCHES);
            };
            let mut open = guards.iter().filter(|guard| !guard.holds());
            let (first, second) = (open.next(), open.next());
            if second.is_some() || first.is_some_and(|guard| guard.switch != switch) {
                return Err("the motion meets two switches at once");
            }
        }
        let at_end = Ball::rational(bits, &after);
        let past = pieces[1].guards(&at_end, &end);
        if past.is_ok_and(|guards| guards.iter().all(Guarded::holds)) {
            return Ok(Crossing {
                before: time.clone(),
                after,
                hull,
                states: end,
            });
        }
    }
    Err(TOUCHES)
}

/// Values for all times and states of some balls.
type Slopes<'a> = &'a mut dyn FnMut(&Ball, &[Ball]) -> Option<Vec<Ball>>;

/// The same way across where states after the first `n` are derivatives of those by parameters:
/// with the switching time τ they jump by `(f_1 − f_2) ∂τ/∂p`, and `∂τ/∂p = −(∂g/∂p)/ġ` for the
/// value g of the switch, derived along the motion before it (Aizerman, Gantmakher, *Quart. J.
/// Mech. Appl. Math.* 11 (1958) 101–117).
///
/// `slopes` gives `∂g/∂p` for all times and states of some balls.
///
/// # Errors
/// Why the jump is not enclosed.
pub(super) fn jumped(
    crossing: Crossing,
    pieces: [&Smooth; 2],
    switch: Switch,
    (n, slopes): (usize, Slopes<'_>),
    bits: u32,
) -> Result<Crossing, &'static str> {
    const OPEN: &str = "the derivatives are not enclosed across a switch";
    let Crossing {
        before,
        after,
        hull,
        states,
    } = crossing;
    let span = times(bits, &before, &after);
    let guards = pieces[0].guards(&span, &hull).map_err(|_| OPEN)?;
    let pace = guards.into_iter().find(|guard| guard.switch == switch);
    let pace = pace.and_then(|guard| guard.rate).ok_or(OPEN)?;
    if pace.contains_zero() {
        return Err(TOUCHES);
    }
    let slopes = slopes(&span, &hull).ok_or(OPEN)?;
    let [first, second] = pieces.map(|piece| piece.rates(&span, &hull).map_err(|_| OPEN));
    let (first, second) = (first?, second?);
    let mut jumped = hull.clone();
    for (k, derivative) in jumped[n..].iter_mut().enumerate() {
        let (state, parameter) = (k / slopes.len(), k % slopes.len());
        let delay = &slopes[parameter] / &pace;
        *derivative = &*derivative + &((&second[state] - &first[state]) * &delay);
    }
    // The motion from any time between, for the time that is left at most.
    let way = Ball::rational(bits, &Rational::from(&after - &before));
    let (rest, _) = enclosed(&jumped, pieces, &span, &way).ok_or(OPEN)?;
    let union = |(a, b): (&Ball, &Ball)| a.union(b);
    Ok(Crossing {
        before,
        after,
        hull: hull.iter().zip(&rest).map(union).collect(),
        states: states[..n].iter().chain(&rest[n..]).cloned().collect(),
    })
}

/// Boxes of the states while they cross, and at the end.
fn enclosed(
    states: &[Ball],
    pieces: [&Smooth; 2],
    span: &Ball,
    way: &Ball,
) -> Option<(Vec<Ball>, Vec<Ball>)> {
    let hull_of_rates = |over: &[Ball]| -> Option<Vec<Ball>> {
        let [a, b] = pieces.map(|piece| piece.rates(span, over).ok());
        let both = a?.into_iter().zip(b?);
        Some(both.map(|(a, b)| a.union(&b)).collect())
    };
    let mut around: Vec<Ball> = states.to_vec();
    for _ in 0..16 {
        let rates = hull_of_rates(&around)?;
        let boxes: Vec<[Ball; 2]> = states
            .iter()
            .zip(&rates)
            .map(|(y, f)| moved(y, way, f))
            .collect();
        if boxes
            .iter()
            .zip(&around)
            .all(|([some, _], around)| is_inside(some, around))
        {
            return Some(boxes.into_iter().map(|[some, end]| (some, end)).unzip());
        }
        around = boxes
            .into_iter()
            .map(|[some, _]| {
                // Ends are rounded outward to the precision, those of the inner ball too.
                let rounding = some.magnitude().shift(4 - i64::from(some.prec()));
                let spare = some.rad().max(rounding);
                some.widened(spare.max(Mag::power_of_two(-4096)))
            })
            .collect();
    }
    None
}

/// Returns true if a ball lies in the interior of another.
fn is_inside(inner: &Ball, outer: &Ball) -> bool {
    inner.is_finite()
        && outer.is_finite()
        && inner.lower() > outer.lower()
        && inner.upper() < outer.upper()
}
