//! Angles that are reduced exactly.

use super::super::tests::value;

/// Angles in degrees, to 25 digits by mpmath: large ones, small ones, next to zeros, and quarters.
#[test]
fn rational_multiples_of_pi_are_reduced() {
    for (text, x, due) in [
        (
            "sin(x/180*pi)",
            (1_i64 << 62, 7),
            "-0.009973144676492593632965270",
        ),
        (
            "cos(pi*(x^3*x^2/180))",
            (1 << 30, 7),
            "0.8862657308623767464256948",
        ),
        (
            "tan(-(pi*x)/180 + pi/2)",
            (1, 1_000_000_007),
            "57295779914.15277746836858",
        ),
        (
            "sin(pi*(1 - x) - pi*3)*1e20",
            (1, 1 << 50),
            "-279029.4798406905519583393",
        ),
        ("cos(pi*x/2)", (3, 1), "0"),
        ("sin(pi/2*x)", (-7, 1), "1.000000000000000000000000"),
        ("tan(pi*x)", (5, 4), "1.000000000000000000000000"),
        (
            "tan(x*pi)",
            (-3, 2),
            "undefined: the tangent of a right angle: tan(x*PI)",
        ),
        // It is not needed.
        (
            "if(x > 0, 2, tan(x*pi))",
            (1, 2),
            "2.000000000000000000000000",
        ),
        (
            "cos(x*pi) + if(x > 0, 2, tan(x*pi))",
            (1, 2),
            "2.000000000000000000000000",
        ),
    ] {
        assert_eq!(value(text, x, 25), due, "{text}");
    }
}
