//! The library as its user meets it: solvers, references, audit, methods and papers together.

/// As the program.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[cfg(feature = "oracle")]
mod campaigns;
#[cfg(feature = "oracle")]
mod conditions;
#[cfg(feature = "oracle")]
mod documented_accuracy;
#[cfg(feature = "oracle")]
mod double_butterfly;
#[cfg(feature = "oracle")]
mod fuzz_parsers;
mod fuzz_solvers;
#[cfg(feature = "oracle")]
mod gembara_senyk;
#[cfg(feature = "oracle")]
mod independent;
#[cfg(feature = "oracle")]
mod inventory;
#[cfg(feature = "oracle")]
mod jansen_leg;
#[cfg(feature = "oracle")]
mod layouts;
#[cfg(feature = "oracle")]
mod ledger;
#[cfg(feature = "oracle")]
mod linear_witness;
#[cfg(feature = "oracle")]
mod methods;
#[cfg(feature = "oracle")]
mod peaucellier;
#[cfg(feature = "oracle")]
mod pinned;
#[cfg(feature = "oracle")]
mod planar_rows;
#[cfg(feature = "oracle")]
mod planted_faults;
#[cfg(feature = "oracle")]
mod run_up_accuracy;
#[cfg(feature = "oracle")]
mod run_up_witness;
#[cfg(feature = "oracle")]
mod signatures;
#[cfg(feature = "oracle")]
mod solver_bits;
#[cfg(feature = "oracle")]
mod solver_values;
#[cfg(feature = "oracle")]
mod swept_peak;
#[cfg(feature = "oracle")]
mod zinchenko;

/// Compares a text with `snapshots/NAME.snap`.
#[cfg(feature = "oracle")]
fn pin(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}
