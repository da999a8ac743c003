//! The findings of a proof on its rectangles.

use super::deal::Stride;
use super::plan::Part;
use crate::audit::hex_float;
use crate::proof::{
    Certificate, Code, Leaf, ProofError, Rectangle, UPPER_HALF_PLANE, Watch, first_rectangles,
    on_rectangle,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rectangles without a bound that are kept.
const OPEN: usize = 20;

/// The ends of Re z and of Im z, by their bits.
type Ends = [u64; 4];

fn ends(at: &Rectangle) -> Ends {
    [at.a[0], at.a[1], at.b[0], at.b[1]].map(f64::to_bits)
}

fn shown(at: Ends) -> Value {
    let hex = at.map(|x| hex_float(f64::from_bits(x)));
    json!({ "re": [hex[0], hex[1]], "im": [hex[2], hex[3]] })
}

/// The largest bound, and the first rectangle where it is attained.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Attained {
    /// The complement of the bound's bits, so that the largest comes first; bounds are not
    /// negative.
    order: u64,
    at: Ends,
}

impl Attained {
    fn new(bound: f64, at: &Rectangle) -> Attained {
        Attained {
            order: !bound.to_bits(),
            at: ends(at),
        }
    }

    /// The bound; infinite where a rectangle has none.
    pub fn bound(&self) -> f64 {
        f64::from_bits(!self.order)
    }

    fn add(&mut self, other: &Attained) {
        if other < self {
            self.clone_from(other);
        }
    }

    fn json(&self) -> Value {
        json!({ "bound": finite(self.bound()), "box": shown(self.at) })
    }
}

/// Nothing for what no number says.
fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// The bounds proved by one formula.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfFormula {
    /// Rectangles.
    pub boxes: u64,
    /// Of the norm, in units of 2⁻⁵².
    pub norm: Attained,
    /// Of the real part, in units in its last place.
    pub re: Attained,
    /// Of the imaginary part.
    pub im: Attained,
    /// Of either part, in addition, in units of 2⁻¹⁰⁷⁵, where it may be below 2⁻⁹⁶⁰.
    tiny: Attained,
}

/// Counts and the largest bounds; adding is exact, in any order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProofTally {
    /// Rectangles of the first partition.
    pub parts: u64,
    /// Rectangles without a bound.
    pub open: u64,
    /// The first of them, and why.
    first_open: Vec<(Ends, String)>,
    formulas: BTreeMap<String, OfFormula>,
}

impl ProofTally {
    fn of(found: &Certificate) -> ProofTally {
        let mut tally = ProofTally {
            parts: 1,
            ..ProofTally::default()
        };
        for Leaf { at, formula, bound } in &found.leaves {
            let attained = |x: f64| Attained::new(x, at);
            tally.add_formula(
                formula.name().into(),
                OfFormula {
                    boxes: 1,
                    norm: attained(bound.norm),
                    re: attained(bound.re),
                    im: attained(bound.im),
                    tiny: attained(bound.tiny),
                },
            );
        }
        tally.open = found.open.len() as u64;
        let open = found.open.iter().map(|o| (ends(&o.at), o.why.into()));
        tally.first_open = open.collect();
        tally.cut();
        tally
    }

    fn add_formula(&mut self, name: String, more: OfFormula) {
        match self.formulas.get_mut(&name) {
            None => drop(self.formulas.insert(name, more)),
            Some(own) => {
                own.boxes += more.boxes;
                own.norm.add(&more.norm);
                own.re.add(&more.re);
                own.im.add(&more.im);
                own.tiny.add(&more.tiny);
            }
        }
    }

    fn cut(&mut self) {
        self.first_open.sort();
        self.first_open.truncate(OPEN);
    }

    /// Adds what was found on other rectangles.
    pub fn merge(&mut self, other: ProofTally) {
        self.parts += other.parts;
        self.open += other.open;
        self.first_open.extend(other.first_open);
        self.cut();
        for (name, more) in other.formulas {
            self.add_formula(name, more);
        }
    }

