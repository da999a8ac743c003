//! Laws and cycles of cams, and followers that a cam forces.

mod law_input;

crate::methods::definition::methods! {
    cam_law: CamLaw;
    cam_fourier_series: CamFourierSeries;
    chirp_response: ChirpResponse;
}
