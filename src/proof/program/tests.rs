//! Bounds beside errors in exact arithmetic.

use super::*;
use crate::certificate::Watch;
use mechaudit_symbolic::evaluation::{Evaluator, Floating};
use mechaudit_symbolic::graph::Node;
use mechaudit_symbolic::{Definitions, parse};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rug::Rational;
use std::sync::Arc;

/// A formula of inputs x, y, z with its domain, or the two parts of a complex one.
struct Kernel {
    graph: Arc<Graph>,
    roots: Vec<Id>,
    domain: Vec<Interval>,
    setting: Setting,
}

fn kernel(text: &str, domain: &[[f64; 2]]) -> Kernel {
    let names = ["x", "y", "z"].iter().take(domain.len());
    let mut graph = Graph::new(names.map(|n| n.to_string()));
    let mut root = |text| graph.build(&Definitions::default(), &parse(text).unwrap());
    Kernel {
        roots: text.split(';').map(|part| root(part).unwrap()).collect(),
        graph: Arc::new(graph),
        domain: domain.iter().map(|d| Interval::new(d[0], d[1])).collect(),
        setting: Setting::default(),
    }
}

/// The proof of a program on as many boxes, without a target.
fn proved(program: &Program, measure: Measure, boxes: u64) -> Proof {
    let limits = Limits { boxes, target: 0.0 };
    prove(program, measure, &limits, &Watch::default()).unwrap()
}

impl Kernel {
    fn tried(&self) -> Result<Program, ProgramError> {
        Program::new(&self.graph, &self.roots, None, &self.domain, self.setting)
    }

    fn program(&self) -> Program {
        self.tried().unwrap()
    }

    fn proof(&self, measure: Measure) -> Proof {
        proved(&self.program(), measure, 2_000)
    }

    fn bound(&self, measure: Measure) -> f64 {
        self.proof(measure).bound
    }

    /// The value of a node over the rationals; none where it divides by zero.
    fn exact(&self, id: Id, x: &[f64]) -> Option<Rational> {
        let of = |id| self.exact(id, x);
        Some(match self.graph.node(id) {
            Node::Number(k) => self.graph.rational(k).clone(),
            Node::Input(k) => Rational::from_f64(x[k as usize])?,
            Node::Neg(a) => -of(a)?,
            Node::Add(a, b) => of(a)? + of(b)?,
            Node::Sub(a, b) => of(a)? - of(b)?,
            Node::Mul(a, b) => of(a)? * of(b)?,
            Node::Div(a, b) => {
                let b = of(b)?;
                (b != 0).then(|| of(a).map(|a| a / b))??
            }
            Node::Power(a, 2) => of(a)?.square(),
            Node::Unary(mechaudit_symbolic::Func::Abs, a) => of(a)?.abs(),
            Node::Ternary(_, a, b, c) => of(a)? * of(b)? + of(c)?,
            Node::If(condition, a, b) => {
                let Node::Compare(_, p, q) = self.graph.node(condition) else {
                    panic!("another condition");
                };
                if of(p)? < of(q)? { of(a)? } else { of(b)? }
            }
            node => panic!("{node:?} is not rational"),
        })
    }

    /// The largest error found at random inputs and at corners: absolute, relative, in ulps.
    fn worst(&self, tries: u32) -> [f64; 3] {
        let meaning = Floating {
            format: self.setting.format,
            elementary: self.setting.elementary,
        };
        let mut evaluator = Evaluator::new(self.graph.clone(), meaning);
        let mut random = ChaCha8Rng::seed_from_u64(59);
        let mut worst = [0.0f64; 3];
        for k in 0..tries {
            let x: Vec<f64> = self
                .domain
                .iter()
                .map(|d| {
                    let at = match k % 4 {
                        0 => [d.lo, d.hi][random.random_range(0..2usize)],
                        1 => d.hi - (d.hi - d.lo) * random.random_range(0.0..1e-3),
                        _ => random.random_range(d.lo..=d.hi),
                    };
                    let at = if self.setting.format == Format::Single {
                        f64::from(at as f32)
                    } else {
                        at
                    };
                    at.clamp(d.lo, d.hi)
                })
                .collect();
            evaluator.reset(false);
            for (k, x) in x.iter().enumerate() {
                evaluator.set_input(k, (*x).into());
            }
            let exact: Option<Vec<Rational>> =
                self.roots.iter().map(|r| self.exact(*r, &x)).collect();
            let Some(exact) = exact else {
                continue;
            };
            let errors = self.roots.iter().zip(&exact).map(|(root, exact)| {
                let computed = evaluator.value(*root).unwrap().real().unwrap();
                (Rational::from_f64(computed).unwrap() - exact).to_f64()
            });
            let norm = |parts: Vec<f64>| parts.into_iter().fold(0.0, f64::hypot);
            let error = norm(errors.collect());
            let size = norm(exact.iter().map(Rational::to_f64).collect());
            worst[0] = worst[0].max(error);
            if size != 0.0 {
                worst[1] = worst[1].max(error / size);
            }
            let ulp = if size < f64::MIN_POSITIVE {
                f64::from_bits(1)
            } else {
                size.next_up() - size
            };
            let ulp = if self.setting.format == Format::Single {
                ulp * (2f64).powi(29)
            } else {
                ulp
            };
            worst[2] = worst[2].max(error / ulp);
        }
        worst
    }
}

