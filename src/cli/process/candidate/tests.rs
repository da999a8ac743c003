use super::*;
use mechaudit::audit::{Cases, Origin};
use mechaudit::campaign::Stride;
use mechaudit::methods;
use std::path::Path;
use std::sync::Mutex;

fn method() -> Box<dyn Method> {
    methods::find("erf").unwrap()
}

/// erf 0 = 0: an answer that is right at this case.
fn zero() -> Case {
    Case {
        method: "erf",
        region: "given",
        input: vec![0.0, 0.0],
        origin: Origin::Given,
    }
}

/// A shell script as a candidate that may be silent for `seconds`.
fn spoken(script: &str, seconds: f64) -> Candidate {
    Candidate {
        command: shell(script),
        folder: None,
        timeout: Duration::from_secs_f64(seconds),
        run_timeout: Duration::from_secs(3600),
        form: Form::Lines,
        decimal: false,
        lines: AnswerLines::default(),
    }
}

fn shell(script: &str) -> String {
    format!("sh -c {}", shell_words::quote(script))
}

fn of(script: &str, settings: &Settings, seconds: f64) -> MethodReport {
    let method = method();
    audit(&*method, None, &spoken(script, seconds), settings).unwrap()
}

fn few(cases_per_region: u64) -> Settings {
    Settings {
        cases_per_region,
        ..Settings::default()
    }
}

fn trouble(report: &MethodReport) -> Option<String> {
    report.candidate.as_ref().unwrap().trouble.clone()
}

#[test]
fn one_input_is_judged() {
    let method = method();
    let judged = |script: &str| {
        let one = Some(zero());
        let report = audit(&*method, one, &spoken(script, 20.0), &few(1)).unwrap();
        let candidate = report.candidate.clone().unwrap();
        (report.cases, report.passed, candidate)
    };
    let right = "echo '# name: w'; echo '# version: 2'; read x; echo 0,0";
    let (cases, passed, candidate) = judged(right);
    assert_eq!((cases, passed), (1, 1));
    let (name, version) = (candidate.name.as_str(), candidate.version.as_deref());
    assert_eq!((name, version), ("w", Some("2")));
    assert_eq!((candidate.answered, candidate.trouble), (1, None));
    assert_eq!(candidate.command, Some(shell(right)));
    let wrong = "read x; echo 1,0";
    let (cases, passed, candidate) = judged(wrong);
    assert_eq!((cases, passed), (1, 0));
    assert_eq!((candidate.name, candidate.version), (shell(wrong), None));
}

/// One sentence gives the reason for the end of a program and the number of its answers.
#[test]
fn what_went_wrong_is_said() {
    let settings = few(1);
    let n = Cases::new(&*method(), &settings).len();
    let all = "while read x; do echo refuse; done";
    let left = |k: usize| format!("; {} of {n} inputs are unanswered", n - k);
    for (script, answered, why) in [
        (all.to_string(), n, None),
        (
            format!("{all}; exit 3"),
            n,
            Some("ended: exit status 3".to_string()),
        ),
        (
            format!("{all}; kill -9 $$"),
            n,
            Some("ended: killed by signal 9".into()),
        ),
        (
            format!("{all}; echo refuse"),
            n,
            Some("wrote one more line than there are inputs".into()),
        ),
        (
            "read x; echo refuse; read x; echo refuse".into(),
            2,
            Some(format!(
                "it ended its output, with exit status 0{}",
                left(2)
            )),
        ),
        (
            "read x; echo refuse; exit 7".into(),
            1,
            Some(format!("ended: exit status 7{}", left(1))),
        ),
    ] {
        let report = of(&script, &settings, 20.0);
        assert_eq!(report.cases, n as u64, "{script}");
        assert_eq!(report.candidate.as_ref().unwrap().answered, answered as u64);
        let due = why.map(|why| format!("The program answered {answered} times, then {why}."));
        assert_eq!(trouble(&report), due, "{script}");
    }
}

