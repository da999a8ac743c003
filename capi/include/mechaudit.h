/* The C interface of mechaudit's solvers: the Faddeeva function and its relatives, the Voigt profile, cubic
 * splines, tridiagonal systems. C99 and later; C++17 and later, with overloads for std::complex<double> in
 * namespace mechaudit at the end.
 *
 * Every function is thread-safe and keeps no state. Functions of one point allocate nothing and cannot
 * fail. What can fail returns a mechaudit_status and fills in a mechaudit_error unless that is NULL. Nothing
 * unwinds into the caller. Statuses are named without their prefix MECHAUDIT_STATUS_ below. Accuracy is the
 * budget of the audit named, which compares with certified values, or proved where it says so.
 *
 * Licence: MIT or Apache-2.0, at your option. Made by cbindgen from capi/src; not to be edited. */


#ifndef MECHAUDIT_H
#define MECHAUDIT_H

#include <stddef.h>
#include <stdint.h>

/* `double _Complex` by value: where its calling convention is known and the compiler has it. C++ has
 * std::complex<double> at the end instead. */
#if !defined(__cplusplus) && !defined(__STDC_NO_COMPLEX__) && !defined(_WIN32) && \
    (defined(__x86_64__) || defined(__aarch64__))
#define MECHAUDIT_COMPLEX
typedef double _Complex mechaudit_complex;
#endif


/**
 * Characters of a message, its final zero included.
 */
#define MECHAUDIT_MESSAGE 160

/**
 * The status that a function returns if it can fail.
 */
typedef enum mechaudit_status {
    /**
     * Done.
     */
    MECHAUDIT_STATUS_OK = 0,
    /**
     * A pointer that is needed is NULL.
     */
    MECHAUDIT_STATUS_NULL_POINTER = 1,
    /**
     * A number of elements or a stride beyond what memory can hold, fewer elements than the method needs, or
     * a stride of 0 between elements that are written.
     */
    MECHAUDIT_STATUS_SIZE = 2,
    /**
     * A code that names none of the choices.
     */
    MECHAUDIT_STATUS_ARGUMENT = 3,
    /**
     * A number that has to be finite is not.
     */
    MECHAUDIT_STATUS_NOT_FINITE = 4,
    /**
     * Knots that do not increase, a step that is not positive, points that are not sorted.
     */
    MECHAUDIT_STATUS_ORDER = 5,
    /**
     * The ends of a periodic spline differ.
     */
    MECHAUDIT_STATUS_NOT_PERIODIC = 6,
    /**
     * A point outside the knots of a spline that is not to be continued.
     */
    MECHAUDIT_STATUS_OUTSIDE = 7,
    /**
     * A pivot of the elimination is zero, subnormal or overflows.
     */
    MECHAUDIT_STATUS_PIVOT = 8,
    /**
     * The result does not fit in a double.
     */
    MECHAUDIT_STATUS_OVERFLOW = 9,
    /**
     * No memory for a copy of the input.
     */
    MECHAUDIT_STATUS_MEMORY = 10,
    /**
     * A defect of this library; please report it. Builds that abort on one never return it.
     */
    MECHAUDIT_STATUS_INTERNAL = 11,
} mechaudit_status;

/**
 * The functions of a complex number, for batches.
 */
typedef enum mechaudit_function {
    /**
     * The Faddeeva function.
     */
    MECHAUDIT_FUNCTION_FADDEEVA = 0,
    /**
     * Its derivative.
     */
    MECHAUDIT_FUNCTION_FADDEEVA_DERIVATIVE = 1,
    /**
     * The error function.
     */
    MECHAUDIT_FUNCTION_ERF = 2,
    /**
     * The complementary error function.
     */
    MECHAUDIT_FUNCTION_ERFC = 3,
    /**
     * The scaled complementary error function.
     */
    MECHAUDIT_FUNCTION_ERFCX = 4,
    /**
     * The imaginary error function.
     */
    MECHAUDIT_FUNCTION_ERFI = 5,
    /**
     * Dawson's function.
     */
    MECHAUDIT_FUNCTION_DAWSON = 6,
} mechaudit_function;

