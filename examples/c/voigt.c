/* The Voigt profile of a spectral line and its width, then W at many points.
 *
 *     cc voigt.c $(pkg-config --cflags --libs mechaudit) -o voigt */
#include <mechaudit.h>
#include <stdio.h>

int main(void) {
    const double sigma = 0.5, gamma = 0.25; /* Doppler and collisional width in one unit, here GHz */
    const double half = mechaudit_voigt_hwhm(sigma, gamma);
    printf("half width  %.16g GHz\n", half);
    printf("V(0), V(h)  %.16g %.16g 1/GHz\n", mechaudit_voigt(0, sigma, gamma), mechaudit_voigt(half, sigma, gamma));

    double re, im;
    mechaudit_faddeeva(1, 1, &re, &im);
    printf("w(1 + i)    %.16g %+.16gi\n", re, im);

    enum { N = 1000 };
    static double z[2 * N], w[2 * N];
    for (int k = 0; k < N; ++k) {
        z[2 * k] = 0.01 * k;
        z[2 * k + 1] = -0.5;
    }
    mechaudit_error error;
    if (mechaudit_batch(MECHAUDIT_FUNCTION_FADDEEVA, N, z, 1, w, 1, &error) != MECHAUDIT_STATUS_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("w(9.99 - i/2) %.16g %+.16gi\n", w[2 * N - 2], w[2 * N - 1]);
    return 0;
}
