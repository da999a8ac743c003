//! Code that is surveyed: an algorithm, or a library run as a program.

use super::lines;
use crate::audit::{SolverAnswer, hex_float};
use crate::solvers::faddeeva::faddeeva;
use mechaudit_atlas::{Algorithm, Parts, Plane, Profile};
use num_complex::{Complex, Complex32};

type Answers<'a> = Box<dyn Fn(&[Vec<f64>]) -> Vec<SolverAnswer> + 'a>;

/// Code with what it is called.
pub struct Code<'a> {
    /// The name of its row.
    pub name: String,
    /// Holds what it is.
    pub title: String,
    /// The paper, or the version.
    pub source: String,
    /// Where it is defined.
    pub plane: Plane,
    /// Holds what it gives.
    pub parts: Parts,
    /// Tells whether it computes in single precision.
    pub single: bool,
    /// The algorithm, if it is one.
    pub algorithm: Option<Algorithm>,
    /// Nanoseconds a value, as a program has measured itself.
    pub nanoseconds: Option<f64>,
    answers: Answers<'a>,
}

impl<'a> Code<'a> {
    /// An algorithm in double precision.
    pub fn double(a: Algorithm) -> Code<'a> {
        let source = (a.name.into(), a.title.into(), a.source.into());
        let answers = move |inputs: &[Vec<f64>]| inputs.iter().map(|z| answer(&a, z)).collect();
        Code {
            algorithm: Some(a),
            ..Code::other(source, a.plane, a.parts, answers)
        }
    }

    /// An algorithm in single precision, if it has that.
    pub fn single(a: Algorithm) -> Option<Code<'a>> {
        let w = a.single?;
        let one = move |z: &Vec<f64>| {
            let w = w(Complex32::new(z[0] as f32, z[1] as f32));
            SolverAnswer::Values(vec![f64::from(w.re), f64::from(w.im)])
        };
        Some(Code {
            name: format!("{} (f32)", a.name),
            single: true,
            answers: Box::new(move |inputs| inputs.iter().map(one).collect()),
            ..Code::double(a)
        })
    }

    /// An algorithm for the Hartmann–Tran profile: `answers` gets lines of eight parameters.
    pub fn line(p: Profile) -> Code<'a> {
        let source = (p.name.into(), p.title.into(), p.source.into());
        // Half of the lines where it has half of the parameters.
        let plane = if p.whole { Plane::Whole } else { Plane::Upper };
        Code::other(source, plane, Parts::Both, move |inputs| {
            inputs.iter().map(|i| lines::answer(&p, i)).collect()
        })
    }

    /// Anything else: `answers` gets points of the upper half-plane, of the whole plane if `plane`
    /// says so.
    pub fn other(
        (name, title, source): (String, String, String),
        plane: Plane,
        parts: Parts,
        answers: impl Fn(&[Vec<f64>]) -> Vec<SolverAnswer> + 'a,
    ) -> Code<'a> {
        Code {
            name,
            title,
            source,
            plane,
            parts,
            single: false,
            algorithm: None,
            nanoseconds: None,
            answers: Box::new(answers),
        }
    }

    /// Its answers, one for each point.
    pub fn answers(&self, inputs: &[Vec<f64>]) -> Vec<SolverAnswer> {
        (self.answers)(inputs)
    }

    /// The arguments of `mechaudit` that show it at a point.
    pub fn at(&self, z: &[f64]) -> String {
        at(&self.name, z)
    }
}

/// The arguments of `mechaudit` that show an algorithm at a point.
pub fn at(name: &str, z: &[f64]) -> String {
    let place: Vec<String> = z.iter().map(|x| hex_float(*x)).collect();
    format!("atlas --only {name} --at {}", place.join(","))
}

/// The solver of this suite, surveyed with the others.
fn ours() -> Algorithm {
    Algorithm {
        name: "mechaudit",
        title: "This suite's own solver, mechaudit_solvers::faddeeva",
        source: "mechaudit-solvers",
        read_from: "its code",
        plane: Plane::Whole,
        parts: Parts::Both,
        w: faddeeva,
        single: None,
        formula: None,
    }
}

/// The published algorithms and this suite's own.
pub fn algorithms() -> Vec<Algorithm> {
    let mut all = mechaudit_atlas::all();
    all.push(ours());
    all
}

/// The answer of an algorithm.
pub fn answer(a: &Algorithm, z: &[f64]) -> SolverAnswer {
    let w = (a.w)(Complex::new(z[0], z[1]));
    SolverAnswer::Values(match a.parts {
        Parts::Both => vec![w.re, w.im],
        Parts::Real => vec![w.re],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit_atlas::find;

    #[test]
    fn a_command_names_the_code_and_the_exact_point() {
        let code = Code::double(find("humlicek-1982").unwrap());
        assert_eq!(
            code.at(&[1.0625, -0.15625]),
            "atlas --only humlicek-1982 --at 0x1.1p+0,-0x1.4p-3"
        );
    }

    #[test]
    fn both_precisions_answer_with_their_own_values() {
        let a = find("humlicek-1982").unwrap();
        let z = vec![1.25, 0.1];
        let (double, single) = (Code::double(a), Code::single(a).unwrap());
        assert!(!double.single && single.single);
        assert_eq!(single.name, "humlicek-1982 (f32)");
        let w = (a.w)(Complex::new(1.25, 0.1));
        let due = SolverAnswer::Values(vec![w.re, w.im]);
        assert_eq!(double.answers(std::slice::from_ref(&z)), [due]);
        let w = (a.single.unwrap())(Complex32::new(1.25, 0.1));
        let due = SolverAnswer::Values(vec![f64::from(w.re), f64::from(w.im)]);
        assert_eq!(single.answers(&[z]), [due]);
        let other = Code::other(Default::default(), a.plane, a.parts, |_| Vec::new());
        assert!(!other.single);
    }

    #[test]
    fn profiles_of_half_of_the_lines_are_told_from_those_of_all() {
        let mut seen = [false; 2];
        for p in mechaudit_atlas::PROFILES {
            let code = Code::line(p);
            assert_eq!(code.plane == Plane::Whole, p.whole, "{}", p.name);
            seen[usize::from(p.whole)] = true;
        }
        assert_eq!(seen, [true; 2]);
    }

    #[test]
    fn the_suite_s_own_solver_stands_beside_the_others() {
        let all = algorithms();
        assert_eq!(all.len(), mechaudit_atlas::all().len() + 1);
        assert!(all.iter().any(|a| a.name == "mechaudit"));
    }
}