#[test]
fn a_program_that_is_silent_or_stays_is_given_up() {
    let settings = few(1);
    let n = Cases::new(&*method(), &settings).len();
    let start = Instant::now();
    let silent = of("read x; echo refuse; exec sleep 100", &settings, 0.5);
    let due = format!(
        "The program answered 1 times, then wrote no line for 0.5 s and was ended; {} of {n} inputs are unanswered.",
        n - 1
    );
    assert_eq!(trouble(&silent), Some(due));
    let stays = "while read x; do echo refuse; done; exec >&-; exec sleep 100";
    let due = format!(
        "The program answered {n} times, then ended its output but not itself within 0.5 s."
    );
    assert_eq!(trouble(&of(stays, &settings, 0.5)), Some(due));
    assert!(start.elapsed() < Duration::from_secs(50));
}

/// Those without an answer count where they belong, and the first of them is a case to look at.
#[test]
fn unanswered_inputs_are_counted_in_their_regions() {
    let (method, settings) = (method(), few(5));
    let inputs = Inputs::of(&*method, None, &settings).unwrap();
    let total = inputs.len();
    let counted = |from: usize| {
        let mut tally = Tally::new(&*method, &settings);
        unanswered(&*method, &settings, &inputs, from, "it ended", &mut tally);
        tally.finish(&*method)
    };
    for from in [0, 3, total - 7, total - 1] {
        let report = counted(from);
        assert_eq!(report.cases, (total - from) as u64, "{from}");
        assert_eq!(report.passed, 0);
        let cases = Cases::new(&*method, &settings);
        for region in &report.regions {
            let there = (from..total).filter(|i| cases.get(*i).region == region.name);
            assert_eq!(region.cases, there.count() as u64, "{from} {}", region.name);
        }
        let [first] = report.wrong.as_slice() else {
            panic!("{} cases to look at", report.wrong.len());
        };
        let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&first.case.input), bits(&cases.get(from).input));
    }
    for from in [total, total + 1] {
        assert_eq!(counted(from).cases, 0, "{from}");
    }
}

/// The inputs of a run as a program is shown them, from the first to the last and round again.
#[test]
fn a_program_is_shown_every_input() {
    let (method, settings) = (method(), few(20));
    let inputs = Inputs::of(&*method, None, &settings).unwrap();
    let n = inputs.len();
    assert!(n > SHOWN);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("seen");
    let shown = |total: usize, decimal: bool, binary: bool| {
        let path = file.to_str().unwrap();
        let script = format!("cat > {path}; echo $MECHAUDIT_PROTOCOL > {path}.how");
        let candidate = Candidate {
            decimal,
            form: if binary { Form::Frames } else { Form::Lines },
            ..spoken(&script, 20.0)
        };
        let mut process = CandidateProcess::start(&candidate, &inputs, total).unwrap();
        let mut batch = Batch::default();
        let end = process.collect(total, &mut batch);
        assert!(matches!(end, Some(End::Closed)) && batch.is_empty());
        process.end(End::Closed);
        let how = std::fs::read_to_string(folder.path().join("seen.how")).unwrap();
        assert_eq!(how.trim(), if binary { "binary" } else { "text" });
        std::fs::read(&file).unwrap()
    };
    let cases = Cases::new(&*method, &settings);
    for total in [1, SHOWN, n, 2 * n + 3] {
        let all = (0..total).map(|i| cases.get(i % n).input);
        for decimal in [false, true] {
            let due: String = all
                .clone()
                .map(|x| wire::line(&x, decimal) + "\n")
                .collect();
            let seen = String::from_utf8(shown(total, decimal, false)).unwrap();
            assert_eq!(seen, due, "{total} {decimal}");
        }
        let mut due = Vec::new();
        all.for_each(|x| frames::encode(&x, &mut due));
        assert_eq!(shown(total, false, true), due, "{total}");
    }
}

