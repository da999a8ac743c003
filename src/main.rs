//! The command-line program; see `mechaudit --help`.
#![forbid(unsafe_code)]

// The program's rooms, and the library's modules under the same names.
extern crate mechaudit_cli as mechaudit;

mod cli;
#[cfg(test)]
#[path = "report/gallery.rs"]
mod gallery;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    cli::main()
}
