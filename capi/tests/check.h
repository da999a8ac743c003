/* Counting checks, and numbers of which the same come on every machine. */
#ifndef CHECK_H
#define CHECK_H

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static int checked, failed;

#define CHECK(condition)                                                                          \
    do {                                                                                          \
        ++checked;                                                                                \
        if (!(condition)) {                                                                       \
            ++failed;                                                                             \
            printf("%s:%d: %s\n", __FILE__, __LINE__, #condition);                                \
        }                                                                                         \
    } while (0)

/* The last line: what was counted. */
static inline int verdict(const char *name) {
    printf("%s: %d passed, %d failed\n", name, checked - failed, failed);
    return failed != 0;
}

static inline uint64_t bits(double x) {
    uint64_t b;
    memcpy(&b, &x, sizeof b);
    return b;
}

static inline double from_bits(uint64_t b) {
    double x;
    memcpy(&x, &b, sizeof x);
    return x;
}

static inline int same(double a, double b) { return bits(a) == bits(b); }

/* SplitMix64. */
static uint64_t state = 23;
static inline uint64_t next_bits(void) {
    uint64_t z = state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Uniform from low to high; exact in every step but the last, so the same everywhere. */
static inline double between(double low, double high) {
    const double unit = (double)(next_bits() >> 11) * (1.0 / 9007199254740992.0);
    const double part = (high - low) * unit;
    return low + part;
}

/* A number of either sign with an exponent from low to high. */
static inline double of_size(int low, int high) {
    const uint64_t exponent = (uint64_t)(1023 + low) + next_bits() % (uint64_t)(high - low + 1);
    return from_bits((next_bits() & UINT64_C(0x800fffffffffffff)) | exponent << 52);
}

#endif
