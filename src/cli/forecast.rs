//! Estimates of how long a run takes, given before it begins. A run that cannot end is refused.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::process::wire;
use mechaudit::audit::{Cases, Method, Settings, audit_case};
use std::time::{Duration, Instant};

/// The largest number of random cases of a region for which no time is estimated.
const FEW: u64 = 10_000;
/// The number of cases tried, and the longest time for them.
const TRIED: usize = 64;
const TRIAL: Duration = Duration::from_millis(50);
/// Seconds and bytes above which the estimate is printed.
const LONG: f64 = 600.0;
const LARGE: f64 = 1e9;
/// Seconds and bytes above which a run is refused.
const ENDLESS: f64 = 30.0 * DAY;
const TOO_LARGE: f64 = 1e12;

const DAY: f64 = 86_400.0;

/// Checks that an audit of these methods on all cores ends.
pub fn check_workload(methods: &[&dyn Method], settings: &Settings) -> Result<(), Failure> {
    if settings.cases_per_region <= FEW {
        return Ok(());
    }
    let [count, seconds] = sums(methods, settings, &each);
    judged("cases", count, seconds)
}

/// Returns the number of cases of all methods and their seconds, `each` giving those of one case.
fn sums(
    methods: &[&dyn Method],
    settings: &Settings,
    each: &dyn Fn(&dyn Method, &Cases, &Settings) -> f64,
) -> [f64; 2] {
    let (mut count, mut seconds) = (0.0, 0.0);
    for method in methods {
        let cases = Cases::new(*method, settings);
        let total = cases.len() as f64;
        count += total;
        seconds += total * each(*method, &cases, settings);
    }
    [count, seconds]
}

/// Checks that a hunt of that many evaluations ends.
pub fn check_hunt(method: &dyn Method, evaluations: u64) -> Result<(), Failure> {
    if evaluations <= FEW {
        return Ok(());
    }
    let settings = Settings::default();
    let cases = Cases::new(method, &settings);
    let count = evaluations as f64;
    let seconds = count * each(method, &cases, &settings);
    judged("evaluations", count, seconds)
}

/// Returns the seconds for a case on all cores.
fn each(method: &dyn Method, cases: &Cases, settings: &Settings) -> f64 {
    let start = Instant::now();
    let tried = sample(cases, TRIAL, |i| {
        drop(audit_case(method, cases.get(i), settings));
    });
    let seconds = start.elapsed().as_secs_f64();
    share(seconds, tried, rayon::current_num_threads())
}

/// Returns the seconds of a case on all cores, from those of `tried` cases on one core.
fn share(seconds: f64, tried: f64, cores: usize) -> f64 {
    seconds / tried / cores as f64
}

fn judged(of: &str, count: f64, seconds: f64) -> Result<(), Failure> {
    let what = format!("{count:.2e} {of} take about {}", time(seconds));
    if is_worth_saying(&what, seconds, 0.0)? {
        let cores = rayon::current_num_threads();
        complain(&format!(
            "{what} on {cores} cores; memory grows by some 2 kB for each failing case alone"
        ));
    }
    Ok(())
}

/// Returns true if the estimate is to be printed; refuses a run that cannot end.
fn is_worth_saying(what: &str, seconds: f64, bytes: f64) -> Result<bool, Failure> {
    match seconds > ENDLESS || bytes > TOO_LARGE {
        true => Err(refused(what)),
        false => Ok(seconds > LONG || bytes > LARGE),
    }
}

