//! Machines as their files describe them, computed in the user's units.
//!
//! A [`Source`] holds a description in TOML or JSON; every quantity in it is a string with its
//! unit, read exactly. A description that is refused names the value, the rule and the line.
//!
//! | module | what it holds |
//! |---|---|
//! | [`quantity`] | numbers with units, exact |
//! | [`class_iii`] | linkages of class III: branches, rows, certified decimals |
//! | [`dyad`] | four-bar linkages and slider-cranks: rows, certified decimals, crank ranges |
//! | [`planar`] | mechanisms of any structure: bodies, joints, drive |
//! | [`crank_angles`] | the crank angles of rows, exact |
//! | [`run_up`] | machines with motor and load: run, steady cycle, work against precision |
//! | [`cam_oscillator`] | cam-driven oscillators whose shaft changes speed |
//!
//! The rows of a linkage, each value with 25 digits that are proved:
//!
//! ```
//! use mechaudit_cli::machine::{class_iii, Linkage, Source};
//! let source = Source::toml(include_str!(concat!(
//!     env!("CARGO_MANIFEST_DIR"), "/../../examples/sand-screen.toml"
//! )));
//! let Linkage::ClassIii(linkage) = Linkage::read(&source)? else { unreachable!() };
//! let start = linkage.start_degrees().unwrap();
//! let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start)?;
//! let mut certifier = class_iii::Certifier::new(&linkage, 25);
//! let position = certifier.advance(&start, &branch.start).expect("proved");
//! for (name, digits) in class_iii::names(&linkage, true)[2..].iter().zip(certifier.values(&start,
//! &position)) {     println!("{name} = {}", digits.as_deref().unwrap_or("undecided")); }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod cam_oscillator;
pub mod class_iii;
pub mod crank_angles;
pub mod dyad;
mod linkage;
pub mod planar;
pub mod quantity;
mod reach;
pub mod run_up;
mod sections;
mod source;

pub use cam_oscillator::CamOscillator;
pub use linkage::Linkage;
pub use reach::Reach;
pub use sections::CrankMotion;
pub use source::{Form, Refusal, Source, SourceError};

/// The bits at which the proof of `digits` significant decimal digits is first tried.
fn first_bits(digits: u32) -> u32 {
    (f64::from(digits) * std::f64::consts::LOG2_10).ceil() as u32 + 64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_begin_with_the_bits_they_hold_and_a_word() {
        for (digits, bits) in [
            (1, 4 + 64),
            (19, 64 + 64),
            (30, 100 + 64),
            (1000, 3322 + 64),
        ] {
            assert_eq!(first_bits(digits), bits);
        }
    }
}