/**
 * The condition at an end of a spline.
 */
typedef enum mechaudit_spline_end {
    /**
     * The second derivative; 0 makes a natural spline.
     */
    MECHAUDIT_SPLINE_END_SECOND_DERIVATIVE = 0,
    /**
     * The first derivative (clamped).
     */
    MECHAUDIT_SPLINE_END_FIRST_DERIVATIVE = 1,
    /**
     * Nothing: the third derivative is continuous at the neighbouring knot.
     */
    MECHAUDIT_SPLINE_END_NOT_A_KNOT = 2,
} mechaudit_spline_end;

/**
 * The continuation of a spline outside its knots.
 */
typedef enum mechaudit_spline_outside {
    /**
     * No value there: `MECHAUDIT_STATUS_OUTSIDE`.
     */
    MECHAUDIT_SPLINE_OUTSIDE_REFUSE = 0,
    /**
     * The cubic of the first or last segment goes on.
     */
    MECHAUDIT_SPLINE_OUTSIDE_POLYNOMIAL = 1,
    /**
     * The tangent at the end goes on.
     */
    MECHAUDIT_SPLINE_OUTSIDE_TANGENT = 2,
    /**
     * The ordinate of the end is held.
     */
    MECHAUDIT_SPLINE_OUTSIDE_HOLD = 3,
    /**
     * The spline repeats with the period from first to last knot.
     */
    MECHAUDIT_SPLINE_OUTSIDE_REPEAT = 4,
} mechaudit_spline_outside;

/**
 * A cubic spline. Made by one of the `mechaudit_spline_fit` functions, never changed afterwards, so that
 * any number of threads may evaluate it at once; given back to `mechaudit_spline_free` once.
 */
typedef struct mechaudit_spline mechaudit_spline;

/**
 * Why a function failed, for a reader and for a program.
 */
typedef struct mechaudit_error {
    /**
     * The status returned.
     */
    enum mechaudit_status status;
    /**
     * The place in the array that the message is about, counted from 0; 0 where it is about none.
     */
    size_t index;
    /**
     * The number that was refused; NaN where the message is about none.
     */
    double value;
    /**
     * The value and the rule, UTF-8 with a final zero; empty after success.
     */
    char message[MECHAUDIT_MESSAGE];
} mechaudit_error;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Returns the meaning of the status, a constant string; that of `INTERNAL` for any other number.
 */
const char *mechaudit_status_message(int status);

/**
 * The version of the library, `"MAJOR.MINOR.PATCH"`, a constant string.
 */
const char *mechaudit_version(void);

