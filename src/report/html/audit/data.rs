//! The data of the page's script: cases by number, and who refers to them.

use super::encoded::Map;
use super::whole::Whole;
use crate::audit::{Case, CaseReport, Layout, Limit, MethodReport, Point};
use crate::report::words::audit::of_case;
use serde::Serialize;
use serde_json::Value;
use std::collections::HashMap;

/// Sampled points of a page over all methods.
const POINTS: usize = 1200;
/// Cases of a page, over all methods, with all that is known of them, in addition to the worst.
const WHOLE: usize = 300;
/// Numbers of an input that are kept for every case, and those of an input or an answer for a whole
/// case: on pages of few methods, and of many.
const NUMBERS: [(usize, usize); 2] = [(8, 24), (4, 12)];
/// The number of methods up to which a page has few.
const FEW: usize = 3;

/// The page's data.
#[derive(Serialize)]
pub struct Data<'a> {
    methods: Vec<OfMethod<'a>>,
}

#[derive(Serialize)]
struct OfMethod<'a> {
    name: &'a str,
    /// The parts of a case's command before its place and after it.
    command: [&'a str; 2],
    /// Regions whose cases lie beside something that a map can show.
    marks: Vec<(&'static str, Vec<usize>)>,
    inputs: &'a [(&'static str, usize)],
    outputs: Vec<OfOutput<'a>>,
    points: Vec<OfPoint>,
    map: Option<Map<'a>>,
    #[serde(flatten)]
    book: Book,
    #[serde(skip)]
    worst: Vec<(Option<usize>, Vec<Option<usize>>)>,
}

#[derive(Serialize)]
struct OfOutput<'a> {
    name: &'a str,
    /// The budget, if it is one in ulps.
    limit: Option<f64>,
    /// Exponent, count, worst case.
    octaves: Vec<(Option<i32>, u64, usize)>,
    wrong: u64,
}

/// Case, verdict's tone, inputs to plot against where the case has them not, ulps of each output.
#[derive(Serialize)]
struct OfPoint(usize, &'static str, Vec<Option<f64>>, Vec<Option<f64>>);

/// Region, number of the place's beginning, its last word, input if it is short, number of the
/// whole case.
#[derive(Serialize)]
struct Entry(usize, usize, String, Vec<Value>, Option<usize>);

/// Each case once.
#[derive(Serialize)]
struct Book {
    cases: Vec<Entry>,
    /// Beginnings of places, which many cases share.
    heads: Vec<String>,
    whole: Vec<Whole>,
    #[serde(skip)]
    numbers: HashMap<String, usize>,
    regions: Vec<String>,
    #[serde(skip)]
    most: (usize, usize),
    #[serde(skip)]
    layout: Layout,
}

impl Book {
    fn new(report: &MethodReport, most: (usize, usize)) -> Book {
        Book {
            most,
            regions: report.regions.iter().map(|r| r.name.to_string()).collect(),
            layout: report.layout.clone(),
            cases: Vec::new(),
            heads: Vec::new(),
            whole: Vec::new(),
            numbers: HashMap::new(),
        }
    }

    fn number(&mut self, case: &Case) -> usize {
        let place = case.place();
        if let Some(known) = self.numbers.get(&place) {
            return *known;
        }
        let (head, last) = place.rsplit_once(' ').unwrap_or(("", &place));
        let heads = self.heads.iter().position(|h| h == head);
        let head = heads.unwrap_or_else(|| {
            self.heads.push(head.to_string());
            self.heads.len() - 1
        });
        let region = self.regions.iter().position(|r| r == case.region);
        let region = region.unwrap_or_else(|| {
            self.regions.push(case.region.to_string());
            self.regions.len() - 1
        });
        let input = match case.input.len() <= self.most.0 {
            true => case.input.iter().map(number).collect(),
            false => Vec::new(),
        };
        self.cases
            .push(Entry(region, head, last.to_string(), input, None));
        self.numbers.insert(place, self.cases.len() - 1);
        self.cases.len() - 1
    }

    fn add(&mut self, report: &CaseReport) {
        let number = self.number(&report.case);
        if self.cases[number].4.is_none() {
            self.cases[number].4 = Some(self.whole.len());
            self.whole
                .push(Whole::of(report, &self.layout, self.most.1));
        }
    }
}

/// JSON has no infinities.
fn number(x: &f64) -> Value {
    match x.is_finite() {
        true => (*x).into(),
        false => format!("{x:?}").into(),
    }
}

/// Three significant digits.
fn rounded(x: f64) -> Option<f64> {
    let x = x.is_finite().then(|| format!("{x:.2e}"))?;
    x.parse().ok()
}

impl<'a> Data<'a> {
    /// Of these reports; with fewer sampled points each, the more there are.
    pub fn of(reports: &[(&'a str, &'a MethodReport)]) -> Data<'a> {
        let regions: usize = reports.iter().map(|r| r.1.regions.len()).sum();
        let points = (POINTS / regions.max(1)).max(3);
        let whole = WHOLE / reports.len().max(1);
        let most = NUMBERS[usize::from(reports.len() > FEW)];
        let methods = reports
            .iter()
            .map(|(name, r)| of_method(name, r, points, whole, most));
        Data {
            methods: methods.collect(),
        }
    }

    /// The number of the worst case of a region.
    pub fn worst_of(&self, method: usize, region: usize) -> Option<usize> {
        self.methods[method].worst.get(region)?.0
    }

    /// The number of the worst case of an output in a region.
    pub fn worst_of_output(&self, method: usize, region: usize, output: usize) -> Option<usize> {
        *self.methods[method].worst.get(region)?.1.get(output)?
    }

    /// The number of a case that the data hold.
    pub fn place_of(&self, method: usize, case: &Case) -> Option<usize> {
        self.methods[method]
            .book
            .numbers
            .get(&case.place())
            .copied()
    }
}

