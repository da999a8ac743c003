//! Cases of a study, drawn from its domain: at random, and where formulas are apt to fail.

use super::compiled::{FloatSolver, Sketch};
use super::error::StudyError;
use super::problem::{Problem, Spacing, StudyInput, intern};
use crate::audit::{CheckPoint, Domain, Draw, Format, Region};
use crate::reference::nearest_f64;
use mechaudit_symbolic::evaluation::{Evaluator, Floating};
use mechaudit_symbolic::graph::{Graph, Id, Node};
use std::sync::Arc;

/// Draws after which a condition counts as one that nothing satisfies.
const TRIES: u32 = 20_000;

/// Pairs of inputs between which a flip is sought, for each condition or difference.
const PAIRS: u64 = 24;

/// Edge cases of flips that are kept.
const MOST: usize = 400;

/// The ends of an input as numbers, both within the range.
#[derive(Clone, Copy, Debug)]
struct Range {
    low: f64,
    high: f64,
    spacing: Spacing,
    /// True if the study states both ends.
    is_bounded: bool,
}

impl Range {
    fn of(input: &StudyInput, format: Format) -> Range {
        let inside = |end: &Option<rug::Rational>, way: f64| match end {
            None => way * f64::MAX,
            Some(q) => {
                let x = nearest_f64(q).clamp(-f64::MAX, f64::MAX);
                let is_outside = match way > 0.0 {
                    true => rug::Rational::from_f64(x).is_some_and(|x| x > *q),
                    false => rug::Rational::from_f64(x).is_some_and(|x| x < *q),
                };
                match (is_outside, way > 0.0) {
                    (false, _) => x,
                    (true, true) => x.next_down(),
                    (true, false) => x.next_up(),
                }
            }
        };
        let (low, high) = (inside(&input.from, -1.0), inside(&input.to, 1.0));
        let (low, high) = match format {
            Format::Double => (low, high),
            Format::Single => within_single(low, high),
        };
        Range {
            low,
            high,
            spacing: input.spacing,
            is_bounded: input.from.is_some() && input.to.is_some(),
        }
    }

    fn holds(self, x: f64) -> bool {
        (self.low..=self.high).contains(&x)
    }

    /// A number by the spacing.
    fn draw(self, d: &mut Draw) -> f64 {
        match self.spacing {
            Spacing::Linear if self.is_bounded => {
                let t = d.unit();
                ((1.0 - t) * self.low + t * self.high).clamp(self.low, self.high)
            }
            _ => self.magnitudes(d),
        }
    }

    /// A number of any magnitude that the range holds.
    fn magnitudes(self, d: &mut Draw) -> f64 {
        let size = |low: f64, high: f64, d: &mut Draw| {
            let low = low.max(f64::from_bits(1));
            match low < high {
                true => d.log_uniform(low, high).clamp(low, high),
                false => high,
            }
        };
        let (negative, positive) = (self.low < 0.0, self.high > 0.0);
        let x = match (negative, positive) {
            (true, true) => match d.chance(0.5) {
                true => size(0.0, self.high, d),
                false => -size(0.0, -self.low, d),
            },
            (false, true) => size(self.low, self.high, d),
            (true, false) => -size(-self.high, -self.low, d),
            (false, false) => 0.0,
        };
        x.clamp(self.low, self.high)
    }

    /// The ends and their neighbours, zeros, subnormal and huge numbers, powers of two that the
    /// range holds.
    fn edges(self) -> Vec<f64> {
        let mut all = vec![
            self.low,
            self.low.next_up(),
            self.high,
            self.high.next_down(),
        ];
        let tiny = f64::from_bits(1);
        let sizes = [
            0.0,
            tiny,
            f64::MIN_POSITIVE.next_down(),
            f64::MIN_POSITIVE,
            1.0,
            f64::MAX,
        ];
        let powers =
            [-600, -100, -53, -27, -4, -1, 1, 2, 8, 27, 53, 100, 600].map(|k| 2f64.powi(k));
        for size in sizes.into_iter().chain(powers) {
            all.extend([size, -size]);
        }
        all.extend([1.0f64.next_up(), 1.0f64.next_down()]);
        all.retain(|x| self.holds(*x));
        all
    }
}

