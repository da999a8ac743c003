//! This project's solver.

use crate::code::{Code, Codes, Scalar, Shape, timed};
use mechaudit::solvers::faddeeva;
use num_complex::Complex64;
use std::time::Duration;

const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), ", this checkout");

/// Adds its shapes.
pub fn add(codes: &mut Codes) {
    codes.found.push(Box::new(Scalar {
        name: "mechaudit".into(),
        version: VERSION.into(),
        own: true,
        w: faddeeva::faddeeva,
    }));
    codes.found.push(Box::new(Batch));
    codes.found.push(Box::new(Soa));
}

struct Batch;

impl Code for Batch {
    fn name(&self) -> &str {
        "mechaudit batch"
    }
    fn version(&self) -> &str {
        VERSION
    }
    fn shape(&self) -> Shape {
        Shape::Batch
    }
    fn own(&self) -> bool {
        true
    }
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]) {
        faddeeva::faddeeva_batch(z, out).expect("equal lengths");
    }
}

/// The function on slices of real and imaginary parts.
struct Soa;

impl Code for Soa {
    fn name(&self) -> &str {
        "mechaudit SoA"
    }
    fn version(&self) -> &str {
        VERSION
    }
    fn shape(&self) -> Shape {
        Shape::Soa
    }
    fn own(&self) -> bool {
        true
    }
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]) {
        self.time(z, out);
    }
    fn time(&self, z: &[Complex64], out: &mut [Complex64]) -> Duration {
        let (re, im): (Vec<f64>, Vec<f64>) = z.iter().map(|z| (z.re, z.im)).unzip();
        // Written to before, as the other codes' output is.
        let (mut out_re, mut out_im) = (re.clone(), im.clone());
        let taken = timed(|| {
            faddeeva::faddeeva_soa(&re, &im, &mut out_re, &mut out_im).expect("equal lengths")
        });
        for (w, (re, im)) in out.iter_mut().zip(out_re.into_iter().zip(out_im)) {
            *w = Complex64::new(re, im);
        }
        taken
    }
}
