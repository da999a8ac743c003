//! Equations that hold at positive inputs and at all others.

use super::{Graph, Id, Node};
use crate::Func::*;
use std::collections::HashSet;

impl Graph {
    /// Returns true if two real formulas that are equal at all positive inputs where both are
    /// defined are equal at all real inputs where both are. Inputs that are always positive are
    /// parameters; of what depends on them alone nothing is asked.
    ///
    /// The identity theorem gives it in two cases. Formulas of entire functions and quotients are
    /// holomorphic off the zeros of finitely many holomorphic functions, which leave ℂⁿ connected
    /// and meet the positive inputs in a set without interior. Formulas without quotients, of
    /// functions that are analytic on the real line, are analytic on ℝⁿ. The two do not mix:
    /// `arctan x + arctan 1/x` is `π/2` on one side of zero and `−π/2` on the other.
    pub fn continues(&self, formulas: [Id; 2], is_parameter: impl Fn(usize) -> bool) -> bool {
        let mut moves: Vec<bool> = Vec::with_capacity(self.len());
        for id in 0..self.len() as Id {
            moves.push(match self.node(id) {
                Node::Input(k) => !is_parameter(k as usize),
                node => self.operands(node).iter().any(|a| moves[*a as usize]),
            });
        }
        let (mut is_meromorphic, mut is_analytic) = (true, true);
        let (mut open, mut seen) = (formulas.to_vec(), HashSet::new());
        while let Some(id) = open.pop() {
            if !seen.insert(id) {
                continue;
            }
            let node = self.node(id);
            open.extend(self.operands(node).iter().filter(|_| moves[id as usize]));
            match node {
                Node::Number(_) | Node::Constant(_) | Node::Input(_) => {}
                // A number that may be complex.
                _ if !moves[id as usize] => is_analytic = false,
                Node::Neg(_) | Node::Add(..) | Node::Sub(..) | Node::Mul(..) => {}
                Node::Ternary(Fma, ..) => {}
                Node::Power(_, k) => is_analytic &= k >= 0,
                Node::Div(_, b) => {
                    is_analytic &= matches!(self.node(b), Node::Number(_) | Node::Constant(_));
                }
                Node::Unary(Exp | Exp2 | Exp10 | Expm1 | Sin | Cos | Sinh | Cosh | Erf, _) => {}
                // A quotient of entire functions, without poles on the real line.
                Node::Unary(Tanh, _) => {}
                Node::Unary(Tan, _) => is_analytic = false,
                Node::Unary(Arctan | Asinh, _) => is_meromorphic = false,
                _ => return false,
            }
        }
        is_meromorphic || is_analytic
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Definitions, parse_equation};

    /// `p` is a parameter, `x` and `y` have either sign.
    fn continues(equation: &str) -> bool {
        let mut graph = Graph::new(["x", "y", "p"].map(String::from));
        let e = parse_equation(equation).unwrap();
        let sides = [e.left, e.right].map(|e| graph.build(&Definitions::default(), &e).unwrap());
        graph.continues(sides, |k| k == 2)
    }

    #[test]
    fn quotients_of_entire_functions_continue() {
        for equation in [
            "x^2 - y^2 = x*x - y*y",
            "(x^2 - 1)/(x - 1) = x + 1",
            "exp(1/x)*exp(y) = exp((1 + x*y)/x)",
            "tan(x)*cos(x) = sin(x)",
            "sinh(x)/cosh(x) = tanh(x)",
            "x^(-1) = 1/x",
            "sqrt(p)*sqrt(p)*x = abs(p)*x",
        ] {
            assert!(continues(equation), "{equation}");
        }
    }

    #[test]
    fn functions_analytic_on_the_real_line_continue() {
        for equation in [
            "arctan(x)*2 = arctan(x) + arctan(x)",
            "arctan(x/2)*exp(y) = exp(y)*arctan(x/pi)",
            "asinh(tanh(x)) = asinh(p*x^3)",
        ] {
            assert!(continues(equation), "{equation}");
        }
    }

    /// Each holds, or may, for positive numbers alone.
    #[test]
    fn branches_and_jumps_do_not_continue() {
        for equation in [
            "sqrt(x^2) = x",
            "abs(x) = x",
            "log(x^2) = 2*log(x)",
            "pow(x^2, 1/2) = x",
            "arctan(1/x) = 1 - arctan(x)",
            "arctan(x^(-1)) = 1 - arctan(x)",
            "arctan(tan(x)) = x",
            "asinh(x*sqrt(p - 5)) = 0",
            "hypot(x, 0) = x",
            "fmax(x, -x) = x",
            "sum(k, 1, 3, k*abs(x)) = 6*x",
        ] {
            assert!(!continues(equation), "{equation}");
        }
    }
}
