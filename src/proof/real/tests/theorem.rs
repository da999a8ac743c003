use super::*;

#[test]
fn print() {
    for function in Function::ALL {
        let t = std::time::Instant::now();
        let code = Code::of_the_solver(function).unwrap();
        eprintln!("{:?} tables {:?} exp {:e} near {:e} const {:?}", function, t.elapsed(), code.tables.exponential*2f64.powi(53), code.tables.near*2f64.powi(53), code.tables.constants);
        let found = real_line(&code, function, std::env::var("T").ok().and_then(|t| t.parse().ok()).unwrap_or(1.0), &Watch::default()).unwrap();
        eprintln!("{:?} {:?} open {} {:?}", function, t.elapsed(), found.open.len(), &found.open[..found.open.len().min(4)]);
        if let Some(s) = found.summary(function) {
            for f in s.formulas { eprintln!("{f:?}"); }
        }
        eprintln!("hole {:?}", hole(function, found.leaves.iter().map(|l| l.at)));
    }
}
