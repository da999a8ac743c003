//! The public Rust crates.

use crate::code::{Code, Codes, Scalar};
use num_complex::Complex64;

/// Adds them.
pub fn add(codes: &mut Codes) {
    codes.add("puruspe", Ok(puruspe()));
    codes.add("errorfunctions", Ok(errorfunctions()));
    codes.add("scirs2-special", scirs2());
}

/// The version of a crate as this package's lock file has it.
fn locked_version(name: &str) -> String {
    let name_line = format!("name = \"{name}\"");
    let mut lines = include_str!("../Cargo.lock").lines();
    lines.by_ref().find(|l| *l == name_line);
    let version = lines.next().and_then(|l| l.split('"').nth(1));
    format!("{} (crates.io)", version.unwrap_or("unknown"))
}

fn puruspe() -> Box<dyn Code> {
    Box::new(Scalar {
        name: "puruspe".into(),
        version: locked_version("puruspe"),
        own: false,
        w: |z: Complex64| {
            let (re, im) = puruspe::faddeeva(z.re, z.im);
            Complex64::new(re, im)
        },
    })
}

fn errorfunctions() -> Box<dyn Code> {
    Box::new(Scalar {
        name: "errorfunctions".into(),
        version: locked_version("errorfunctions"),
        own: false,
        w: |z: Complex64| errorfunctions::ComplexErrorFunctions::w(z),
    })
}

#[cfg(feature = "scirs2")]
fn scirs2() -> Result<Box<dyn Code>, String> {
    Ok(Box::new(Scalar {
        name: "scirs2-special".into(),
        version: locked_version("scirs2-special"),
        own: false,
        w: |z: Complex64| scirs2_special::faddeeva_complex(z),
    }))
}

#[cfg(not(feature = "scirs2"))]
fn scirs2() -> Result<Box<dyn Code>, String> {
    Err("not compiled in: --features scirs2".into())
}

#[cfg(test)]
mod tests {
    #[test]
    fn versions_are_read_from_the_lock_file() {
        assert!(super::locked_version("puruspe").starts_with("0.4."));
        assert!(super::locked_version("no such crate").starts_with("unknown"));
    }
}
