/* Batches, splines, systems and errors of mechaudit.h. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "check.h"
#include <mechaudit.h>

enum { POINTS = 3000, KINDS = 7 };

typedef void (*by_pointer)(double, double, double *, double *);
static const by_pointer functions[KINDS] = {
    mechaudit_faddeeva, mechaudit_faddeeva_derivative, mechaudit_erf,   mechaudit_erfc,
    mechaudit_erfcx,    mechaudit_erfi,                mechaudit_dawson};

/* A batch of each layout gives the bits of single points; what lies between elements is left alone. */
static void batches(int kind, size_t n) {
    static double z[2 * POINTS], w[2 * POINTS], due[2 * POINTS], wide[10 * POINTS], parts[6 * POINTS];
    for (size_t k = 0; k < n; ++k) {
        z[2 * k] = between(-9, 9);
        z[2 * k + 1] = between(-4, 9);
        functions[kind](z[2 * k], z[2 * k + 1], &due[2 * k], &due[2 * k + 1]);
    }
    mechaudit_error error;
    CHECK(mechaudit_batch(kind, n, z, 1, w, 1, &error) == MECHAUDIT_STATUS_OK);
    CHECK(error.status == MECHAUDIT_STATUS_OK && error.message[0] == '\0');
    for (size_t k = 0; k < 2 * n; ++k) {
        CHECK(same(w[k], due[k]));
    }
    /* Every second number backwards into every fifth place. */
    for (size_t k = 0; k < 10 * n; ++k) {
        wide[k] = -7;
    }
    if (n > 0) {
        CHECK(mechaudit_batch(kind, n, z + 2 * (n - 1), -1, wide, 5, NULL) == MECHAUDIT_STATUS_OK);
    }
    for (size_t k = 0; k < n; ++k) {
        CHECK(same(wide[10 * k], due[2 * (n - 1 - k)]) && same(wide[10 * k + 1], due[2 * (n - 1 - k) + 1]));
        for (int j = 2; j < 10; ++j) {
            CHECK(wide[10 * k + (size_t)j] == -7);
        }
    }
    /* Parts by themselves, dense and apart by three. */
    for (size_t k = 0; k < n; ++k) {
        parts[k] = z[2 * k];
        parts[n + k] = z[2 * k + 1];
    }
    CHECK(mechaudit_batch_split(kind, n, parts, 1, parts + n, 1, parts + 2 * n, 1, parts + 3 * n, 1, NULL) ==
          MECHAUDIT_STATUS_OK);
    for (size_t k = 0; k < n; ++k) {
        CHECK(same(parts[2 * n + k], due[2 * k]) && same(parts[3 * n + k], due[2 * k + 1]));
    }
    CHECK(mechaudit_batch_split(kind, n, z, 2, z + 1, 2, parts, 3, parts + 1, 3, NULL) == MECHAUDIT_STATUS_OK);
    for (size_t k = 0; k < n; ++k) {
        CHECK(same(parts[3 * k], due[2 * k]) && same(parts[3 * k + 1], due[2 * k + 1]));
    }
    /* In place. */
    CHECK(mechaudit_batch(kind, n, z, 1, z, 1, NULL) == MECHAUDIT_STATUS_OK);
    for (size_t k = 0; k < 2 * n; ++k) {
        CHECK(same(z[k], due[k]));
    }
}

