/* `double _Complex` by value and two doubles by pointer give the same bits, at points of every kind. The last
 * line but one is a digest of all values: the same on every machine. */
#include <complex.h>
#include <math.h>

#include "check.h"
#include <mechaudit.h>
#include <mechaudit/cerf.h>

typedef double _Complex (*by_value)(double _Complex);
typedef void (*by_pointer)(double, double, double *, double *);

static const struct {
    by_value value, cerf;
    by_pointer pointer;
} functions[] = {
    {mechaudit_faddeeva_c, w_of_z, mechaudit_faddeeva},
    {mechaudit_faddeeva_derivative_c, NULL, mechaudit_faddeeva_derivative},
    {mechaudit_erf_c, cerf, mechaudit_erf},
    {mechaudit_erfc_c, cerfc, mechaudit_erfc},
    {mechaudit_erfcx_c, cerfcx, mechaudit_erfcx},
    {mechaudit_erfi_c, cerfi, mechaudit_erfi},
    {mechaudit_dawson_c, cdawson, mechaudit_dawson},
};

/* Made of its parts without arithmetic, which C allows to change them. */
static double _Complex complex_of(double x, double y) {
    const double parts[2] = {x, y};
    double _Complex z;
    memcpy(&z, parts, sizeof z);
    return z;
}

/* FNV-1a. */
static uint64_t digest = UINT64_C(0xcbf29ce484222325);
static void note(double x) {
    for (int k = 0; k < 64; k += 8) {
        digest = (digest ^ (bits(x) >> k & 0xff)) * UINT64_C(0x100000001b3);
    }
}

static void point(double x, double y) {
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k) {
        double re, im;
        functions[k].pointer(x, y, &re, &im);
        const double _Complex w = functions[k].value(complex_of(x, y));
        CHECK(same(creal(w), re) && same(cimag(w), im));
        if (functions[k].cerf) {
            const double _Complex c = functions[k].cerf(complex_of(x, y));
            CHECK(same(creal(c), re) && same(cimag(c), im));
        }
        note(re);
        note(im);
    }
}

static void real(double x, double y, double z) {
    double re, im;
    mechaudit_faddeeva(x, y, &re, &im);
    CHECK(same(re_w_of_z(x, y), re) && same(im_w_of_z(x, y), im));
    CHECK(same(erfcx(x), mechaudit_erfcx_real(x)) && same(erfi(x), mechaudit_erfi_real(x)));
    CHECK(same(dawson(x), mechaudit_dawson_real(x)));
    CHECK(same(voigt(x, y, z), mechaudit_voigt(x, fabs(y), fabs(z))));
    CHECK(same(voigt_hwhm(y, z), mechaudit_voigt_hwhm(fabs(y), fabs(z))));
    const double all[] = {mechaudit_erf_real(x),    mechaudit_erfc_real(x),      mechaudit_erfcx_real(x),
                          mechaudit_erfi_real(x),   mechaudit_dawson_real(x),    mechaudit_voigt(x, y, z),
                          mechaudit_voigt_hwhm(y, z), im_w_of_x(x)};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        note(all[k]);
    }
}

int main(void) {
    const double nan_of_either_sign[] = {from_bits(UINT64_C(0x7ff8000000000000)),
                                         from_bits(UINT64_C(0xfff8000000000000))};
    const double special[] = {0.0,      -0.0,   1.0,     -1.0,     5e-324, -5e-324, 1e300,
                              -1e300,   26.0,   -26.7,   INFINITY, -INFINITY,
                              nan_of_either_sign[0], nan_of_either_sign[1]};
    const int n = sizeof special / sizeof *special;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            point(special[i], special[j]);
            real(special[i], special[j], special[(i + j) % n]);
        }
    }
    for (int k = 0; k < 3000; ++k) {
        /* One after another: the order of arguments is the compiler's. */
        double r[12];
        r[0] = between(-8, 8), r[1] = between(-6, 8);
        r[2] = of_size(-30, 30), r[3] = of_size(-30, 30);
        r[4] = of_size(-1020, 1020), r[5] = of_size(-1020, 1020);
        r[6] = between(-30, 30), r[7] = between(0, 3), r[8] = between(0, 3);
        r[9] = of_size(-1020, 1020), r[10] = fabs(of_size(-300, 300)), r[11] = fabs(of_size(-300, 300));
        point(r[0], r[1]);
        point(r[2], r[3]);
        point(r[4], r[5]);
        real(r[6], r[7], r[8]);
        real(r[9], r[10], r[11]);
    }
    printf("digest %016" PRIx64 "\n", digest);
    return verdict("abi");
}