/// Formulas with the factor by which the bound may exceed what random inputs reach.
const KERNELS: &[(&str, &[[f64; 2]], f64)] = &[
    ("x + y", &[[1.0, 2.0], [-1.0, 3.0]], 1.05),
    ("x*y - z", &[[-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0]], 2.0),
    ("4*x/(1 + x/1.11)", &[[0.1, 0.3]], 3.0),
    ("x*x*x/6 - x", &[[-1.5, 1.5]], 3.0),
    ("(x + y)*(x - y)", &[[1.0, 2.0], [3.0, 4.0]], 2.0),
    ("x^2 - y^2", &[[1.0, 2.0], [3.0, 4.0]], 2.0),
    ("1/(x - y)", &[[1.0, 2.0], [2.125, 3.0]], 4.0),
    ("fma(x, y, -1)*x", &[[1.0, 2.0], [3.0, 4.0]], 2.0),
    ("abs(x - 0.1)*y", &[[-1.0, 1.0], [1.0, 2.0]], 3.0),
    ("if(x < 1, x*0.1, x*x*0.1)", &[[0.5, 1.5]], 3.0),
    (
        "(-(331.4 + 0.6*z)*y)/((331.4 + 0.6*z + x)*(331.4 + 0.6*z + x))",
        &[[-100.0, 100.0], [20.0, 20000.0], [-30.0, 50.0]],
        4.0,
    ),
    ("1 + 0.5*x - 0.125*x*x + 0.0625*x*x*x", &[[0.0, 1.0]], 3.0),
];

#[test]
fn bounds_hold_and_are_near_what_is_found() {
    for format in [Format::Double, Format::Single] {
        for (text, domain, factor) in KERNELS {
            let mut kernel = kernel(text, domain);
            kernel.setting.format = format;
            let found = kernel.worst(4_000);
            for (k, measure) in [Measure::Absolute, Measure::Relative, Measure::Ulps]
                .into_iter()
                .enumerate()
            {
                let proof = kernel.proof(measure);
                let bound = proof.bound;
                assert!(
                    bound >= found[k],
                    "{text} {measure:?} {format:?}: {bound:e} < {:e}",
                    found[k]
                );
                if measure == Measure::Absolute {
                    assert!(
                        bound <= factor * found[k],
                        "{text} {format:?}: {bound:e}, found {:e}",
                        found[k]
                    );
                }
            }
        }
    }
}

/// Random formulas over random boxes: no error in exact arithmetic is above the bound.
#[test]
fn no_random_formula_exceeds_its_bound() {
    let mut random = ChaCha8Rng::seed_from_u64(60);
    for round in 0..60 {
        let mut terms = vec!["x".to_string(), "y".into(), "0.3".into(), "2".into()];
        for _ in 0..random.random_range(2..7) {
            let mut pick = || terms[random.random_range(0..terms.len())].clone();
            let (a, b) = (pick(), pick());
            let op = ["+", "-", "*", "/"][random.random_range(0..4usize)];
            terms.push(format!("({a} {op} {b})"));
        }
        let text = terms.last().unwrap().clone();
        let mut end = || {
            let lo = random.random_range(-2.0..2.0f64);
            [
                lo,
                lo + random.random_range(0.0..1.0) * (0.1f64).powi(random.random_range(0..12)),
            ]
        };
        let mut kernel = kernel(&text, &[end(), end()]);
        if round % 3 == 0 {
            kernel.setting.format = Format::Single;
            for d in &mut kernel.domain {
                *d = Interval::new(f64::from(d.lo as f32), f64::from(d.hi as f32));
                if d.hi < d.lo {
                    *d = Interval::point(d.lo);
                }
            }
        }
        let measures = [Measure::Absolute, Measure::Relative, Measure::Ulps];
        let bounds = measures.map(|m| proved(&kernel.program(), m, 60).bound);
        if !bounds[0].is_finite() {
            continue;
        }
        let found = kernel.worst(300);
        for k in 0..3 {
            assert!(
                bounds[k] >= found[k],
                "{text} over {:?} {:?}: {:e} < {:e}",
                kernel.domain,
                measures[k],
                bounds[k],
                found[k]
            );
        }
    }
}