fn of_method<'a>(
    name: &'a str,
    r: &'a MethodReport,
    points: usize,
    whole: usize,
    most: (usize, usize),
) -> OfMethod<'a> {
    let mut book = Book::new(r, most);
    for c in r
        .wrong
        .iter()
        .chain(&r.worst)
        .chain(r.failures.iter().take(whole))
    {
        book.add(c);
    }
    let worst = r.regions.iter().map(|region| {
        let own = region.worst.as_ref().map(|c| book.number(c));
        let each = region.outputs.iter();
        let each = each.map(|o| o.worst.as_ref().map(|c| book.number(c)));
        (own, each.collect())
    });
    let worst = worst.collect();
    let outputs = r.outputs().iter().enumerate().map(|(k, o)| OfOutput {
        name: o.name,
        limit: match r.budgets.get(k).map(|b| b.budget.limit) {
            Some(Limit::Ulps(n)) => Some(n),
            _ => None,
        },
        octaves: o
            .histogram
            .iter()
            .map(|b| (b.exponent, b.count, book.number(&b.worst)))
            .collect(),
        wrong: o.kinds.total(),
    });
    let outputs = outputs.collect();
    let points = thinned(&r.points, points).map(|p| {
        let case = book.number(&p.case);
        let short = p.case.input.len() <= most.0;
        let along = r.inputs.iter().filter(|_| !short);
        OfPoint(
            case,
            crate::report::html::page::class(of_case(p.verdict).1),
            along.map(|(_, k)| p.case.input.get(*k).copied()).collect(),
            p.ulps.iter().map(|u| rounded(*u)).collect(),
        )
    });
    let points = points.collect();
    let beside = |word: &'static str| -> (&'static str, Vec<usize>) {
        let regions = r.regions.iter().enumerate();
        let those = regions.filter(|(_, region)| region.name.contains(word));
        (word, those.map(|(k, _)| k).collect())
    };
    OfMethod {
        name,
        command: [&r.reproduce.head, &r.reproduce.tail],
        marks: ["zero", "seam"]
            .map(beside)
            .into_iter()
            .filter(|m| !m.1.is_empty())
            .collect(),
        inputs: &r.inputs,
        outputs,
        points,
        map: r.map.as_ref().map(|m| Map::of(m, r.method)),
        book,
        worst,
    }
}

/// At most `most` of each region, in their order.
fn thinned(points: &[Point], most: usize) -> impl Iterator<Item = &Point> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    points.iter().filter(move |p| {
        let n = seen.entry(p.case.region).or_default();
        *n += 1;
        *n <= most
    })
}

#[cfg(test)]
mod tests;
