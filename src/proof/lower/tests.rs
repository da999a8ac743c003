use super::*;

#[test]
fn exponential() {
    let e = Exponential::of(&Factors::default()).expect("bounds");
    let unit = 2f64.powi(52);
    eprintln!("{} {} {} {} {}", e.pair * unit, e.rounded * unit, e.short[0] * unit, e.short[1] * unit, e.boxes);
}


fn code() -> Code {
    Code {
        tables: crate::Tables::of_the_solver().unwrap(),
        rows: rows::Rows::of_the_solver().unwrap(),
        formula: mechaudit_solvers::faddeeva::proof::lower::formula,
        exponential: Exponential { pair: 0.1346 / 2f64.powi(52), rounded: 1.957 / 2f64.powi(52), short: [2.31 / 2f64.powi(52), 1.51 / 2f64.powi(52)], leading: 0.0, boxes: 0 },
        limits: mechaudit_solvers::faddeeva::proof::lower::LIMITS,
        rounding: Default::default(),
    }
}

#[test]
fn plane() {
    let code = code();
    let t = std::time::Instant::now();
    let watch = crate::Watch::default();
    //let d = Dominated::of(&crate::Code::of_the_solver().unwrap(), &code.exponential, &code.limits, &watch);
    //eprintln!("{d:?} {:?}", t.elapsed());
    for (lo, hi) in [(4.0, 8.0), (8.0, 16.0), (0.0, 1e300)] {
        let t = std::time::Instant::now();
        let c = lower_half_plane(&code, Target { depth: 30, ..LOWER_HALF_PLANE }, &watch, |r| { let m = r.a[1].max(r.b[1]); lo <= m && m < hi }).unwrap();
        let mut worst = std::collections::BTreeMap::new();
        for l in &c.leaves { let e = worst.entry(l.region.name()).or_insert((0, 0.0f64, 0.0f64)); e.0 += 1; e.1 = e.1.max(l.norm); e.2 = e.2.max(l.away); }
        eprintln!("{lo} {hi}: {} open {:?} {:?} {:#?}", c.open.len(), c.open.iter().step_by(c.open.len() / 6 + 1).collect::<Vec<_>>(), t.elapsed(), worst);
    }
}

#[test]
fn cells() {
    let code = code();
    for (a, b, d) in [(1.0, 1.0, 0.01), (1.1, 1.1, 0.01), (1.1, 1.1, 0.001), (1.9,1.3, 0.01),(1.99,1.35,0.01),(1.99,1.35,0.001), (1.37, 1.12, 0.001),(1.37, 1.37, 0.001), (2.1,0.6,0.001), (3.0,3.0,0.01),(5.0,4.5,0.01)] {
        let at = crate::Rectangle { a: [a, a + d], b: [b, b + d] };
        for (at, r) in regions::regions(&code, &at).unwrap() {
            let v = regions::values(&code, r, &at).unwrap();
            eprintln!("{a} {b} {d} {r:?} {:?} {:?} decay {:?} W {:?}", v[0].norm(), regions::bound(&code, r, &at), reflection::exponential([reflection::decay(&at).lo, reflection::decay(&at).hi]), v[0]);
        }
    }
}