/// Checks that the lines of a method's inputs are not too many.
pub fn check_points(cases: &Cases, decimal: bool) -> Result<(), Failure> {
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

/// Returns the seconds and bytes of all lines, estimated from some that are tried for `trial` at
/// most.
fn of_lines(cases: &Cases, decimal: bool, trial: Duration) -> [f64; 2] {
    let (start, mut bytes) = (Instant::now(), 0);
    let tried = sample(cases, trial, |i| {
        bytes += wire::line(&cases.get(i).input, decimal).len() + 1;
    });
    let each = cases.len() as f64 / tried;
    [each * start.elapsed().as_secs_f64(), each * bytes as f64]
}

/// Tries cases from all over the run and returns their number.
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

/// Checks that work of that many seconds, measured on a part of it, ends.
pub fn check_duration(what: &str, seconds: f64) -> Result<(), Failure> {
    let what = format!("{what} take about {}", time(seconds));
    if is_worth_saying(&what, seconds, 0.0)? {
        complain(&what);
    }
    Ok(())
}

/// Formats seconds in words.
pub fn time(seconds: f64) -> String {
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
            (119.9, "120 seconds"),
            (120.0, "2 minutes"),
            (600.0, "10 minutes"),
            (7199.0, "120 minutes"),
            (7200.0, "2 hours"),
            (36_000.0, "10 hours"),
            (172_799.0, "48 hours"),
            (172_800.0, "2 days"),
            (864_000.0, "10 days"),
            (729.0 * 86_400.0, "729 days"),
            (730.5 * 86_400.0, "2 years"),
            (9999.0 * 365.25 * 86_400.0, "9999 years"),
            (1e4 * 365.25 * 86_400.0, "1.0e4 years"),
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
        assert!(check_workload(&[&*method], &settings(200)).is_ok());
        assert!(check_workload(&[&*method], &settings(20_000)).is_ok());
        assert!(check_hunt(&*method, 20_000).is_ok());
        assert!(check_hunt(&*method, u64::MAX).is_err());
        for endless in [99_999_999_999_999, u64::MAX] {
            let settings = settings(endless);
            let Err(Failure::Message(why)) = check_workload(&[&*method], &settings) else {
                panic!("{endless} cases are begun");
            };
            assert!(why.contains("years; more than 30 days"), "{why}");
            let cases = Cases::new(&*method, &settings);
            assert!(check_points(&cases, false).is_err());
        }
    }

    /// The message counts the cases of all methods together.
    #[test]
    fn what_is_refused_is_counted() {
        let methods = ["slider-crank", "erf"].map(|m| methods::find(m).expect("in the registry"));
        let [one, other] = methods.each_ref().map(|m| &**m);
        let settings = Settings {
            cases_per_region: 10_000_000_000_000,
            ..Settings::default()
        };
        let count = |m: &dyn Method| Cases::new(m, &settings).len() as f64;
        let refused = |found: Result<(), Failure>| match found {
            Err(Failure::Message(why)) => why,
            _ => panic!("it is begun"),
        };
        let all = count(one) + count(other);
        let why = refused(check_workload(&[one, other], &settings));
        assert!(
            why.starts_with(&format!("{all:.2e} cases take about ")),
            "{why}"
        );
        let end = "; more than 30 days or 1e12 bytes are refused: take fewer";
        assert!(why.ends_with(end), "{why}");
        let why = refused(check_hunt(one, 3_000_000_000_000_000_000));
        assert!(why.starts_with("3.00e18 evaluations take about "), "{why}");
        let why = refused(check_points(&Cases::new(other, &settings), true));
        let head = format!("{:.2e} inputs are ", count(other));
        assert!(
            why.starts_with(&head) && why.contains(" bytes and take about "),
            "{why}"
        );
    }

    #[test]
    fn work_that_cannot_end_is_refused() {
        assert!(check_duration("they", LONG).is_ok() && check_duration("they", ENDLESS).is_ok());
        let why = check_duration("9 points", 1e9).unwrap_err().to_string();
        assert!(
            why.starts_with("9 points take about 32 years; more than 30 days"),
            "{why}"
        );
    }

    /// As many as are run without a word are not even tried; of one more, a few are.
    #[test]
    fn few_cases_are_not_asked() {
        use mechaudit::audit::{SolverAnswer, Variant};
        use std::sync::atomic::{AtomicUsize, Ordering};
        assert_eq!(FEW, 10_000);
        let method = methods::find("slider-crank").expect("in the registry");
        let asked = AtomicUsize::new(0);
        let solver = |_: &[f64]| {
            asked.fetch_add(1, Ordering::Relaxed);
            SolverAnswer::Declines(None)
        };
        let counted = Variant::new(&*method).solver(solver);
        let settings = |cases_per_region| Settings {
            cases_per_region,
            ..Settings::default()
        };
        assert!(
            check_workload(&[&counted], &settings(FEW)).is_ok()
                && check_hunt(&counted, FEW).is_ok()
        );
        assert_eq!(asked.swap(0, Ordering::Relaxed), 0);
        assert!(check_workload(&[&counted], &settings(FEW + 1)).is_ok());
        let tried = asked.swap(0, Ordering::Relaxed);
        assert!(tried > 0 && tried <= TRIED, "{tried}");
        assert!(check_hunt(&counted, FEW + 1).is_ok());
        assert!(asked.load(Ordering::Relaxed) > 0);
    }

    #[test]
    fn seconds_are_those_of_all_cases() {
        let methods = ["slider-crank", "erf"].map(|m| methods::find(m).expect("in the registry"));
        let [one, other] = methods.each_ref().map(|m| &**m);
        let settings = Settings {
            cases_per_region: 3,
            ..Settings::default()
        };
        let counts = [one, other].map(|m| Cases::new(m, &settings).len() as f64);
        let each = |m: &dyn Method, cases: &Cases, _: &Settings| {
            assert_eq!(cases.len(), Cases::new(m, &settings).len());
            if m.name() == "erf" { 0.5 } else { 4.0 }
        };
        let due = [counts[0] + counts[1], 4.0 * counts[0] + 0.5 * counts[1]];
        assert_eq!(sums(&[one, other], &settings, &each), due);
        assert_eq!(sums(&[], &settings, &each), [0.0, 0.0]);
    }

    #[test]
    fn a_case_takes_its_share_of_all_cores() {
        assert_eq!(share(12.0, 3.0, 2), 2.0);
        assert_eq!(share(0.5, 1.0, 1), 0.5);
    }

    /// Cases all over the run are tried, as many as there is time for.
    #[test]
    fn cases_are_tried_from_the_first_on() {
        let method = methods::find("slider-crank").expect("in the registry");
        let tried = |cases_per_region: u64, trial: Duration| {
            let settings = Settings {
                cases_per_region,
                ..Settings::default()
            };
            let cases = Cases::new(&*method, &settings);
            let mut seen = Vec::new();
            let count = sample(&cases, trial, |i| seen.push(i));
            (cases.len(), count, seen)
        };
        let (total, count, seen) = tried(1, Duration::MAX);
        assert!(total < TRIED && count == total as f64);
        assert!(seen.into_iter().eq(0..total));
        let (total, count, seen) = tried(1000, Duration::MAX);
        assert_eq!(count, 64.0);
        assert!(seen.into_iter().eq((0..64).map(|k| k * (total / 64))));
        let (_, count, seen) = tried(1000, Duration::ZERO);
        assert!(count == 1.0 && seen.is_empty());
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
            let start = Instant::now();
            let [seconds, bytes] = of_lines(&cases, decimal, Duration::MAX);
            assert_eq!(bytes, lines.collect::<String>().len() as f64);
            assert!(0.0 < seconds && seconds <= start.elapsed().as_secs_f64());
        }
        // Of many, some stand for all.
        let settings = Settings {
            cases_per_region: 1000,
            ..Settings::default()
        };
        let cases = Cases::new(&*method, &settings);
        let step = cases.len() / TRIED;
        let tried = (0..TRIED).map(|k| wire::line(&cases.get(k * step).input, true).len() + 1);
        let due = tried.sum::<usize>() as f64 * cases.len() as f64 / TRIED as f64;
        let start = Instant::now();
        let [seconds, bytes] = of_lines(&cases, true, Duration::MAX);
        assert!((bytes / due - 1.0).abs() < 1e-12, "{bytes} for {due}");
        let each = cases.len() as f64 / TRIED as f64;
        assert!(seconds <= each * start.elapsed().as_secs_f64());
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
