//! What is judged, where and how strictly, as the arguments ask for it.

use crate::cli::args::{ProgramArgs, ScopeArgs, WhereArgs};
use crate::cli::commands::hunt::hard_folder;
use crate::cli::failure::Failure;
use mechaudit::audit::{
    Case, Cases, Format, Limit, Method, Near, Origin, SampleBox, Sampling, Settings, Variant,
};

/// The limit for each output that is asked for, if one is.
fn limit(scope: &ScopeArgs) -> Option<Limit> {
    match (scope.ulps, scope.relative, scope.absolute) {
        (Some(k), ..) => Some(Limit::Ulps(k)),
        (None, Some(r), Some(a)) => Some(Limit::RelativeOrAbsolute(r, a)),
        (None, Some(r), None) => Some(Limit::Relative(r)),
        (None, None, Some(a)) => Some(Limit::Absolute(a)),
        (None, None, None) => None,
    }
}

/// The method with the outputs, the format and the limits asked for.
pub fn judged<'a>(method: &'a dyn Method, scope: &ScopeArgs) -> Result<Variant<'a>, Failure> {
    let mut variant = Variant::new(method);
    if let Some(names) = &scope.outputs {
        variant = variant.outputs(names)?;
    }
    if scope.single {
        variant = variant.format(Format::Single);
    }
    if let Some(limit) = limit(scope) {
        variant = variant.limit(limit);
    }
    if let Some(r) = scope.normwise {
        variant = variant.norm_limit(r);
    }
    Ok(variant)
}

/// The method over the part of its domain asked for, but for regions: [`regions`] comes after a case of
/// one was looked for.
pub fn placed<'a>(
    mut variant: Variant<'a>,
    place: &WhereArgs,
    settings: &Settings,
    alone: bool,
) -> Result<Variant<'a>, Failure> {
    if let Some(folder) = &place.hard {
        let cases = match alone {
            true => hard_folder::of_method(folder, &variant)?,
            false => hard_folder::read(folder, &variant)?.unwrap_or_default(),
        };
        variant = variant.hard_cases(cases);
    }
    if place.ordinary {
        variant = variant.ordinary();
    }
    if let Some(text) = &place.sides {
        // Other inputs come from the regions asked for.
        variant = named(variant, place)?;
        let sides = SampleBox::read(&variant, text).map_err(Failure::caused)?;
        variant = variant.sampling(Sampling::Box(sides));
    }
    if let (Some(text), Some(radius)) = (&place.near, place.radius) {
        let near = Near::read(&variant, settings, text, radius).map_err(Failure::caused)?;
        variant = variant.sampling(Sampling::Near(near));
    }
    Ok(variant)
}

/// Only the regions asked for.
pub fn regions<'a>(variant: Variant<'a>, place: &WhereArgs) -> Result<Variant<'a>, Failure> {
    match place.sides {
        Some(_) => Ok(variant),
        None => named(variant, place),
    }
}

fn named<'a>(variant: Variant<'a>, place: &WhereArgs) -> Result<Variant<'a>, Failure> {
    let mut named = place.regions.iter();
    Ok(named.try_fold(variant, |v, name| v.region(name))?)
}

/// The one case that the arguments ask for, if they do.
pub fn one_case(
    method: &dyn Method,
    place: &WhereArgs,
    settings: &Settings,
) -> Result<Option<Case>, Failure> {
    let cases = Cases::new(method, settings);
    if let Some(number) = place.hard_case {
        return Ok(Some(cases.hard_case(number)?));
    }
    if let Some(name) = &place.check_point {
        return Ok(Some(cases.at_check_point(name)?));
    }
    let Some(index) = place.case else {
        return Ok(None);
    };
    if let Some(case) = cases.at_index(index) {
        return Ok(Some(case));
    }
    match place.regions.as_slice() {
        [region] => Ok(Some(cases.in_region(region, index)?)),
        [] => Err(Failure::new(
            "--case: of which region? Give --region, --box or --near",
        )),
        _ => Err(Failure::new("--case: of which of the regions? Give one")),
    }
}

/// A case of an input that is given by itself.
pub fn given(method: &'static str, input: Vec<f64>) -> Case {
    Case {
        method,
        region: "given",
        input,
        origin: Origin::Given,
    }
}

