//! Switching times: where a motion leaves a smooth piece of its rates, and the way across.
//!
//! A piece is proved to hold as long as all its guards have their signs: over a part of a step in
//! balls, or at both ends of a part over which the guard's rate has a sign. Where one fails, the
//! switching time is bracketed by times `a < b`: at a the guard has its sign for all solutions that
//! are enclosed, at b it has the other one.
//!
//! Between a and b nothing is said about the order of events: a solution of `y′ = f_1` or `y′ =
//! f_2` satisfies `y(t) ∈ y(a) + [0, b − a] F` for the hull F of both rates over a box that holds
//! this set in its interior. So it is for several switches at once, with the rates on all their
//! sides: their order does not matter. So does any mean of them, as of a motion that slides along
//! the switch ([`super::sliding`]). Where the rates of both sides move a value h of size `|h| ≤ u` at
//! a towards zero by at least m, the motion is on the switch at `b ≥ a + u/m`. Where a rate has a value
//! of its own at the switch, as in `if(y == 1, 0, 1)`, it is one of those in F: the motion may stay
//! there.

use super::field::{Guarded, Smooth};
use crate::evaluation::taylor::Switch;
use mechaudit_reference::{Ball, Mag};
use rug::Rational;

/// The way across a switch.
pub(super) struct Crossing {
    /// The last time at which the motion is certainly before the switch.
    pub before: Rational,
    /// The states then.
    pub starts: Vec<Ball>,
    /// The first time at which it is certainly past it.
    pub after: Rational,
    /// The states at all times between.
    pub hull: Vec<Ball>,
    /// The states at the last.
    pub states: Vec<Ball>,
    /// True if the motion is on the switch then, and stays there.
    pub slides: bool,
    /// True if the rates on the way are those before and after it.
    pub has_two_sides: bool,
}

