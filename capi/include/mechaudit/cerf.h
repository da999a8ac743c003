/* libcerf's functions under its names and with its types, computed by mechaudit: put the folder of this file
 * before libcerf's on the include path and link with -lmechaudit in place of -lcerf.
 *
 * In C complex numbers are `double _Complex`, in C++ std::complex<double>; libcerf's macros CERF_AS_CPP
 * and __cplusplus mean the same here. Every function is thread-safe, allocates nothing and cannot fail; NaN and
 * infinities give the limits where they exist, else NaN. Accuracy: each component within 4 units in its last
 * place, voigt within 3, voigt_hwhm within 1 (`mechaudit audit faddeeva`, `erf`, ... judge it).
 *
 * Other than libcerf: voigt_hwhm of an infinite width is infinite (libcerf 2.5 does not return); the variables
 * cerf_algorithm and cerf_nofterms of libcerf's introspection do not exist.
 *
 * Licence: MIT or Apache-2.0, at your option. */
#ifndef MECHAUDIT_CERF_H
#define MECHAUDIT_CERF_H
/* libcerf's own guard, lest its header is read as well. */
#ifndef __CERF_H
#define __CERF_H
#endif

#ifdef __cplusplus
#include <complex>
#include "../mechaudit.h"
typedef std::complex<double> _cerf_cmplx;
extern "C" {
#else
#include <complex.h>
#include "../mechaudit.h"
#ifndef MECHAUDIT_COMPLEX
#error "double _Complex by value is not known to work on this platform; use the functions of mechaudit.h"
#endif
typedef double _Complex _cerf_cmplx;

/* w(z) = exp(-z^2) erfc(-iz), the Faddeeva function. */
_cerf_cmplx w_of_z(_cerf_cmplx z);
/* erf z. */
_cerf_cmplx cerf(_cerf_cmplx z);
/* erfc z = 1 - erf z. */
_cerf_cmplx cerfc(_cerf_cmplx z);
/* erfcx z = exp(z^2) erfc z. */
_cerf_cmplx cerfcx(_cerf_cmplx z);
/* erfi z = -i erf(iz). */
_cerf_cmplx cerfi(_cerf_cmplx z);
/* Dawson's function, exp(-z^2) (sqrt(pi)/2) erfi z. */
_cerf_cmplx cdawson(_cerf_cmplx z);
#endif

/* Im w(x). */
double im_w_of_x(double x);
/* Re w(x + iy), Im w(x + iy). */
double re_w_of_z(double x, double y);
double im_w_of_z(double x, double y);
/* erfcx, erfi and Dawson's function of a real number. */
double erfcx(double x);
double erfi(double x);
double dawson(double x);
/* The density at x of the sum of a normal variable of standard deviation |sigma| and a Cauchy variable of
 * half-width |gamma|. */
double voigt(double x, double sigma, double gamma);
/* Half the width of that density at half its maximum. */
double voigt_hwhm(double sigma, double gamma);

#ifdef __cplusplus
} // extern "C"

inline _cerf_cmplx w_of_z(_cerf_cmplx z) { return mechaudit::faddeeva(z); }
inline _cerf_cmplx cerf(_cerf_cmplx z) { return mechaudit::erf(z); }
inline _cerf_cmplx cerfc(_cerf_cmplx z) { return mechaudit::erfc(z); }
inline _cerf_cmplx cerfcx(_cerf_cmplx z) { return mechaudit::erfcx(z); }
inline _cerf_cmplx cerfi(_cerf_cmplx z) { return mechaudit::erfi(z); }
inline _cerf_cmplx cdawson(_cerf_cmplx z) { return mechaudit::dawson(z); }
#endif

#endif