/// The options that a command needs besides the place of a case to judge it again, with the program that answered.
pub fn again(
    program: Option<(&str, &ProgramArgs)>,
    scope: &ScopeArgs,
    place: &WhereArgs,
) -> String {
    let mut words: Vec<String> = Vec::new();
    let pair = |name: &str, value: &str| format!("{name} {}", shell_words::quote(value));
    if let Some((command, spoken)) = program {
        words.push(pair("--exec", command));
        words.extend(spoken.decimal.then(|| "--decimal".into()));
        words.extend(spoken.binary.then(|| "--binary".into()));
    }
    if let Some(names) = &scope.outputs {
        words.push(pair("--outputs", &names.join(",")));
    }
    let numbers = [
        ("--ulps", scope.ulps),
        ("--relative", scope.relative),
        ("--absolute", scope.absolute),
        ("--normwise", scope.normwise),
    ];
    words.extend(
        numbers
            .iter()
            .filter_map(|(name, x)| Some(format!("{name} {:?}", (*x)?))),
    );
    // A box draws what it does not name from them, one after the other.
    if place.sides.is_some() {
        words.extend(place.regions.iter().map(|r| pair("--region", r)));
        words.extend(place.ordinary.then(|| "--ordinary".into()));
    }
    words.extend(scope.single.then(|| "--single".into()));
    words.iter().map(|w| format!(" {w}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::methods;

    fn scope(ulps: Option<f64>, relative: Option<f64>, absolute: Option<f64>) -> ScopeArgs {
        ScopeArgs {
            ulps,
            relative,
            absolute,
            ..ScopeArgs::default()
        }
    }

    #[test]
    fn a_limit_is_the_one_asked_for() {
        for (args, due) in [
            (scope(None, None, None), None),
            (scope(Some(3.0), None, None), Some(Limit::Ulps(3.0))),
            (scope(None, Some(0.5), None), Some(Limit::Relative(0.5))),
            (scope(None, None, Some(0.25)), Some(Limit::Absolute(0.25))),
            (
                scope(None, Some(0.5), Some(0.25)),
                Some(Limit::RelativeOrAbsolute(0.5, 0.25)),
            ),
        ] {
            assert_eq!(limit(&args), due);
            let method = methods::find("erf").unwrap();
            let judged: &dyn Method = &judged(&*method, &args).unwrap();
            let own = method.outputs();
            for (a, b) in judged.outputs().iter().zip(&own) {
                assert_eq!(a.budget.limit, due.unwrap_or(b.budget.limit));
            }
        }
    }

    #[test]
    fn outputs_format_and_norm_are_those_asked_for() {
        let method = methods::find("erf").unwrap();
        let args = ScopeArgs {
            outputs: Some(vec!["Im erf".into()]),
            normwise: Some(0.5),
            single: true,
            ..ScopeArgs::default()
        };
        let found: &dyn Method = &judged(&*method, &args).unwrap();
        assert!(found.outputs().len() == 1 && found.outputs()[0].name == "Im erf");
        assert_eq!(found.format(), Format::Single);
        assert!(found.norm_budget().is_some());
        let plain: &dyn Method = &judged(&*method, &ScopeArgs::default()).unwrap();
        assert_eq!((plain.outputs().len(), plain.format()), (2, Format::Double));
        let none = ScopeArgs {
            outputs: Some(vec!["Im".into()]),
            ..ScopeArgs::default()
        };
        assert!(judged(&*method, &none).is_err());
    }

    /// Cases are where the arguments say.
    #[test]
    fn places_are_those_asked_for() {
        let method = methods::find("erf").unwrap();
        let settings = Settings {
            cases_per_region: 4,
            ..Settings::default()
        };
        let names = |place: &WhereArgs| {
            let variant = placed(Variant::new(&*method), place, &settings, true).unwrap();
            let variant = regions(variant, place).unwrap();
            let cases = Cases::new(&variant, &settings);
            let mut all: Vec<&str> = (0..cases.len()).map(|i| cases.get(i).region).collect();
            all.dedup();
            all
        };
        let some = |list: &[&str]| list.iter().map(|r| r.to_string()).collect();
        let place = WhereArgs {
            regions: some(&["mid", "small"]),
            ..WhereArgs::default()
        };
        let mut two = names(&place);
        two.sort();
        assert_eq!(two, ["mid", "small"]);
        let boxed = WhereArgs {
            sides: Some("Re z=0..1,Im z=0..1".into()),
            ..place
        };
        assert_eq!(names(&boxed), ["box"]);
        let near = WhereArgs {
            near: Some("1,1".into()),
            radius: Some(0.25),
            ..WhereArgs::default()
        };
        assert_eq!(names(&near), ["near"]);
        let plain = names(&WhereArgs::default());
        let ordinary = names(&WhereArgs {
            ordinary: true,
            ..WhereArgs::default()
        });
        assert!(
            ordinary.len() < plain.len() && plain.contains(&"hard"),
            "{plain:?}"
        );
        let nowhere = WhereArgs {
            regions: some(&["nowhere"]),
            ..WhereArgs::default()
        };
        assert!(regions(Variant::new(&*method), &nowhere).is_err());
    }
}
