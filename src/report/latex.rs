//! A ledger as a LaTeX document.

use super::words::ledger::{counts, search, word};
use crate::papers::ledger::{Formula, Ledger, LedgerEntry};

/// Plain text with the characters that mean something in LaTeX written out, and the mathematical
/// characters of notes in math mode.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(c);
            }
            '~' => out.push_str(r"\textasciitilde{}"),
            '^' => out.push_str(r"\textasciicircum{}"),
            '\\' => out.push_str(r"\textbackslash{}"),
            c => out.push(c),
        }
    }
    out
}

/// The document; for LuaLaTeX or XeLaTeX, because notes have Greek letters in text.
pub fn ledger(ledger: &Ledger) -> String {
    let p = &ledger.paper;
    let mut out = format!(
        "% Ledger of {}; lualatex or xelatex.\n\\documentclass[a4paper]{{article}}\n\
         \\usepackage{{amsmath,fontspec}}\n\\setmainfont{{DejaVu Serif}}\n\
         \\usepackage[margin=2cm]{{geometry}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\
         \\section*{{{}}}\n{}. {}\n",
        p.key,
        escape(p.title),
        escape(p.authors),
        escape(&counts(ledger))
    );
    ledger.entries.iter().for_each(|e| out.push_str(&entry(e)));
    out.push_str("\\end{document}\n");
    out
}

fn shown(caption: &str, f: &Formula) -> String {
    format!("\\noindent {caption}\n\\[ {} \\]\n", f.latex)
}

fn entry(e: &LedgerEntry) -> String {
    let mut out = format!(
        "\n\\subsection*{{{} \\normalfont\\small [{}]}}\n{}\n\n",
        escape(e.place),
        e.verdict.words(),
        escape(e.claim)
    );
    if let Some(f) = &e.printed {
        let caption = if e.composed {
            "Of corrected parts:"
        } else {
            "Printed:"
        };
        out.push_str(&shown(caption, f));
    }
    if let Some(f) = &e.corrected {
        out.push_str(&shown("Corrected:", f));
    }
    if let Some(r) = &e.repair {
        out.push_str(&format!("{}\n\n", escape(&search(r))));
    }
    for o in &e.obligations {
        let mut outcome = word(o.printed).to_string();
        if let Some(c) = o.corrected {
            outcome.push_str(&format!(" as printed, {} as corrected", word(c)));
        }
        out.push_str(&shown(&format!("Requirement ({outcome}):"), &o.formula));
    }
    if !e.note.is_empty() {
        out.push_str(&format!("{}\n", escape(e.note)));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::ledger::tests::fabricated;

    #[test]
    fn the_document_is_balanced() {
        let tex = ledger(&fabricated());
        assert!(tex.contains(r"\begin{document}") && tex.trim_end().ends_with(r"\end{document}"));
        assert_eq!(tex.matches(r"\[").count(), tex.matches(r"\]").count());
        let plain = tex.replace(r"\{", "").replace(r"\}", "");
        assert_eq!(plain.matches('{').count(), plain.matches('}').count());
        assert!(tex.contains(r"A square \& more."));
        assert!(tex.contains(r"{\left(a + b\right)}^{2}"));
    }
}
