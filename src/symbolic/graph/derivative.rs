//! Derivatives of nodes.

mod bessel;
mod jumps;

use super::{Binding, Graph, Id, Node};
use crate::error::unsupported;
use crate::{Constant, Func, Relation, Roots, SymbolicError};
use std::collections::HashMap;

/// A derivative; nothing stands for zero.
pub(super) type Slope = Option<Id>;

impl Graph {
    /// The derivative of a node by an input or a bound variable.
    ///
    /// Step functions have the derivative zero where they are constant ([`Node::Flat`]); a choice
    /// has that of the part that is chosen. The derivative by a variable that occurs in a complex
    /// conjugate is that by a real variable.
    ///
    /// # Errors
    /// [`SymbolicError::Unsupported`] for functions whose derivatives are not in the language.
    pub fn derivative(&mut self, root: Id, leaf: Id) -> Result<Id, SymbolicError> {
        let slope = match self.derivatives.get(&(root, leaf)) {
            Some(known) => *known,
            None => {
                let seeds = HashMap::from([(leaf, Some(self.number(1)))]);
                let found = self.slope(root, &seeds)?;
                self.derivatives.insert((root, leaf), found);
                found
            }
        };
        Ok(slope.unwrap_or_else(|| self.number(0)))
    }

    /// `a − b`.
    pub fn difference(&mut self, a: Id, b: Id) -> Id {
        self.push(Node::Sub(a, b))
    }

    /// The derivative of a node along a path, by the derivatives of inputs along it; others are
    /// constant.
    ///
    /// # Errors
    /// As [`Graph::derivative`].
    pub fn derivative_along(&mut self, root: Id, path: &[(Id, Id)]) -> Result<Id, SymbolicError> {
        let seeds = path.iter().map(|(leaf, slope)| (*leaf, Some(*slope)));
        let slope = self.slope(root, &seeds.collect())?;
        Ok(slope.unwrap_or_else(|| self.number(0)))
    }

    /// Zero where a node has a value: elsewhere it has no derivative, though that of a logarithm is
    /// `1/x` and that of a part without the variable is gone. Integrals are not computed for that,
    /// and of a choice one part need not have a value.
    pub(super) fn nothing(&mut self, root: Id) -> Slope {
        let (mut sum, mut open) = (None, vec![root]);
        while let Some(id) = open.pop() {
            let node = self.node(id);
            let operands = self.operands(node);
            let is_bound = |part: &Id| matches!(self.node(*part), Node::Bound(_));
            let is_plain = !self.reach(id).iter().any(is_bound);
            if operands.is_empty() || !self.is_finite(id) && is_plain {
                continue;
            }
            if is_plain && self.facts[id as usize].binders.is_empty() && !self.is_condition(id) {
                let zero = self.number(0);
                let part = self.product(zero, id);
                sum = self.plus(sum, Some(part));
            } else if !matches!(node, Node::If(..) | Node::Last(..)) {
                open.extend(operands);
            }
        }
        sum
    }

    /// The derivative of a node, given those of the leaves.
    pub(super) fn slope(
        &mut self,
        root: Id,
        seeds: &HashMap<Id, Slope>,
    ) -> Result<Slope, SymbolicError> {
        let known = self.slopes(root, seeds)?;
        Ok(known.get(&root).copied().flatten())
    }

    /// The derivatives of all nodes that a node needs.
    fn slopes(
        &mut self,
        root: Id,
        seeds: &HashMap<Id, Slope>,
    ) -> Result<HashMap<Id, Slope>, SymbolicError> {
        let mut known: HashMap<Id, Slope> = HashMap::new();
        let mut loops: HashMap<u32, (u32, u32)> = HashMap::new();
        for id in self.reach(root) {
            let slope = match seeds.get(&id) {
                Some(seed) => *seed,
                None => self.slope_of(id, &known, seeds, &mut loops)?,
            };
            known.insert(id, slope);
        }
        Ok(known)
    }

