use super::*;

#[test]
fn exponential() {
    let e = Exponential::of(&Factors::default()).expect("bounds");
    let unit = 2f64.powi(52);
    eprintln!("{} {} {} {} {}", e.pair * unit, e.rounded * unit, e.short[0] * unit, e.short[1] * unit, e.boxes);
}
