//! The numbers in the text.

use crate::papers::ledger::Item;
use crate::papers::ledger::Kind::Number;

pub(super) fn items() -> Vec<Item> {
    let measured = |id, place| Item::new(id, place, Number).undefined();
    vec![
        Item::new("gs-drop", "law C_0", Number)
            .printed("drop = 2.34")
            .claims("The whole drop of the dynamic factor, from 2.2 to 0.94.")
            .requires(&["2.2/0.94 ~ drop within 0.005"])
            .note("A ratio, 2.3404."),
        Item::new("gs-increase", "figure 3", Number)
            .printed("increase = 14.5")
            .claims("The factor 1.70 is larger than 1.16 by so many per cent.")
            .requires(&["100*(1.70/1.16 - 1) ~ increase within 0.05"])
            .refuted(&[], "")
            .but_not("100*(1.695/1.165 - 1) < increase")
            .but_not("100*(1.70/1.16 - 1) ~ increase within 10")
            .note(
                "It is 46.55 %, and at least 45.4 % for any numbers that round to 1.70 and 1.16. No \
                 single wrong digit explains it.",
            ),
        Item::new("gs-speeds", "figure 3", Number)
            .printed("xi_b = 5.18")
            .claims("At ξ = 5.18 the shaft turns slower than at ξ = 3.50, by (1).")
            .with(&["xi_a = 3.50", "n_a = 1/xi_a", "n_b = 1/xi_b"])
            .requires(&["n_b < n_a"])
            .note("By (1) the speed is proportional to 1/ξ; the unit is immaterial."),
        Item::new("gs-range", "figure 5", Number)
            .printed("points = (14 - 2.0)/0.1 + 1")
            .claims("ξ from 2.0 to 14 in steps of 0.1.")
            .requires(&["points = 121"])
            .note("121 values for each law."),
        Item::new("gs-minute", "before (1)", Number)
            .printed("c = 30")
            .claims("The 30 in T_B and (1): revolutions per minute and radians.")
            .requires(&["pi/c = 2*pi/60"]),
        measured("gs-least-factor", "law C_0")
            .claims("The smallest factor is 0.94, at ξ = 4.81.")
            .note("Measured; neither law nor record is given."),
        measured("gs-largest-factor", "third group")
            .claims("The dynamic factor reaches 5.0.")
            .note("Measured; neither law nor record is given."),
        measured("gs-unevenness", "third group")
            .claims("The speed of the cam shaft varies by up to 12 %.")
            .note("Measured; the inertia of the shaft is not given."),
        measured("gs-newton-number", "closed follower")
            .claims("The Newton number is 0.11.")
            .note("Defined neither here nor by the data given."),
        measured("gs-misfit-amplitude", "figure 5")
            .claims("Theory and experiment differ by up to 16 % in the largest amplitude.")
            .note("D_n, δ_n, n_*, ω_* and ε of the calculation are not given."),
        measured("gs-misfit-phase", "figure 5")
            .claims("The zones of beating are displaced by 10 % at most.")
            .note("D_n, δ_n, n_*, ω_* and ε of the calculation are not given."),
    ]
}
