//! The workload of a run: which methods are judged, at which cases and how strictly.

use crate::cli::args::{ProgramArgs, RunArgs, ScopeArgs, WhereArgs};
use crate::cli::failure::Failure;
use crate::cli::files::hard_folder;
use crate::cli::forecast;
use crate::cli::process::answers::{AnswerLines, Form};
use crate::cli::process::candidate::Candidate;
use mechaudit::audit::{
    Case, Cases, Format, Layout, Limit, Method, Near, Origin, SampleBox, Sampling, Settings,
    Variant, answer_of,
};
use mechaudit::methods::Evaluable;
use mechaudit::reference::Decimal;
use mechaudit::report::words::numbers::count;

/// The arguments that select cases and say how they are judged.
#[derive(Clone, Copy)]
pub struct Selection<'a> {
    /// The place of the cases.
    pub place: &'a WhereArgs,
    /// The outputs, the format and the limits.
    pub scope: &'a ScopeArgs,
    /// One input given by itself.
    pub input: Option<&'a [f64]>,
    /// True if the method's laws are judged.
    pub laws: bool,
}

impl<'a> Selection<'a> {
    /// Selects cases for code other than the method's own solver: the method's laws are left out.
    pub fn new(place: &'a WhereArgs, scope: &'a ScopeArgs) -> Selection<'a> {
        Selection {
            place,
            scope,
            input: None,
            laws: false,
        }
    }
}

/// The methods of a run, each over the part of its domain that is judged.
pub struct Workload<'a> {
    pub methods: Vec<Variant<'a>>,
    /// The only case, if the arguments select one.
    pub one: Option<Case>,
    pub settings: Settings,
}

impl<'a> Workload<'a> {
    /// Selects from all methods. What cannot be read is refused before anything is judged.
    pub fn of_all(
        methods: &'a [Box<dyn Evaluable>],
        selection: Selection,
        settings: Settings,
    ) -> Result<Workload<'a>, Failure> {
        let chosen = methods.iter().map(|method| {
            let variant = placed(
                judged(&**method, selection)?,
                selection.place,
                &settings,
                false,
            )?;
            regions(variant, selection.place)
        });
        Ok(Workload {
            methods: chosen.collect::<Result<_, Failure>>()?,
            one: None,
            settings,
        })
    }

    /// Selects from one method.
    pub fn of_one(
        method: &'a dyn Evaluable,
        selection: Selection,
        settings: Settings,
    ) -> Result<Workload<'a>, Failure> {
        let place = selection.place;
        let variant = placed(judged(method, selection)?, place, &settings, true)?;
        let one = match selection.input {
            Some(input) => Some(given_at(&variant, input)?),
            None => one_case(&variant, place, &settings)?,
        };
        // A case of a region is looked for among all of them.
        let variant = match one {
            Some(_) => variant,
            None => regions(variant, place)?,
        };
        Ok(Workload {
            methods: vec![variant],
            one,
            settings,
        })
    }

    /// Says how long very many cases will take, and refuses a run that cannot end.
    pub fn check(&self) -> Result<(), Failure> {
        if self.one.is_some() {
            return Ok(());
        }
        let methods: Vec<&dyn Method> = self.methods.iter().map(|m| m as _).collect();
        forecast::check_workload(&methods, &self.settings)
    }
}

/// Returns the candidate that a command and the options of its protocol describe.
pub fn candidate(command: &str, program: &ProgramArgs) -> Candidate {
    Candidate {
        command: command.into(),
        folder: None,
        timeout: program.timeout,
        run_timeout: program.run_timeout,
        form: match program.binary {
            true => Form::Frames,
            false => Form::Lines,
        },
        decimal: program.decimal,
        lines: AnswerLines::default(),
    }
}

