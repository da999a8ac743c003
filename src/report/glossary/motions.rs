//! Columns of linkages, run-ups and cam-driven oscillators.

use super::{Topic, column};

#[rustfmt::skip]
pub const LINKAGE: Topic = Topic {
    key: "linkage",
    title: "Columns of a linkage",
    columns: &[
        column("phi1_deg", "", "crank angle, from the x axis"),
        column("phi_deg", "", "angle of the drive"),
        column("s_m", "", "travel of the drive"),
        column("branch", "", "number of the assembly mode, from 0"),
        column("phi*_deg", "", "angle of link *, from the x axis"),
        column("omega*_rad_per_s", "", "angular velocity of link * or body *"),
        column("epsilon*_rad_per_s2", "", "angular acceleration of link * or body *"),
        column("dphi*_dphi1", "", "angular velocity of link * over that of the crank"),
        column("d2phi*_dphi1_2_per_rad", "", "second derivative of the angle of link * by the crank angle"),
        column("slider_m", "", "coordinate of the slider along its guide"),
        column("dslider_dphi1_m_per_rad", "", "derivative of the slider's coordinate by the crank angle"),
        column("d2slider_dphi1_2_m_per_rad2", "", "its second derivative by the crank angle"),
        column("slider_velocity_m_per_s", "", "velocity of the slider"),
        column("slider_acceleration_m_per_s2", "", "acceleration of the slider"),
        column("I_n_kg_m2", "", "moment of inertia of all links reduced to the drive"),
        column("dI_n_dphi_kg_m2_per_rad", "", "derivative of I_n by the drive's angle"),
        column("M_o_N_m", "", "moment of weights and loads reduced to the drive, positive where it drives"),
        column("dM_o_dphi_N_m_per_rad", "", "derivative of M_o by the drive's angle"),
        column("m_n_kg", "", "mass of all bodies reduced to the drive"),
        column("dm_n_ds_kg_per_m", "", "derivative of m_n by the drive's travel"),
        column("F_o_N", "", "force of weights and loads reduced to the drive, positive where it drives"),
        column("dF_o_ds_N_per_m", "", "derivative of F_o by the drive's travel"),
        column("drive_N_m | drive_N", "",
            "moment or force that the drive has to give at its speed and acceleration"),
        column("det_J_m4", "", "determinant of the Jacobian of the loop equations: zero at a fold"),
        column("condition", "",
            "upper bound on the condition number of the loop equations, by floating point"),
        column("pressure_angle_deg", "",
            "angle between link 2 and the path of B: 0 is best, 90 a singular position"),
        column("transmission_angle_deg", "",
            "transmission angle between coupler and rocker, or rod and guide's normal"),
        column("transmission_*_deg", "", "transmission angle between the two bodies of a dyad"),
        column("determinant_m2 | determinant_m", "",
            "determinant of the loop equations: zero at a dead position"),
        column("d2*_dphi_2 | d2*_ds_2", "", "second derivative of a column by the drive"),
        column("d*_dphi | d*_ds", "", "derivative of a column by the drive's angle or travel"),
        column("x_*_m | y_*_m", "", "coordinates of the point *"),
        column("s_*_m", "", "travel in the slide or slot *"),
        column("v_*_m_per_s", "", "velocity along the coordinate or travel *"),
        column("a_*_m_per_s2", "", "acceleration along the coordinate or travel *"),
        column("curvature_*_per_m", "", "curvature of the path of the point *"),
        column("Fx_*_N | Fy_*_N", "", "components of the force in a joint on the body named after it"),
        column("M_*_N_m", "", "moment in a slide on the body named after it"),
        column("*_deg", "", "angle of the body *, from the x axis"),
    ],
};

