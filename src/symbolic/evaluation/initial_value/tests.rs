//! Certified motions against values from elsewhere and against closed forms.

use super::{InitialValueProblem, Limits, MotionError, ProblemError, State, Trajectory};
use crate::evaluation::Goal;
use crate::{Definitions, parse};
use rug::Rational;

/// A problem without inputs: a text `name = start, rate; …`.
fn problem(text: &str) -> Result<InitialValueProblem, ProblemError> {
    let states: Vec<State> = text
        .split(';')
        .map(|line| {
            let (name, rest) = line.split_once('=').unwrap();
            let (start, rate) = rest.split_once(" -> ").unwrap();
            let [start, rate] = [start, rate].map(|text| parse(text.trim()).unwrap());
            State::new(name.trim(), start, rate)
        })
        .collect();
    let zero = parse("0").unwrap();
    InitialValueProblem::new(&Definitions::default(), &[], "t", &zero, &states)
}

fn trajectory(text: &str) -> Trajectory {
    let problem = problem(text).unwrap();
    problem.trajectory(&[], Limits::default()).unwrap()
}

fn bits(digits: u32) -> Goal {
    Goal::Bits(digits * 10 / 3 + 4)
}

/// The decimals of all states at a time.
fn decimals(motion: &mut Trajectory, time: (i64, i64), digits: u32) -> Vec<String> {
    let found = motion.at(&Rational::from(time), bits(digits));
    let decimal = |ball: &mechaudit_reference::Ball| {
        let text = ball.to_decimal(digits as usize);
        text.unwrap_or_else(|| format!("{ball:?}"))
    };
    match found {
        Ok(balls) => balls.iter().map(decimal).collect(),
        Err(error) => vec![error.to_string()],
    }
}

const LORENZ: &str = "x = 1 -> 10*(y - x); y = 1 -> x*(28 - z) - y; z = 1 -> x*y - 8/3*z";
const PENDULUM: &str = "theta = 3 -> omega; omega = 0 -> -9.81*sin(theta)";

#[test]
fn survey() {
    let pleiades = {
        let x = ["3", "3", "-1", "-3", "2", "-2", "2"];
        let y = ["3", "-3", "2", "0", "0", "-4", "4"];
        let u = ["0", "0", "0", "0", "0", "1.75", "-1.5"];
        let v = ["0", "0", "0", "-1.25", "1", "0", "0"];
        let mut lines = Vec::new();
        for i in 0..7 {
            lines.push(format!("x{i} = {} -> u{i}", x[i]));
            lines.push(format!("y{i} = {} -> v{i}", y[i]));
        }
        for i in 0..7 {
            let sum = |c: &str| {
                let others = (0..7).filter(|j| *j != i);
                let term = |j: usize| {
                    format!(
                        "{}*({c}{j} - {c}{i})/pow((x{i} - x{j})^2 + (y{i} - y{j})^2, 3/2)",
                        j + 1
                    )
                };
                others.map(term).collect::<Vec<_>>().join(" + ")
            };
            lines.push(format!("u{i} = {} -> {}", u[i], sum("x")));
            lines.push(format!("v{i} = {} -> {}", v[i], sum("y")));
        }
        lines.join("; ")
    };
    let double = "a = 2 -> p; b = 1 -> q; \
        p = 0 -> (-9.81*3*sin(a) - 9.81*sin(a - 2*b) - 2*sin(a - b)*(q^2 + p^2*cos(a - b)))/(3 - cos(2*a - 2*b)); \
        q = 0 -> 2*sin(a - b)*(2*p^2 + 2*9.81*cos(a) + q^2*cos(a - b))/(3 - cos(2*a - 2*b))";
    let arenstorf = "x = 0.994 -> u; y = 0 -> v; \
        u = 0 -> x + 2*v - (1 - 0.012277471)*(x + 0.012277471)/pow((x + 0.012277471)^2 + y^2, 3/2) - 0.012277471*(x - 1 + 0.012277471)/pow((x - 1 + 0.012277471)^2 + y^2, 3/2); \
        v = -2.00158510637908252240537862224 -> y - 2*u - (1 - 0.012277471)*y/pow((x + 0.012277471)^2 + y^2, 3/2) - 0.012277471*y/pow((x - 1 + 0.012277471)^2 + y^2, 3/2)";
    let all: Vec<(&str, &str, (i64, i64), u32)> = vec![
        ("exponential", "y = 1 -> -y", (1, 1), 25),
        ("pendulum", PENDULUM, (10, 1), 25),
        ("lorenz", LORENZ, (10, 1), 25),
        (
            "roessler",
            "x = 1 -> -y - z; y = 1 -> x + y/5; z = 0 -> 1/5 + z*(x - 5.7)",
            (50, 1),
            25,
        ),
        (
            "duffing",
            "x = 1 -> v; v = 0 -> -v/5 - x^3 + x + cos(t^2/10)",
            (20, 1),
            25,
        ),
        ("vdp1", "x = 2 -> v; v = 0 -> (1 - x^2)*v - x", (20, 1), 25),
        (
            "vdp10",
            "x = 2 -> v; v = 0 -> 10*(1 - x^2)*v - x",
            (20, 1),
            25,
        ),
        ("double", double, (10, 1), 25),
        (
            "kepler",
            "x = 1/10 -> u; y = 0 -> v; u = 0 -> -x/pow(x^2 + y^2, 3/2); v = sqrt(19) -> -y/pow(x^2 + y^2, 3/2)",
            (20, 1),
            25,
        ),
        ("arenstorf", arenstorf, (17, 1), 25),
        (
            "brusselator",
            "x = 1.5 -> 1 + x^2*y - 4*x; y = 3 -> 3*x - x^2*y",
            (20, 1),
            25,
        ),
        (
            "rigid",
            "a = 0 -> b*c; b = 1 -> -a*c; c = 1 -> -0.51*a*b",
            (20, 1),
            25,
        ),
        (
            "kloss",
            "w = 0 -> 44/((1 - w/157)/0.2 + 0.2/(1 - w/157))/0.9; phi = 0 -> w",
            (10, 1),
            25,
        ),
        ("pleiades", &pleiades, (3, 1), 25),
        (
            "vdp100",
            "x = 2 -> v; v = 0 -> 100*(1 - x^2)*v - x",
            (200, 1),
            15,
        ),
        (
            "hires",
            "a = 1 -> -1.71*a + 0.43*b + 8.32*c + 0.0007; b = 0 -> 1.71*a - 8.75*b; c = 0 -> -10.03*c + 0.43*d + 0.035*e; d = 0 -> 8.32*b + 1.71*c - 1.12*d; e = 0 -> -1.745*e + 0.43*f + 0.43*g; f = 0 -> -280*f*h + 0.69*d + 1.71*e - 0.43*f + 0.69*g; g = 0 -> 280*f*h - 1.81*g; h = 0.0057 -> -280*f*h + 1.81*g",
            (321, 1),
            15,
        ),
        (
            "robertson",
            "a = 1 -> -0.04*a + 10000*b*c; b = 0 -> 0.04*a - 10000*b*c - 30000000*b^2; c = 0 -> 30000000*b^2",
            (40, 1),
            15,
        ),
    ];
    for (name, text, time, digits) in all {
        if std::env::var("ONLY").is_ok_and(|only| !only.split(',').any(|o| o == name)) {
            continue;
        }
        let clock = std::time::Instant::now();
        let mut motion = trajectory(text);
        let found = decimals(&mut motion, time, digits);
        println!("{name}: {:?} {} {found:?}", clock.elapsed(), motion.work());
    }
}
