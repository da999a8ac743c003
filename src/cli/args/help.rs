//! Help texts: examples within the width of a terminal, and the columns of what a command prints.

use mechaudit::report::glossary;

/// Columns of a terminal.
const WIDTH: usize = 80;

/// The grammar with its help texts as they are shown: only then it is time to write them.
pub fn explained(grammar: clap::Command) -> clap::Command {
    let whole = |command: clap::Command| match command.get_after_help() {
        Some(examples) => {
            let examples = examples.to_string();
            let shown = text(&examples, topics(command.get_name()));
            command.after_help(shown)
        }
        None => command,
    };
    whole(grammar).mut_subcommands(whole)
}

/// The topics whose columns a command prints.
fn topics(command: &str) -> &'static [&'static str] {
    match command {
        "audit" => &["audit"],
        "campaign" => &["audit", "campaign"],
        "chirp" => &["history", "chart", "spectrum"],
        "compare" => &["compare"],
        "converge" => &["converge"],
        "describe" => &["describe"],
        "hunt" => &["hunt"],
        "judge" => &["audit", "judge"],
        "linkage" => &["linkage"],
        "paper" => &["paper"],
        "prove" => &["prove"],
        "regenerate" => &["values"],
        "runup" => &["runup", "work-precision"],
        _ => &[],
    }
}

/// The text with its examples broken into lines that fit, and the columns of these topics after it.
fn text(examples: &str, topics: &[&str]) -> String {
    let lines = examples.lines().map(|line| match line.starts_with("  ") {
        true => fitted(line),
        // Prose is wrapped by the parser.
        false => line.into(),
    });
    glossary::help(&lines.collect::<Vec<_>>().join("\n"), topics)
}

/// An example as lines that fit: a comment goes on below itself, a command after a backslash.
fn fitted(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return line.into();
    }
    let comment = line.find(" # ").map(|k| (k + 1, "# "));
    let words = line
        .trim_start()
        .rfind("  ")
        .map(|k| line.len() - line.trim_start().len() + k + 2);
    let comment = comment.filter(|c| c.0 > 2);
    let (from, mark) = match (comment, words) {
        (Some((from, mark)), _) => (from + mark.len(), mark),
        (None, Some(from)) => (from, ""),
        (None, None) => return continued(line),
    };
    let column = line[..from].chars().count() - mark.len();
    // A line that continues a comment line is a comment too.
    let start = if line.starts_with("  # ") { "  #" } else { "" };
    let indent = format!("{start:<column$}{mark}");
    let mut out = line[..from].to_string();
    let mut at = width(&out);
    for (k, word) in line[from..]
        .split(' ')
        .filter(|w| !w.is_empty())
        .enumerate()
    {
        if k > 0 && at + 1 + width(word) > WIDTH {
            out.push_str(&format!("\n{indent}"));
            at = width(&indent);
        } else if k > 0 {
            out.push(' ');
            at += 1;
        }
        out.push_str(word);
        at += width(word);
    }
    out
}

fn width(text: &str) -> usize {
    text.chars().count()
}

/// A command whose options go on in the next line.
fn continued(line: &str) -> String {
    let mut out = Vec::new();
    let mut rest = line.to_string();
    while rest.chars().count() > WIDTH {
        let breaks = [" --", " | ", " > "];
        let places = breaks
            .iter()
            .flat_map(|b| rest.match_indices(b))
            .map(|m| m.0);
        let place = places
            .filter(|k| rest[..*k].chars().count() <= WIDTH - 2 && *k > 6)
            .max();
        let Some(place) = place else { break };
        out.push(format!("{} \\", &rest[..place]));
        rest = format!("      {}", rest[place..].trim_start());
    }
    out.push(rest);
    out.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_are_too_long_go_on_below() {
        let blanks = " ".repeat(20);
        for (line, due) in [
            (
                format!("  law = 1{blanks}# {}", "word ".repeat(12).trim_end()),
                format!(
                    "  law = 1{blanks}# {}\n{:29}# word word",
                    "word ".repeat(10).trim_end(),
                    ""
                ),
            ),
            (
                format!("  mechaudit list{blanks}{}", "word ".repeat(10).trim_end()),
                format!(
                    "  mechaudit list{blanks}{}\n{:36}word",
                    "word ".repeat(9).trim_end(),
                    ""
                ),
            ),
            (
                format!("  mechaudit audit erf --box 'a --b' {} --seed 7", "--case 1 ".repeat(5).trim_end()),
                "  mechaudit audit erf --box 'a --b' --case 1 --case 1 --case 1 --case 1 \\\n      --case 1 --seed 7".into(),
            ),
        ] {
            let found = fitted(&line);
            assert_eq!(found, due);
            assert!(found.lines().all(|l| l.chars().count() <= WIDTH));
        }
    }
}
