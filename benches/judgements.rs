//! Measures the cost of an audit beside the solver and the certified reference, on one core.
//!
//! `cargo bench --bench judgements [-- METHOD | "METHOD REGION" | "METHOD *"…]`, `*` for each region
//! by itself. Microseconds a case, with the allocator of the program. `owed` is
//! the solver and the reference as the audit asks for it: at every precision until it decides, with
//! condition numbers where a budget needs them. `audited` draws, solves, judges and counts the same
//! cases (the laws are not part of it); `solved`, `drawn`, `judged` and `counted` are parts of
//! that, `judged` with the reference. The parts are interleaved over the rounds of one run; each
//! column has the least of its rounds, in processor time of the thread, because other work on the
//! machine only ever adds. `added` is what `audited` takes over `owed`, in percent.

use mechaudit::audit::{
    Case, CaseReport, Cases, Judge, Method, Panel, Settings, SolverAnswer, Tally, Variant,
    answer_of, judge_case_briefly,
};
use mechaudit::methods;
use rug::Rational;
use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// As in the program.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Methods over all their regions, and W in each.
const WHERE: [&str; 12] = [
    "faddeeva",
    "faddeeva *",
    "erf",
    "erfc",
    "erfcx",
    "dawson",
    "voigt",
    "tridiagonal",
    "cubic-spline-clamped",
    "four-bar",
    "class-iii",
    "chirp-response",
];
const COUNT: u64 = 4000;
const ROUNDS: usize = 7;
const PARTS: [&str; 6] = ["solved", "drawn", "judged", "counted", "owed", "audited"];

/// Of this thread.
fn processor_time() -> Duration {
    let t = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(t.tv_sec as u64, t.tv_nsec as u32)
}

/// A method, the numbers of random cases, and what is done with them.
struct Sample {
    method: Box<dyn Method>,
    settings: Settings,
    cases: Cases,
    numbers: Vec<usize>,
    drawn: Vec<Case>,
    answers: Vec<SolverAnswer>,
    judged: Vec<CaseReport>,
}

impl Sample {
    fn new(place: &str) -> Sample {
        let (name, region) = place.split_once(' ').unwrap_or((place, ""));
        let method = methods::find(name).expect("in the registry");
        let regions = method.domain().regions.into_iter().map(|r| r.name);
        let regions: Vec<_> = regions
            .filter(|r| region.is_empty() || *r == region)
            .collect();
        // One region after another, as an audit goes.
        let settings = Settings {
            cases_per_region: COUNT.div_ceil(regions.len() as u64),
            ..Settings::default()
        };
        let cases = Cases::new(&*method, &settings);
        let mut numbers = Vec::new();
        let mut next = 0;
        while next < cases.len() {
            let (region, end) = cases.region_of(next);
            if regions.contains(&region) {
                numbers.extend(next..end);
            }
            next = end;
        }
        let drawn: Vec<Case> = numbers.iter().map(|i| cases.get(*i)).collect();
        let answers: Vec<_> = (drawn.iter().map(|c| answer_of(&*method, &c.input))).collect();
        let judged = drawn.iter().zip(&answers);
        let judged = judged
            .map(|(c, a)| judge_case_briefly(&*method, c.clone(), a.clone(), &settings))
            .collect();
        Sample {
            method,
            settings,
            cases,
            numbers,
            drawn,
            answers,
            judged,
        }
    }

    fn solve(&self) {
        for case in &self.drawn {
            black_box(answer_of(&*self.method, &case.input));
        }
    }

    fn draw(&self) {
        for i in &self.numbers {
            black_box(self.cases.get(*i));
        }
    }

    fn judge(&self) {
        let judge = Judge::new(&*self.method, &self.settings);
        for (case, answer) in self.drawn.iter().zip(&self.answers) {
            black_box(judge.judge(case.clone(), answer.clone(), false));
        }
    }

    fn count(&self, tally: &mut Tally) {
        self.judged.iter().for_each(|report| tally.add(report));
    }

    fn owe(&self, conditional: bool) {
        for (case, report) in self.drawn.iter().zip(&self.judged) {
            black_box(answer_of(&*self.method, &case.input));
            let exact = case.input.iter().map(|&x| Rational::from_f64(x));
            // Inputs that are not finite owe nothing.
            let Some(exact) = exact.collect::<Option<Vec<_>>>() else {
                continue;
            };
            let mut bits = self.settings.first_bits;
            while bits <= report.bits {
                let reference = self.method.reference(&exact, bits);
                if conditional && bits == self.settings.first_bits {
                    black_box(self.method.conditions_beside(&case.input, &reference));
                }
                black_box(reference);
                bits *= 2;
            }
        }
    }

    fn audit(&self, panel: &Panel) {
        let drawn = |i: u64| self.cases.get(self.numbers[i as usize]);
        let stop = AtomicBool::new(false);
        panel.audit(self.numbers.len() as u64, &drawn, &|_| {}, &stop);
    }

    /// Microseconds a case for each of the parts.
    fn measure(&self) -> [f64; PARTS.len()] {
        let outputs = self.method.outputs();
        let conditional = outputs.iter().any(|o| o.budget.limit.needs_conditions());
        let mut tally = Tally::new(&*self.method, &self.settings);
        // As other code goes: the laws are about the method's own.
        let variant = Variant::new(&*self.method).without_laws();
        let panel = Panel::new(&variant, &self.settings);
        let mut least = [f64::INFINITY; PARTS.len()];
        for _ in 0..ROUNDS {
            for (k, least) in least.iter_mut().enumerate() {
                let start = processor_time();
                match PARTS[k] {
                    "solved" => self.solve(),
                    "drawn" => self.draw(),
                    "judged" => self.judge(),
                    "counted" => self.count(&mut tally),
                    "owed" => self.owe(conditional),
                    _ => self.audit(&panel),
                }
                *least = least.min(
                    (processor_time() - start).as_secs_f64() / self.numbers.len() as f64 * 1e6,
                );
            }
        }
        least
    }
}

fn main() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1);
    let one = one.use_current_thread().build_global();
    one.expect("nothing has run before");
    // Cargo's own options begin with a dash.
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    let mut asked: Vec<&str> = asked.into_iter().filter(|a| !a.starts_with('-')).collect();
    if asked.is_empty() {
        asked = WHERE.to_vec();
    }
    let heads = PARTS.map(|part| format!("{part:>9}")).concat();
    println!("{:<26}{heads}  added", "us a case");
    let each = asked
        .into_iter()
        .flat_map(|place| match place.strip_suffix(" *") {
            Some(name) => {
                let method = methods::find(name).expect("in the registry");
                let regions = method.domain().regions.into_iter();
                regions.map(|r| format!("{name} {}", r.name)).collect()
            }
            None => vec![place.to_string()],
        });
    for place in each {
        let times = Sample::new(&place).measure();
        let [.., owed, audited] = times;
        let cells = times.map(|t| format!("{t:>9.2}")).concat();
        println!("{place:<26}{cells}{:>6.0}%", (audited / owed - 1.0) * 100.0);
    }
}
