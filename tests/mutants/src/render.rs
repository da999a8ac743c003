//! A file with its mutants behind their numbers.

use crate::mutate::{Kind, Place};
use std::collections::HashSet;
use std::ops::Range;

/// A mutant: one of the texts of a place, or a statement left out.
#[derive(Clone, Debug)]
pub struct Mutant {
    pub number: u32,
    pub file: usize,
    pub place: usize,
    /// Which text of the place.
    pub choice: usize,
}

/// Where a mutant's text stands in the rendered file; and the whole of its place.
pub struct Written {
    pub number: u32,
    pub own: Range<usize>,
    pub place: Range<usize>,
}

/// The rendered file and where its mutants are.
pub struct Rendered {
    pub text: String,
    pub written: Vec<Written>,
}

/// Renders a file with all mutants that are not left out.
pub fn render(
    source: &str,
    places: &[Place],
    mutants: &[&Mutant],
    left_out: &HashSet<u32>,
    switch: &str,
) -> Rendered {
    let mut of_place: Vec<Vec<&Mutant>> = vec![Vec::new(); places.len()];
    for m in mutants {
        if !left_out.contains(&m.number) {
            of_place[m.place].push(m);
        }
    }
    let mut out = Rendered {
        text: String::with_capacity(3 * source.len()),
        written: Vec::new(),
    };
    let mut renderer = Renderer {
        source,
        places,
        of_place,
        switch,
    };
    let mut next = 0;
    renderer.part(0..source.len(), &mut next, &mut out);
    out
}

struct Renderer<'a> {
    source: &'a str,
    places: &'a [Place],
    of_place: Vec<Vec<&'a Mutant>>,
    switch: &'a str,
}

impl Renderer<'_> {
    /// The text of `bytes` with the places from `next` on that lie in it.
    fn part(&mut self, bytes: Range<usize>, next: &mut usize, out: &mut Rendered) {
        let mut at = bytes.start;
        while let Some(place) = self.places.get(*next)
            && place.bytes.end <= bytes.end
        {
            let (kind, range) = (place.kind, place.bytes.clone());
            out.text.push_str(&self.source[at..range.start]);
            at = range.end;
            let index = *next;
            *next += 1;
            self.place(kind, range, index, next, out);
        }
        out.text.push_str(&self.source[at..bytes.end]);
    }

    fn place(
        &mut self,
        kind: Kind,
        range: Range<usize>,
        index: usize,
        next: &mut usize,
        out: &mut Rendered,
    ) {
        let chosen = std::mem::take(&mut self.of_place[index]);
        if chosen.is_empty() {
            self.part(range, next, out);
            return;
        }
        let start = out.text.len();
        let first = out.written.len();
        let switch = self.switch;
        match kind {
            Kind::Expression => {
                out.text.push('(');
                for m in &chosen {
                    out.text.push_str(&format!("if {switch}({}) {{ ", m.number));
                    let from = out.text.len();
                    out.text.push_str(&self.places[index].instead[m.choice]);
                    out.written.push(Written {
                        number: m.number,
                        own: from..out.text.len(),
                        place: 0..0,
                    });
                    out.text.push_str(" } else ");
                }
                out.text.push_str("{ ");
                let inner = out.written.len();
                self.part(range, next, out);
                out.text.push_str(" })");
                close(out, first..inner, start);
            }
            Kind::Statement => {
                let m = chosen[0];
                out.text
                    .push_str(&format!("if !{switch}({}) {{ ", m.number));
                out.written.push(Written {
                    number: m.number,
                    own: start..out.text.len(),
                    place: 0..0,
                });
                self.part(range, next, out);
                out.text.push_str(" }");
                close(out, first..first + 1, start);
            }
            Kind::Entry => {
                for m in &chosen {
                    out.text
                        .push_str(&format!(" if {switch}({}) {{ ", m.number));
                    let from = out.text.len();
                    out.text.push_str(&self.places[index].instead[m.choice]);
                    out.written.push(Written {
                        number: m.number,
                        own: from..out.text.len(),
                        place: 0..0,
                    });
                    out.text.push_str(" }");
                }
                let all = first..out.written.len();
                close(out, all, start);
            }
        }
    }
}

fn close(out: &mut Rendered, which: Range<usize>, start: usize) {
    let end = out.text.len();
    for w in &mut out.written[which] {
        w.place = start..end;
    }
}

impl Rendered {
    /// The mutants to blame for an error at these bytes: those whose own text is concerned, or all
    /// of the innermost place around it.
    pub fn blamed(&self, bytes: &Range<usize>) -> Vec<u32> {
        let meets = |r: &Range<usize>| r.start <= bytes.end && bytes.start <= r.end;
        let holds = |r: &Range<usize>| r.start <= bytes.start && bytes.end <= r.end;
        let own: Vec<u32> = self
            .written
            .iter()
            .filter(|w| holds(&w.own))
            .map(|w| w.number)
            .collect();
        if !own.is_empty() {
            return own;
        }
        let around = self.written.iter().filter(|w| holds(&w.place));
        let innermost = around.map(|w| w.place.len()).min();
        let found: Vec<u32> = self
            .written
            .iter()
            .filter(|w| holds(&w.place) && Some(w.place.len()) == innermost)
            .map(|w| w.number)
            .collect();
        if !found.is_empty() {
            return found;
        }
        let touched = self.written.iter().filter(|w| meets(&w.place));
        touched.map(|w| w.number).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Mutant, render};
    use crate::mutate::places;
    use std::collections::HashSet;

    fn all(source: &str, left_out: &[u32]) -> super::Rendered {
        let places = places(source).unwrap();
        let mut mutants = Vec::new();
        for (place, p) in places.iter().enumerate() {
            for choice in 0..p.instead.len().max(1) {
                let number = mutants.len() as u32;
                mutants.push(Mutant {
                    number,
                    file: 0,
                    place,
                    choice,
                });
            }
        }
        let mutants: Vec<&Mutant> = mutants.iter().collect();
        let left_out: HashSet<u32> = left_out.iter().copied().collect();
        render(source, &places, &mutants, &left_out, "on")
    }

    #[test]
    fn nested_choices_stay_a_file() {
        let source = "fn f(mut x: f64) -> f64 { x += 2.0; (x + 1.0) * x.max(3.0) }";
        let rendered = all(source, &[]);
        syn::parse_file(&rendered.text).unwrap();
        assert!(rendered.text.contains("if !on("), "{}", rendered.text);
        for w in &rendered.written {
            assert!(rendered.blamed(&w.own).contains(&w.number));
        }
    }

    #[test]
    fn without_mutants_the_file_is_the_source() {
        let source = "fn f(x: f64) -> f64 { x + 1.0 }";
        let every: Vec<u32> = (0..100).collect();
        assert_eq!(all(source, &every).text, source);
    }
}
