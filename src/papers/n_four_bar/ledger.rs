//! The ledger: what is printed of bars and start, the reduction to one angle for every N, the
//! windows' loops, and what happens with all bars on one line.
//!
//! φ is a crank's angle from upright, θ from x; `w` is φ'. Directions a, b, c of left crank, right
//! crank and rod of a window are complex numbers of size 1; u, v, r are their rates.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::{Formula, Number, Statement};

/// Heights of the centres and the kinetic energy of all bars.
const BARS: [&str; 7] = [
    "x_c = l*sin(phi)/2",
    "y_c = l*cos(phi)/2",
    "x_r = l*sin(phi)",
    "y_r = l*cos(phi)",
    "T_c = m*((D(x_c, phi)*w)^2 + (D(y_c, phi)*w)^2)/2 + m*l^2/12*w^2/2",
    "T_r = m*((D(x_r, phi)*w)^2 + (D(y_r, phi)*w)^2)/2",
    "T = (N + 1)*T_c + N*T_r",
];
/// Their reduced inertia and potential.
const REDUCED: [&str; 2] = [
    "I_N = (4*N + 1)*m*l^2/3",
    "V_N = (3*N + 1)*m*g*l*cos(phi)/2",
];
/// A window in complex numbers; the second is the conjugate.
const WINDOW: [&str; 2] = ["g_1 = a + c - 1 - b", "g_2 = 1/a + 1/c - 1 - 1/b"];
/// A window in angles.
const LOOP: [&str; 2] = [
    "h_x = cos(alpha) + cos(gamma) - 1 - cos(beta)",
    "h_y = sin(alpha) + sin(gamma) - sin(beta)",
];
/// Acceleration over −g/l at the horizontal position, on the parallelogram branch.
const FALL: [&str; 1] = ["f = 3*(3*N + 1)/(2*(4*N + 1))"];

/// All entries.
pub fn items() -> Vec<Item> {
    let mut all = specification();
    all.extend(reduction());
    all.extend(windows());
    all.extend(one_line());
    all
}

fn specification() -> Vec<Item> {
    vec![
        Item::new("nb-links", "specification", Statement)
            .claims("N four-bar linkages in a row have 2N + 1 links.")
            .model()
            .also("(N + 1) + N = 2*N + 1"),
        Item::new("nb-one", "specification", Statement)
            .claims("One degree of freedom: 2N + 1 angles less two equations for every window.")
            .model()
            .also("(2*N + 1) - 2*N = 1"),
        Item::new("nb-increase", "specification", Statement)
            .claims("In the horizontal position the degrees of freedom increase from 1 to N + 1.")
            .with(&LOOP)
            .model()
            .also("at(at(at(D(h_x, alpha), alpha, 0), beta, 0), gamma, 0) = 0")
            .also("at(at(at(D(h_x, beta), alpha, 0), beta, 0), gamma, 0) = 0")
            .also("at(at(at(D(h_x, gamma), alpha, 0), beta, 0), gamma, 0) = 0")
            .also("at(at(at(D(h_y, gamma), alpha, 0), beta, 0), gamma, 0) = 1")
            .also("(2*N + 1) - N = N + 1")
            .note(
                "The x row of every window vanishes there, so the rank is N and N + 1 rates are free. That is \
                 true of the Jacobian and of no motion: see nb-order-2.",
            ),
        Item::new("nb-bar", "copies", Formula)
            .printed("J = m*l^2/12")
            .claims("The moment of inertia of a uniform bar about its centre.")
            .with(&["F = m/l*x^3/3"])
            .requires(&["J = at(F, x, l/2) - at(F, x, -l/2)", "D(F, x) = m/l*x^2"]),
        Item::new("nb-start-crank", "copies", Formula)
            .printed("v_c = v_0/2")
            .claims("The velocity of a crank's centre at the start, where B0 has v_0.")
            .with(&BARS)
            .requires(&["v_c = at(D(x_c, phi), phi, 0)*v_0/l"]),
        Item::new("nb-start-rod", "copies", Formula)
            .printed("v_r = v_0")
            .claims("The velocity of a rod at the start.")
            .with(&BARS)
            .requires(&["v_r = at(D(x_r, phi), phi, 0)*v_0/l"]),
        Item::new("nb-start-t", "copies", Number)
            .printed("T_0 = 3/2")
            .claims("The kinetic energy at the start in J for N = 2.")
            .with(&BARS)
            .requires(&["T_0 = at(at(at(at(at(T, N, 2), phi, 0), w, 1), m, 1), l, 1)"]),
        Item::new("nb-start-v", "copies", Number)
            .printed("V_0 = 7/2*m*g")
            .claims("The potential energy at the start for N = 2 and l = 1.")
            .with(&BARS)
            .requires(&["V_0 = at(at(m*g*((N + 1)*at(y_c, phi, 0) + N*at(y_r, phi, 0)), N, 2), l, 1)"]),
        Item::new("nb-drift", "copies", Statement)
            .claims("Without dissipation the mechanical energy does not vary.")
            .with(&REDUCED)
            .with(&["T = I_N*w^2/2", "w_t = -D(V_N, phi)/I_N"])
            .model()
            .also("D(T, w)*w_t + D(V_N, phi)*w = 0"),
    ]
}