    /// The derivative of a node whose operands' derivatives are known.
    fn slope_of(
        &mut self,
        id: Id,
        known: &HashMap<Id, Slope>,
        seeds: &HashMap<Id, Slope>,
        loops: &mut HashMap<u32, (u32, u32)>,
    ) -> Result<Slope, SymbolicError> {
        let d = |a: Id| known.get(&a).copied().flatten();
        let node = self.node(id);
        Ok(match node {
            Node::Number(_)
            | Node::Constant(_)
            | Node::ImaginaryUnit
            | Node::Infinity
            | Node::Input(_)
            | Node::Variable(..)
            | Node::Truth(_)
            | Node::Flat(..)
            | Node::Compare(..)
            | Node::And(..)
            | Node::Or(..)
            | Node::Not(_) => None,
            Node::Neg(a) => d(a).map(|a| self.push(Node::Neg(a))),
            Node::Add(a, b) => self.plus(d(a), d(b)),
            Node::Sub(a, b) => self.minus(d(a), d(b)),
            Node::Mul(a, b) => {
                let (left, right) = (self.times(d(a), b), self.times(d(b), a));
                self.plus(left, right)
            }
            Node::Div(a, b) => {
                // (a′ − (a/b) b′)/b.
                let moved = self.times(d(b), id);
                let above = self.minus(d(a), moved);
                above.map(|above| self.push(Node::Div(above, b)))
            }
            Node::Power(_, 0) => None,
            Node::Power(a, k) => d(a).map(|slope| {
                let factor = self.number(k);
                let power = match k {
                    1 => return slope,
                    2 => a,
                    k => self.push(Node::Power(a, k - 1)),
                };
                let factor = self.push(Node::Mul(factor, power));
                self.push(Node::Mul(factor, slope))
            }),
            Node::If(condition, a, b) => match (d(a), d(b)) {
                (None, None) => None,
                (a, b) => {
                    let [a, b] = [a, b].map(|x| x.unwrap_or_else(|| self.number(0)));
                    Some(self.push(Node::If(condition, a, b)))
                }
            },
            Node::Unary(f, a) => match d(a) {
                None => None,
                Some(slope) => self.unary(f, id, a, slope)?,
            },
            Node::Binary(f, a, b) => match (d(a), d(b)) {
                (None, None) => None,
                slopes => self.binary(f, id, [a, b], slopes)?,
            },
            Node::Ternary(f, a, b, c) => match [d(a), d(b), d(c)] {
                [None, None, None] => None,
                [da, db, dc] if f == Func::Fma => {
                    let (left, right) = (self.times(da, b), self.times(db, a));
                    let product = self.plus(left, right);
                    self.plus(product, dc)
                }
                _ if f == Func::Voigt => {
                    let definition = self.voigt(a, b, c)?;
                    self.slope(definition, seeds)?
                }
                _ => return unsupported(format!("the derivative of {}", f.name())),
            },
            Node::Bound(binder) => self.bound_slope(binder, id, known, seeds)?,
            Node::Last(binder, k) => {
                let (new, n) = match loops.get(&binder) {
                    Some(found) => *found,
                    None => {
                        let found = match self.binder(binder).binding {
                            Binding::System { .. } => self.system_slope(binder, seeds)?,
                            _ => self.loop_slope(binder, known, seeds)?,
                        };
                        loops.insert(binder, found);
                        found
                    }
                };
                Some(self.push(Node::Last(new, n + k)))
            }
        })
    }