/**
 * A function at n complex numbers `z`, each a real and an imaginary part one after the other, as C,
 * C++, Fortran and Julia store them. Strides count complex numbers and may be negative or, for `z`, zero; the
 * k-th number is `z[2*k*incz]`. `w` may be `z` with the same stride; other overlap gives values of
 * what was overwritten. The values are those of one point at a time, bit for bit, and
 * several times as fast. Thread-safe. Dense arrays are fastest.
 *
 * Errors: `NULL_POINTER`, `SIZE` (also `incw` = 0 for n > 1), `ARGUMENT`; nothing is written then.
 * `error` may be NULL.
 *
 * # Safety
 * `z` and `w` point to n complex numbers each at these strides, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_batch(int function,
                                      size_t n,
                                      const double *z,
                                      ptrdiff_t incz,
                                      double *w,
                                      ptrdiff_t incw,
                                      struct mechaudit_error *error);

/**
 * As `mechaudit_batch`, with real and imaginary parts in arrays of their own; strides count doubles, the
 * k-th number is `x[k*incx] + i y[k*incy]`. `re` and `im` may be `x` and `y` with the same strides; their
 * strides are not 0 for n > 1.
 *
 * # Safety
 * The four arrays have n doubles at these strides, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_batch_split(int function,
                                            size_t n,
                                            const double *x,
                                            ptrdiff_t incx,
                                            const double *y,
                                            ptrdiff_t incy,
                                            double *re,
                                            ptrdiff_t incre,
                                            double *im,
                                            ptrdiff_t incim,
                                            struct mechaudit_error *error);

/**
 * The Faddeeva function w(z) = exp(-z^2) erfc(-iz) (DLMF 7.2.3) at z = x + iy, dimensionless.
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit faddeeva`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_faddeeva(double x, double y, double *re, double *im);

/**
 * The derivative w'(z) = -2z w(z) + 2i/sqrt(pi) (DLMF 7.10.2) of the Faddeeva function, without that
 * sum's cancellation.
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit faddeeva-derivative`.
 * Thread-safe, allocates nothing, cannot fail; NaN and infinities give the limits where they exist,
 * else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_faddeeva_derivative(double x, double y, double *re, double *im);

/**
 * The error function erf z (DLMF 7.2.1).
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit erf`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_erf(double x, double y, double *re, double *im);

/**
 * The complementary error function erfc z = 1 - erf z (DLMF 7.2.2).
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit erfc`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_erfc(double x, double y, double *re, double *im);

/**
 * The scaled complementary error function erfcx z = exp(z^2) erfc z = w(iz).
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit erfcx`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_erfcx(double x, double y, double *re, double *im);

/**
 * The imaginary error function erfi z = -i erf(iz).
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit erfi`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_erfi(double x, double y, double *re, double *im);

/**
 * Dawson's function F(z) = exp(-z^2) (sqrt(pi)/2) erfi z (DLMF 7.2.5).
 *
 * The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
 * units in its last place. Budget, regions and worst inputs: `mechaudit audit dawson`. Thread-safe,
 * allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
 *
 * # Safety
 * Each of `re` and `im` is NULL or can be written to.
 */
void mechaudit_dawson(double x, double y, double *re, double *im);

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_faddeeva` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_faddeeva_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_faddeeva_derivative` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_faddeeva_derivative_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_erf` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_erf_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_erfc` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_erfc_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_erfcx` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_erfcx_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_erfi` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_erfi_c(mechaudit_complex z);
#endif

#if defined(MECHAUDIT_COMPLEX)
/**
 * `mechaudit_dawson` with `double _Complex` by value, the same bits.
 */
mechaudit_complex mechaudit_dawson_c(mechaudit_complex z);
#endif

/**
 * erf of a real number. NaN for NaN. Accuracy: within 0.875 units in the last place,
 * proved for every double (`mechaudit prove erf`).
 */
double mechaudit_erf_real(double x);

/**
 * erfc of a real number, gradual underflow included. Accuracy: within 0.875 units in the last place,
 * proved for every double (`mechaudit prove erfc`).
 */
double mechaudit_erfc_real(double x);

/**
 * erfcx x = exp(x^2) erfc x of a real number. Accuracy: within 0.875 units in the last place,
 * proved for every double (`mechaudit prove erfcx`).
 */
double mechaudit_erfcx_real(double x);

/**
 * erfi of a real number. Accuracy: within 4 units in the last place; `mechaudit audit erfi`.
 */
double mechaudit_erfi_real(double x);

/**
 * Dawson's function of a real number. Accuracy: within 0.875 units in the last place,
 * proved for every double (`mechaudit prove dawson`).
 */
double mechaudit_dawson_real(double x);

