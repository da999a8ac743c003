//! Runs of the program, and checks of its output.

use sha2::{Digest, Sha256};
use std::io::Write;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

/// The program, in the folder of the sources.
pub fn program() -> Command {
    let mut c = Command::new(env!("CARGO_BIN_EXE_mechaudit"));
    c.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    c.env_remove("MECHAUDIT_EFFORT");
    c
}

/// The result of a run.
pub struct Done {
    pub code: i32,
    pub out: String,
    pub err: String,
}

pub fn done(o: Output) -> Done {
    let err = String::from_utf8(o.stderr).expect("UTF-8");
    err.lines().for_each(well_said);
    Done {
        code: o.status.code().expect("no signal"),
        out: String::from_utf8(o.stdout).expect("UTF-8"),
        err,
    }
}

/// No message says anything twice or writes out rows of zeros, whatever the test is about.
pub fn well_said(line: &str) {
    let said = line.strip_prefix("mechaudit: ").unwrap_or(line);
    let parts: Vec<&str> = said.split(": ").collect();
    for pair in parts.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        // Formulas and single words may well occur again.
        let is_word = |w: &str| w.len() > 1 && w.chars().all(char::is_alphabetic);
        let words = |s: &str| s.split(' ').filter(|w| is_word(w)).count();
        let within = |a: &str, b: &str| words(a) > 1 && b.contains(a);
        let twice = within(a, b) || within(b, a);
        assert!(!twice, "it says {a:?} and {b:?}: {line}");
        let begin = |s: &str| s.split(' ').take(3).collect::<Vec<_>>().join(" ");
        let same = begin(a) == begin(b) && words(&begin(a)) == 3;
        assert!(!same, "two parts begin alike: {line}");
    }
    assert!(!line.contains(&"0".repeat(25)), "{line}");
}

pub fn run(args: &[&str]) -> Done {
    done(program().args(args).output().unwrap())
}

/// Writes a file of the folder; its path.
pub fn file(folder: &TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().into()
}

/// Arguments without blanks in them.
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// A run as it is typed.
pub fn command(line: &str) -> Done {
    run(&words(line))
}

/// `part` stands on stderr.
pub fn said(d: &Done, part: &str) {
    assert!(d.err.contains(part), "{part:?} is missing in {}", d.err);
}

