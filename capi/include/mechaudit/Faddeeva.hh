// The C++ names of the MIT Faddeeva package, computed by mechaudit: put the folder of this file on the
// include path in place of the package's and link with -lmechaudit.
//
// Full accuracy costs nothing here, so `relerr` is ignored: each component is within 4 units in its last place.
//
// Licence: MIT or Apache-2.0, at your option.
#ifndef MECHAUDIT_FADDEEVA_HH
#define MECHAUDIT_FADDEEVA_HH
// The package's own guard, lest its header is read as well.
#ifndef FADDEEVA_HH
#define FADDEEVA_HH 1
#endif

#include "../mechaudit.h"
#include <complex>

namespace Faddeeva {

// w(z) = exp(-z^2) erfc(-iz), and Im w(x).
inline std::complex<double> w(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::faddeeva(z);
}
inline double w_im(double x) { return mechaudit::faddeeva(x).imag(); }

// erfcx z = exp(z^2) erfc z.
inline std::complex<double> erfcx(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::erfcx(z);
}
inline double erfcx(double x) { return mechaudit::erfcx(x); }

// erf z.
inline std::complex<double> erf(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::erf(z);
}
inline double erf(double x) { return mechaudit::erf(x); }

// erfi z = -i erf(iz).
inline std::complex<double> erfi(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::erfi(z);
}
inline double erfi(double x) { return mechaudit::erfi(x); }

// erfc z = 1 - erf z.
inline std::complex<double> erfc(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::erfc(z);
}
inline double erfc(double x) { return mechaudit::erfc(x); }

// Dawson's function, exp(-z^2) (sqrt(pi)/2) erfi z.
inline std::complex<double> Dawson(std::complex<double> z, double relerr = 0) {
    static_cast<void>(relerr);
    return mechaudit::dawson(z);
}
inline double Dawson(double x) { return mechaudit::dawson(x); }

} // namespace Faddeeva

#endif