#[rustfmt::skip]
pub const RUN_UP: Topic = Topic {
    key: "runup",
    title: "Columns of a run-up",
    columns: &[
        column("t_s", "", "time since the start"),
        column("phi1_deg", "", "crank angle, whole turns included"),
        column("omega_rad_per_s", "", "angular velocity of the crank"),
        column("epsilon_rad_per_s2", "", "angular acceleration of the crank"),
        column("I_kg_m2", "", "I_n and all inertia that turns with the crank"),
        column("M_motor_N_m", "", "torque of the motor at the crank"),
        column("M_o_N_m", "", "moment of the weights reduced to the crank"),
        column("M_load_N_m", "", "torque of the load at the crank"),
        column("kinetic_energy_J", "", "kinetic energy of the machine"),
        column("work_motor_J", "", "work of the motor since the start"),
        column("work_weights_J", "", "work of the weights since the start"),
        column("work_load_J", "", "work of the load since the start"),
        column("energy_balance_J", "",
            "gain of kinetic energy less the three works: the error of the integration"),
    ],
};

#[rustfmt::skip]
pub const WORK_PRECISION: Topic = Topic {
    key: "work-precision",
    title: "Columns of work and precision",
    columns: &[
        column("method", "", "method of integration"),
        column("tolerance", "", "tolerance of a step"),
        column("evaluations", "", "evaluations of the right-hand side in the whole run"),
        column("error_rad_per_s", "", "worst error of the speed found, against the finest run"),
    ],
};

#[rustfmt::skip]
pub const CHIRP_HISTORY: Topic = Topic {
    key: "history",
    title: "Columns of an oscillator's history",
    columns: &[
        column("t_s", "", "time"),
        column("shaft_deg", "", "angle of the shaft, whole turns included"),
        column("speed_rad_per_s", "", "angular velocity of the shaft"),
        column("xi_rise", "", "frequency criterion: w over 2 pi per time of the rise at this speed"),
        column("xi_turn", "", "frequency criterion with the turn as period: w over the speed"),
        column("f_m", "", "displacement that the cam prescribes"),
        column("y_m", "", "displacement of the follower"),
        column("v_m_per_s", "", "velocity of the follower"),
        column("a_m_per_s2", "", "acceleration of the follower"),
        column("envelope_low_m", "",
            "lower bound on y: a_0 less the amplitudes of harmonics and free vibration"),
        column("envelope_high_m", "", "upper bound on y: a_0 and these amplitudes"),
    ],
};

#[rustfmt::skip]
pub const CHIRP_CHART: Topic = Topic {
    key: "chart",
    title: "Columns of an oscillator's chart",
    columns: &[
        column("law", "", "law of the cam's rise"),
        column("xi_rise", "", "frequency criterion: w over 2 pi per time of the rise at this speed"),
        column("xi_turn", "", "frequency criterion with the turn as period: w over the speed"),
        column("t_s", "", "time at which the shaft has this speed"),
        column("speed_rad_per_s", "", "angular velocity of the shaft"),
        column("formula_19", "lifts", "sum of the |A_k|, formula (19): a bound on |y - a_0|"),
        column("peak_displacement", "lifts", "true peak of |y - a_0| in the turn about this point"),
        column("C_phi_bound", "h(Ω/β)²", "w² times the sum of the |D_k - A_k|"),
        column("C_phi", "h(Ω/β)²", "true peak of the follower's acceleration in the turn about this point"),
        column("K_dc", "", "dynamic coefficient of the acceleration: C_phi over C of the rigid follower"),
        column("K_dM", "", "dynamic coefficient of the moments y'' df/dθ of inertia on the camshaft"),
        column("K_dN", "", "dynamic coefficient of the kinetic power y' y''"),
        column("dwell_amplitude", "lifts", "amplitude of the free vibration at the end of the high dwell"),
        column("dwell_phase_deg", "", "phase of that vibration there"),
    ],
};

#[rustfmt::skip]
pub const CHIRP_SPECTRUM: Topic = Topic {
    key: "spectrum",
    title: "Columns of a cam's spectrum",
    columns: &[
        column("n", "", "order of the harmonic of the shaft's turn"),
        column("a_m", "", "coefficient a_n of the cosine"),
        column("b_m", "", "coefficient b_n of the sine"),
        column("D_m", "", "amplitude D_n of the harmonic"),
        column("delta_deg", "", "phase of the harmonic: atan2(-b_n, a_n)"),
        column("left_out_m", "", "bound on all harmonics beyond this one together"),
    ],
};
