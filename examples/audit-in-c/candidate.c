/* Lets mechaudit audit sweep(): one input a line, lower[n-1], diagonal[n], upper[n-1], d[n]; one answer
 * a line. */
#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>

enum { LONGEST = 1 << 20, MOST = 4096 };

int main(void) {
    static char line[LONGEST];
    static double v[MOST];
    puts("# name: sweep\n# version: 0.1.0");
    while (fgets(line, sizeof line, stdin)) {
        if (line[0] == '#') {
            continue;
        }
        size_t count = 0;
        for (char *at = line, *end; count < MOST; at = end) {
            at += *at == ',';
            v[count] = strtod(at, &end);
            if (end == at) {
                break;
            }
            count++;
        }
        size_t n = (count + 2) / 4;
        if (n < 1 || 4 * n - 2 != count) {
            puts("refuse bad layout");
            continue;
        }
        double *d = v + 3 * n - 2;
        if (!sweep(n, v, v + n - 1, v + 2 * n - 1, d)) {
            puts("refuse singular");
            continue;
        }
        for (size_t i = 0; i < n; i++) {
            printf(i ? ",%a" : "%a", d[i]);
        }
        putchar('\n');
    }
    return ferror(stdin) != 0;
}