/// Returns the limit that replaces those of all outputs, if the arguments give one.
fn limit(scope: &ScopeArgs) -> Option<Limit> {
    match (scope.ulps, scope.relative, scope.absolute) {
        (Some(k), ..) => Some(Limit::Ulps(k)),
        (None, Some(r), Some(a)) => Some(Limit::RelativeOrAbsolute(r, a)),
        (None, Some(r), None) => Some(Limit::Relative(r)),
        (None, None, Some(a)) => Some(Limit::Absolute(a)),
        (None, None, None) => None,
    }
}

/// Returns the method with the selected outputs, format and limits.
fn judged<'a>(method: &'a dyn Method, selection: Selection) -> Result<Variant<'a>, Failure> {
    let scope = selection.scope;
    let mut variant = Variant::new(method);
    if !selection.laws {
        variant = variant.without_laws();
    }
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

/// Returns the method over the selected part of its domain, but for regions.
fn placed<'a>(
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
        // The other inputs are drawn from the selected regions.
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

/// Returns the method over the selected regions.
fn regions<'a>(variant: Variant<'a>, place: &WhereArgs) -> Result<Variant<'a>, Failure> {
    match place.sides {
        Some(_) => Ok(variant),
        None => named(variant, place),
    }
}

fn named<'a>(variant: Variant<'a>, place: &WhereArgs) -> Result<Variant<'a>, Failure> {
    let mut named = place.regions.iter();
    Ok(named.try_fold(variant, |v, name| v.region(name))?)
}

/// Returns the one case that the arguments select, if they do.
fn one_case(
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

/// Checks an input that is given by itself.
fn given_at(method: &dyn Method, input: &[f64]) -> Result<Case, Failure> {
    let refusal = answer_of(method, input);
    if let Some("layout" | "bad layout") = refusal.refusal() {
        let layout = Layout::new(method).input();
        let (n, name) = (count(input.len(), "number"), method.name());
        return Err(Failure::new(format!(
            "--at: {n} cannot be an input of {name}, which is: {layout}"
        )));
    }
    let held = input.iter().map(|x| method.format().representable(*x));
    Ok(given(method.name(), held.collect()))
}

/// Returns the case of an input that is given by itself.
pub fn given(method: &'static str, input: Vec<f64>) -> Case {
    Case {
        method,
        region: "given",
        input,
        origin: Origin::Given,
    }
}

/// Returns the options that a command needs, after the place of a case, to judge it again in the
/// same way.
pub fn reproduce_command(candidate: Option<&Candidate>, selection: Selection) -> String {
    let Selection { place, scope, .. } = selection;
    let mut words: Vec<String> = Vec::new();
    let pair = |name: &str, value: &str| format!("{name} {}", shell_words::quote(value));
    if let Some(candidate) = candidate {
        words.push(pair("--exec", &candidate.command));
        words.extend(candidate.decimal.then(|| "--decimal".into()));
        words.extend((candidate.form == Form::Frames).then(|| "--binary".into()));
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

/// Returns the settings that arguments and environment select.
pub fn settings(args: &RunArgs) -> Result<Settings, Failure> {
    let effort = effort(std::env::var_os("MECHAUDIT_EFFORT").as_deref())?;
    Ok(at_effort(args, effort))
}

fn at_effort(args: &RunArgs, effort: f64) -> Settings {
    let default = Settings::default();
    let cases = args.cases.unwrap_or(default.cases_per_region);
    // Saturates; at least one case unless none were asked for.
    let scaled = (cases as f64 * effort).ceil() as u64;
    Settings {
        seed: args.seed.unwrap_or(default.seed),
        cases_per_region: if effort == 1.0 { cases } else { scaled },
        ..default
    }
}

fn effort(value: Option<&std::ffi::OsStr>) -> Result<f64, Failure> {
    let Some(value) = value else { return Ok(1.0) };
    let text = value.to_string_lossy();
    match Decimal::nearest(&text) {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Failure::new(format!(
            "MECHAUDIT_EFFORT = {text:?} must be a positive number, for instance 0.1 or 10"
        ))),
    }
}

#[cfg(test)]
mod tests;