/**
 * A function of n real numbers `x[k*incx]`, to `y[k*incy]`: erf, erfc, erfcx, erfi or Dawson's function
 * by their codes in `mechaudit_function`. The values are those of one point at a time, bit for bit, by
 * vectors of four or eight. `y` may be `x` with the same stride; `incy` is not 0 for n > 1. Dense arrays
 * are fastest.
 *
 * Errors: `NULL_POINTER`, `SIZE`, `ARGUMENT` (also for the Faddeeva function and its derivative, which
 * are not real); nothing is written then. `error` may be NULL.
 *
 * # Safety
 * `x` and `y` have n doubles at these strides, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_real_batch(int function,
                                           size_t n,
                                           const double *x,
                                           ptrdiff_t incx,
                                           double *y,
                                           ptrdiff_t incy,
                                           struct mechaudit_error *error);

/**
 * The Voigt profile `Re w((x + i gamma)/(sigma sqrt 2))/(sigma sqrt(2 pi))`: the density at x of the sum of a
 * normal variable of standard deviation sigma and a Cauchy variable of half-width gamma. x, sigma and gamma
 * share a unit, the value has its inverse. sigma = 0 gives Lorentz's profile, gamma = 0 the normal
 * density, both zero infinity at x = 0 and else 0; NaN for negative widths (`voigt` of
 * `mechaudit/cerf.h` takes their moduli). Accuracy: within 3 units in the last place; `mechaudit
 * audit voigt`.
 */
double mechaudit_voigt(double x, double sigma, double gamma);

/**
 * Half the width of the Voigt profile at half its maximum, in the unit of sigma and gamma. NaN for
 * negative widths, infinity where one is infinite. Accuracy: within 1 unit in the last place;
 * `mechaudit audit voigt-hwhm`.
 */
double mechaudit_voigt_hwhm(double sigma, double gamma);

/**
 * `mechaudit_voigt` at n abscissae `x[k*incx]`, to `v[k*incv]`; the values are those of one at a
 * time, bit for bit. `v` may be `x` with the same stride; `incv` is not 0 for n > 1.
 *
 * Errors: `NULL_POINTER`, `SIZE`; nothing is written then. `error` may be NULL.
 *
 * # Safety
 * `x` and `v` have n doubles at these strides, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_voigt_batch(size_t n,
                                            const double *x,
                                            ptrdiff_t incx,
                                            double sigma,
                                            double gamma,
                                            double *v,
                                            ptrdiff_t incv,
                                            struct mechaudit_error *error);

/**
 * Fits the interpolating cubic spline through n points `(x[k], y[k])`, x increasing. At each end the kind
 * is one of `mechaudit_spline_end` with its value (ignored for not-a-knot); `outside` is one of
 * `mechaudit_spline_outside`. Units: first derivatives y/x, second y/x^2. On success `*spline` has to be
 * given to `mechaudit_spline_free`; else it is NULL. The arrays are copied. Accuracy: `mechaudit audit
 * cubic-spline-second-derivatives`, `-clamped`, `-not-a-knot`.
 *
 * Errors: `NULL_POINTER`, `SIZE` (n < 2), `ARGUMENT`, `NOT_FINITE`, `ORDER`, `OVERFLOW`, `MEMORY`.
 *
 * # Safety
 * `x` and `y` have n doubles; `spline` can be written to, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_spline_fit(size_t n,
                                           const double *x,
                                           const double *y,
                                           int first_kind,
                                           double first_value,
                                           int last_kind,
                                           double last_value,
                                           int outside,
                                           struct mechaudit_spline **spline,
                                           struct mechaudit_error *error);

/**
 * As `mechaudit_spline_fit`, periodic: `y[0] = y[n-1]`, first and second derivative agree at the ends.
 * Accuracy: `mechaudit audit cubic-spline-periodic`.
 *
 * Errors: those, and `NOT_PERIODIC`.
 *
 * # Safety
 * As `mechaudit_spline_fit`.
 */
enum mechaudit_status mechaudit_spline_fit_periodic(size_t n,
                                                    const double *x,
                                                    const double *y,
                                                    int outside,
                                                    struct mechaudit_spline **spline,
                                                    struct mechaudit_error *error);