/// Results that are numbers of the format whatever the inputs.
#[test]
fn exact_operations_have_no_error() {
    for (text, domain) in [
        ("2*x", &[[-3.0, 5.0]][..]),
        ("x/8", &[[1.0, 5.0]]),
        ("-abs(x)*0.5", &[[1.0, 5.0]]),
        ("x - y", &[[1.0, 1.5], [0.8, 1.4]]),
        ("x - x", &[[1.0, 1.9]]),
        ("max(x, y) + 0", &[[1.0, 1.9], [-4.0, 7.0]]),
    ] {
        assert_eq!(kernel(text, domain).bound(Measure::Absolute), 0.0, "{text}");
    }
    // 0.1 is no number of the format, and its error is that of the nearest one.
    let bound = kernel("0.1 + 0*x", &[[1.0, 2.0]]).bound(Measure::Absolute);
    let exact = (Rational::from_f64(0.1).unwrap() - Rational::from((1, 10))).to_f64();
    assert!(
        bound >= exact && bound <= exact * 1.001,
        "{bound:e} {exact:e}"
    );
}

/// Half an ulp of the value, in the binade of the exact product: the end of a box that is a power
/// of two belongs to the binade below.
#[test]
fn one_rounding_is_half_an_ulp() {
    let product = kernel("x*y", &[[0.5, 1.0], [0.5, 1.0]]);
    assert_eq!(product.bound(Measure::Absolute), (0.5f64).powi(54));
    let ulps = product.bound(Measure::Ulps);
    assert!((0.5..0.51).contains(&ulps), "{ulps}");
    let above = kernel("x*y", &[[0.5, 1.0], [0.5, 1.25]]);
    assert_eq!(above.bound(Measure::Absolute), (0.5f64).powi(53));
    let mut single = kernel("x*y", &[[0.5, 1.0], [0.5, 1.0]]);
    single.setting.format = Format::Single;
    assert_eq!(single.bound(Measure::Absolute), (0.5f64).powi(25));
}

/// In binary32 near a pole the derivative changes much between the exact and the computed divisor:
/// here the product is rounded towards the pole by nearly half a unit.
#[test]
fn errors_of_second_order_are_held() {
    let unit = (0.5f64).powi(24);
    let (x, y) = (0.5 + 2149.0 * unit, 0.5 - 2147.0 * unit);
    let mut pole = kernel("1/(x*y - 0.25)", &[[x, x], [y, y]]);
    pole.setting.format = Format::Single;
    let (found, bound) = (pole.worst(4)[0], pole.bound(Measure::Absolute));
    assert!(found > 1e6 && bound >= found, "{bound:e} {found:e}");
}

/// `a − 1/a` has the derivative `1 + 1/a²`.
#[test]
fn derivatives_have_their_signs() {
    for (text, domain) in [
        ("x*0.1 - 1/(x*0.1)", [9.0, 11.0]),
        ("x*0.1 + 1/(x*0.1)", [1.0, 2.0]),
        ("(x*0.1 + 1)*(1 - x*0.1)", [1.0, 20.0]),
    ] {
        let kernel = kernel(text, &[domain]);
        let (found, bound) = (kernel.worst(3_000)[0], kernel.bound(Measure::Absolute));
        assert!(bound >= found, "{text}: {bound:e} {found:e}");
    }
}