/// The least and the largest number of binary32 between two others, between which rounding stays.
fn within_single(low: f64, high: f64) -> (f64, f64) {
    let end = |x: f64| x.clamp(f32::MIN.into(), f32::MAX.into()) as f32;
    let (from, to) = (end(low), end(high));
    let from = match f64::from(from) < low {
        true => from.next_up(),
        false => from,
    };
    let to = match f64::from(to) > high {
        true => to.next_down(),
        false => to,
    };
    (from.into(), to.into())
}

/// A condition of a region, evaluated in binary64.
#[derive(Clone)]
struct Filter {
    sketch: Arc<Sketch>,
    conditions: Vec<Id>,
}

impl Filter {
    fn evaluator(&self) -> Evaluator<Floating> {
        self.sketch.evaluator()
    }

    fn admits(&self, evaluator: &mut Evaluator<Floating>, input: &[f64]) -> bool {
        if self.conditions.is_empty() {
            return true;
        }
        set(evaluator, input);
        self.conditions
            .iter()
            .all(|id| evaluator.holds(*id) == Ok(true))
    }
}

fn set(evaluator: &mut Evaluator<Floating>, input: &[f64]) {
    evaluator.reset(false);
    for (k, x) in input.iter().enumerate() {
        evaluator.set_input(k, (*x).into());
    }
}

/// A region of a box with a condition.
fn region(
    name: &'static str,
    description: &'static str,
    (filter, format): (Filter, Format),
    draw: impl Fn(&mut Draw) -> Vec<f64> + Send + Sync + 'static,
) -> Region {
    // Conditions hold at the numbers of the format.
    let draw = move |d: &mut Draw| -> Vec<f64> {
        let input = draw(d).into_iter();
        input.map(|x| format.representable(x)).collect()
    };
    let sample = move |d: &mut Draw| {
        let mut evaluator = filter.evaluator();
        let mut input = draw(d);
        for _ in 0..TRIES {
            if filter.admits(&mut evaluator, &input) {
                break;
            }
            input = draw(d);
        }
        input
    };
    Region {
        name,
        description,
        sample: Arc::new(sample),
    }
}

