/* Tridiagonal systems by elimination without pivoting, to be audited:
 *
 *     cc -O2 -o tridiagonal examples/candidates/tridiagonal.c
 *     mechaudit audit tridiagonal --exec ./tridiagonal
 *
 * Input: lower[n-1], diagonal[n], upper[n-1], d[n] on one line, separated by commas. strtod reads
 * hexadecimal floats, and printf writes them with %a. The first two lines are for the report.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Reads all numbers of a line into v, which grows; returns how many there were, -1 out of memory. */
static long numbers(char *line, double **v, long *room) {
    long count = 0;
    for (char *at = line, *end;; at = end) {
        while (*at == ',') {
            at++;
        }
        double x = strtod(at, &end);
        if (end == at) {
            return count;
        }
        if (count == *room) {
            *room = *room ? 2 * *room : 64;
            double *more = realloc(*v, (size_t)*room * sizeof **v);
            if (!more) {
                return -1;
            }
            *v = more;
        }
        (*v)[count++] = x;
    }
}

/* Solves in place: the solution is left in d. Returns 0 where a pivot vanishes. */
static int sweep(long n, const double *lower, double *diagonal, const double *upper, double *d) {
    for (long i = 0; i < n; i++) {
        if (i > 0) {
            double factor = lower[i - 1] / diagonal[i - 1];
            diagonal[i] -= factor * upper[i - 1];
            d[i] -= factor * d[i - 1];
        }
        if (diagonal[i] == 0.0) {
            return 0;
        }
    }
    for (long i = n - 1; i >= 0; i--) {
        if (i + 1 < n) {
            d[i] -= upper[i] * d[i + 1];
        }
        d[i] /= diagonal[i];
    }
    return 1;
}

int main(void) {
    char *line = NULL;
    size_t length = 0;
    double *v = NULL;
    long room = 0;
    puts("# name: sweep in C\n# version: 1.0");
    while (getline(&line, &length, stdin) > 0) {
        if (line[0] == '#') {
            continue;
        }
        long count = numbers(line, &v, &room);
        if (count < 0) {
            return 1;
        }
        long n = (count + 2) / 4;
        if (n < 1 || 4 * n - 2 != count) {
            puts("refuse bad layout");
            continue;
        }
        double *d = v + 3 * n - 2;
        if (!sweep(n, v, v + n - 1, v + 2 * n - 1, d)) {
            puts("refuse singular");
            continue;
        }
        for (long i = 0; i < n; i++) {
            printf(i ? ",%a" : "%a", d[i]);
        }
        putchar('\n');
    }
    free(line);
    free(v);
    return ferror(stdin) != 0;
}
