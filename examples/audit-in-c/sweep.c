#include "sweep.h"

int sweep(size_t n, const double *lower, double *diagonal, const double *upper, double *d) {
    for (size_t i = 0; i < n; i++) {
        if (i > 0) {
            double factor = lower[i - 1] / diagonal[i - 1];
            diagonal[i] -= factor * upper[i - 1];
            d[i] -= factor * d[i - 1];
        }
        if (diagonal[i] == 0.0) {
            return 0;
        }
    }
    for (size_t i = n; i-- > 0;) {
        if (i + 1 < n) {
            d[i] -= upper[i] * d[i + 1];
        }
        d[i] /= diagonal[i];
    }
    return 1;
}
