// The functions of libcerf 3's C++ library, whichever library provides them.
#include <cerf.h>
#include <complex>
#include <cstdio>

static void show(std::complex<double> w) { std::printf("%.17g %.17g\n", w.real(), w.imag()); }

int main() {
    using C = std::complex<double>;
    const C z(1.9914668428, -1.3548101281);
    for (const C w : {w_of_z(z), cerf(z), cerfc(z), cerfcx(z), cerfi(z), cdawson(z)}) {
        show(w);
    }
    for (const double x : {im_w_of_x(3.0), re_w_of_z(100, -100.01), im_w_of_z(100, -100.01), erfcx(2.0), erfi(26.6),
                           dawson(0.924), voigt(30, 1, 1e-300), voigt_hwhm(1, 0.5)}) {
        show(x);
    }
}
