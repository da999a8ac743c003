//! Piecewise cubics with local slopes on arbitrary knots.

use super::common::{self, Kind, SplineProblem};
use super::laws::{knots_law, monotone_law, reflection_law, scaling_law};
use super::on_knots::{SplineInput, on_knots};
use super::{conditions, domain};
use crate::audit::{Domain, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::solvers::hermite_spline::Slopes;
use rug::Rational;

macro_rules! local {
    ($(#[$doc:meta])* $method:ident, $slopes:ident, $summary:literal, $source:literal $(, $law:expr)*) => {
        on_knots!(
            $(#[$doc])*
            $method(SplineInput),
            Kind::Local(Slopes::$slopes),
            $summary,
            $source,
            common::local_outputs(16.0),
            reflection_law(|v| Kind::Local(Slopes::$slopes).reflection_residual($method::unpack(v)?.into()))
            $(, $law)*
        );
    };
}

local!(
    /// PCHIP: the monotone piecewise cubic interpolant of Fritsch and Butland, as MATLAB's `pchip`,
    /// SLATEC's `PCHIM` and scipy's `PchipInterpolator` define it.
    Pchip,
    Pchip,
    "monotone piecewise cubic Hermite interpolant (PCHIP)",
    "Fritsch & Butland 1984, weighted harmonic mean; ends: Moler 2004, sections 3.4 and 3.6 (pchiptx)",
    monotone_law(|v| Kind::Local(Slopes::Pchip).monotone_residual(Pchip::unpack(v)?.into()))
);

local!(
    /// Akima's interpolant; the mean of two chords where both weights vanish.
    Akima,
    Akima,
    "Akima's piecewise cubic interpolant of 1970",
    "Akima, J. ACM 17 (1970) 589-602, eq. (1), ends by section 2.3"
);

local!(
    /// The modified Akima interpolant, MATLAB's `makima`.
    ModifiedAkima,
    ModifiedAkima,
    "modified Akima piecewise cubic interpolant (makima)",
    "Moler & Ionita 2019, Makima piecewise cubic interpolation; ends by Akima 1970, section 2.3"
);

method! {
    Pchip "pchip": Fn(SplineProblem<'_>), |f, i| f(i.into())
}

method! {
    Akima "akima": Fn(SplineProblem<'_>), |f, i| f(i.into())
}

method! {
    ModifiedAkima "modified-akima": Fn(SplineProblem<'_>), |f, i| f(i.into())
}