#[test]
fn what_has_no_bound_says_so() {
    let at_zero = kernel("1/x", &[[-1.0, 1.0]]).proof(Measure::Absolute);
    assert!(at_zero.bound == f64::INFINITY && at_zero.proved().is_none());
    assert!(at_zero.at.unwrap().why.is_some());
    let large = kernel("x*x", &[[1e200, 1e300]]).proof(Measure::Absolute);
    assert!(large.bound == f64::INFINITY);
    let zero = kernel("x - y*y", &[[-1.0, 1.0], [0.0, 1.0]]).proof(Measure::Relative);
    assert!(zero.bound == f64::INFINITY && zero.looked_at < 2_000);
    // The sum of errors rises or falls with every input here, the quotient by the value does not.
    let turbine = kernel(
        "6*x - (0.5*x*(y*y*z*z))/(1 - x) - 2.5",
        &[[-4.5, -0.3], [0.4, 0.9], [3.8, 7.8]],
    );
    for measure in [Measure::Relative, Measure::Ulps] {
        assert!(turbine.bound(measure) == f64::INFINITY, "{measure:?}");
    }
    // On some boxes the sum only rises, and divides by what may be zero at their end.
    let end = kernel("(y + x)/(x - x + x/y)", &[[-5.0, 5.0], [1.0, 2.0]]);
    assert!(end.bound(Measure::Ulps) == f64::INFINITY);
    assert!(kernel("W(x)", &[[1.0, 1.0]]).tried().is_err());
}

/// The norm of the error of both parts, also as a part of a value whose parts are zero somewhere.
#[test]
fn complex_results_have_one_error() {
    let square = kernel("x*x - y*y; 2*x*y", &[[-1.0, 2.0], [1.0, 3.0]]);
    let found = square.worst(4_000);
    for (k, measure) in [Measure::Absolute, Measure::Relative]
        .into_iter()
        .enumerate()
    {
        let bound = square.bound(measure);
        assert!(
            bound >= found[k] && bound <= 2.0 * found[k],
            "{measure:?}: {bound:e} {:e}",
            found[k]
        );
    }
    let real = kernel("x*x - y*y", &[[-1.0, 2.0], [1.0, 3.0]]);
    assert!(real.bound(Measure::Relative) == f64::INFINITY);
    let zero = kernel("x*0.1; y*0.1", &[[-1.0, 2.0], [-1.0, 3.0]]);
    assert!(zero.bound(Measure::Relative) == f64::INFINITY);
}

/// A condition narrows ranges on boxes that it cuts: the sides of a triangle, of which no one is
/// longer than the others together.
#[test]
fn conditions_narrow_ranges() {
    let mut graph = Graph::new(["x", "y", "z"].map(String::from));
    let mut build = |text: &str| graph.build(&Definitions::default(), &parse(text).unwrap());
    let sides = "x + y > z + 0.001 and x + z > y + 0.001 and y + z > x + 0.001";
    let condition = build(sides).unwrap();
    let half = "((x + y + z)/2)";
    let area = build(&format!(
        "sqrt({half}*({half} - x)*({half} - y)*({half} - z))"
    ))
    .unwrap();
    let domain = [Interval::new(1.0, 9.0); 3];
    let of = |condition| {
        let program = Program::new(&graph, &[area], condition, &domain, Setting::default());
        proved(&program.unwrap(), Measure::Absolute, 400)
    };
    assert!(of(None).bound == f64::INFINITY);
    let proof = of(Some(condition));
    assert!(proof.bound < 1e-6, "{:e}", proof.bound);
    // At thin triangles next to the condition's edge, and at others: in binary64 and in 300 bits.
    let mut random = ChaCha8Rng::seed_from_u64(62);
    let mut worst = 0.0f64;
    for k in 0..4_000 {
        let mut side = || random.random_range(1.0..8.0f64);
        let (x, y) = (side(), side());
        let z = match k % 2 {
            0 => (x + y - 0.001 * (1.0 + 1e-9)).min(9.0),
            _ => (x - y).abs().max(1.0) + 0.5,
        };
        let float = |x: f64| rug::Float::with_val(300, x);
        let room =
            float(x) + y - z - rug::Float::with_val(300, rug::Float::parse("0.001").unwrap());
        if !(room > 0.0 && x + z > y + 0.0011 && y + z > x + 0.0011) {
            continue;
        }
        let area = |s: rug::Float| (s.clone() * (s.clone() - x) * (s.clone() - y) * (s - z)).sqrt();
        let s = (x + y + z) / 2.0;
        let computed = (s * (s - x) * (s - y) * (s - z)).sqrt();
        let exact = area((float(x) + y + z) / 2u32);
        worst = worst.max((exact - computed).abs().to_f64());
    }
    assert!(
        worst > 1e-15 && worst <= proof.bound,
        "{worst:e} {:e}",
        proof.bound
    );
}