    /// Each formula, by its name.
    pub fn formulas(&self) -> impl Iterator<Item = (&str, &OfFormula)> {
        self.formulas.iter().map(|(name, f)| (name.as_str(), f))
    }

    /// Rectangles with a bound.
    pub fn boxes(&self) -> u64 {
        self.formulas.values().map(|f| f.boxes).sum()
    }

    fn most<'a>(&'a self, of: impl Fn(&'a OfFormula) -> &'a Attained) -> Option<&'a Attained> {
        self.formulas.values().map(of).min()
    }

    /// K: of the norm, in units of 2⁻⁵²; 0 of nothing.
    pub fn norm(&self) -> f64 {
        self.most(|f| &f.norm).map_or(0.0, Attained::bound)
    }

    /// C: of each component, in units in its last place; 0 of nothing.
    pub fn component(&self) -> f64 {
        self.worse_part().map_or(0.0, Attained::bound)
    }

    fn worse_part(&self) -> Option<&Attained> {
        self.formulas.values().flat_map(|f| [&f.re, &f.im]).min()
    }

    /// All of it.
    pub fn json(&self) -> Value {
        let tiny = self.most(|f| &f.tiny).map(Attained::bound);
        let formulas = self.formulas.iter().map(|(name, f)| {
            json!({
                "formula": name,
                "boxes": f.boxes,
                "norm": f.norm.json(),
                "re": f.re.json(),
                "im": f.im.json(),
                "tiny": f.tiny.bound(),
            })
        });
        let open = self.first_open.iter();
        let open = open.map(|(at, why)| json!({ "box": shown(*at), "why": why }));
        json!({
            "function": "faddeeva",
            "part": "upper",
            "passed": self.open == 0,
            "proved": self.open == 0,
            "rectangles": self.parts,
            "norm": self.most(|f| &f.norm).map(Attained::json),
            "component": self.worse_part().map(Attained::json),
            "tiny": tiny,
            "boxes": self.boxes(),
            "formulas": formulas.collect::<Vec<Value>>(),
            "open": self.open,
            "first_open": open.collect::<Vec<Value>>(),
        })
    }
}

/// Proves what can be proved on some of the rectangles, on the threads of the pool that this runs
/// in; what is found after `stop` is set means nothing.
///
/// # Errors
/// If the reference is undecided about a coefficient of the solver's tables.
pub fn of(
    part: &Part,
    stride: Stride,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Result<ProofTally, ProofError> {
    if stride.is_empty() {
        return Ok(ProofTally::default());
    }
    let code = Code::of_the_solver()?;
    let all = first_rectangles(part.within);
    let watch = Watch::default();
    let units = (0..stride.len() as usize).into_par_iter().with_max_len(1);
    let found = units.map(|j| {
        if stop.load(Ordering::Relaxed) {
            watch.stop.store(true, Ordering::Relaxed);
        }
        let at = all[stride.at(j as u64) as usize];
        let found = on_rectangle(&code, UPPER_HALF_PLANE, &watch, at);
        progress(1);
        found.map_or_else(ProofTally::default, |f| ProofTally::of(&f))
    });
    Ok(found.reduce(ProofTally::default, |mut sum, more| {
        sum.merge(more);
        sum
    }))
}

/// The bounds on two of the rectangles, bit for bit, so that another prover is noticed.
pub fn probe(part: &Part) -> String {
    let all = first_rectangles(part.within);
    let some = [0, all.len() / 3].map(|i| all[i]);
    match Code::of_the_solver() {
        Err(why) => why.to_string(),
        Ok(code) => {
            let found = some.map(|at| on_rectangle(&code, UPPER_HALF_PLANE, &Watch::default(), at));
            let tally = found.map(|f| f.map(|f| ProofTally::of(&f)));
            format!("{} {tally:?}\n", all.len())
        }
    }
}

#[cfg(test)]
mod tests;