impl Crossing {
    /// The way from a time and states on, by boxes of the states on it and at its end.
    pub fn new(
        (time, states): (&Rational, &[Ball]),
        after: Rational,
        (hull, end): (Vec<Ball>, Vec<Ball>),
        slides: bool,
    ) -> Crossing {
        Crossing {
            before: time.clone(),
            starts: states.to_vec(),
            after,
            hull,
            states: end,
            slides,
            has_two_sides: true,
        }
    }
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

/// Reason why a motion is not proved to cross.
pub(super) enum Uncrossed {
    /// It meets another switch on the way.
    Meets(Guarded),
    /// Anything else.
    Open(&'static str),
}

/// Crosses some switches at once, from a time on; `width` is the first length that is tried.
/// `pieces` are those of all sides of the switches and those at them, the last one past them.
///
/// # Errors
/// Why the motion is not proved to cross.
pub(super) fn cross(
    (time, states): (&Rational, &[Ball]),
    pieces: &[&Smooth],
    switches: &[Switch],
    (mut width, is_backward): (Rational, bool),
    bits: u32,
) -> Result<Crossing, Uncrossed> {
    let last = pieces.last().ok_or(Uncrossed::Open(TOUCHES))?;
    let has_two_sides = pieces.len() == 2;
    for _ in 0..4 * bits {
        let after = match is_backward {
            true => Rational::from(time - &width),
            false => Rational::from(time + &width),
        };
        width *= 2;
        let span = times(bits, time, &after);
        let way = Ball::rational(bits, &Rational::from(&after - time));
        let Some((hull, end)) = enclosed(states, pieces, &span, &way) else {
            let reason = "the motion is not enclosed while it crosses a switch";
            return Err(Uncrossed::Open(reason));
        };
        // On which sides of a switch the rates lead to it, and how fast.
        let mut pulls = Vec::new();
        for piece in pieces {
            let Ok(guards) = piece.guards(&span, &hull) else {
                return Err(Uncrossed::Open(TOUCHES));
            };
            let own = guards
                .iter()
                .filter(|guard| switches.contains(&guard.switch));
            pulls.extend(own.map(|guard| (guard.positive, guard.pull())));
            let mut open = guards.into_iter().filter(|guard| !guard.holds());
            if let Some(other) = open.find(|guard| !switches.contains(&guard.switch)) {
                return Err(Uncrossed::Meets(other));
            }
        }
        if let ([Switch::Sign(..) | Switch::SignOf(_)], [(a, Some(one)), (b, Some(other))]) =
            (switches, &pulls[..])
            && !is_backward
            && a != b
        {
            let off = last.guards(&Ball::rational(bits, time), states);
            let off = off.ok().and_then(|guards| {
                let mut own = guards.iter().filter(|guard| guard.switch == switches[0]);
                own.next().map(|guard| guard.value.magnitude())
            });
            // The product of magnitudes is rounded up.
            let reached = one.min(*other).mul(way.mignitude()).shift(-1);
            match off {
                Some(off) if off < reached => {
                    let crossing = Crossing::new((time, states), after, (hull, end), true);
                    return Ok(Crossing {
                        has_two_sides,
                        ..crossing
                    });
                }
                _ => continue,
            }
        }
        let at_end = Ball::rational(bits, &after);
        let past = last.guards(&at_end, &end);
        if past.is_ok_and(|guards| guards.iter().all(Guarded::holds)) {
            let crossing = Crossing::new((time, states), after, (hull, end), false);
            return Ok(Crossing {
                has_two_sides,
                ..crossing
            });
        }
    }
    Err(Uncrossed::Open(TOUCHES))
}

/// The derivatives `S = ∂y/∂p` past some switches, of those before them; a column that is not known
/// is the whole line. `gradients` are those of the values g that change their signs.
///
/// With the switching time τ a column s jumps by `(f_1 − f_2) ∂τ/∂p`, and `∂τ/∂p = −(∇g·s)/ġ`, ġ
/// along the motion before the switch (Aizerman, Gantmakher, *Quart. J. Mech. Appl. Math.* 11
/// (1958) 101–117), if the motion before the switch and the one past it both cross it. Where `∇g·s
/// = 0` for all switches, to first order their times do not move, and neither their order nor a
/// start at them matters. Rates along a switch do not cross it, and have no ġ.
///
/// Before the jump and after it `S′ = J S`, so that S is multiplied by a matrix whose row i differs
/// from that of the identity by at most `2 ν_i` for `ν_i ≥ ∫ Σ_k |J_ik| dt`, `ν_i ≤ 1/2`.
pub(super) fn jumped(
    before: Vec<Ball>,
    crossing: &Crossing,
    pieces: &[&Smooth],
    (switches, gradients): (&[Switch], &[Vec<Ball>]),
    is_start: bool,
) -> Vec<Ball> {
    let n = crossing.states.len();
    let bits = crossing.hull[0].prec();
    let span = times(bits, &crossing.before, &crossing.after);
    let way = Ball::rational(bits, &Rational::from(&crossing.after - &crossing.before));
    let hull = &crossing.hull;
    let unknown = || vec![whole(); n * n];
    let [first, .., last] = pieces else {
        return unknown();
    };
    let mut pace = whole();
    // A motion that starts on a switch and stays there has no switching time.
    let paced = if is_start && crossing.slides {
        &[]
    } else {
        switches
    };
    for switch in paced {
        let of = |piece: &&Smooth| match piece.guards(&span, hull) {
            Ok(guards) => {
                let guard = guards.into_iter().find(|guard| guard.switch == *switch);
                guard.map(|guard| guard.rate)
            }
            Err(_) => Some(None),
        };
        let paces = pieces.iter().filter_map(of).collect::<Option<Vec<Ball>>>();
        let Some(paces) = paces.filter(|paces| !paces.is_empty()) else {
            return unknown();
        };
        let all = paces
            .iter()
            .fold(paces[0].clone(), |all, pace| all.union(pace));
        if all.contains_zero() {
            return unknown();
        }
        pace = paces[0].clone();
    }
    let mut off = vec![Mag::ZERO; n];
    for piece in pieces {
        let Ok(rows) = piece.steepness(&span, hull) else {
            return unknown();
        };
        for (off, row) in off.iter_mut().zip(rows) {
            *off = off.max(row.mul(way.magnitude()));
        }
    }
    let [from, to] = [first, last].map(|piece| piece.rates(&span, hull));
    let (true, Ok(from), Ok(to)) = (off.iter().all(|x| *x <= Mag::power_of_two(-1)), from, to)
    else {
        return unknown();
    };
    let turned = |s: Vec<Ball>| -> Vec<Ball> {
        let column = |j: usize| (j..n * n).step_by(n).map(|k| s[k].magnitude());
        let largest: Vec<Mag> = (0..n)
            .map(|j| column(j).fold(Mag::ZERO, Mag::max))
            .collect();
        let entries = s.iter().enumerate();
        let widened = entries.map(|(k, x)| x.widened(off[k / n].shift(1).mul(largest[k % n])));
        widened.collect()
    };
    let (start, mut s) = (before.clone(), turned(before));
    for j in 0..n {
        let at = if is_start { &start } else { &s };
        let moves = gradients.iter().map(|gradient| {
            let terms = gradient.iter().enumerate().map(|(k, g)| g * &at[k * n + j]);
            terms.fold(Ball::integer(bits, 0), |sum, x| sum + x)
        });
        let moves: Vec<Ball> = moves.collect();
        if moves.iter().all(Ball::is_zero) {
            continue;
        }
        let delay = match moves.as_slice() {
            [one] if !is_start => one / &pace,
            _ => whole(),
        };
        for i in 0..n {
            s[i * n + j] = &s[i * n + j] + (&to[i] - &from[i]) * &delay;
        }
    }
    turned(s)
}

/// The whole line.
pub(super) fn whole() -> Ball {
    Ball::exact(64, f64::INFINITY)
}

/// Boxes of the states while they cross, and at the end.
pub(super) fn enclosed(
    states: &[Ball],
    pieces: &[&Smooth],
    span: &Ball,
    way: &Ball,
) -> Option<(Vec<Ball>, Vec<Ball>)> {
    let hull_of_rates = |over: &[Ball]| -> Option<Vec<Ball>> {
        let mut hull: Option<Vec<Ball>> = None;
        for piece in pieces {
            let rates = piece.rates(span, over).ok()?;
            hull = Some(match hull {
                None => rates,
                Some(hull) => hull.iter().zip(&rates).map(|(a, b)| a.union(b)).collect(),
            });
        }
        hull
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
