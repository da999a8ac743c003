#ifndef SWEEP_H
#define SWEEP_H

#include <stddef.h>

/* Solves a tridiagonal system of n equations in place by elimination without pivoting: the solution is
 * left in d, the pivots in diagonal. lower and upper are one shorter. Returns 0 where a pivot vanishes. */
int sweep(size_t n, const double *lower, double *diagonal, const double *upper, double *d);

#endif
