/// How good or bad something is; each form has its own colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// As it should be.
    Good,
    /// Wrong.
    Bad,
    /// Open, or of little weight.
    Doubt,
    /// Not known before.
    New,
    /// Neither.
    Plain,
}
