use super::*;
use crate::evaluation::Interpretation;
use mechaudit_reference::{Ball, Mag};
use proptest::prelude::*;

/// Functions of one complex number that are holomorphic but for cuts.
const FUNCTIONS: [Func; 22] = [
    Func::Exp,
    Func::Expm1,
    Func::Log,
    Func::Log1p,
    Func::Sqrt,
    Func::Sin,
    Func::Cos,
    Func::Tan,
    Func::Asin,
    Func::Acos,
    Func::Arctan,
    Func::Sinh,
    Func::Tanh,
    Func::Asinh,
    Func::Acosh,
    Func::Atanh,
    Func::Erf,
    Func::Erfcx,
    Func::Dawson,
    Func::W,
    Func::Tgamma,
    Func::LambertW,
];

fn number(re: f64, im: f64) -> ComplexBall {
    let of = |x| Ball::exact(120, x).widened(Mag::power_of_two(-90));
    ComplexBall::new(of(re), of(im))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// On the real line an image is the conjugate of the value, of every operation and function; the
    /// parts are those of the complex number.
    #[test]
    fn images_are_conjugates_on_the_real_line(
        [a, b, c, d] in prop::array::uniform4(-3.0..3.0f64),
        constant in any::<bool>(),
    ) {
        let mut balls = Balls::new(120);
        balls.mirrors = true;
        balls.holomorphic = true;
        let (x, y) = (number(a, b), number(c, d));
        let first = Mirrored::value(x.clone(), Some(x.conj()));
        let second = match constant {
            true => Value::Complex(y.clone()),
            false => Value::Continued(number(c, 0.0)),
        };
        let mut found = vec![
            balls.add(&first, &second),
            balls.sub(&second, &first),
            balls.mul(&first, &second),
            balls.div(&second, &first),
            balls.power(&first, -3),
            balls.neg(&first),
            balls.call(Func::Conj, &[&first]),
            balls.call(Func::Pow, &[&first, &second]),
            balls.call(Func::W, &[&Value::Continued(number(a, 0.0))]),
        ];
        found.extend(FUNCTIONS.map(|f| balls.call(f, &[&first])));
        for (k, value) in found.into_iter().enumerate() {
            // Next to a cut there is none.
            let Ok(value) = value else { continue };
            let (value, image) = (value.to_complex().unwrap(), value.image());
            let image = image.map(|z| z.conj());
            let agrees = image.is_none_or(|z| z.re.overlaps(&value.re) && z.im.overlaps(&value.im));
            prop_assert!(agrees, "{} {} {} {} {}", k, a, b, c, d);
        }
        let part = |f: Func| balls.clone().call(f, &[&first]).ok().and_then(|x| x.to_complex());
        let size = a.hypot(b);
        for (f, due) in [(Func::Re, a), (Func::Im, b), (Func::Abs, size), (Func::Arg, b.atan2(a))] {
            let Some(z) = part(f) else { continue };
            let off = [z.re.mid().to_f64() - due, z.im.mid().to_f64()];
            prop_assert!(off.iter().all(|x| x.abs() < 1e-12), "{:?} {} {}", f, a, b);
        }
    }
}