fn reduction() -> Vec<Item> {
    let item = |id, form| {
        Item::new(id, "reduction", Formula)
            .composed(form)
            .with(&BARS)
    };
    vec![
        item("nb-inertia", "I_N = (4*N + 1)*m*l^2/3")
            .claims("The inertia of all bars for the crank angle, on the parallelogram branch.")
            .requires(&["I_N = D(D(T, w), w)"]),
        item("nb-potential", "V_N = (3*N + 1)*m*g*l*cos(phi)/2")
            .claims("The potential energy of all bars.")
            .requires(&["V_N = m*g*((N + 1)*y_c + N*y_r)"]),
        item("nb-motion", "w_t = 3*(3*N + 1)*g*sin(phi)/(2*(4*N + 1)*l)")
            .claims("The equation of motion: a pendulum.")
            .with(&REDUCED)
            .requires(&["I_N*w_t = -D(V_N, phi)"]),
        item(
            "nb-energy",
            "s = v_0^2/l^2 + 3*(3*N + 1)*g*(1 - cos(phi))/((4*N + 1)*l)",
        )
        .claims("The square of φ' by the energy. It is never less than at the start: the cranks turn over.")
        .with(&REDUCED)
        .requires(&["I_N*s/2 + V_N = I_N*v_0^2/(2*l^2) + at(V_N, phi, 0)"]),
        item("nb-halves", "s = p_2*cos(phi/2)^2 + q_2*sin(phi/2)^2")
            .claims("The same with the squares at the top and at the bottom.")
            .with(&["q_2 = p_2 + 2*k"])
            .requires(&["s = p_2 + k*(1 - cos(phi))"]),
    ]
}

fn windows() -> Vec<Item> {
    let fits = |id, claim, first: &'static str, second: &'static str| {
        Item::new(id, "windows", Statement)
            .claims(claim)
            .with(&WINDOW)
            .model()
            .also(first)
            .also(second)
    };
    vec![
        Item::new("nb-window", "windows", Formula)
            .composed("(a + c)*(b - a*c) = a*b*c*g_2 - a*c*g_1")
            .claims("Where a window is closed, a + c = 0 or b = a c.")
            .with(&WINDOW)
            .requires(&["left = right"]),
        Item::new("nb-window-2", "windows", Formula)
            .composed("(1 - a)*(1 - c) = -at(g_1, b, a*c)")
            .claims("Where b = a c, it is a = 1 or c = 1.")
            .with(&WINDOW)
            .requires(&["left = right"]),
        fits(
            "nb-parallelogram",
            "c = 1 and b = a: cranks turn alike, the rod does not turn.",
            "at(at(g_1, c, 1), b, a) = 0",
            "at(at(g_2, c, 1), b, a) = 0",
        ),
        fits(
            "nb-left-folded",
            "a = 1 and c = b: the left crank lies on the ground, rod and right crank turn as one.",
            "at(at(g_1, a, 1), c, b) = 0",
            "at(at(g_2, a, 1), c, b) = 0",
        ),
        fits(
            "nb-right-folded",
            "a + c = 0, which leaves b = -1: the right crank lies on the ground, rod and left crank turn as one.",
            "at(at(g_1, c, -a), b, -1) = 0",
            "at(at(g_2, c, -a), b, -1) = 0",
        )
        .also("at(g_1, c, -a) = -(1 + b)"),
        Item::new("nb-determinant", "windows", Formula)
            .composed("d = -sin(theta)")
            .claims("A window's determinant on the parallelogram branch: regular but where all bars lie on one line.")
            .with(&LOOP)
            .requires(&[
                "d = at(at(D(h_x, alpha)*D(h_y, gamma) - D(h_x, gamma)*D(h_y, alpha), gamma, 0), alpha, theta)",
            ]),
    ]
}

