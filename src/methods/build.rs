//! Finds the files of hard cases, so that a method need not name its own.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let folder =
        Path::new(&env::var_os("CARGO_MANIFEST_DIR").expect("set by cargo")).join("reference/hard");
    // Relative, so that it is the same in a copy of the project.
    println!("cargo::rerun-if-changed=reference/hard");
    let entries = fs::read_dir(&folder).expect("the folder of hard cases");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry of the folder of hard cases").path())
        .filter(|path| path.extension().is_some_and(|e| e == "csv"))
        .collect();
    files.sort();
    let mut code = String::from("fn hard(name: &str) -> &'static str {\n    match name {\n");
    for file in files {
        let name = file.file_stem().expect("a file has a name");
        writeln!(code, "        {name:?} => include_str!({file:?}),").expect("memory");
    }
    code += "        _ => \"\",\n    }\n}\n";
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by cargo"));
    fs::write(out.join("hard.rs"), code).expect("a file in the folder of the build");
}
