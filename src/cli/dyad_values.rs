//! The values of one position of a dyad's linkage and the numbers of its branches.

use mechaudit::solvers::dyad::Assembly;

/// Two coordinates, their first and second derivatives by the crank angle, the transmission angle
/// and the determinant. The coordinates are φ2 and φ3 of the four-bar, or the slider's coordinate
/// and φ2.
pub type Values<T> = [T; 8];

/// Both assemblies, in the order of their branch numbers.
pub const ASSEMBLIES: [Assembly; 2] = [Assembly::Positive, Assembly::Negative];

/// The number of an assembly in the column `branch`.
pub fn number(assembly: Assembly) -> usize {
    usize::from(assembly == Assembly::Negative)
}

/// The values with velocities and accelerations in the place of the derivatives.
pub fn at_crank_speed<T>(v: Values<T>, rates: impl Fn(&T, &T) -> (T, T)) -> Values<T> {
    let (w1, e1) = rates(&v[2], &v[4]);
    let (w2, e2) = rates(&v[3], &v[5]);
    let [p, q, _, _, _, _, transmission, determinant] = v;
    [p, q, w1, w2, e1, e2, transmission, determinant]
}
