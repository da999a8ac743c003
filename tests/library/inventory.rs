//! The audited methods, pinned: nothing can be dropped from the registry, a domain or a judge's
//! list unseen.

use mechaudit::audit::{Cases, Settings, audit_method};
use mechaudit::methods;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Outputs with their limits, regions, check points, hard cases and laws of every method.
#[test]
fn methods_regions_and_laws() {
    let mut text = String::new();
    for m in methods::registry() {
        let domain = m.domain();
        writeln!(text, "{}", m.name()).unwrap();
        for o in m.outputs() {
            writeln!(text, "  output {}: {}", o.name, o.budget.limit).unwrap();
        }
        if let Some(norm) = m.norm_budget() {
            writeln!(text, "  norm: {}", norm.factor).unwrap();
        }
        for r in &domain.regions {
            writeln!(text, "  region {}", r.name).unwrap();
        }
        writeln!(text, "  {} check points", domain.check_points.len()).unwrap();
        writeln!(text, "  {} hard cases", m.hard().len()).unwrap();
        for law in m.laws() {
            writeln!(text, "  law {}", law.name).unwrap();
        }
    }
    crate::pin("inventory", &text);
}

/// An audit judges every check point, every hard case, and as many cases of every region as it is
/// asked for.
#[test]
fn no_case_is_left_out() {
    for name in ["slider-crank", "erf", "tridiagonal"] {
        let m = methods::find(name).expect("a method");
        let settings = Settings {
            cases_per_region: 2,
            ..Settings::default()
        };
        let domain = m.domain();
        let due = 2 * domain.regions.len() + domain.check_points.len() + m.hard().len();
        let due = due as u64;
        let cases = Cases::new(&*m, &settings);
        for r in &domain.regions {
            assert!(cases.in_region(r.name, 0).is_ok(), "{name}: {}", r.name);
        }
        assert_eq!(
            audit_method(&*m, &settings, &|| ()).cases,
            due as u64,
            "{name}"
        );
    }
}

/// Bytes of the data in a folder, without what was built there.
fn data(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|e| e.expect("an entry").path());
    let sizes = paths.map(|path| {
        if path.is_dir() {
            let built = path.file_name().is_some_and(|n| n == "target");
            return if built { 0 } else { data(&path) };
        }
        let ending = path.extension().and_then(|e| e.to_str());
        match ending {
            Some("csv" | "json" | "snap") => fs::metadata(&path).expect("a file").len(),
            _ => 0,
        }
    });
    sizes.sum()
}

/// Data are committed once and in a compact form: values to be held, not what a command prints
/// again.
#[test]
fn committed_data_is_small() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["reference", "tests", "snapshots"];
    let bytes: u64 = folders.iter().map(|f| data(&root.join(f))).sum();
    assert!((500_000..2_000_000).contains(&bytes), "{bytes} bytes");
}
