//! The shared part of the audits of the Faddeeva function's complex relatives.

mod dawson;
mod erf;
mod erfc;
mod erfcx;
mod erfi;
mod faddeeva_derivative;
mod laws;
mod regions;
mod relative;

use super::complex::{ComplexInput, PROOF, asked, expected_part};
use crate::audit::{
    BranchAt, Budget, Domain, Law, Limit, NormBudget, Output, Proof, ProvedBound, ReferenceAnswer,
    Uncertified,
};
use crate::methods::common::output;
use crate::methods::definition::Definition;
use crate::methods::inputs::Number;
use crate::reference::faddeeva::Scaled;
use relative::Relative;
use rug::Rational;

pub use dawson::Dawson;
pub use erf::Erf;
pub use erfc::Erfc;
pub use erfcx::Erfcx;
pub use erfi::Erfi;
pub use faddeeva_derivative::FaddeevaDerivative;

impl<F: Relative> Definition for F {
    type Input<'a, T: Number> = ComplexInput<'a, T>;
    const SUMMARY: &'static str = F::SUMMARY;
    const SOURCE: &'static str = F::SOURCE;

    fn outputs() -> Vec<Output> {
        let budget = Budget::new(Limit::Ulps(F::ULPS.0), F::ULPS.1);
        F::OUTPUTS.map(|name| output(name, "1", budget)).to_vec()
    }

    fn norm_budget() -> Option<NormBudget> {
        Some(NormBudget::new(F::NORM.0, F::NORM.1))
    }

    fn proved() -> Vec<ProvedBound> {
        <F as Relative>::proved()
    }

    fn domain() -> Domain {
        Domain {
            regions: regions::all::<F>(),
            check_points: regions::check_points::<F>(),
        }
    }

    fn solve(z: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let value = (F::VALUE)(z.into());
        Ok(vec![value.re, value.im])
    }

    fn reference(z: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let parts = (F::EXACT)(z.re, z.im, asked(bits))?;
        Ok(ReferenceAnswer::Expected(
            parts.iter().map(expected_part).collect(),
            PROOF,
        ))
    }

    fn reference_not_finite(z: Self::Input<'_, f64>) -> ReferenceAnswer {
        ReferenceAnswer::Expected(F::limit(z.re, z.im).to_vec(), Proof::Exact)
    }

    fn branch(z: Self::Input<'_, f64>) -> Option<BranchAt> {
        <F as Relative>::branch(z.into())
    }

    fn signs_of_zero(z: Self::Input<'_, f64>) -> Vec<Option<bool>> {
        F::signs_of_zero(z.re, z.im).to_vec()
    }

    fn laws() -> Vec<Law> {
        <F as Relative>::laws()
    }

    fn certify(z: Self::Input<'_, Rational>, bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        Ok((F::EXACT)(z.re, z.im, bits)?.to_vec())
    }
}

#[cfg(test)]
mod tests;
