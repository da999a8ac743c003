//! Style sheets and scripts, embedded whole: a page asks nothing of the network.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// Of every page.
pub const FRAME_CSS: &str = include_str!("assets/frame.css");
/// Of papers and ledgers.
pub const PAPER_CSS: &str = include_str!("assets/paper.css");
/// The mechanism in motion.
pub const MOTION_CSS: &str = include_str!("assets/motion.css");
/// Of audits.
pub const AUDIT_CSS: &str = include_str!("assets/audit.css");

/// Of run-ups and oscillators.
pub const RUN_CSS: &str = include_str!("assets/run.css");

/// Of every page: colour scheme, filters, sorting, copying.
pub const FRAME_JS: &str = include_str!("assets/frame.js");
/// The mechanism in motion.
pub const MOTION_JS: &str = include_str!("assets/motion.js");
/// Histograms and errors against inputs.
pub const FIGURES_JS: &str = include_str!("assets/figures.js");
/// Error maps.
pub const MAP_JS: &str = include_str!("assets/map.js");
/// An audit's figures where they come into view, and the dialog of a case.
pub const AUDIT_JS: &str = include_str!("assets/audit.js");
/// D3, on which Observable Plot is built.
pub const D3_JS: &str = include_str!("assets/d3.min.js");
/// Observable Plot: scales, axes and marks as SVG.
pub const PLOT_JS: &str = include_str!("assets/plot.umd.min.js");

/// The name of a script in the content security policy of a page: its digest.
pub fn source(script: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(script)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_the_one_of_its_packages() {
        for line in include_str!("assets/sha256.txt").lines() {
            let (due, name) = line.split_once("  ").unwrap();
            let script = match name {
                "d3.min.js" => D3_JS,
                "plot.umd.min.js" => PLOT_JS,
                _ => panic!("{name}"),
            };
            let got: String = Sha256::digest(script)
                .iter()
                .map(|b| format!("{b:02x}"))
                .collect();
            assert_eq!(got, due, "{name}");
        }
    }

    #[test]
    fn no_script_ends_its_element() {
        for script in [
            FRAME_JS, MOTION_JS, FIGURES_JS, MAP_JS, AUDIT_JS, D3_JS, PLOT_JS,
        ] {
            assert!(!script.contains("</script") && !script.contains("<!--"));
        }
    }
}
