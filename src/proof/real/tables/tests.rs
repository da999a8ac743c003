use super::*;
use crate::pinned::{bit_by_bit, counted, largest};

/// Which centres are asked for rows, and what all that is stored is found to be wrong by.
#[test]
fn tables_of_the_solver_bit_by_bit() {
    let centres = Function::ALL.map(|f| counted(f.name(), points(f)));
    let all = Function::ALL.map(|f| Tables::of_the_solver(f).expect("decided"));
    let mut errors = Vec::new();
    for tables in &all {
        let mut keys: Vec<u64> = tables.rows.keys().copied().collect();
        keys.sort_unstable();
        errors.extend(keys.iter().step_by(10).map(|k| (*k, &tables.rows[k].1)));
    }
    let found = [
        counted("errors", errors),
        largest("exponential", all.iter().map(|t| t.exponential)),
        largest("series", all.iter().map(|t| t.near)),
        largest("constants", all.iter().flat_map(|t| t.constants)),
    ];
    let due = [
        ("erf", 0xfa15c9f2ad7bd145, 96.0),
        ("erfc", 0xcbf29ce484222325, 0.0),
        ("erfcx", 0xcbf29ce484222325, 0.0),
        ("dawson", 0x8ab3b061b5710742, 137.0),
        ("errors", 0x68afa6eda1c904a4, 24.0),
        ("exponential", 0x9b37966e7b0c4575, 7.054681641197559e-18),
        ("series", 0xb5cd05752b8700c5, 4.2911580492483906e-19),
        ("constants", 0x87d817f31535867d, 7.374751284825688e-34),
    ];
    bit_by_bit(&[&centres[..], &found].concat(), &due);
}
