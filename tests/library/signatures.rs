//! The compiler's messages for code that is no candidate: they name the signature that is wanted.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Code of a candidate.
const RIGHT: &str = "mechaudit::audit::<Faddeeva>(|z: Complex64| z)";

/// The library: of those with references, which the right code needs, the last that was built.
fn library() -> PathBuf {
    let own = std::env::current_exe().unwrap();
    let built = std::fs::read_dir(own.parent().unwrap()).unwrap();
    let mut built: Vec<_> = built
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let name = path.file_name()?.to_str()?;
            let is_it = name.starts_with("libmechaudit-") && name.ends_with(".rlib");
            let modified = path.metadata().ok()?.modified().ok()?;
            is_it.then_some((modified, path))
        })
        .collect();
    built.sort();
    let mut paths = built.into_iter().rev().map(|(_, path)| path);
    let found = paths.find(|path| said(path, RIGHT).is_empty());
    found.expect("the right code compiles with a library that is built")
}

/// Returns the compiler's message for the code; nothing if it compiles.
fn said(library: &Path, code: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("fixture.rs");
    let text = format!(
        "use mechaudit::Complex64;\nuse mechaudit::methods::*;\n\
         pub fn audited() {{ let _ = {code}; }}\npub fn unused(_: Complex64) {{}}\n"
    );
    std::fs::write(&source, text).unwrap();
    let compiler = std::env::var_os("RUSTC").unwrap_or("rustc".into());
    let output = Command::new(compiler)
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "lib",
            "--emit",
            "metadata",
            "-o",
        ])
        .arg(folder.path().join("fixture.rmeta"))
        .arg("-L")
        .arg(format!(
            "dependency={}",
            library.parent().unwrap().display()
        ))
        .arg("--extern")
        .arg(format!("mechaudit={}", library.display()))
        .arg(&source)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.success(), text.is_empty(), "{text}");
    text
}

#[test]
fn the_compiler_names_the_signature() {
    let library = library();
    for (code, parts) in [
        (
            "mechaudit::audit::<Faddeeva>(|x: f64| x)",
            &["Complex<f64>) -> _`", "Faddeeva>"][..],
        ),
        (
            "mechaudit::audit::<FourBar>(|x: f64| x)",
            &["takes 1 argument", "to take 3 arguments", "FourBar>"],
        ),
        (
            "mechaudit::audit::<Faddeeva>(3.0)",
            &["this is no candidate for `", "Fn(", "mechaudit describe"],
        ),
        (
            "mechaudit::audit::<Faddeeva>(|_: Complex64| \"text\")",
            &["`&str` is no answer of a candidate", "Option"],
        ),
    ] {
        let text = said(&library, code);
        for part in parts {
            assert!(text.contains(part), "{part:?} is missing in\n{text}");
        }
    }
}