/**
 * As `mechaudit_spline_fit` on the knots `origin + k step`, taken exactly; faster to fit and to evaluate.
 * Accuracy: `mechaudit audit cubic-spline-uniform`.
 *
 * Errors: those; `SIZE` beyond 2^26 + 1 knots too, `ORDER` for a step that is not positive or too
 * small beside the knots.
 *
 * # Safety
 * `y` has n doubles; `spline` can be written to, `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_spline_fit_uniform(size_t n,
                                                   double origin,
                                                   double step,
                                                   const double *y,
                                                   int first_kind,
                                                   double first_value,
                                                   int last_kind,
                                                   double last_value,
                                                   int outside,
                                                   struct mechaudit_spline **spline,
                                                   struct mechaudit_error *error);

/**
 * Gives a spline back. NULL does nothing.
 *
 * # Safety
 * `spline` is NULL or came from one of the fits and was not given back before.
 */
void mechaudit_spline_free(struct mechaudit_spline *spline);

/**
 * The ordinate at x, to `*value`. The quickest way to many of them is `mechaudit_spline_values`.
 *
 * Errors: `NULL_POINTER`, `NOT_FINITE`, `OUTSIDE`; nothing is written then. `error` may be NULL.
 *
 * # Safety
 * `spline` is NULL or a spline that was not given back; `value` and `error` are NULL or can be written to.
 */
enum mechaudit_status mechaudit_spline_value(const struct mechaudit_spline *spline,
                                             double x,
                                             double *value,
                                             struct mechaudit_error *error);

/**
 * The ordinate and the first three derivatives at x, to `jet[0]` ... `jet[3]`. At a knot the third
 * derivative is that to the right.
 *
 * Errors: as `mechaudit_spline_value`.
 *
 * # Safety
 * As `mechaudit_spline_value`; `jet` is NULL or has room for four doubles.
 */
enum mechaudit_status mechaudit_spline_jet(const struct mechaudit_spline *spline,
                                           double x,
                                           double *jet,
                                           struct mechaudit_error *error);

/**
 * The ordinates at n points `x[k*incx]`, to `y[k*incy]`: those of `mechaudit_spline_value`, bit for bit.
 * `y` may be `x` with the same stride; `incy` is not 0 for n > 1.
 *
 * Errors: as there; `error` has the place of the first point refused. What `y` holds then is not specified.
 *
 * # Safety
 * `spline` is NULL or a spline that was not given back; `x` and `y` have n doubles at these strides;
 * `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_spline_values(const struct mechaudit_spline *spline,
                                              size_t n,
                                              const double *x,
                                              ptrdiff_t incx,
                                              double *y,
                                              ptrdiff_t incy,
                                              struct mechaudit_error *error);

/**
 * The integral of the spline from a to b, to `*value`; b < a gives the negative of that from b to a.
 *
 * Errors: as `mechaudit_spline_value`, index 0 for a, 1 for b.
 *
 * # Safety
 * As `mechaudit_spline_value`.
 */
enum mechaudit_status mechaudit_spline_integral(const struct mechaudit_spline *spline,
                                                double a,
                                                double b,
                                                double *value,
                                                struct mechaudit_error *error);

/**
 * Solves a tridiagonal system of n equations by elimination without pivoting from both ends: row i is
 * `lower[i-1] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = d[i]`; `lower` and `upper` have n - 1 numbers,
 * `diagonal`, `d` and `x` n. `x` may be `d`. For a matrix that is diagonally dominant by rows or columns the
 * solution is that of a system off by a few roundings (Higham, Accuracy and Stability, theorems 9.11-9.13).
 * For others `*error_estimate`, unless NULL, tells an estimate of the relative error; without pivoting it
 * may be large. Accuracy: `mechaudit audit tridiagonal`.
 *
 * Errors: `NULL_POINTER`, `SIZE` (n = 0), `NOT_FINITE`, `PIVOT` (index: the row), `OVERFLOW`; what `x`
 * holds then is unspecified. `error` may be NULL.
 *
 * # Safety
 * The arrays have these lengths; `error_estimate` and `error` are NULL or can be written to.
 */
