//! The switch that is put into the crate under test.

/// Its source: `on(n)` tells whether mutant `n` is the one that the environment names. With a trace
/// asked for, the numbers reached are appended to that file, each once for a process.
pub const SOURCE: &str = r#"
#[doc(hidden)]
#[allow(missing_docs, clippy::all)]
pub mod mutant_switch {
    use std::io::Write;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicBool, Ordering};

    const MOST: usize = 1 << 16;
    static REACHED: [AtomicBool; MOST] = [const { AtomicBool::new(false) }; MOST];
    static ACTIVE: OnceLock<u32> = OnceLock::new();
    static TRACE: OnceLock<Option<String>> = OnceLock::new();

    #[inline(never)]
    pub fn on(n: u32) -> bool {
        let active = *ACTIVE.get_or_init(|| {
            let named = std::env::var("MUTANT").ok();
            named.and_then(|v| v.parse().ok()).unwrap_or(u32::MAX)
        });
        if active != u32::MAX {
            return active == n;
        }
        let trace = TRACE.get_or_init(|| std::env::var("MUTANT_TRACE").ok());
        if let Some(path) = trace
            && !REACHED[n as usize % MOST].swap(true, Ordering::Relaxed)
        {
            let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
            if let Ok(mut file) = file {
                let _ = file.write_all(format!("{n}\n").as_bytes());
            }
        }
        false
    }
}
"#;