/// Begins a run with pipes on all three sides.
pub fn start(args: &[&str]) -> Child {
    program()
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// A run that is given `input` on its standard input.
pub fn run_on(input: impl AsRef<[u8]>, args: &[&str]) -> Done {
    let mut child = start(args);
    let mut stdin = child.stdin.take().unwrap();
    let input = input.as_ref();
    let output = std::thread::scope(|s| {
        // A refusal closes the pipe early.
        s.spawn(move || stdin.write_all(input).is_ok());
        child.wait_with_output().unwrap()
    });
    done(output)
}

/// One line on stderr that says `part`, nothing on stdout, exit code 2.
pub fn refused(d: &Done, part: &str) {
    assert_eq!(d.code, 2, "{}{}", d.out, d.err);
    assert_eq!(d.err.lines().count(), 1, "{}", d.err);
    assert!(d.err.starts_with("mechaudit: "), "{}", d.err);
    said(d, part);
    assert_eq!(d.out, "");
    assert!(!d.err.contains("panicked"));
}

/// An example with its first `from` made `to`.
pub fn changed(text: &str, from: &str, to: &str) -> String {
    let new = text.replacen(from, to, 1);
    assert_ne!(new, text, "{from:?} is not in the example");
    new
}

/// A table as text, its cells between bars; `\n` in a cell ends a line.
pub fn cells<const N: usize>(table: &str) -> impl Iterator<Item = [String; N]> {
    let lines = table.lines().filter(|l| !l.trim().is_empty());
    lines.map(|line| {
        let cells: Vec<String> = line
            .split('|')
            .map(|c| c.trim().replace("\\n", "\n"))
            .collect();
        cells.try_into().expect(line)
    })
}

/// Names and rows of a table.
pub fn csv(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let split = |l: &str| l.split(',').map(String::from).collect::<Vec<_>>();
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let head = split(lines.next().expect("a header"));
    let rows: Vec<Vec<String>> = lines.map(split).collect();
    assert!(rows.iter().all(|r| r.len() == head.len()));
    (head, rows)
}

/// A column as written.
pub fn texts(table: &str, name: &str) -> Vec<String> {
    let (head, rows) = csv(table);
    let k = head.iter().position(|h| h == name).expect(name);
    rows.into_iter().map(|mut r| r.swap_remove(k)).collect()
}

/// A column of numbers.
pub fn column(table: &str, name: &str) -> Vec<f64> {
    let texts = texts(table, name);
    texts.iter().map(|t| t.parse().expect("a number")).collect()
}

/// The names of all files of a folder.
pub fn names(folder: &Path) -> Vec<String> {
    let mut all: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    all.sort();
    all
}

/// Says on the terminal itself that something is missing.
pub fn skipped(what: &str) {
    let _ = writeln!(std::io::stderr(), "SKIPPED: {what} is not installed");
}

/// A path as an argument.
pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A drawing that is whole: named and described, dark on dark pages, its curves to hundredths of a
/// pixel. Returns the points of its curves.
pub fn drawing(svg: &str) -> Vec<Vec<(f64, f64)>> {
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(!svg.contains("NaN") && !svg.contains("inf,") && !svg.contains(",inf"));
    for part in ["<title>", "<desc>", "prefers-color-scheme: dark"] {
        assert!(svg.contains(part), "{part} is missing");
    }
    let lines = svg.split("points=\"").skip(1);
    let lines = lines.map(|l| l.split('"').next().unwrap().split_whitespace());
    let hundredths = |n: &str| n.split_once('.').is_some_and(|(_, d)| d.len() == 2);
    // Axes and strokes of a legend have two.
    lines
        .map(Iterator::collect::<Vec<_>>)
        .filter(|l| l.len() > 2)
        .map(|line| {
            let point = |p: &str| {
                let (x, y) = p.split_once(',').expect("a point");
                assert!(hundredths(x) && hundredths(y), "{p}");
                (x.parse().unwrap(), y.parse().unwrap())
            };
            line.into_iter().map(point).collect()
        })
        .collect()
}

/// The page as a browser without a network makes it out, if there is one.
pub fn browsed(path: &Path, width: u32) -> Option<String> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let there = |name: &&&str| {
        let started = Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        started.is_ok_and(|s| s.success())
    };
    let Some(name) = names.iter().find(there) else {
        let _ = writeln!(std::io::stderr(), "SKIPPED: chromium is not installed");
        return None;
    };
    let profile = tempfile::tempdir().unwrap();
    let mut browser = Command::new(name);
    browser.args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
    ]);
    browser.args([
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
    ]);
    browser.arg(format!("--user-data-dir={}", profile.path().display()));
    browser.arg(format!("--window-size={width},1000"));
    browser.args(["--dump-dom", &format!("file://{}", path.display())]);
    let output = browser.stderr(Stdio::null()).output().unwrap();
    Some(String::from_utf8(output.stdout).unwrap())
}

/// A page without its scripts and styles.
pub fn markup(page: &str) -> String {
    let mut out = String::new();
    let mut rest = page;
    while let Some(at) = rest
        .find("<script")
        .into_iter()
        .chain(rest.find("<style"))
        .min()
    {
        let end = match rest[at..].starts_with("<script") {
            true => "</script>",
            false => "</style>",
        };
        let length = rest[at..].find(end).expect("an end");
        let opening = rest[at..].split('>').next().unwrap();
        assert!(!opening.contains("src"), "{opening}");
        out.push_str(&rest[..at]);
        rest = &rest[at + length + end.len()..];
    }
    out + rest
}

/// Nothing is fetched: by its policy a page may not, and no part of it asks for anything.
pub fn needs_nothing_else(page: &str) {
    assert!(page.contains("default-src 'none'"), "no policy");
    let markup = markup(page)
        .replace("http-equiv", "")
        .replace("http://www.w3.org/", "");
    for outside in ["<link", "<img", "src=", "url(", "@import", "http"] {
        assert!(!markup.contains(outside), "{outside}");
    }
}

/// Returns true if programs started here ignore a signal: the hang-up under `nohup`, the interrupt
/// in the background of a shell.
#[cfg(target_os = "linux")]
pub fn is_ignored(signal: &str) -> bool {
    let number = match signal {
        "-HUP" => 1,
        "-INT" => 2,
        _ => return false,
    };
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = u64::from_str_radix(mask.unwrap().trim(), 16).unwrap();
    mask >> (number - 1) & 1 == 1
}

/// Size and the first digits of SHA-256.
pub fn digest(bytes: impl AsRef<[u8]>) -> String {
    let (bytes, mut short) = (bytes.as_ref(), String::new());
    for byte in &Sha256::digest(bytes)[..4] {
        short += &format!("{byte:02x}");
    }
    format!("{} {short}", bytes.len())
}

/// Compares a text with `snapshots/NAME.snap`.
pub fn pin(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}