enum mechaudit_status mechaudit_tridiagonal_solve(size_t n,
                                                  const double *lower,
                                                  const double *diagonal,
                                                  const double *upper,
                                                  const double *d,
                                                  double *x,
                                                  double *error_estimate,
                                                  struct mechaudit_error *error);

/**
 * Solves a cyclic tridiagonal system of n >= 3 equations, as `mechaudit_tridiagonal_solve`, but all
 * arrays have n numbers: `lower[0]` multiplies `x[n-1]` in row 0, `upper[n-1]` multiplies `x[0]` in row n - 1.
 *
 * # Safety
 * The arrays have n doubles; `error_estimate` and `error` are NULL or can be written to.
 */
enum mechaudit_status mechaudit_cyclic_tridiagonal_solve(size_t n,
                                                         const double *lower,
                                                         const double *diagonal,
                                                         const double *upper,
                                                         const double *d,
                                                         double *x,
                                                         double *error_estimate,
                                                         struct mechaudit_error *error);

/**
 * Solves m tridiagonal systems of n equations each, which lie one after the other, n numbers each in all
 * arrays; of each system the first number of `lower` and the last one of `upper` are not used. `x` may be `d`.
 * Several systems are solved side by side: for many small ones. Of no system, m = 0, no array is touched.
 *
 * Errors: as `mechaudit_tridiagonal_solve` with the place in the whole array, and `SIZE` where m n numbers
 * do not fit in memory; what `x` holds then is unspecified.
 *
 * # Safety
 * The arrays have m n doubles, `x` does not overlap `lower`, `diagonal` or `upper`, nor `d` unless it is `d`;
 * `error` is NULL or can be written to.
 */
enum mechaudit_status mechaudit_tridiagonal_solve_batch(size_t m,
                                                        size_t n,
                                                        const double *lower,
                                                        const double *diagonal,
                                                        const double *upper,
                                                        const double *d,
                                                        double *x,
                                                        struct mechaudit_error *error);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MECHAUDIT_H */

#if defined(__cplusplus) && !defined(MECHAUDIT_H_OVERLOADS)
#define MECHAUDIT_H_OVERLOADS
#include <complex>

namespace mechaudit {

using complex = std::complex<double>;

inline complex faddeeva(complex z) {
    double re, im;
    mechaudit_faddeeva(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex faddeeva_derivative(complex z) {
    double re, im;
    mechaudit_faddeeva_derivative(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex erf(complex z) {
    double re, im;
    mechaudit_erf(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex erfc(complex z) {
    double re, im;
    mechaudit_erfc(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex erfcx(complex z) {
    double re, im;
    mechaudit_erfcx(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex erfi(complex z) {
    double re, im;
    mechaudit_erfi(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline complex dawson(complex z) {
    double re, im;
    mechaudit_dawson(z.real(), z.imag(), &re, &im);
    return {re, im};
}

inline double erf(double x) { return mechaudit_erf_real(x); }
inline double erfc(double x) { return mechaudit_erfc_real(x); }
inline double erfcx(double x) { return mechaudit_erfcx_real(x); }
inline double erfi(double x) { return mechaudit_erfi_real(x); }
inline double dawson(double x) { return mechaudit_dawson_real(x); }
inline double voigt(double x, double sigma, double gamma) { return mechaudit_voigt(x, sigma, gamma); }
inline double voigt_hwhm(double sigma, double gamma) { return mechaudit_voigt_hwhm(sigma, gamma); }

/* std::complex<double> is laid out as two doubles ([complex.numbers]/4). */
inline mechaudit_status batch(mechaudit_function function, std::size_t n, const complex *z, complex *w,
                              mechaudit_error *error = nullptr) {
    return mechaudit_batch(function, n, reinterpret_cast<const double *>(z), 1, reinterpret_cast<double *>(w), 1,
                           error);
}

} // namespace mechaudit
#endif
