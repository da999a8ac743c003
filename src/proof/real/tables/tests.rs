use super::*;
use crate::pinned::{bit_by_bit, counted, largest};

/// Which centres are asked for rows, and what all that is stored is found to be wrong by.
#[test]
fn tables_of_the_solver_bit_by_bit() {
    let centres = Function::ALL.map(|f| counted(f.name(), centres(f)));
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
        ("erf", 0xc9484a3b0bfb7a13, 24.0),
        ("erfc", 0x60154523fe53b08f, 29.0),
        ("erfcx", 0x60154523fe53b08f, 29.0),
        ("dawson", 0xf9ffdbc540f953b5, 137.0),
        ("errors", 0xc8926a1d60191675, 22.0),
        ("exponential", 0x9b37966e7b0c4575, 7.054681641197559e-18),
        ("series", 0x06b19f0620982664, 4.607513661184747e-19),
        ("constants", 0x87d817f31535867d, 7.374751284825688e-34),
    ];
    bit_by_bit(&[&centres[..], &found].concat(), &due);
}