/// The domain of a study.
///
/// # Errors
/// A condition that no input satisfies that was drawn.
pub(super) fn domain(
    problem: &Problem,
    sketch: &Arc<Sketch>,
    format: Format,
) -> Result<Domain, StudyError> {
    let range_of = |input: &StudyInput| Range::of(input, format);
    let ranges: Vec<Range> = problem.given().iter().map(range_of).collect();
    if let Some((input, _)) = problem
        .inputs
        .iter()
        .zip(&ranges)
        .find(|(_, r)| r.low > r.high)
    {
        let name = match format {
            Format::Double => "binary64",
            Format::Single => "binary32",
        };
        let reason = match (&input.from, &input.to) {
            (Some(from), Some(to)) if from > to => {
                format!("the range of {} is empty: {from} to {to}", input.name)
            }
            _ => format!("the range of {} holds no {name}", input.name),
        };
        let stated = problem.condition.as_ref();
        return Err(StudyError::new(reason).at(stated.and_then(|c| c.place)));
    }
    let filter = Filter {
        sketch: sketch.clone(),
        conditions: sketch.condition.into_iter().collect(),
    };
    let mut regions = Vec::new();
    let texts = |ranges: &[Range]| {
        let ranges = problem.given().iter().zip(ranges);
        let parts = ranges.map(|(i, r)| format!("{} = {:e}..{:e}", i.name, r.low, r.high));
        let text = parts.collect::<Vec<_>>().join(", ");
        intern(if text.is_empty() { "no inputs" } else { &text })
    };
    if problem.given().is_empty() {
        regions.push(region(
            "domain",
            "no inputs",
            (filter.clone(), format),
            |_| Vec::new(),
        ));
    } else {
        let box_of = ranges.clone();
        let draw = move |d: &mut Draw| box_of.iter().map(|r| r.draw(d)).collect();
        regions.push(region(
            "domain",
            texts(&ranges),
            (filter.clone(), format),
            draw,
        ));
        let wide = |r: &Range| r.low <= 0.0 && r.high >= 0.0 || r.high / r.low > 100.0;
        if ranges
            .iter()
            .any(|r| r.is_bounded && r.spacing == Spacing::Linear && wide(r))
        {
            let box_of = ranges.clone();
            let draw = move |d: &mut Draw| box_of.iter().map(|r| r.magnitudes(d)).collect();
            let text = "inputs of every magnitude that the ranges hold";
            regions.push(region("magnitudes", text, (filter.clone(), format), draw));
        }
        let edges: Vec<Vec<f64>> = ranges.iter().map(|r| r.edges()).collect();
        let box_of = ranges.clone();
        let draw = move |d: &mut Draw| {
            let parts = box_of.iter().zip(&edges);
            let mut input: Vec<f64> = Vec::new();
            for (range, edges) in parts {
                let on_edge = !edges.is_empty() && d.chance(0.6);
                input.push(if on_edge {
                    d.one_of(edges)
                } else {
                    range.draw(d)
                });
            }
            input
        };
        let text =
            "ends of ranges and their neighbours, signed zeros, subnormal numbers, powers of two";
        regions.push(region("edges", text, (filter.clone(), format), draw));
        let flips = Arc::new(beside_flips(sketch, &filter, &ranges));
        if !flips.is_empty() {
            let all = flips.clone();
            let draw = move |d: &mut Draw| all[d.integer(0, all.len() - 1)].clone();
            let text = "next to where a condition flips or a difference is zero";
            regions.push(region("flips", text, (filter.clone(), format), draw));
        }
    }
    for (stated, condition) in problem.regions.iter().zip(&sketch.regions) {
        let mut own = ranges.clone();
        for input in &stated.inputs {
            if let Some(k) = problem.given().iter().position(|i| i.name == input.name) {
                own[k] = range_of(input);
            }
        }
        let mut filter = filter.clone();
        filter.conditions.extend(condition);
        let description = texts(&own);
        let draw = move |d: &mut Draw| own.iter().map(|r| r.draw(d)).collect();
        regions.push(region(
            intern(&stated.name),
            description,
            (filter, format),
            draw,
        ));
    }
    let mut kept = Vec::new();
    for region in regions {
        match (is_empty(&region, problem, sketch), region.name) {
            (false, _) => kept.push(region),
            // The condition may leave out all edges.
            (true, "edges" | "magnitudes" | "flips") => {}
            (true, name) => {
                let own = problem.regions.iter().find(|r| r.name == name);
                let own = own.and_then(|r| r.condition.as_ref());
                let stated: Vec<_> = problem.condition.iter().chain(own).collect();
                let texts: Vec<_> = stated.iter().map(|c| c.is.to_string()).collect();
                let reason = format!(
                    "no input was found that satisfies the conditions of {name}: {}; where there \
                     are some, narrow the ranges of inputs to them",
                    texts.join(" and ")
                );
                let place = stated.last().and_then(|c| c.place);
                return Err(StudyError::new(reason).at(place));
            }
        }
    }
    let points = check_points(&ranges, &filter, format);
    Ok(Domain {
        regions: kept,
        check_points: points,
    })
}

