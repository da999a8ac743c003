//! Linear systems.

pub(super) use tridiagonal::identical;

crate::methods::definition::methods! {
    tridiagonal: Tridiagonal;
    tridiagonal_pivoting: TridiagonalPivoting;
    cyclic_tridiagonal: CyclicTridiagonal;
}