    fn plus(&mut self, a: Slope, b: Slope) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.push(Node::Add(a, b))),
            (a, b) => a.or(b),
        }
    }

    fn minus(&mut self, a: Slope, b: Slope) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.push(Node::Sub(a, b))),
            (None, Some(b)) => Some(self.push(Node::Neg(b))),
            (a, None) => a,
        }
    }

    fn times(&mut self, slope: Slope, factor: Id) -> Slope {
        let one = self.number(1);
        slope.map(|slope| match slope == one {
            true => factor,
            false => self.push(Node::Mul(factor, slope)),
        })
    }

    fn of(&mut self, f: Func, a: Id) -> Id {
        self.push(Node::Unary(f, a))
    }

    fn ratio(&mut self, a: Id, b: Id) -> Id {
        self.push(Node::Div(a, b))
    }

    fn product(&mut self, a: Id, b: Id) -> Id {
        self.push(Node::Mul(a, b))
    }

    /// `1 + s x²` with s = 1 or −1.
    fn one_and_square(&mut self, s: i32, x: Id) -> Id {
        let one = self.number(1);
        let square = self.push(Node::Power(x, 2));
        self.push(match s {
            1 => Node::Add(one, square),
            _ => Node::Sub(one, square),
        })
    }

    /// `2/√π`.
    fn two_over_root_pi(&mut self) -> Id {
        self.push(Node::Constant(Constant::TwoOverRootPi))
    }

    /// `c e^{s x²}` with c = ±2/√π.
    fn gaussian(&mut self, negative: bool, s: i32, x: Id) -> Id {
        let mut c = self.two_over_root_pi();
        if negative {
            c = self.push(Node::Neg(c));
        }
        let mut square = self.push(Node::Power(x, 2));
        if s < 0 {
            square = self.push(Node::Neg(square));
        }
        let gaussian = self.of(Func::Exp, square);
        self.product(c, gaussian)
    }

    /// `f′(a) a′`, `id` being f(a).
    fn unary(&mut self, f: Func, id: Id, a: Id, slope: Id) -> Result<Slope, SymbolicError> {
        let outer = match f {
            Func::Exp => id,
            Func::Exp2 | Func::Exp10 => {
                let c = match f {
                    Func::Exp2 => Constant::Ln2,
                    _ => Constant::Ln10,
                };
                let c = self.push(Node::Constant(c));
                self.product(c, id)
            }
            Func::Expm1 => self.of(Func::Exp, a),
            Func::Log => return Ok(Some(self.ratio(slope, a))),
            Func::Log2 | Func::Log10 => {
                let c = match f {
                    Func::Log2 => Constant::Ln2,
                    _ => Constant::Ln10,
                };
                let c = self.push(Node::Constant(c));
                let below = self.product(c, a);
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Log1p => {
                let one = self.number(1);
                let below = self.push(Node::Add(one, a));
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Sqrt => {
                let two = self.number(2);
                let below = self.product(two, id);
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Cbrt => {
                let three = self.number(3);
                let square = self.push(Node::Power(id, 2));
                let below = self.product(three, square);
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Sin => self.of(Func::Cos, a),
            Func::Cos => {
                let sine = self.of(Func::Sin, a);
                self.push(Node::Neg(sine))
            }
            Func::Tan => self.one_and_square(1, id),
            Func::Sinh => self.of(Func::Cosh, a),
            Func::Cosh => self.of(Func::Sinh, a),
            Func::Tanh => self.one_and_square(-1, id),
            Func::Asin | Func::Acos => {
                let below = self.one_and_square(-1, a);
                let root = self.of(Func::Sqrt, below);
                let quotient = self.ratio(slope, root);
                return Ok(Some(match f {
                    Func::Asin => quotient,
                    _ => self.push(Node::Neg(quotient)),
                }));
            }
            Func::Arctan => {
                let below = self.one_and_square(1, a);
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Asinh => {
                let below = self.one_and_square(1, a);
                let root = self.of(Func::Sqrt, below);
                return Ok(Some(self.ratio(slope, root)));
            }
            Func::Acosh => {
                // √(a − 1) √(a + 1): the root of the product has the other sign left of the
                // imaginary axis.
                let one = self.number(1);
                let parts = [Node::Sub(a, one), Node::Add(a, one)];
                let [below, above] = parts.map(|part| {
                    let part = self.push(part);
                    self.of(Func::Sqrt, part)
                });
                let product = self.product(below, above);
                return Ok(Some(self.ratio(slope, product)));
            }
            Func::Atanh => {
                let below = self.one_and_square(-1, a);
                return Ok(Some(self.ratio(slope, below)));
            }
            Func::Erf => self.gaussian(false, -1, a),
            Func::Erfc => self.gaussian(true, -1, a),
            Func::Erfi => self.gaussian(false, 1, a),
            Func::Erfcx => {
                let two = self.number(2);
                let double = self.product(two, a);
                let first = self.product(double, id);
                let c = self.two_over_root_pi();
                self.push(Node::Sub(first, c))
            }
            Func::Dawson => {
                let two = self.number(2);
                let double = self.product(two, a);
                let second = self.product(double, id);
                let one = self.number(1);
                self.push(Node::Sub(one, second))
            }
            // W′ = 2i/√π − 2zW.
            Func::W => {
                let two = self.number(2);
                let double = self.product(two, a);
                let second = self.product(double, id);
                let c = self.two_over_root_pi();
                let unit = self.push(Node::ImaginaryUnit);
                let first = self.product(c, unit);
                self.push(Node::Sub(first, second))
            }
            Func::Tgamma | Func::Lgamma if self.is_complex(a) => {
                return unsupported(format!("the derivative of {} of complex numbers", f.name()));
            }
            Func::Tgamma => {
                let psi = self.of(Func::Digamma, a);
                self.product(id, psi)
            }
            Func::Lgamma => self.of(Func::Digamma, a),
            Func::AiryAi => self.of(Func::AiryAiPrime, a),
            Func::AiryBi => self.of(Func::AiryBiPrime, a),
            Func::AiryAiPrime | Func::AiryBiPrime => {
                let of = match f {
                    Func::AiryAiPrime => Func::AiryAi,
                    _ => Func::AiryBi,
                };
                let value = self.of(of, a);
                self.product(a, value)
            }
            Func::SinInt | Func::CosInt | Func::Ei | Func::ExpInt => {
                let above = match f {
                    Func::SinInt => self.of(Func::Sin, a),
                    Func::CosInt => self.of(Func::Cos, a),
                    Func::Ei => self.of(Func::Exp, a),
                    _ => {
                        let turned = self.push(Node::Neg(a));
                        let fall = self.of(Func::Exp, turned);
                        self.push(Node::Neg(fall))
                    }
                };
                self.ratio(above, a)
            }
            // e^{−w}/(1 + w).
            Func::LambertW | Func::LambertWm1 => {
                let turned = self.push(Node::Neg(id));
                let fall = self.of(Func::Exp, turned);
                let one = self.number(1);
                let below = self.push(Node::Add(one, id));
                self.ratio(fall, below)
            }
            Func::Zeta => {
                let one = self.number(1);
                self.push(Node::Binary(Func::ZetaDerivative, one, a))
            }
            Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint => {
                self.push(Node::Flat(f, a))
            }
            Func::Re | Func::Im | Func::Conj => return Ok(Some(self.of(f, slope))),
            Func::Abs => {
                if self.is_complex(a) {
                    let conj = self.of(Func::Conj, a);
                    let product = self.product(conj, slope);
                    let above = self.of(Func::Re, product);
                    return Ok(Some(self.ratio(above, id)));
                }
                let one = self.number(1);
                self.push(Node::Binary(Func::Copysign, one, a))
            }
            // arg′ = Im(a′/a).
            Func::Arg => {
                let quotient = self.ratio(slope, a);
                return Ok(Some(self.of(Func::Im, quotient)));
            }
            f => return unsupported(format!("the derivative of {}", f.name())),
        };
        let one = self.number(1);
        Ok(Some(match slope == one {
            true => outer,
            false => self.product(outer, slope),
        }))
    }

    fn binary(
        &mut self,
        f: Func,
        id: Id,
        [a, b]: [Id; 2],
        (da, db): (Slope, Slope),
    ) -> Result<Slope, SymbolicError> {
        let choice = |graph: &mut Graph, relation: Relation| {
            let condition = graph.push(Node::Compare(relation, a, b));
            let [x, y] = [da, db].map(|s| s.unwrap_or_else(|| graph.number(0)));
            Some(graph.push(Node::If(condition, x, y)))
        };
        Ok(match f {
            Func::Pow => {
                // b a^{b−1} a′ + a^b log(a) b′.
                let one = self.number(1);
                let less = self.push(Node::Sub(b, one));
                let power = self.push(Node::Binary(Func::Pow, a, less));
                let factor = self.product(b, power);
                let left = self.times(da, factor);
                let right = match db {
                    None => None,
                    db => {
                        let log = self.of(Func::Log, a);
                        let factor = self.product(id, log);
                        self.times(db, factor)
                    }
                };
                self.plus(left, right)
            }
            Func::Hypot => {
                let (left, right) = (self.times(da, a), self.times(db, b));
                let above = self.plus(left, right);
                above.map(|above| self.ratio(above, id))
            }
            Func::Atan2 => {
                let (left, right) = (self.times(da, b), self.times(db, a));
                let above = self.minus(left, right);
                let [x, y] = [a, b].map(|x| self.push(Node::Power(x, 2)));
                let below = self.push(Node::Add(x, y));
                above.map(|above| self.ratio(above, below))
            }
            Func::Fmin => choice(self, Relation::LessEqual),
            Func::Fmax => choice(self, Relation::GreaterEqual),
            Func::Fdim => {
                let condition = self.push(Node::Compare(Relation::Greater, a, b));
                let slope = self.minus(da, db).unwrap_or_else(|| self.number(0));
                let zero = self.number(0);
                Some(self.push(Node::If(condition, slope, zero)))
            }
            // x − n y with n = trunc(x/y) or the nearest integer.
            Func::Fmod | Func::Remainder => {
                let quotient = self.ratio(a, b);
                let step = match f {
                    Func::Fmod => Func::Trunc,
                    _ => Func::Nearbyint,
                };
                let n = self.of(step, quotient);
                let moved = self.times(db, n);
                let slope = self.minus(da, moved);
                let flat = self.push(Node::Flat(step, quotient));
                self.plus(slope, Some(flat))
            }
            Func::Copysign => {
                let one = self.number(1);
                let signs = [a, b].map(|x| self.push(Node::Binary(Func::Copysign, one, x)));
                let sign = self.product(signs[0], signs[1]);
                self.times(da, sign)
            }
            Func::WeierstrassP if db.is_none() => {
                let slope = self.push(Node::Binary(Func::WeierstrassPPrime, a, b));
                self.times(da, slope)
            }
            Func::ZetaDerivative if da.is_none() => {
                let one = self.number(1);
                let next = self.push(Node::Add(a, one));
                let slope = self.push(Node::Binary(f, next, b));
                self.times(db, slope)
            }
            Func::BesselJ | Func::BesselI | Func::BesselIe if da.is_none() => {
                let slope = self.bessel_slope(f, [a, b], id);
                self.times(db, slope)
            }
            f => return unsupported(format!("the derivative of {}", f.name())),
        })
    }

    /// `Re W((x + iγ)/(σ√2))/(σ√(2π))`.
    fn voigt(&mut self, x: Id, sigma: Id, gamma: Id) -> Result<Id, SymbolicError> {
        let unit = self.push(Node::ImaginaryUnit);
        let turned = self.product(unit, gamma);
        let above = self.push(Node::Add(x, turned));
        let root = self.push(Node::Constant(Constant::Sqrt2));
        let below = self.product(sigma, root);
        let z = self.ratio(above, below);
        let w = self.of(Func::W, z);
        let re = self.of(Func::Re, w);
        let pi = self.push(Node::Constant(Constant::Pi));
        let root = self.of(Func::Sqrt, pi);
        let width = self.product(below, root);
        Ok(self.ratio(re, width))
    }

    /// The derivative of a sum, an integral or a root.
    fn bound_slope(
        &mut self,
        binder: u32,
        id: Id,
        known: &HashMap<Id, Slope>,
        seeds: &HashMap<Id, Slope>,
    ) -> Result<Slope, SymbolicError> {
        let d = |a: Id| known.get(&a).copied().flatten();
        let variable = self.push(Node::Variable(binder, 0));
        // A body whose slope depends on the variable gets a binder of its own.
        let depth = self.binders[binder as usize].depth;
        let names = self.binders[binder as usize].names.clone();
        match self.binder(binder).binding.clone() {
            Binding::Sum { from, to, body } => {
                if d(from).is_some() || d(to).is_some() {
                    return unsupported("the derivative of a sum by its limits");
                }
                let Some(slope) = d(body) else {
                    return Ok(None);
                };
                // Term by term only where that is known to converge.
                if self.node(to) == Node::Infinity {
                    return unsupported("the derivative of a sum to infinity");
                }
                let new = self.open(names, depth);
                let inner = self.push(Node::Variable(new, 0));
                let body = self.substitute(slope, variable, inner)?;
                self.binders[new as usize].binding = Binding::Sum { from, to, body };
                Ok(Some(self.push(Node::Bound(new))))
            }
            Binding::Integral { from, to, body } => {
                let mut sum = None;
                // Leibniz's rule, which holds where no jump moves over the interval.
                let jumps = self.jumps(body, known, |graph, id| graph.depends_on(id, binder));
                if let Some(slope) = self.plus(d(body), jumps) {
                    let new = self.open(names, depth);
                    let inner = self.push(Node::Variable(new, 0));
                    let body = self.substitute(slope, variable, inner)?;
                    self.binders[new as usize].binding = Binding::Integral { from, to, body };
                    sum = Some(self.push(Node::Bound(new)));
                }
                for (limit, sign) in [(to, 1), (from, -1)] {
                    if let Some(slope) = d(limit) {
                        let value = self.substitute(body, variable, limit)?;
                        let part = self.times(Some(slope), value);
                        sum = match sign {
                            1 => self.plus(sum, part),
                            _ => self.minus(sum, part),
                        };
                    }
                }
                Ok(sum)
            }
            // A number of roots jumps where one enters or leaves.
            Binding::Root {
                which: Roots::Number,
                ..
            } => unsupported("the derivative of a number of roots"),
            // f(x, p) = 0: x′ = −f_p/f_x.
            Binding::Root { body, slope, .. } => {
                let mut inner = seeds.clone();
                inner.insert(variable, None);
                let Some(direct) = self.slope(body, &inner)? else {
                    return Ok(None);
                };
                let direct = self.substitute(direct, variable, id)?;
                let slope = self.substitute(slope, variable, id)?;
                let quotient = self.ratio(direct, slope);
                Ok(Some(self.push(Node::Neg(quotient))))
            }
            Binding::Loop { .. } | Binding::System { .. } | Binding::Open => {
                unsupported("the derivative of a loop's sum")
            }
        }
    }

    /// A loop over the variables of another and their derivatives; the number of the former.
    fn loop_slope(
        &mut self,
        binder: u32,
        known: &HashMap<Id, Slope>,
        seeds: &HashMap<Id, Slope>,
    ) -> Result<(u32, u32), SymbolicError> {
        let Binding::Loop {
            condition,
            first,
            next,
        } = self.binder(binder).binding.clone()
        else {
            return unsupported("the derivative of what is no loop");
        };
        let n = first.len() as u32;
        let mut names = self.binder(binder).names.clone();
        names.extend(names.clone().into_iter().map(|name| format!("{name}'")));
        let depth = self.binder(binder).depth;
        let new = self.open(names, depth);
        let (mut map, mut inner) = (HashMap::new(), seeds.clone());
        for k in 0..n {
            let old = self.push(Node::Variable(binder, k));
            let variable = self.push(Node::Variable(new, k));
            let slope = self.push(Node::Variable(new, n + k));
            map.insert(old, variable);
            inner.insert(variable, Some(slope));
        }
        let condition = self.replaced(condition, &map)?;
        let mut updates = Vec::new();
        for x in next {
            updates.push(self.replaced(x, &map)?);
        }
        let zero = self.number(0);
        let mut slopes = Vec::new();
        for x in &updates {
            slopes.push(self.slope(*x, &inner)?.unwrap_or(zero));
        }
        let starts = first
            .iter()
            .map(|x| known.get(x).copied().flatten().unwrap_or(zero));
        let first = first.iter().copied().chain(starts).collect();
        updates.extend(slopes);
        self.binders[new as usize].binding = Binding::Loop {
            condition,
            first,
            next: updates,
        };
        Ok((new, n))
    }
}
