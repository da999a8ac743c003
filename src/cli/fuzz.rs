//! The readers of the command line with text of any kind: a value or a line that says why not.

use crate::cli::args::Args;
use crate::cli::failure::Failure;
use crate::cli::{
    commands::chirp, commands::eval, commands::judge::published, commands::runup, process::wire,
};
use clap::Parser;
use mechaudit::machine::{Linkage, Source};
use mechaudit::methods::registry;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::io::{BufReader, Cursor, Write};

fn cases(quick: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|n| n.parse().ok());
    let usual = ProptestConfig::default();
    ProptestConfig {
        cases: asked.unwrap_or(quick),
        failure_persistence: None,
        // The same cases every time, unless more are asked for.
        rng_seed: match asked {
            Some(_) => usual.rng_seed,
            None => RngSeed::Fixed(1),
        },
        ..usual
    }
}

const FIELDS: &[&str] = &[
    "0",
    "1",
    "-2.5",
    "1e-310",
    "1e400",
    "1e-100000",
    "-1e99999",
    "1e100001",
    "0x1p-3",
    "-0x1.8p+1023",
    "0x1p-1080",
    "0x1p350000",
    "inf",
    "-inf",
    "nan",
    "27.3",
    "745.2",
    "1e16",
    "é",
    "",
    " ",
    "x",
    "#",
    "1e-2147483648",
    "0x1p-9223372036854775808",
];

fn line() -> impl Strategy<Value = Vec<u8>> {
    let field = prop_oneof![
        6 => prop::sample::select(FIELDS).prop_map(String::from),
        2 => any::<u64>().prop_map(|b| format!("{:e}", f64::from_bits(b))),
        1 => "\\PC{0,6}",
    ];
    prop_oneof![
        8 => prop::collection::vec(field, 1..4).prop_map(|f| f.join(",").into_bytes()),
        1 => prop::collection::vec(any::<u8>(), 0..20),
    ]
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn lines_of_eval(
        lines in prop::collection::vec(line(), 0..4), which in 0..registry().len(),
        digits in prop::option::of(1u32..40), end: bool,
    ) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let mut text = lines.join(&b'\n');
        if end {
            text.push(b'\n');
        }
        let mut out = Vec::new();
        let input = BufReader::new(Cursor::new(text));
        let methods = registry();
        let method = &*methods[which];
        let evaluation = eval::Evaluation::new(method, digits);
        let answered = eval::stream(&evaluation, &pool, input, &mut out);
        if let Err(Failure::Message(why) | Failure::Caused(why, _)) = answered {
            prop_assert!(why.starts_with("line ") && !why.contains('\n'), "{}", why);
        }
    }
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn lines_of_points_and_judge(lines in prop::collection::vec(prop_oneof![
        line(), Just(b"refuse".to_vec()), Just(b"refuse: singular".to_vec()), Just(b"# region x".to_vec()),
    ], 0..6)) {
        let mut read = wire::Lines::new(Cursor::new(lines.join(&b'\n')));
        while let Some(line) = read.read_any().expect("memory") {
            let _ = (line.comment().map(str::len), line.is_blank(), line.answer());
            if let Err(Failure::Message(why) | Failure::Caused(why, _)) = line.input() {
                prop_assert!(why.starts_with("inputs, line"), "{}", why);
            }
        }
    }

    #[test]
    fn tables_of_values(
        header in prop::sample::select(vec!["x,y", "Re z,Im z,Re W,Im W", "Re W", "Re W,Re W", "", "a [m],Re W [1]"]),
        lines in prop::collection::vec(line(), 0..5),
    ) {
        let method = mechaudit::methods::find("faddeeva").expect("in the registry");
        let text = [header.as_bytes(), b"\n", &lines.join(&b'\n')].concat();
        if let Err(why) = published::read(&*method, Cursor::new(text)) {
            prop_assert!(!why.to_string().is_empty());
        }
    }
}

/// The files that come with the program.
const FILES: [(&str, &str); 12] = [
    ("toml", include_str!("../../examples/sand-screen.toml")),
    ("toml", include_str!("../../examples/four-bar.toml")),
    ("toml", include_str!("../../examples/slider-crank.toml")),
    ("json", include_str!("../../examples/sand-screen.json")),
    ("toml", include_str!("../../examples/no-full-turn.toml")),
    ("toml", include_str!("../../examples/unassemblable.toml")),
    (
        "toml",
        include_str!("../../examples/sand-screen-run-up.toml"),
    ),
    (
        "toml",
        include_str!("../../examples/sand-screen-rotor.toml"),
    ),
    ("toml", include_str!("../../examples/four-bar-run-up.toml")),
    ("toml", include_str!("../../examples/chirp-chart.toml")),
    ("toml", include_str!("../../examples/chirp-run-down.toml")),
    ("toml", include_str!("../../examples/chirp-run-up.toml")),
];

