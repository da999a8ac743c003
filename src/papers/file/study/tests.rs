//! Tables whose numbers are values of a study or of a machine's motion.

use crate::papers::EntryVerdict;
use crate::papers::file::PaperFile;
use crate::study::{StudyError, intern};

const SWING: &str =
    "[ode.states]\nx = { start = '1', rate = 'v' }\nv = { start = '0', rate = '-x' }";

/// A pendulum of 1 m that falls from the horizontal.
const PENDULUM: &str = r#"
type = "planar"
gravity = "9.81 m/s^2"
[ground]
points = { O = ["0 m", "0 m"] }
[[body]]
name = "bar"
ends = ["O", "A"]
length = "1 m"
mass = "1 kg"
inertia = "0 kg m^2"
centre = ["1 m", "0 m"]
[[joint]]
kind = "pin"
point = "O"
[motion.start]
bar = { at = "0 deg" }
"#;

fn paper(study: &str, table: &str, columns: &str) -> Result<PaperFile, StudyError> {
    let text = format!(
        "title = 'T'\n[[table]]\nnumber = 1\nfile = 't.csv'\nstudy = 's.toml'\ncolumns = {{ {columns} }}"
    );
    let texts = [("paper.toml", &*text), ("s.toml", study), ("t.csv", table)];
    let texts = texts.map(|(name, text)| (name, intern(text)));
    PaperFile::parse("planted", texts.to_vec().leak())
}

/// The rows and columns that do not agree.
fn wrong(study: &str, table: &str, columns: &str) -> Vec<(u32, &'static str)> {
    let report = paper(study, table, columns).unwrap().report(&|_, _, _| {});
    let entries = report.unwrap().entries;
    let off = entries
        .iter()
        .filter(|e| e.variants["as_printed"].verdict != EntryVerdict::Agrees);
    off.map(|e| (e.row, e.column)).collect()
}

/// cos t and its square beside that of the sine.
#[test]
fn columns_are_expressions_of_the_states() {
    let columns = "x = 'x', e = 'x^2 + v^2'";
    let good = "t,x,e\n1,0.5403,1.000\n2,-0.4161,1.00\n";
    assert_eq!(wrong(SWING, good, columns), []);
    let bad = "t,x,e\n1,0.5404,1.000\n2,-0.4161,1.01\n";
    assert_eq!(wrong(SWING, bad, columns), [(1, "x"), (2, "e")]);
}

/// The values at 1 s are those that the benchmark library prints, mirrored.
#[test]
fn a_machine_stands_behind_a_table() {
    let columns = "x = 'cos(theta_bar)', y = 'sin(theta_bar)'";
    let table = "t,x,y\n1,-9.86292E-01,-1.65011E-01\n1,-9.86293E-01,-1.65012E-01\n";
    assert_eq!(wrong(PENDULUM, table, columns), [(2, "x"), (2, "y")]);
}

/// The solution ends at t = 1: a number after that is neither right nor wrong, whatever is on
/// record.
#[test]
fn an_undecided_number_is_never_as_recorded() {
    let blown = "[ode.states]\nx = { start = '1', rate = 'x^2' }";
    let recorded = |table: &str, columns: &str| {
        let file = paper(blown, table, columns).unwrap();
        file.report(&|_, _, _| {}).unwrap().as_recorded()
    };
    let known = "t,x\n0.5,2.000\n0.75,3.999\n";
    assert!(recorded(known, "x = { is = 'x', wrong = [2] }"));
    let open = "t,x\n0.5,2.000\n2,4.000\n";
    for wrong in ["", "2"] {
        assert!(!recorded(
            open,
            &format!("x = {{ is = 'x', wrong = [{wrong}] }}")
        ));
    }
}

#[test]
fn faults_name_the_file_and_the_rule() {
    let table = "t,x\n1,0.5403\n";
    assert!(paper(SWING, table, "x = 'x'").is_ok());
    for (study, table, columns, rule) in [
        (SWING, table, "x = 'y'", "the name y is not declared"),
        (
            SWING,
            "s,x\n1,0.5403\n",
            "x = 'x'",
            "t.csv has no column \"t\"",
        ),
        ("[ode]", table, "x = 'x'", "s.toml: "),
        ("type = 'planar'", table, "x = 'x'", "s.toml: "),
    ] {
        let found = paper(study, table, columns).expect_err(rule).to_string();
        assert!(found.contains(rule), "{found}");
    }
    let text = "title = 'T'\n[[table]]\nnumber = 1\nfile = 't.csv'\nstudy = 's.toml'\ngiven = 't'\ncolumns = { x = 'x' }";
    let texts = vec![("paper.toml", text), ("s.toml", SWING), ("t.csv", table)];
    let found = PaperFile::parse("planted", texts.leak())
        .unwrap_err()
        .to_string();
    assert!(
        found.contains("the inputs of a study are taken as printed"),
        "{found}"
    );
}

/// Of all reference solutions those digits are right that are on record.
#[test]
fn published_motions_are_as_recorded() {
    let folder =
        std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../reference/papers");
    for (paper, entries) in [
        ("iftomm-pendulum", 24),
        ("ivp-test-set", 48),
        ("modelica-multibody", 154),
    ] {
        let file = PaperFile::open(&folder.join(paper)).unwrap();
        let report = file.report(&|_, _, _| {}).unwrap();
        let changed = report.findings.iter().filter(|f| !f.as_recorded);
        let changed: Vec<&str> = changed.map(|f| f.id).collect();
        assert!(changed.is_empty(), "{paper}: {changed:?}");
        assert_eq!(report.entries.len(), entries);
    }
}
