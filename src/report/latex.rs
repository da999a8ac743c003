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
    if let Some(fault) = &e.dimension {
        out.push_str(&format!("Dimension: {}.\n\n", escape(fault)));
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

    #[test]
    fn what_means_something_in_latex_is_written_out() {
        assert_eq!(escape("a & b_1 {50 %} #$"), r"a \& b\_1 \{50 \%\} \#\$");
        assert_eq!(
            escape(r"~^\φ"),
            r"\textasciitilde{}\textasciicircum{}\textbackslash{}φ"
        );
    }

    #[test]
    fn an_entry_has_its_formulas_and_what_came_of_them() {
        let mut all = fabricated();
        let good = entry(&all.entries[0]);
        let start = "\n\\subsection*{(1) \\normalfont\\small [proved]}\nA square.\n\n\\noindent Printed:\n\\[ ";
        assert!(good.starts_with(start), "{good}");
        assert!(
            good.contains("\\noindent Requirement (proved):\n"),
            "{good}"
        );
        assert!(!good.contains("Corrected:"), "{good}");
        let slip = &mut all.entries[1];
        slip.note = "See 50 %.";
        let text = entry(slip);
        for part in [
            "\\noindent Corrected:\n",
            "single edits",
            "Requirement (refuted as printed, proved as corrected):",
        ] {
            assert!(text.contains(part), "{part} is missing in {text}");
        }
        assert!(text.ends_with("See 50 \\%.\n"), "{text}");
        slip.composed = true;
        let text = entry(slip);
        assert!(text.contains("\\noindent Of corrected parts:\n") && !text.contains("Printed:"));
        let tex = ledger(&all);
        assert_eq!(tex.matches("\\subsection*").count(), 3);
        assert!(tex.contains("A \\& B. 3 entries: "), "{tex}");
    }
}