/// The change made to a file.
#[derive(Clone, Debug)]
enum Change {
    /// A number becomes another.
    Number(prop::sample::Index, &'static str),
    /// A line goes, or comes twice, or changes places with the next.
    Line(prop::sample::Index, u8),
    /// A word becomes another word of the file.
    Word(prop::sample::Index, prop::sample::Index),
    /// A character becomes another.
    Character(prop::sample::Index, char),
    /// The rest is missing.
    Cut(prop::sample::Index),
}

fn change() -> impl Strategy<Value = Change> {
    let at = any::<prop::sample::Index>;
    let numbers: &'static [&'static str] = &[
        "0",
        "-1",
        "1e-300",
        "1e308",
        "1e400",
        "1e-400",
        "1e99999",
        "-0",
        "nan",
        "inf",
        "1e-2147483648",
        "99999999999999999999",
        "4",
        "3 cm",
        "2 rad/s^9",
        "7 m^4 m^4",
        "0.5 rev",
        "1 /",
    ];
    prop_oneof![
        6 => (at(), prop::sample::select(numbers)).prop_map(|(k, n)| Change::Number(k, n)),
        3 => (at(), 0u8..3).prop_map(|(k, how)| Change::Line(k, how)),
        2 => (at(), at()).prop_map(|(a, b)| Change::Word(a, b)),
        2 => (at(), any::<char>()).prop_map(|(k, c)| Change::Character(k, c)),
        1 => at().prop_map(Change::Cut),
    ]
}

/// The places of the numbers in a text.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let part = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let mut found: Vec<(usize, usize)> = Vec::new();
    for (i, c) in text.char_indices().filter(|&(_, c)| part(c)) {
        match found.last_mut() {
            Some(last) if last.1 == i => last.1 += c.len_utf8(),
            _ => found.push((i, i + c.len_utf8())),
        }
    }
    found
}

impl Change {
    fn apply(&self, text: &str) -> String {
        let mut lines: Vec<&str> = text.lines().collect();
        match self {
            Change::Number(k, to) => {
                let places = numbers(text);
                if places.is_empty() {
                    return text.into();
                }
                let (start, end) = *k.get(&places);
                [&text[..start], to, &text[end..]].concat()
            }
            _ if lines.is_empty() => text.into(),
            Change::Line(k, how) => {
                let k = k.index(lines.len());
                match how {
                    0 => drop(lines.remove(k)),
                    1 => lines.insert(k, lines[k]),
                    _ => lines.swap(k, (k + 1) % text.lines().count()),
                }
                lines.join("\n")
            }
            Change::Word(a, b) => {
                let words: Vec<&str> = text.split_whitespace().collect();
                match words.is_empty() {
                    true => text.into(),
                    false => {
                        text.replacen(words[a.index(words.len())], words[b.index(words.len())], 1)
                    }
                }
            }
            Change::Character(k, c) => {
                let mut all: Vec<char> = text.chars().collect();
                let k = k.index(all.len().max(1));
                if let Some(old) = all.get_mut(k) {
                    *old = *c;
                }
                all.into_iter().collect()
            }
            Change::Cut(k) => text
                .chars()
                .take(k.index(text.chars().count().max(1)))
                .collect(),
        }
    }
}

fn args(command: &str, path: &str) -> crate::cli::args::Command {
    let parsed = Args::try_parse_from(["mechaudit", command, path]);
    parsed.expect("arguments").command.expect("a command")
}

fn one_line(failure: Failure) {
    if !matches!(failure, Failure::ClosedPipe) {
        let why = failure.to_string();
        assert!(!why.is_empty() && !why.contains('\n'), "{why:?}");
    }
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn files_of_machines(file in 0..FILES.len(), changes in prop::collection::vec(change(), 0..5)) {
        use crate::cli::args::Command;
        let (kind, text) = FILES[file];
        let text = changes.iter().fold(text.to_string(), |text, change| change.apply(&text));
        let source = match kind {
            "json" => Source::json(text.as_str()),
            _ => Source::toml(text.as_str()),
        };
        if let Err(why) = Linkage::read(&source) {
            let why = why.to_string();
            prop_assert!(!why.is_empty() && !why.contains('\n'), "{:?}", why);
        }
        let suffix = format!(".{kind}");
        let mut file = tempfile::Builder::new().suffix(&suffix).tempfile().expect("a file");
        file.write_all(text.as_bytes()).expect("written");
        let path = file.path().to_str().expect("a name").to_string();
        if let Command::Runup(a) = args("runup", &path)
            && let Err(f) = runup::machine(&a)
        {
            one_line(f);
        }
        if let Command::Chirp(a) = args("chirp", &path)
            && let Err(f) = chirp::machine(&a)
        {
            one_line(f);
        }
    }
}

#[test]
fn unchanged_files_are_read() {
    for (kind, text) in &FILES[..8] {
        let source = match *kind {
            "json" => Source::json(*text),
            _ => Source::toml(*text),
        };
        assert!(Linkage::read(&source).is_ok());
    }
}