/// Parts cover the domain, and the worst of their bounds is one of the whole.
#[test]
fn parts_of_a_domain_are_proved_apart() {
    let kernel = kernel("x*y - x*0.1", &[[1.0, 2.0], [-1.0, 1.0]]);
    let program = kernel.program();
    let all = parts(&program, 8);
    assert_eq!(all.len(), 8);
    let each = all.iter().map(|at| {
        let part = program.within(at.clone());
        proved(&part, Measure::Absolute, 400).bound
    });
    let worst = each.fold(0.0, f64::max);
    let whole = kernel.bound(Measure::Absolute);
    assert!(
        worst >= kernel.worst(2_000)[0] && worst <= 1.01 * whole,
        "{worst:e} {whole:e}"
    );
    for x in [[1.0, -1.0], [1.3, 0.2], [2.0, 1.0], [1.5, 0.0]] {
        let holds = |at: &Vec<Interval>| at.iter().zip(x).all(|(d, x)| d.lo <= x && x <= d.hi);
        assert!(all.iter().any(holds), "{x:?}");
    }
    let point = self::kernel("x*0.1", &[[2.0, 2.0]]);
    assert_eq!(parts(&point.program(), 8).len(), 1);
}

/// Subnormal products may lose all their digits: by less than the smallest number.
#[test]
fn underflow_counts() {
    let tiny = kernel("x*y", &[[1e-170, 1e-160], [1e-170, 1e-160]]);
    let found = tiny.worst(2_000);
    let bound = tiny.bound(Measure::Absolute);
    assert!(bound >= found[0] && bound <= 1e-323, "{bound:e}");
}

#[test]
fn boxes_cover_the_domain() {
    let kernel = kernel("x*y - x", &[[1.0, 2.0], [-1.0, 1.0]]);
    let proof = kernel.proof(Measure::Absolute);
    let mut random = ChaCha8Rng::seed_from_u64(61);
    for _ in 0..2_000 {
        let x: Vec<f64> = kernel
            .domain
            .iter()
            .map(|d| random.random_range(d.lo..=d.hi))
            .collect();
        let holds = |b: &&ProvedBox| b.at.iter().zip(&x).all(|(d, x)| d.lo <= *x && *x <= d.hi);
        let held = proof.boxes.iter().find(holds).expect("a box");
        assert!(held.bound <= proof.bound);
    }
}

/// Loops run as often as their counters say; one that depends on rounding is refused.
#[test]
fn bounded_loops_are_unrolled() {
    let of = |text: &str| kernel(text, &[[1.0, 2.0]]);
    let unrolled = of("while_all(k < 3, s, 0, s + x, k, 0, k + 1, s)");
    let same = of("0 + x + x + x");
    assert_eq!(
        unrolled.bound(Measure::Absolute),
        same.bound(Measure::Absolute)
    );
    assert!(of("while_all(s < 3, s, 0, s + x*x, s)").tried().is_err());
    let endless = of("x + while(1 < 2, k, 0, k, k)").tried().unwrap_err();
    assert!(endless.to_string().contains("rounds"), "{endless}");
}

/// A comparison of numbers without errors picks the branch of the exact value, one of rounded
/// numbers may pick the other.
#[test]
fn exact_comparisons_pick_the_branch_of_the_value() {
    let domain = [[0.0, 1.0]];
    let exact = kernel("if(x > 0.25 and not (2*x < 0.5), x + 1, x/3)", &domain);
    let bound = exact.bound(Measure::Absolute);
    assert!(bound <= 2f64.powi(-53), "{bound:e}");
    let rounded = kernel("if(x*x > 0.1, x + 1, x/3)", &domain);
    let bound = rounded.bound(Measure::Absolute);
    assert!(bound > 0.5, "{bound:e}");
    let both = kernel("if(x > 0.25 and x*x > 0.1, x + 1, x/3)", &domain);
    let bound = both.bound(Measure::Absolute);
    assert!(bound > 0.5, "{bound:e}");
}
