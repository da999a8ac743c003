//! Names of indeterminates.

use super::SymbolicError;
use std::fmt;

/// An indeterminate. Names have up to 16 ASCII characters and are ordered as text, so that normal
/// forms do not depend on the order in which symbols are first met.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(u128);

impl Symbol {
    /// The longest name, in bytes.
    pub const LONGEST: usize = 16;

    /// `pi`, the number.
    pub(super) const PI: Symbol = Symbol::of_bytes(b"pi");
    /// The index of a series: any positive integer. Its name cannot be typed.
    pub(super) const INDEX: Symbol = Symbol::of_bytes(b"#");
    /// The sign of summation of a series: sums are linear in it. Its name cannot be typed.
    pub(super) const SERIES: Symbol = Symbol::of_bytes(b"##");

    const fn of_bytes(name: &[u8]) -> Symbol {
        let mut bytes = [0; Symbol::LONGEST];
        let mut k = 0;
        while k < name.len() {
            bytes[k] = name[k];
            k += 1;
        }
        Symbol(u128::from_be_bytes(bytes))
    }

    /// The symbol of that name; `None` if it is empty, too long, or not printable ASCII.
    pub fn new(name: &str) -> Option<Symbol> {
        let good = (1..=Symbol::LONGEST).contains(&name.len())
            && name.bytes().all(|b| b.is_ascii_graphic());
        good.then(|| {
            let mut bytes = [0; Symbol::LONGEST];
            bytes[..name.len()].copy_from_slice(name.as_bytes());
            Symbol(u128::from_be_bytes(bytes))
        })
    }

    /// Returns true if a name that nothing defines stands for any positive number in an
    /// [`Algebra`](super::Algebra), which gives names with other letters to roots and the like.
    pub fn is_free(name: &str) -> bool {
        let is_letter = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'\'');
        Symbol::new(name).is_some_and(|s| s != Symbol::PI) && name.bytes().all(is_letter)
    }

    /// The symbol of that name.
    ///
    /// # Errors
    /// [`SymbolicError::Name`] if there is none.
    pub(super) fn named(name: &str) -> Result<Symbol, SymbolicError> {
        Symbol::new(name).ok_or_else(|| SymbolicError::Name(name.into()))
    }

    /// Its name.
    pub fn name(self) -> String {
        let bytes = self.0.to_be_bytes();
        bytes
            .iter()
            .take_while(|b| **b != 0)
            .map(|b| char::from(*b))
            .collect()
    }
}

impl fmt::Display for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back_in_order() {
        let s = |n| Symbol::new(n).unwrap();
        assert_eq!(s("omega_star").name(), "omega_star");
        assert!(s("a") < s("ab") && s("ab") < s("b"));
        for bad in ["", "a name with blanks", "seventeen_letters", "ω"] {
            assert_eq!(Symbol::new(bad), None, "{bad}");
        }
        for taken in ["pi", "r:x", "k#1", "#", "seventeen_letters"] {
            assert!(!Symbol::is_free(taken), "{taken}");
        }
        assert!(Symbol::is_free("x_1'"));
    }
}
