/* Values of libcerf's functions, whichever library provides them; the header is that of the include path. */
#include <cerf.h>
#include <complex.h>
#include <stdio.h>
#include <string.h>

static double _Complex at(double x, double y) {
    const double parts[2] = {x, y};
    double _Complex z;
    memcpy(&z, parts, sizeof z);
    return z;
}

static void show(const char *name, double _Complex w) {
    printf("%-34s %.17g %.17g\n", name, creal(w), cimag(w));
}

#define SHOW(value) show(#value, value)

int main(void) {
    /* Where libcerf is right, */
    SHOW(w_of_z(at(1, 1)));
    SHOW(cerf(at(0.5, -2)));
    SHOW(voigt(1, 1, 1));
    SHOW(erfcx(2));
    /* beside a zero of w, on the diagonal of the lower half-plane, beside the axes, */
    SHOW(w_of_z(at(1.9914668428, -1.3548101281)));
    SHOW(w_of_z(at(100, -100.01)));
    SHOW(w_of_z(at(1e9, 1e-3)));
    SHOW(w_of_z(at(5.5, -2.25)));
    SHOW(cerfc(at(2.5, 1e-200)));
    SHOW(cdawson(at(6, -5.5)));
    SHOW(cerfi(at(-3, 2)));
    SHOW(cerfcx(at(-4, 6)));
    /* in the wings of a narrow line, and at the ends of the range. */
    SHOW(voigt(30, 1, 1e-300));
    SHOW(voigt(1e-310, 1e-310, 0));
    SHOW(im_w_of_x(1e300));
    SHOW(dawson(0.924));
    SHOW(erfi(26.6));
    return 0;
}