static void refused_batches(void) {
    double z[2] = {1, 1}, w[2] = {5, 5};
    mechaudit_error e;
    CHECK(mechaudit_batch(7, 1, z, 1, w, 1, &e) == MECHAUDIT_STATUS_ARGUMENT && strstr(e.message, "7"));
    CHECK(mechaudit_batch(-1, 0, NULL, 1, NULL, 1, NULL) == MECHAUDIT_STATUS_ARGUMENT);
    CHECK(mechaudit_batch(0, 0, NULL, 1, NULL, 1, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_batch(0, 1, NULL, 1, w, 1, &e) == MECHAUDIT_STATUS_NULL_POINTER && strstr(e.message, "z"));
    CHECK(mechaudit_batch(0, 1, z, 1, NULL, 1, &e) == MECHAUDIT_STATUS_NULL_POINTER && strstr(e.message, "w"));
    CHECK(mechaudit_batch(0, SIZE_MAX, z, 1, w, 1, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch(0, 3, z, PTRDIFF_MAX, w, 1, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch(0, 3, z, PTRDIFF_MIN, w, 1, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch_split(0, 2, z, PTRDIFF_MAX / 8, z, 1, w, 1, w + 1, 1, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch_split(0, 1, z, 1, NULL, 1, w, 1, w + 1, 1, &e) == MECHAUDIT_STATUS_NULL_POINTER);
    CHECK(w[0] == 5 && w[1] == 5);
    /* One place for several values would keep the last alone. */
    double pair[4] = {1, 1, 2, 2};
    CHECK(mechaudit_batch(0, 2, pair, 1, w, 0, &e) == MECHAUDIT_STATUS_SIZE && strstr(e.message, "stride of 0"));
    CHECK(mechaudit_batch_split(0, 2, pair, 2, pair + 1, 2, w, 0, w + 1, 1, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch_split(0, 2, pair, 2, pair + 1, 2, w, 1, w + 1, 0, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_voigt_batch(2, pair, 1, 1, 1, w, 0, NULL) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_batch(0, 1, pair, 0, pair, 0, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(w[0] == 5 && w[1] == 5);
    /* Either part alone. */
    mechaudit_faddeeva(0, 1, w, NULL);
    mechaudit_faddeeva(0, 1, NULL, w + 1);
    CHECK(fabs(w[0] - 0.427583576155807) < 1e-15 && w[1] == 0);
    /* One point into many places. */
    CHECK(mechaudit_batch(2, 1, z, 0, w, 1, NULL) == MECHAUDIT_STATUS_OK);
}

static void voigt_profiles(void) {
    static double x[POINTS], v[2 * POINTS];
    for (int k = 0; k < POINTS; ++k) {
        x[k] = between(-20, 20);
    }
    CHECK(mechaudit_voigt_batch(POINTS, x, 1, 1.5, 0.25, v, 2, NULL) == MECHAUDIT_STATUS_OK);
    for (int k = 0; k < POINTS; ++k) {
        CHECK(same(v[2 * k], mechaudit_voigt(x[k], 1.5, 0.25)));
    }
    CHECK(mechaudit_voigt_batch(POINTS, x, 1, 1.5, 0.25, v, 1, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_voigt_batch(POINTS, x, 1, 1.5, 0.25, x, 1, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(memcmp(x, v, sizeof x) == 0);
    CHECK(mechaudit_voigt_batch(1, NULL, 1, 1, 1, v, 1, NULL) == MECHAUDIT_STATUS_NULL_POINTER);
    const double h = mechaudit_voigt_hwhm(2, 1);
    CHECK(fabs(mechaudit_voigt(h, 2, 1) / mechaudit_voigt(0, 2, 1) - 0.5) < 1e-15);
    CHECK(isnan(mechaudit_voigt(0, -1, 1)) && isnan(mechaudit_voigt_hwhm(1, -1)));
}

static void real_batches(void) {
    double (*const one[])(double) = {mechaudit_erf_real, mechaudit_erfc_real, mechaudit_erfcx_real,
                                     mechaudit_erfi_real, mechaudit_dawson_real};
    static double x[POINTS], y[2 * POINTS];
    for (int f = 0; f < 5; ++f) {
        for (int k = 0; k < POINTS; ++k) {
            x[k] = between(-30, 30);
        }
        CHECK(mechaudit_real_batch(2 + f, POINTS, x, 1, y, 2, NULL) == MECHAUDIT_STATUS_OK);
        for (int k = 0; k < POINTS; ++k) {
            CHECK(same(y[2 * k], one[f](x[k])));
        }
        CHECK(mechaudit_real_batch(2 + f, POINTS, x, 1, y, 1, NULL) == MECHAUDIT_STATUS_OK);
        CHECK(mechaudit_real_batch(2 + f, POINTS, x, 1, x, 1, NULL) == MECHAUDIT_STATUS_OK);
        CHECK(memcmp(x, y, sizeof x) == 0);
    }
    mechaudit_error e;
    CHECK(mechaudit_real_batch(1, 1, x, 1, y, 1, &e) == MECHAUDIT_STATUS_ARGUMENT && strstr(e.message, "1"));
    CHECK(mechaudit_real_batch(7, 0, NULL, 1, NULL, 1, NULL) == MECHAUDIT_STATUS_ARGUMENT);
    CHECK(mechaudit_real_batch(2, 0, NULL, 1, NULL, 1, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_real_batch(2, 1, NULL, 1, y, 1, NULL) == MECHAUDIT_STATUS_NULL_POINTER);
    CHECK(mechaudit_real_batch(2, 2, x, 1, y, 0, NULL) == MECHAUDIT_STATUS_SIZE);
}

static double cubic(double x) { return x * x * x - 2 * x; }

static void splines(void) {
    enum { KNOTS = 6 };
    double x[KNOTS] = {0, 0.5, 1.25, 2, 3.5, 4}, y[KNOTS];
    for (int k = 0; k < KNOTS; ++k) {
        y[k] = cubic(x[k]);
    }
    mechaudit_error e;
    mechaudit_spline *s = NULL;
    /* A cubic is its own spline with its own second derivatives, slopes, and with not-a-knot ends. */
    const double given[3][2] = {{0, 24}, {-2, 46}, {0, 0}};
    for (int kind = 0; kind < 3; ++kind) {
        CHECK(mechaudit_spline_fit(KNOTS, x, y, kind, given[kind][0], kind, given[kind][1],
                                   MECHAUDIT_SPLINE_OUTSIDE_REFUSE, &s, &e) == MECHAUDIT_STATUS_OK);
        double points[100], values[100], jet[4], value;
        for (int k = 0; k < 100; ++k) {
            points[k] = between(0, 4);
        }
        CHECK(mechaudit_spline_values(s, 100, points, 1, values, 1, NULL) == MECHAUDIT_STATUS_OK);
        for (int k = 0; k < 100; ++k) {
            const double p = points[k];
            CHECK(mechaudit_spline_value(s, p, &value, NULL) == MECHAUDIT_STATUS_OK && same(value, values[k]));
            CHECK(fabs(value - cubic(p)) < 1e-13);
            CHECK(mechaudit_spline_jet(s, p, jet, NULL) == MECHAUDIT_STATUS_OK && same(jet[0], value));
            CHECK(fabs(jet[1] - (3 * p * p - 2)) < 1e-12 && fabs(jet[2] - 6 * p) < 1e-11 && fabs(jet[3] - 6) < 1e-10);
        }
        CHECK(mechaudit_spline_integral(s, 0, 4, &value, NULL) == MECHAUDIT_STATUS_OK && fabs(value - 48) < 1e-12);
        CHECK(mechaudit_spline_integral(s, 4, 0, &value, NULL) == MECHAUDIT_STATUS_OK && fabs(value + 48) < 1e-12);
        points[70] = 4.25;
        CHECK(mechaudit_spline_values(s, 100, points, 1, values, 1, &e) == MECHAUDIT_STATUS_OUTSIDE);
        CHECK(e.index == 70 && e.value == 4.25 && strstr(e.message, "4.25"));
        points[70] = NAN;
        CHECK(mechaudit_spline_values(s, 100, points, 1, points, 1, &e) == MECHAUDIT_STATUS_NOT_FINITE && e.index == 70);
        CHECK(mechaudit_spline_value(s, 1, NULL, &e) == MECHAUDIT_STATUS_NULL_POINTER);
        CHECK(mechaudit_spline_jet(s, 1, NULL, &e) == MECHAUDIT_STATUS_NULL_POINTER);
        CHECK(mechaudit_spline_integral(s, 0, 5, &value, &e) == MECHAUDIT_STATUS_OUTSIDE && e.index == 1);
        mechaudit_spline_free(s);
    }
    /* Far into a batch that is taken over in pieces, the place counts from its beginning. */
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 0, 0, 0, 0, 0, &s, NULL) == MECHAUDIT_STATUS_OK);
    static double many[2 * POINTS], out[POINTS];
    for (int k = 0; k < POINTS; ++k) {
        many[2 * k] = between(0, 4);
    }
    many[2 * 2500] = -1;
    CHECK(mechaudit_spline_values(s, POINTS, many, 2, out, 1, &e) == MECHAUDIT_STATUS_OUTSIDE && e.index == 2500);
    mechaudit_spline_free(s);
    /* What goes on outside. */
    const double after[5] = {0, cubic(5), cubic(4) + 46, cubic(4), 0};
    for (int outside = 1; outside < 4; ++outside) {
        double value;
        CHECK(mechaudit_spline_fit(KNOTS, x, y, 1, -2, 1, 46, outside, &s, NULL) == MECHAUDIT_STATUS_OK);
        CHECK(mechaudit_spline_value(s, 5, &value, NULL) == MECHAUDIT_STATUS_OK);
        CHECK(fabs(value - after[outside]) < 1e-11);
        mechaudit_spline_free(s);
    }
    /* Uniform and periodic ones. */
    double u[9];
    for (int k = 0; k < 9; ++k) {
        u[k] = cubic(0.5 * k);
    }
    double value, again;
    CHECK(mechaudit_spline_fit_uniform(9, 0, 0.5, u, 1, -2, 1, 46, 0, &s, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_spline_value(s, 3.3, &value, NULL) == MECHAUDIT_STATUS_OK && fabs(value - cubic(3.3)) < 1e-13);
    mechaudit_spline_free(s);
    y[KNOTS - 1] = y[0];
    CHECK(mechaudit_spline_fit_periodic(KNOTS, x, y, MECHAUDIT_SPLINE_OUTSIDE_REPEAT, &s, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_spline_value(s, 0.75, &value, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_spline_value(s, 8.75, &again, NULL) == MECHAUDIT_STATUS_OK && fabs(value - again) < 1e-13);
    mechaudit_spline_free(s);
    mechaudit_spline_free(NULL);
    /* Refusals leave NULL. */
    s = (mechaudit_spline *)&e;
    CHECK(mechaudit_spline_fit(1, x, y, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_SIZE && s == NULL);
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 3, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_ARGUMENT);
    CHECK(strstr(e.message, "first_kind 3") != NULL);
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 0, 0, 0, 0, 5, &s, &e) == MECHAUDIT_STATUS_ARGUMENT);
    CHECK(mechaudit_spline_fit(KNOTS, NULL, y, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_NULL_POINTER);
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 0, 0, 0, 0, 0, NULL, &e) == MECHAUDIT_STATUS_NULL_POINTER);
    CHECK(mechaudit_spline_fit(SIZE_MAX / 16, x, y, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_SIZE ||
          e.status == MECHAUDIT_STATUS_MEMORY);
    x[2] = 0.25;
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_ORDER);
    CHECK(e.index == 2 && e.value == 0.25);
    x[2] = 1.25;
    y[3] = INFINITY;
    CHECK(mechaudit_spline_fit(KNOTS, x, y, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_NOT_FINITE && e.index == 3);
    y[3] = 0;
    y[0] = 1;
    CHECK(mechaudit_spline_fit_periodic(KNOTS, x, y, 0, &s, &e) == MECHAUDIT_STATUS_NOT_PERIODIC);
    CHECK(mechaudit_spline_fit_uniform(9, 0, -1, u, 0, 0, 0, 0, 0, &s, &e) == MECHAUDIT_STATUS_ORDER && e.value == -1);
    CHECK(mechaudit_spline_value(NULL, 1, &value, &e) == MECHAUDIT_STATUS_NULL_POINTER);
}

static void systems(void) {
    const double lower[3] = {1, 1, 1}, diagonal[3] = {4, 4, 4}, upper[3] = {1, 1, 1};
    double d[3] = {5, 6, 5}, x[3], estimate = -1;
    mechaudit_error e;
    CHECK(mechaudit_tridiagonal_solve(3, lower, diagonal, upper, d, x, &estimate, &e) == MECHAUDIT_STATUS_OK);
    CHECK(x[0] == 1 && x[1] == 1 && x[2] == 1 && estimate > 0 && estimate < 1e-14);
    CHECK(mechaudit_tridiagonal_solve(3, lower, diagonal, upper, d, d, NULL, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(d[0] == 1 && d[1] == 1 && d[2] == 1);
    double six[3] = {6, 6, 6};
    CHECK(mechaudit_cyclic_tridiagonal_solve(3, lower, diagonal, upper, six, six, &estimate, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(fabs(six[0] - 1) < 1e-15 && fabs(six[1] - 1) < 1e-15 && fabs(six[2] - 1) < 1e-15);
    const double zero[3] = {0, 4, 4};
    x[0] = 9;
    CHECK(mechaudit_tridiagonal_solve(3, lower, zero, upper, d, x, NULL, &e) == MECHAUDIT_STATUS_PIVOT);
    CHECK(e.index == 0 && e.value == 0 && x[0] == 9);
    const double inf[3] = {4, INFINITY, 4};
    CHECK(mechaudit_tridiagonal_solve(3, lower, inf, upper, d, x, NULL, &e) == MECHAUDIT_STATUS_NOT_FINITE && e.index == 1);
    CHECK(strstr(e.message, "diagonal[1]") != NULL);
    CHECK(mechaudit_tridiagonal_solve(0, lower, diagonal, upper, d, x, NULL, &e) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_cyclic_tridiagonal_solve(2, lower, diagonal, upper, d, x, NULL, &e) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_tridiagonal_solve(1, NULL, diagonal, NULL, d, x, NULL, &e) == MECHAUDIT_STATUS_OK && x[0] == 0.25);
    CHECK(mechaudit_tridiagonal_solve(3, lower, diagonal, upper, d, NULL, NULL, &e) == MECHAUDIT_STATUS_NULL_POINTER);
    CHECK(mechaudit_tridiagonal_solve(3, NULL, diagonal, upper, d, x, NULL, &e) == MECHAUDIT_STATUS_NULL_POINTER);
    double two[6] = {5, 6, 5, 5, 6, 5};
    const double bands[6] = {1, 1, 1, 1, 1, 1}, fours[6] = {4, 4, 4, 4, 4, 4};
    CHECK(mechaudit_tridiagonal_solve_batch(2, 3, bands, fours, bands, two, two, &e) == MECHAUDIT_STATUS_OK);
    for (int k = 0; k < 6; k++) CHECK(fabs(two[k] - 1) < 1e-15);
    CHECK(mechaudit_tridiagonal_solve_batch(SIZE_MAX, 3, bands, fours, bands, two, two, &e) == MECHAUDIT_STATUS_SIZE);
    CHECK(mechaudit_tridiagonal_solve_batch(0, 3, NULL, NULL, NULL, NULL, NULL, &e) == MECHAUDIT_STATUS_OK);
    CHECK(mechaudit_tridiagonal_solve_batch(2, 0, bands, fours, bands, two, two, &e) == MECHAUDIT_STATUS_SIZE);
    /* A matrix that elimination without pivoting cannot be trusted with says so. */
    const double tiny[2] = {1e-20, 1}, one[1] = {1}, right[2] = {1, 2};
    CHECK(mechaudit_tridiagonal_solve(2, one, tiny, one, right, x, &estimate, NULL) == MECHAUDIT_STATUS_OK);
    CHECK(estimate > 1);
}

static void texts(void) {
    CHECK(strcmp(mechaudit_status_message(MECHAUDIT_STATUS_OK), "done") == 0);
    CHECK(strlen(mechaudit_status_message(MECHAUDIT_STATUS_OUTSIDE)) > 5);
    CHECK(strcmp(mechaudit_status_message(12345), mechaudit_status_message(MECHAUDIT_STATUS_INTERNAL)) == 0);
    CHECK(strchr(mechaudit_version(), '.') != NULL);
}

int main(void) {
    for (int kind = 0; kind < KINDS; ++kind) {
        const size_t sizes[] = {0, 1, 63, 64, 1024, 1025, POINTS};
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
            batches(kind, kind == MECHAUDIT_FUNCTION_FADDEEVA || sizes[k] < 100 ? sizes[k] : sizes[k] / 2);
        }
    }
    refused_batches();
    voigt_profiles();
    real_batches();
    splines();
    systems();
    texts();
    return verdict("api");
}