/// Returns true if a region's draws do not satisfy its conditions.
fn is_empty(region: &Region, problem: &Problem, sketch: &Sketch) -> bool {
    let stated = problem.regions.iter().position(|r| r.name == region.name);
    let own = stated.and_then(|k| sketch.regions[k]);
    let conditions: Vec<Id> = sketch.condition.into_iter().chain(own).collect();
    if conditions.is_empty() {
        return false;
    }
    let input = (region.sample)(&mut Draw::new(1, "study", region.name, 0));
    let mut evaluator = sketch.evaluator();
    set(&mut evaluator, &input);
    !conditions.iter().all(|id| evaluator.holds(*id) == Ok(true))
}

/// The middle of the domain and its corners, where the condition admits them.
fn check_points(ranges: &[Range], filter: &Filter, format: Format) -> Vec<CheckPoint> {
    let middle = |r: &Range| match (r.is_bounded, r.spacing) {
        (false, _) => 1f64.clamp(r.low, r.high),
        (true, Spacing::Linear) => 0.5 * r.low + 0.5 * r.high,
        (true, Spacing::Log) => {
            let size =
                (r.low.abs().max(f64::MIN_POSITIVE).sqrt() * r.high.abs().sqrt()).copysign(r.high);
            size.clamp(r.low, r.high)
        }
    };
    let all: [(&'static str, Vec<f64>); 3] = [
        ("middle", ranges.iter().map(middle).collect()),
        ("low-corner", ranges.iter().map(|r| r.low).collect()),
        ("high-corner", ranges.iter().map(|r| r.high).collect()),
    ];
    let mut evaluator = filter.evaluator();
    let mut found: Vec<CheckPoint> = Vec::new();
    for (name, input) in all {
        let input = input.into_iter().map(|x| format.representable(x));
        let input: Vec<f64> = input.collect();
        let is_new = found.iter().all(|c| c.input != input);
        if is_new && filter.admits(&mut evaluator, &input) {
            found.push(CheckPoint { name, input });
        }
    }
    found
}

/// Inputs next to where a condition flips or a difference changes its sign.
fn beside_flips(sketch: &Sketch, filter: &Filter, ranges: &[Range]) -> Vec<Vec<f64>> {
    let outputs = sketch.outputs.iter().chain(&sketch.condition);
    let roots: Vec<Id> = outputs
        .chain(sketch.regions.iter().flatten())
        .copied()
        .collect();
    let mut found = Vec::new();
    let wanted = |node| matches!(node, Node::Compare(..) | Node::Sub(..));
    let nodes = nodes(sketch.graph(), &roots, wanted);
    flips(&nodes, &mut sketch.evaluator(), ranges, PAIRS, |flip| {
        let [from, to] = flip.places;
        for k in [from - 1, from, to, to + 1] {
            let input = flip.at(k);
            let holds = ranges[flip.axis].holds(input[flip.axis]);
            if holds && filter.admits(&mut filter.evaluator(), &input) {
                found.push(input);
            }
        }
        found.len() < MOST
    });
    found
}

/// Pairs of neighbouring inputs between which a condition of a solver flips.
pub(super) fn seams(
    problem: &Problem,
    sketch: &Arc<Sketch>,
    solver: &FloatSolver,
) -> Vec<[Vec<f64>; 2]> {
    /// Pairs of inputs between which a flip is sought, for each condition.
    const PAIRS: u64 = 150;
    let ranges: Vec<Range> = problem
        .inputs
        .iter()
        .map(|input| Range::of(input, Format::Double))
        .collect();
    let (graph, roots) = solver.graph();
    let nodes = nodes(graph, roots, |node| matches!(node, Node::Compare(..)));
    let mut found = Vec::new();
    if ranges.is_empty() {
        return found;
    }
    flips(&nodes, &mut solver.evaluator(), &ranges, PAIRS, |flip| {
        let both = flip.places.map(|k| flip.at(k));
        if both.iter().all(|input| admits(problem, sketch, input)) {
            found.push(both);
        }
        true
    });
    found
}

/// The nodes of a kind that roots depend on and that have values of their own.
fn nodes(graph: &Graph, roots: &[Id], wanted: impl Fn(Node) -> bool) -> Vec<Id> {
    let mut seen = vec![false; graph.len()];
    let mut nodes = Vec::new();
    for root in roots {
        for id in graph.reach(*root) {
            let wanted = wanted(graph.node(id));
            // A node that depends on a bound variable has no value of its own.
            let is_free = (0..graph.binders() as u32).all(|b| !graph.depends_on(id, b));
            if wanted && is_free && !std::mem::replace(&mut seen[id as usize], true) {
                nodes.push(id);
            }
        }
    }
    nodes
}

/// Neighbouring inputs that differ in one of them, with different truths of a condition or signs of
/// a difference.
struct Flip {
    input: Vec<f64>,
    axis: usize,
    /// The places of both in the order of the numbers.
    places: [i128; 2],
}

impl Flip {
    /// The input with the number at a place.
    fn at(&self, place: i128) -> Vec<f64> {
        let mut input = self.input.clone();
        input[self.axis] = unordered(place);
        input
    }
}

/// Calls `f` with flips of nodes, until it returns false.
fn flips(
    nodes: &[Id],
    evaluator: &mut Evaluator<Floating>,
    ranges: &[Range],
    pairs: u64,
    mut f: impl FnMut(&Flip) -> bool,
) {
    let graph = evaluator.graph().clone();
    for &id in nodes {
        for pair in 0..pairs {
            let mut d = Draw::new(pair, "flips", "", id.into());
            let axis = d.integer(0, ranges.len() - 1);
            let mut low: Vec<f64> = ranges.iter().map(|r| r.draw(&mut d)).collect();
            let mut high = low.clone();
            let ends = [ranges[axis].magnitudes(&mut d), ranges[axis].draw(&mut d)];
            (low[axis], high[axis]) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let mut side = |input: &[f64]| -> Option<bool> {
                set(evaluator, input);
                match graph.node(id) {
                    Node::Compare(..) => evaluator.holds(id).ok(),
                    _ => Some(evaluator.value(id).ok()?.real()? > 0.0),
                }
            };
            let (Some(a), Some(b)) = (side(&low), side(&high)) else {
                continue;
            };
            if a == b {
                continue;
            }
            // Bisects in the order of the numbers.
            let (mut from, mut to) = (order(low[axis]), order(high[axis]));
            while to - from > 1 {
                let middle = from + (to - from) / 2;
                let mut input = low.clone();
                input[axis] = unordered(middle);
                match side(&input) {
                    Some(s) if s == a => from = middle,
                    Some(_) => to = middle,
                    None => break,
                }
            }
            let flip = Flip {
                input: low,
                axis,
                places: [from, to],
            };
            if !f(&flip) {
                return;
            }
        }
    }
}

/// The place of a number in the order of all.
fn order(x: f64) -> i128 {
    let bits = i128::from(x.to_bits() & !(1 << 63));
    if x.is_sign_negative() { -bits } else { bits }
}

/// The number at a place.
fn unordered(place: i128) -> f64 {
    let x = f64::from_bits(place.unsigned_abs() as u64);
    if place < 0 { -x } else { x }
}

/// Returns true if an input lies in the ranges and satisfies the condition.
pub(super) fn admits(problem: &Problem, sketch: &Arc<Sketch>, input: &[f64]) -> bool {
    let within = problem.given().iter().zip(input).all(|(i, x)| {
        let Some(x) = rug::Rational::from_f64(*x) else {
            return false;
        };
        i.from.as_ref().is_none_or(|from| *from <= x) && i.to.as_ref().is_none_or(|to| x <= *to)
    });
    let filter = Filter {
        sketch: sketch.clone(),
        conditions: sketch.condition.into_iter().collect(),
    };
    within && input.len() == problem.given().len() && filter.admits(&mut filter.evaluator(), input)
}
