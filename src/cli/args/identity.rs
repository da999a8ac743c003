//! Arguments of `mechaudit identity`.

use super::TextOrJson;
use clap::Args as ClapArgs;

pub const AFTER_HELP: &str = "\
Examples:
  echo 'sin(2*x) = 2*sin(x)*cos(x)' | mechaudit identity
  echo 'D(y, t) = -y' | mechaudit identity --define 't: y = -y'
  mechaudit identity --define 'r = sqrt(x^2 + y^2)' --format json < eqs.txt

Input: one equation a line, LEFT = RIGHT. Blank lines and lines that begin with # are skipped.

  + - * / ( )      arithmetic; numbers are decimals and exact
  x^3, x^(-2)      integer powers
  exp sin cos sqrt W re im abs arg arctan
                   functions of one argument; roots and arguments are
                   principal values
  int(s, a, b, f)  the integral of f over s from a to b
  sum(n, a, b, f)  the sum of f over the whole numbers n from a to b
  series(n, f)     a series of like terms; equality is decided term by term
  D(f, x)          the derivative of f by x
  at(f, x, v)      f with the value v in place of x
  a[n]             a symbol with an index

A symbol that nothing defines stands for any positive real number; pi is the constant, i the imaginary \
unit, and inf the upper limit of a sum or an integral without end.

Output: one line for each equation, in the same order.

  proved           the two sides are equal wherever both are defined
  refuted at x = 3/4: left - right = 0.19
                   a point at which the two sides differ, and by how much
  undecided: WHY   neither was found; this is no verdict

With --format json each line is an object: line, equation, outcome, residual (the normal form of left minus right, if \
there is one), witness (point and residual) and reason.

A line that cannot be read ends the run with its number and the character on standard error and exit code 2. \
Lines before it are answered, lines after it are not.

Exit codes: 0, every equation is proved; 1, one is not; 2, bad usage or input.";

/// Arguments of `identity`.
#[derive(ClapArgs, Debug)]
pub struct IdentityArgs {
    /// A definition, `name = expression`, or an image under a derivation, `t: x = expression`,
    /// which makes D(x, t) that expression; may be given several times
    #[arg(long, value_name = "DEFINITION")]
    pub define: Vec<String>,
    /// Form of the answers; json is an object on each line
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
