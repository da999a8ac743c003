use super::*;
use crate::pinned::{bit_by_bit, counted, largest};

/// Which points and centres are asked for rows, and what these are found to be wrong by.
#[test]
fn tables_of_the_solver_bit_by_bit() {
    let tables = Tables::of_the_solver().expect("decided");
    let keys = |all: Vec<Key>| {
        let mut all = all;
        all.sort_unstable();
        all
    };
    let (cells, real, imaginary) = (
        keys(tables.cells.keys().copied().collect()),
        keys(tables.real_axis.keys().copied().collect()),
        keys(tables.imaginary_axis.keys().copied().collect()),
    );
    let errors = (cells.iter().step_by(40).map(|k| &tables.cells[k]))
        .chain(real.iter().step_by(30).map(|k| &tables.real_axis[k]))
        .map(|(_, e)| e);
    let on_axis = imaginary.iter().step_by(7);
    let on_axis = on_axis.map(|k| &tables.imaginary_axis[k].1);
    let found = [
        counted("points", in_cells()),
        counted("real axis", on_real_axis()),
        counted("imaginary axis", on_imaginary_axis()),
        counted("cells", &cells),
        counted("centres", &real),
        counted("of erfcx", &imaginary),
        counted("discs", keys(tables.discs.keys().copied().collect())),
        counted("errors", errors),
        counted("errors of erfcx", on_axis),
        largest("real line", tables.real_line),
        largest("exponential", [tables.exponential]),
    ];
    let due = [
        ("points", 0x1e8f272bb9579867, 2947.0),
        ("real axis", 0xb2d049567d754e88, 127.0),
        ("imaginary axis", 0x60154523fe53b08f, 29.0),
        ("cells", 0xac092585a689e399, 417.0),
        ("centres", 0xdd743c5ef78323a5, 127.0),
        ("of erfcx", 0xe82e1b8d3498e1e1, 29.0),
        ("discs", 0x8bcb6f69b26afe03, 25.0),
        ("errors", 0xef6f14f7f1b5aecc, 16.0),
        ("errors of erfcx", 0x2984dcd256cf26a8, 5.0),
        ("real line", 0xbec0e5c1fb955ff5, 2.0403133907668058e-16),
        ("exponential", 0x9851e6306943c176, 7.054681641169467e-18),
    ];
    bit_by_bit(&found, &due);
}
