//! Numbers in the C headers, the documentation of the Python package and the READMEs are those of
//! budgets and proofs.

use mechaudit::audit::Limit;
use mechaudit::methods;
use mechaudit_cli::proof::real::Function;
use mechaudit_cli::proof::{UPPER_HALF_PLANE, lower::LOWER_HALF_PLANE};

const HEADER: &str = include_str!("../../capi/include/mechaudit.h");
const CERF: &str = include_str!("../../capi/include/mechaudit/cerf.h");
const MIT: &str = include_str!("../../capi/include/mechaudit/Faddeeva.hh");
const C_README: &str = include_str!("../../capi/README.md");
const README: &str = include_str!("../../README.md");
/// Methods and what documents them in Python.
const PYTHON: [(&str, &str); 8] = [
    (
        "faddeeva",
        include_str!("../../python/src/special/docs/wofz.txt"),
    ),
    (
        "faddeeva-derivative",
        include_str!("../../python/src/special/docs/wofz_derivative.txt"),
    ),
    ("erf", include_str!("../../python/src/special/docs/erf.txt")),
    (
        "erfc",
        include_str!("../../python/src/special/docs/erfc.txt"),
    ),
    (
        "erfcx",
        include_str!("../../python/src/special/docs/erfcx.txt"),
    ),
    (
        "erfi",
        include_str!("../../python/src/special/docs/erfi.txt"),
    ),
    (
        "dawson",
        include_str!("../../python/src/special/docs/dawsn.txt"),
    ),
    (
        "voigt",
        include_str!("../../python/src/special/docs/voigt_profile.txt"),
    ),
];

/// The budget of every output of a method, in units in the last place.
fn budget(method: &str) -> f64 {
    let method = methods::find(method).expect("in the registry");
    let limits = method.outputs().into_iter().map(|o| match o.budget.limit {
        Limit::Ulps(k) => k,
        other => panic!("{other}"),
    });
    limits.reduce(f64::max).expect("an output")
}

/// Returns the proved bound of a function of a real number, if there is one.
fn proved(name: &str) -> Option<f64> {
    let all = Function::ALL.into_iter();
    all.filter(|f| f.name() == name).map(Function::ulps).next()
}

/// A text on one line.
fn flat(text: &str) -> String {
    let lines = text
        .lines()
        .map(|l| l.trim().trim_start_matches("* ").trim());
    lines.collect::<Vec<_>>().join(" ")
}

/// The numbers that stand before "unit" or "units" in "within N units in".
fn within(text: &str) -> Vec<f64> {
    let text = flat(text);
    let parts = text.split("within ").skip(1);
    let number = |part: &str| {
        let (number, rest) = part.split_once(' ')?;
        rest.starts_with("unit").then(|| number.parse().ok())?
    };
    parts.filter_map(number).collect()
}

/// The comment before a function of the header.
fn comment(function: &str) -> &'static str {
    let at = HEADER.find(&format!(" {function}(")).expect(function);
    let begin = HEADER[..at].rfind("/**").expect("a comment");
    &HEADER[begin..at]
}

#[test]
fn no_sample_stands_for_a_bound() {
    let python = PYTHON.map(|(_, text)| text);
    for text in [HEADER, CERF, MIT, C_README].into_iter().chain(python) {
        let text = flat(text).to_lowercase();
        assert!(!text.contains("worst error found") && !text.contains("worst found"));
    }
}

#[test]
fn the_header_has_the_budgets_and_the_proofs() {
    for name in [
        "faddeeva",
        "faddeeva-derivative",
        "erf",
        "erfc",
        "erfcx",
        "erfi",
        "dawson",
    ] {
        let function = format!("mechaudit_{}", name.replace('-', "_"));
        assert_eq!(within(comment(&function)), [budget(name)], "{name}");
    }
    for name in ["voigt", "voigt-hwhm"] {
        let function = format!("mechaudit_{}", name.replace('-', "_"));
        assert_eq!(within(comment(&function)), [budget(name)], "{name}");
    }
    for name in ["erf", "erfc", "erfcx", "erfi", "dawson"] {
        let comment = comment(&format!("mechaudit_{name}_real"));
        let bound = proved(name).unwrap_or(budget(name));
        assert_eq!(within(comment), [bound], "{name}");
        assert_eq!(
            flat(comment).contains("proved for every double"),
            proved(name).is_some()
        );
    }
}

#[test]
fn the_other_headers_have_the_budgets() {
    let text = flat(CERF);
    let places = format!(
        "each component within {} units in its last place, voigt within {}, voigt_hwhm within {} (",
        budget("faddeeva"),
        budget("voigt"),
        budget("voigt-hwhm")
    );
    assert!(text.contains(&places), "{places}");
    assert_eq!(within(&MIT.replace("\n//", "\n")), [budget("faddeeva")]);
}

#[test]
fn the_python_package_has_the_budgets_and_the_proofs() {
    for (name, text) in PYTHON {
        let due: Vec<f64> = proved(name).into_iter().chain([budget(name)]).collect();
        assert_eq!(within(text), due, "{name}");
    }
    let norm = format!("{} * 2**-52 of the norm", UPPER_HALF_PLANE.norm);
    assert!(flat(PYTHON[0].1).contains(&norm));
}

#[test]
fn the_readmes_have_the_budgets_and_the_proofs() {
    let rows = |name: &str| {
        let row = C_README
            .lines()
            .find(|l| l.starts_with(&format!("| {name} |")));
        row.unwrap_or_else(|| panic!("{name}")).to_owned()
    };
    for (name, bound) in [
        (
            "W and its derivative, erf, erfc, erfcx, erfi, Dawson",
            budget("faddeeva"),
        ),
        ("erf, erfc, erfcx, Dawson of a double", Function::Erf.ulps()),
        ("Voigt profile", budget("voigt")),
        ("half width of the Voigt profile", budget("voigt-hwhm")),
    ] {
        let cell = format!("| {name} | {bound} unit");
        assert!(rows(name).starts_with(&cell), "{cell}");
    }
    let same = [
        "faddeeva-derivative",
        "erf",
        "erfc",
        "erfcx",
        "erfi",
        "dawson",
    ];
    assert!(same.iter().all(|m| budget(m) == budget("faddeeva")));
    assert!(
        Function::ALL.iter().all(|f| f.ulps() == 0.875),
        "7/8 in the README"
    );
    for part in [
        format!("≤ {} · 2⁻⁵² |w(z)|`", UPPER_HALF_PLANE.norm),
        format!(
            "each component within {} ulp, Im z ≥ 0",
            UPPER_HALF_PLANE.component
        ),
        format!("(below, {} · 2⁻⁵², in part by hand)", LOWER_HALF_PLANE.norm),
        "within 7/8 ulp".into(),
    ] {
        assert!(flat(README).contains(&part), "{part}");
    }
}
