/* Functions of a real argument beside SLEEF's vectors and libm's loops, and batches of all functions beside one point
 * at a time: their time over ours, in one run.
 *
 *     capi/install PREFIX
 *     gcc -O2 -march=native benches/compare_sleef.c -IPREFIX/include -LPREFIX/lib -lmechaudit -lsleef -lm \
 *         -Wl,-rpath,PREFIX/lib -o target/compare_sleef && target/compare_sleef
 *
 * Needs SLEEF (Debian's libsleef-dev). Both sides in turns; the median of the ratios of 200 passes, and the least
 * time of ours. Real points are uniform in -8 ... 8, complex ones in the square, in random order. */
#include <immintrin.h>
#include <math.h>
#include <mechaudit.h>
#include <sleef.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 1 << 20, PASSES = 200 };
static double *x, *y;

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

typedef void Loop(int n);

#ifdef __AVX512F__
#define SLEEF_NAME "AVX-512"
#define SLEEF(name, function512, function256)                            \
    static void name(int n) {                                            \
        for (int i = 0; i < n; i += 8) {                            \
            _mm512_storeu_pd(y + i, function512(_mm512_loadu_pd(x + i))); \
        }                                                                \
    }
#else
#define SLEEF_NAME "AVX2"
#define SLEEF(name, function512, function256)                            \
    static void name(int n) {                                            \
        for (int i = 0; i < n; i += 4) {                            \
            _mm256_storeu_pd(y + i, function256(_mm256_loadu_pd(x + i))); \
        }                                                                \
    }
#endif
SLEEF(sleef_erf, Sleef_erfd8_u10avx512f, Sleef_erfd4_u10avx2)
SLEEF(sleef_erfc, Sleef_erfcd8_u15avx512f, Sleef_erfcd4_u15avx2)

#define EACH(name, function)              \
    static void name(int n) {             \
        for (int i = 0; i < n; ++i) {     \
            y[i] = function(x[i]);        \
        }                                 \
    }
EACH(libm_erf, erf)
EACH(libm_erfc, erfc)
EACH(one_erf, mechaudit_erf_real)
EACH(one_erfc, mechaudit_erfc_real)
EACH(one_erfcx, mechaudit_erfcx_real)
EACH(one_erfi, mechaudit_erfi_real)
EACH(one_dawson, mechaudit_dawson_real)

#define OURS(name, code)                                                  \
    static void name(int n) {                                             \
        if (mechaudit_real_batch(code, n, x, 1, y, 1, NULL) != MECHAUDIT_STATUS_OK) { \
            abort();                                                      \
        }                                                                 \
    }
OURS(our_erf, 2)
OURS(our_erfc, 3)
OURS(our_erfcx, 4)
OURS(our_erfi, 5)
OURS(our_dawson, 6)

#define COMPLEX(name, function, code)                                     \
    static void one_##name(int n) {                                       \
        for (int i = 0; i < n; i += 2) {                             \
            function(x[i], x[i + 1], y + i, y + i + 1);                   \
        }                                                                 \
    }                                                                     \
    static void our_##name(int n) {                                       \
        if (mechaudit_batch(code, n / 2, x, 1, y, 1, NULL) != MECHAUDIT_STATUS_OK) { \
            abort();                                                      \
        }                                                                 \
    }
COMPLEX(w, mechaudit_faddeeva, 0)
COMPLEX(slope, mechaudit_faddeeva_derivative, 1)
COMPLEX(complex_erf, mechaudit_erf, 2)
COMPLEX(complex_erfc, mechaudit_erfc, 3)
COMPLEX(complex_erfcx, mechaudit_erfcx, 4)
COMPLEX(complex_erfi, mechaudit_erfi, 5)
COMPLEX(complex_dawson, mechaudit_dawson, 6)

static void compare(const char *what, int n, Loop ours, Loop theirs) {
    static double ratio[PASSES];
    double least = 1;
    const int loops = n < 4096 ? 4096 / n : 1, passes = n < 100000 ? PASSES : 20;
    for (int pass = -2; pass < passes; ++pass) {
        const double a = seconds();
        for (int k = 0; k < loops; ++k) {
            ours(n);
        }
        const double b = seconds();
        for (int k = 0; k < loops; ++k) {
            theirs(n);
        }
        const double c = seconds();
        if (pass >= 0) {
            ratio[pass] = (c - b) / (b - a);
            least = fmin(least, (b - a) / loops / n);
        }
    }
    qsort(ratio, passes, sizeof *ratio, ascending);
    printf("| %s | %d | %.2f | %.2f |\n", what, n, ratio[passes / 2], 1e9 * least);
}

int main(void) {
    x = malloc(MOST * sizeof *x);
    y = malloc(MOST * sizeof *y);
    srand(1);
    for (int i = 0; i < MOST; ++i) {
        x[i] = -8 + 16.0 * rand() / RAND_MAX;
        y[i] = 0;
    }
    printf("| batch beside | numbers | its time over ours | ours, ns a number |\n|---|---|---|---|\n");
    const int sizes[] = {2, 10, 100, 1000, 10000, MOST};
    for (unsigned k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        const int n = sizes[k];
        compare("erf, SLEEF " SLEEF_NAME, n, our_erf, sleef_erf);
        compare("erfc, SLEEF " SLEEF_NAME, n, our_erfc, sleef_erfc);
        compare("erf, libm", n, our_erf, libm_erf);
        compare("erfc, libm", n, our_erfc, libm_erfc);
        compare("erf, one point at a time", n, our_erf, one_erf);
        compare("erfc, one point at a time", n, our_erfc, one_erfc);
        compare("erfcx, one point at a time", n, our_erfcx, one_erfcx);
        compare("erfi, one point at a time", n, our_erfi, one_erfi);
        compare("dawson, one point at a time", n, our_dawson, one_dawson);
        /* n numbers are n / 2 complex points. */
        compare("complex w, one point at a time", n, our_w, one_w);
        compare("complex w', one point at a time", n, our_slope, one_slope);
        compare("complex erf, one point at a time", n, our_complex_erf, one_complex_erf);
        compare("complex erfc, one point at a time", n, our_complex_erfc, one_complex_erfc);
        compare("complex erfcx, one point at a time", n, our_complex_erfcx, one_complex_erfcx);
        compare("complex erfi, one point at a time", n, our_complex_erfi, one_complex_erfi);
        compare("complex dawson, one point at a time", n, our_complex_dawson, one_complex_dawson);
    }
    printf("\n| one point beside | numbers | its time over ours | ours, ns a number |\n|---|---|---|---|\n");
    compare("erf, libm", 4096, one_erf, libm_erf);
    compare("erfc, libm", 4096, one_erfc, libm_erfc);
    free(x);
    free(y);
    return 0;
}
