//! What a run of very many cases will take, said before it begins; one that cannot end is refused.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::process::wire;
use mechaudit::audit::{Cases, Method, Settings, audit_case};
use std::time::{Duration, Instant};

/// Random cases of a region that are run without asking what they take.
const FEW: u64 = 10_000;
/// Cases tried, and how long at most.
const TRIED: usize = 64;
const TRIAL: Duration = Duration::from_millis(50);
/// Seconds and bytes from which on they are said.
const LONG: f64 = 600.0;
const LARGE: f64 = 1e9;
/// Seconds and bytes that are refused.
const ENDLESS: f64 = 30.0 * DAY;
const TOO_LARGE: f64 = 1e12;

const DAY: f64 = 86_400.0;

/// Looks ahead at an audit of these methods on all cores.
pub fn audit(methods: &[&dyn Method], settings: &Settings) -> Result<(), Failure> {
    if settings.cases_per_region <= FEW {
        return Ok(());
    }
    let (mut count, mut seconds) = (0.0, 0.0);
    for method in methods {
        let cases = Cases::new(*method, settings);
        let total = cases.len() as f64;
        count += total;
        seconds += total * each(*method, &cases, settings);
    }
    let what = format!("{count:.2e} cases take about {}", time(seconds));
    judged(&what, seconds)
}

/// Looks ahead at a hunt of so many evaluations.
pub fn hunt(method: &dyn Method, evaluations: u64) -> Result<(), Failure> {
    if evaluations <= FEW {
        return Ok(());
    }
    let settings = Settings::default();
    let cases = Cases::new(method, &settings);
    let count = evaluations as f64;
    let seconds = count * each(method, &cases, &settings);
    let what = format!("{count:.2e} evaluations take about {}", time(seconds));
    judged(&what, seconds)
}

/// Seconds for a case on all cores.
fn each(method: &dyn Method, cases: &Cases, settings: &Settings) -> f64 {
    let start = Instant::now();
    let tried = sample(cases, TRIAL, |i| {
        drop(audit_case(method, cases.get(i), settings));
    });
    start.elapsed().as_secs_f64() / tried / rayon::current_num_threads() as f64
}

fn judged(what: &str, seconds: f64) -> Result<(), Failure> {
    if is_worth_saying(what, seconds, 0.0)? {
        let cores = rayon::current_num_threads();
        complain(&format!(
            "{what} on {cores} cores; memory grows by some 2 kB for each failing case alone"
        ));
    }
    Ok(())
}

/// Whether what takes so many seconds and bytes is told; what cannot end is refused.
fn is_worth_saying(what: &str, seconds: f64, bytes: f64) -> Result<bool, Failure> {
    match seconds > ENDLESS || bytes > TOO_LARGE {
        true => Err(refused(what)),
        false => Ok(seconds > LONG || bytes > LARGE),
    }
}

/// Looks ahead at the inputs of a method as lines.
pub fn points(cases: &Cases, decimal: bool) -> Result<(), Failure> {
    let [seconds, bytes] = of_lines(cases, decimal, TRIAL);
    let count = cases.len() as f64;
    let what = format!(
        "{count:.2e} inputs are {bytes:.2e} bytes and take about {}",
        time(seconds)
    );
    if is_worth_saying(&what, seconds, bytes)? {
        complain(&what);
    }
    Ok(())
}

/// Seconds and bytes of all lines, by those of some that are tried so long at most.
fn of_lines(cases: &Cases, decimal: bool, trial: Duration) -> [f64; 2] {
    let (start, mut bytes) = (Instant::now(), 0);
    let tried = sample(cases, trial, |i| {
        bytes += wire::line(&cases.get(i).input, decimal).len() + 1;
    });
    let each = cases.len() as f64 / tried;
    [each * start.elapsed().as_secs_f64(), each * bytes as f64]
}

/// Tries cases from all over the run; how many.
fn sample(cases: &Cases, trial: Duration, mut run: impl FnMut(usize)) -> f64 {
    let (start, total) = (Instant::now(), cases.len());
    let step = (total / TRIED).max(1);
    let mut tried = 0;
    while tried < TRIED.min(total) && start.elapsed() < trial {
        run(tried * step);
        tried += 1;
    }
    tried.max(1) as f64
}

fn refused(what: &str) -> Failure {
    let days = ENDLESS / DAY;
    Failure::new(format!(
        "{what}; more than {days} days or {TOO_LARGE:.0e} bytes are refused: take fewer"
    ))
}

/// Seconds in words.
fn time(seconds: f64) -> String {
    let (count, unit) = match seconds {
        s if s < 120.0 => (s, "seconds"),
        s if s < 7200.0 => (s / 60.0, "minutes"),
        s if s < 2.0 * DAY => (s / 3600.0, "hours"),
        s if s < 730.0 * DAY => (s / DAY, "days"),
        s => (s / 365.25 / DAY, "years"),
    };
    match count {
        c if c < 1e4 => format!("{c:.0} {unit}"),
        c => format!("{c:.1e} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::methods;

    #[test]
    fn times_in_words() {
        for (seconds, due) in [
            (30.0, "30 seconds"),
            (600.0, "10 minutes"),
            (36_000.0, "10 hours"),
            (864_000.0, "10 days"),
            (1e12, "3.2e4 years"),
        ] {
            assert_eq!(time(seconds), due);
        }
    }

    #[test]
    fn what_cannot_end_is_refused() {
        let method = methods::find("slider-crank").expect("in the registry");
        let settings = |cases_per_region| Settings {
            cases_per_region,
            ..Settings::default()
        };
        assert!(audit(&[&*method], &settings(200)).is_ok());
        assert!(audit(&[&*method], &settings(20_000)).is_ok());
        assert!(hunt(&*method, 20_000).is_ok());
        assert!(hunt(&*method, u64::MAX).is_err());
        for endless in [99_999_999_999_999, u64::MAX] {
            let settings = settings(endless);
            let Err(Failure::Message(why)) = audit(&[&*method], &settings) else {
                panic!("{endless} cases are begun");
            };
            assert!(why.contains("years; more than 30 days"), "{why}");
            let cases = Cases::new(&*method, &settings);
            assert!(points(&cases, false).is_err());
        }
    }

    /// Of few inputs every line is tried: they are as many bytes as are written.
    #[test]
    fn lines_are_measured() {
        let method = methods::find("slider-crank").expect("in the registry");
        let settings = Settings {
            cases_per_region: 2,
            ..Settings::default()
        };
        let cases = Cases::new(&*method, &settings);
        assert!(cases.len() < TRIED);
        for decimal in [false, true] {
            let lines = (0..cases.len()).map(|i| wire::line(&cases.get(i).input, decimal) + "\n");
            let [seconds, bytes] = of_lines(&cases, decimal, Duration::MAX);
            assert_eq!(bytes, lines.collect::<String>().len() as f64);
            assert!(seconds > 0.0);
        }
    }

    #[test]
    fn what_is_long_or_large_is_told() {
        let said = |seconds: f64, bytes: f64| is_worth_saying("it", seconds, bytes).ok();
        for (seconds, bytes, due) in [
            (LONG, LARGE, Some(false)),
            (LONG.next_up(), 0.0, Some(true)),
            (0.0, LARGE.next_up(), Some(true)),
            (ENDLESS, TOO_LARGE, Some(true)),
            (ENDLESS.next_up(), 0.0, None),
            (0.0, TOO_LARGE.next_up(), None),
        ] {
            assert_eq!(said(seconds, bytes), due, "{seconds} s, {bytes} bytes");
        }
    }
}