fn one_line() -> Vec<Item> {
    let order = |id, form, claim, loops: &'static [&'static str]| {
        Item::new(id, "one line", Formula)
            .composed(form)
            .claims(claim)
            .requires(loops)
    };
    vec![
        order(
            "nb-order-2",
            "z = 2*u*(u - v)",
            "What the loop's x asks of the rates to the second order, both cranks to the right: u = 0 or u = v.",
            &["z = u^2 + (v - u)^2 - v^2"],
        ),
        order(
            "nb-order-2-apart",
            "z = -2*u*v",
            "The same, left crank to the right and right crank to the left: u = 0 or v = 0.",
            &["z = u^2 - (u + v)^2 + v^2"],
        ),
        order(
            "nb-order-2-left",
            "z = 2*v*(v - u)",
            "The same, both cranks to the left: v = 0 or u = v.",
            &["z = -u^2 + (u - v)^2 + v^2"],
        ),
        order(
            "nb-rod-energy",
            "T_r = m*l^2*(u^2 + u*v + v^2)/6",
            "The energy of a rod whose ends move across it with the rates l u, l v.",
            &["T_r = m*(l*(u + v)/2)^2/2 + m*l^2/12*(v - u)^2/2"],
        ),
        Item::new("nb-alone", "one line", Statement)
            .claims(
                "With finite forces in the joints the equations of motion in the position itself would have all \
                 cranks fall alike.",
            )
            .with(&FALL)
            .model()
            .also("2/3*(6/5) + 1/6*(6/5) = 1")
            .also("1/6*(9/8) + 9/8 + 1/6*(9/8) = 3/2")
            .but_not("6/5 = 9/8")
            .also("at(f, N, 1) = 6/5")
            .note(
                "The outer cranks would have to fall with 6/5 g/l, those between them with 9/8. For N = 1 there are \
                 only outer ones, and 6/5 is the acceleration on the branch.",
            ),
        order(
            "nb-fall",
            "f = 3*(3*N + 1)/(2*(4*N + 1))",
            "Acceleration over -g/l on the branch in the horizontal position.",
            &["f*g/l = at(w_t, c_0, 1)"],
        )
        .with(&["w_t = 3*(3*N + 1)*g*c_0/(2*(4*N + 1)*l)"]),
        order(
            "nb-moment",
            "M_x = l*cos(theta)*Y - m*g*l*cos(theta)/2 - m*l^2/3*t_2",
            "What the moments about a crank's pivot leave for l sin θ X, with the force (X, Y) of the rods on its end.",
            &["m*l^2/3*t_2 = -m*g*l*cos(theta)/2 + l*cos(theta)*Y - M_x"],
        ),
        order(
            "nb-pole-outer",
            "P_0 = -(N - 1)/(4*(4*N + 1))",
            "The limit of X sin θ/(m g) at an outer crank, which carries half a rod.",
            &["P_0 = f/3 - 1/2 - (1 - f)/2"],
        )
        .with(&FALL),
        order(
            "nb-pole-inner",
            "P_1 = 1/(2*(4*N + 1))",
            "The limit at the others, which carry two halves.",
            &["P_1 = f/3 - 1/2 - (1 - f)"],
        )
        .with(&FALL),
        order(
            "nb-poles",
            "P_k = (2*k + 1 - N)/(4*(4*N + 1))",
            "The limit of sin θ/(m g) times the force along rod k, k = 0 to N - 1: the sum over the cranks before it.",
            &["P_k = P_0 + k*P_1", "at(P_k, k, N - 1) = -P_0"],
        )
        .with(&["P_0 = -(N - 1)/(4*(4*N + 1))", "P_1 = 1/(2*(4*N + 1))"]),
    ]
}