#[test]
fn as_many_answers_are_collected_as_are_expected() {
    let inputs = Arc::new(Inputs::listed(vec![zero(); 7]));
    let candidate = spoken("while read x; do echo 0,0; done", 20.0);
    let start = || CandidateProcess::start(&candidate, &inputs, 7).unwrap();
    let mut process = start();
    let mut batch = Batch::default();
    assert!(process.collect(2, &mut batch).is_none());
    assert_eq!((batch.len(), process.answered()), (2, 2));
    assert!(process.collect(4, &mut batch).is_none());
    assert_eq!((batch.len(), process.answered()), (6, 6));
    assert!(process.collect(1, &mut batch).is_none());
    assert!(matches!(process.rest(), End::Closed));
    assert_eq!(process.end(End::Closed), None);
    let report = process.report(Some("why".into()));
    assert_eq!((report.answered, report.trouble), (7, Some("why".into())));
    let mut process = start();
    let said = process.end(End::Interrupted);
    let due = "Interrupted: the program had answered 0 of 7 inputs.";
    assert_eq!(said.as_deref(), Some(due));
    let why = std::io::Error::other("gone");
    let mut process = start();
    let said = process.end(End::Unreadable(why)).unwrap();
    let due = "The program answered 0 times, then its output could not be read: gone; 7 of 7 inputs are unanswered.";
    assert_eq!(said, due);
}

/// Of a shard the inputs dealt to it alone, and nothing in place of what did not come.
#[test]
fn a_shard_is_gathered() {
    let (method, settings) = (method(), few(300));
    let total = Cases::new(&*method, &settings).len() as u64;
    let stride = Stride {
        first: 1,
        step: 2,
        end: total,
    };
    let gathered = |script: &str| {
        let panel = Panel::lean(&*method, &settings);
        let inputs = Inputs::dealt(Cases::new(&*method, &settings), stride);
        let told = Mutex::new(Vec::new());
        let tell = |n: u64| told.lock().unwrap().push(n);
        let report = gather(&panel, inputs, &spoken(script, 20.0), &tell);
        let report = report.unwrap().expect("nobody has asked to stop");
        let cases = panel.into_tally().finish(&*method).cases;
        (report, cases, told.into_inner().unwrap())
    };
    assert!(stride.len() > BATCH as u64);
    let (report, cases, told) = gathered("while read x; do echo refuse; done");
    assert_eq!((report.trouble, report.answered), (None, stride.len()));
    assert_eq!(cases, stride.len());
    assert_eq!(told.iter().sum::<u64>(), stride.len());
    assert_eq!(told[0], BATCH as u64);
    let (report, cases, told) = gathered("read x; echo refuse; exit 1");
    let due = format!(
        "The program answered 1 times, then ended: exit status 1; {} of {} inputs are unanswered.",
        stride.len() - 1,
        stride.len()
    );
    assert_eq!((report.trouble, cases), (Some(due), 1));
    assert_eq!(told.iter().sum::<u64>(), 1);
}

#[test]
fn what_cannot_be_started_is_said() {
    let inputs = Arc::new(Inputs::listed(vec![zero()]));
    for (command, why) in [
        ("", "--exec needs a command"),
        ("/no/such/program", "cannot start \"/no/such/program\": "),
        ("'open", "--exec \"'open\": "),
    ] {
        let candidate = Candidate {
            command: command.into(),
            ..spoken("", 1.0)
        };
        let Err(failure) = CandidateProcess::start(&candidate, &inputs, 1) else {
            panic!("{command} is started");
        };
        assert!(failure.to_string().starts_with(why), "{failure}");
    }
    assert!(!Path::new("/no/such/program").exists());
}

/// A program that goes on answering, each line in time, is ended when the time for all of them is
/// over; what it has answered is judged.
#[test]
fn the_whole_run_has_a_bound() {
    let method = method();
    let slow = "while read -r line; do echo 0x1p0,0x0p0; sleep 0.2; done";
    let candidate = Candidate {
        run_timeout: Duration::from_secs_f64(1.5),
        ..spoken(slow, 60.0)
    };
    let start = Instant::now();
    let report = audit(&*method, None, &candidate, &few(100)).unwrap();
    assert!(start.elapsed() < Duration::from_secs(30));
    let why = trouble(&report).unwrap();
    assert!(
        why.contains("its 1.5 s were over and it was ended (--run-timeout); "),
        "{why}"
    );
    let answered = report.candidate.as_ref().unwrap().answered;
    assert!(answered > 0 && report.cases > answered, "{why}");
    let unanswered = report.total.kinds[mechaudit::audit::Kind::Unanswered];
    assert_eq!(unanswered + answered, report.cases, "{why}");
}
