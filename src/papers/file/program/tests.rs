//! Claims about programs that a planted runner answers for.

use super::*;
use crate::papers::FindingVerdict;
use crate::papers::file::PaperFile;
use std::sync::atomic::{AtomicUsize, Ordering};

const STUDY: &str = "[inputs]\nx = { from = 1, to = 3 }\n[outputs]\n\
                     y = { is = '2*x', budget = '1 ulp', why = 'a test' }\n";

/// Answers as the first word of the command says; counts the inputs that it is asked for.
#[derive(Debug)]
struct Planted(AtomicUsize);

impl Programs for Planted {
    fn answers(
        &self,
        program: &Program,
        method: &dyn Method,
        inputs: &[Vec<f64>],
    ) -> (Vec<SolverAnswer>, Option<String>) {
        assert!(program.folder.join("paper.toml").exists());
        assert_eq!(method.outputs().len(), 1);
        self.0.fetch_add(inputs.len(), Ordering::Relaxed);
        let factor = match program.command[0].as_str() {
            "double" => 2.0,
            "near" => 2.0 + 1e-9,
            _ => return (Vec::new(), Some("it is broken".into())),
        };
        let answer = |x: &Vec<f64>| SolverAnswer::Values(vec![factor * x[0]]);
        (inputs.iter().map(answer).collect(), None)
    }
}

fn open(text: &str) -> Result<PaperFile, StudyError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), STUDY).unwrap();
    std::fs::write(folder.path().join("paper.toml"), text).unwrap();
    let file = PaperFile::open(folder.path())?;
    // It is looked at while it runs.
    std::mem::forget(folder);
    Ok(file)
}

fn paper(command: &str, rest: &str) -> PaperFile {
    let text = format!(
        "title = 'T'\n[solver.p]\nstudy = 's.toml'\nexec = ['{command}']\n\
         [[accuracy]]\nid = 'a'\nplace = 'p'\nclaims = 'c'\nsolver = 'p'\n{rest}"
    );
    open(&text).unwrap()
}

/// The verdict, and the inputs that the program was asked for.
fn decided(command: &str, rest: &str) -> (FindingVerdict, usize) {
    let file = paper(command, rest);
    assert!(file.run_by(None).is_err());
    let by: &'static Planted = Box::leak(Box::new(Planted(AtomicUsize::new(0))));
    file.run_by(Some(by)).unwrap();
    let report = file.report(&|_, _, _| {}).unwrap();
    (report.findings[0].verdict, by.0.load(Ordering::Relaxed))
}

#[test]
fn claims_about_programs_are_decided_as_those_about_formulas() {
    use FindingVerdict::{Confirmed, Refuted, Unexplained};
    let (verdict, asked) = decided("double", "bound = '1e-15'\ncases = 100");
    assert_eq!(verdict, Confirmed);
    // Those of the audit and at most as many evaluations as the hunt makes.
    assert!((100..=400).contains(&asked), "{asked}");
    assert_eq!(decided("near", "bound = '1e-8'").0, Confirmed);
    assert_eq!(decided("near", "bound = '1e-10'").0, Refuted);
    assert_eq!(
        decided("near", "bound = '1e-10'\nat = { x = 2 }"),
        (Refuted, 1)
    );
    assert_eq!(
        decided("near", "bound = '1e-8'\nstatistic = 'mean'").0,
        Confirmed
    );
    assert_eq!(
        decided("near", "bound = '1e-10'\nstatistic = 'mean'").0,
        Refuted
    );
    // No answer is no pass.
    assert_eq!(decided("broken", "bound = '1'").0, Unexplained);
    let report = paper("double", "bound = '1'")
        .report(&|_, _, _| {})
        .unwrap();
    assert!(!report.findings[0].as_recorded);
}

#[test]
fn a_survey_has_the_heights_of_programs() {
    let survey =
        "bound = '1'\n[[survey]]\nid = 'h'\nstudy = 's.toml'\nalong = 'x'\ntargets = '1e-10'";
    let file = paper("near", survey);
    let by = Box::leak(Box::new(Planted(AtomicUsize::new(0))));
    file.run_by(Some(by)).unwrap();
    let report = file.report(&|_, _, _| {}).unwrap();
    let heights = report.findings.iter().find(|f| f.id == "h").unwrap();
    assert_eq!(heights.figures[0].value, "1e-10: nowhere, nowhere");
}

#[test]
fn programs_are_of_papers_in_folders() {
    let text = |exec: &str| {
        format!(
            "title = 'T'\n[solver.p]\nstudy = 's.toml'\n{exec}\n[[claim]]\nid = 'c'\nplace = 'p'\nclaims = 'c'\nis = '1'\nprinted = '1'"
        )
    };
    for (exec, due) in [
        ("exec = []", "a command has at least one word"),
        ("exec = 'cat'", "list"),
        ("exec = ['cat']\ny = '1'", "there is no key \"y\""),
    ] {
        let fault = open(&text(exec)).unwrap_err().to_string();
        assert!(fault.contains(due), "{exec}: {fault}");
    }
    let texts = [text("exec = ['cat']"), STUDY.to_string()].map(|t| crate::study::intern(&t));
    let texts = vec![("paper.toml", texts[0]), ("s.toml", texts[1])];
    let fault = PaperFile::parse("planted", texts.leak())
        .unwrap_err()
        .to_string();
    assert!(fault.contains("papers in folders"), "{fault}");
}
