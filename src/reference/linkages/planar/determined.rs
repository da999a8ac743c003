//! Coordinates that slides, gears, racks and the drive determine without the loops.
//!
//! These equations are linear with exact coefficients. A coordinate follows from them alone if its
//! unit vector is a combination of their rows, which Gauss and Jordan's elimination in fractions
//! decides.

use super::enclosure::Linkage;
use crate::class_iii::ExactAngle;
use rug::Rational;

/// A coordinate as a linear function of the drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Determined {
    /// Its derivative by the drive.
    pub rate: Rational,
    /// Holds what is added to that many times the drive, as multiples of angles; a displacement's
    /// number of metres counts as radians.
    pub constants: Vec<(Rational, ExactAngle)>,
}

impl Linkage {
    /// The coordinate as a function of the drive, if no loop is needed for it.
    pub fn determined(&self, coordinate: usize) -> Option<Determined> {
        let relations = &self.mechanism.loops.relations;
        let n = self.mechanism.coordinates();
        let count = relations.len() + 1;
        // Each row is followed by the combination of equations that it is.
        let row = |(i, terms): (usize, &Vec<(usize, Rational)>)| {
            let mut row = vec![Rational::new(); n + count];
            terms.iter().for_each(|(k, a)| row[*k] += a);
            row[n + i] += 1;
            row
        };
        let equations = relations.iter().map(|r| &r.terms).chain([&self.drive.0]);
        let mut rows: Vec<Vec<Rational>> = equations.enumerate().map(row).collect();
        let mut done = 0;
        for k in 0..n {
            let Some(found) = (done..count).find(|&i| !rows[i][k].is_zero()) else {
                continue;
            };
            rows.swap(done, found);
            let lead = rows[done][k].clone();
            rows[done].iter_mut().for_each(|x| *x /= &lead);
            let pivot = rows[done].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                let factor = row[k].clone();
                if i != done && !factor.is_zero() {
                    let pairs = row.iter_mut().zip(&pivot);
                    pairs.for_each(|(x, p)| *x -= Rational::from(&factor * p));
                }
            }
            done += 1;
        }
        let alone = |row: &&Vec<Rational>| (0..n).all(|k| row[k] == u32::from(k == coordinate));
        let by = &rows[..done].iter().find(alone)?[n..];
        let constants = by.iter().zip(relations).filter(|(k, _)| !k.is_zero());
        Some(Determined {
            rate: by[count - 1].clone(),
            constants: constants
                .map(|(k, r)| (k.clone(), r.constant.clone()))
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{cranked, four_bar};
    use super::super::{Attachment, Body, Drive, Frame, Joint, Mechanism, Real};
    use super::*;
    use crate::class_iii::tests::q;

    fn origin() -> [Rational; 2] {
        [Rational::new(), Rational::new()]
    }

    /// A crank, a wheel geared to it, and a rack: all without loops. A rocker needs one.
    #[test]
    fn gears_and_racks_follow_the_drive() {
        let hung = |k| Joint::Pin {
            a: Attachment::ground(origin()),
            b: Attachment::body(k, origin()),
        };
        let joints = vec![
            hung(0),
            hung(1),
            Joint::Gear {
                a: Frame::Body(0),
                b: Frame::Body(1),
                carrier: Frame::Ground,
                ratio: q("-1.5"),
                offset: ExactAngle::Degrees(q("30")),
            },
            Joint::Slide {
                a: Attachment::ground(origin()),
                direction: [q("1"), q("0")].map(Real::from),
                b: Attachment::body(2, origin()),
                turn: ExactAngle::Degrees(q("90")),
            },
            Joint::Rack {
                pinion: Frame::Body(1),
                slide: 3,
                ratio: q("2"),
                offset: q("5"),
            },
        ];
        let bodies = ["crank", "wheel", "rack"].map(Body::massless).to_vec();
        let mechanism = Mechanism::new(bodies, joints).expect("a mechanism");
        let linkage = Linkage::new(&mechanism, &Drive::coordinate(0), 64).expect("a drive");
        let found = |k| linkage.determined(k).expect("determined");
        assert_eq!((found(0).rate, found(0).constants), (q("1"), Vec::new()));
        let offset = ExactAngle::Degrees(q("30"));
        assert_eq!(found(1).rate, q("-1.5"));
        assert_eq!(found(1).constants, [(q("1"), offset.clone())]);
        let turn = ExactAngle::Degrees(q("90"));
        assert_eq!(
            (found(2).rate, found(2).constants),
            (q("0"), vec![(q("1"), turn)])
        );
        assert_eq!(found(3).rate, q("-3"));
        let travel = ExactAngle::Radians(q("5"));
        assert_eq!(found(3).constants, [(q("2"), offset), (q("1"), travel)]);
        let looped = cranked(&four_bar());
        assert_eq!(looped.determined(0).expect("the crank").rate, q("1"));
        assert_eq!((looped.determined(1), looped.determined(2)), (None, None));
    }
}
