/* Calls every function of a robot, and prints the bits of what it returns. */
#include <stdint.h>
#include "bot.h"

#ifdef BOARD
void put(const char *text);
#else
#include <math.h>
#include <stdio.h>

static void put(const char *text)
{
    fputs(text, stdout);
}

void library(double x, double *sine, double *cosine);
void library(double x, double *sine, double *cosine)
{
    *sine = sin(x);
    *cosine = cos(x);
}
#endif

static void print(const char *name, const REAL *x, int n)
{
    put(name);
    put(":");
    for (int k = 0; k < n; ++k) {
        union { REAL real; BITS bits; } value;
        char digits[2 * sizeof value + 1];
        value.real = x[k];
        for (unsigned d = 0; d < 2 * sizeof value; ++d) {
            digits[2 * sizeof value - 1 - d] = "0123456789abcdef"[value.bits & 15u];
            value.bits >>= 4;
        }
        digits[2 * sizeof value] = '\0';
        put(" ");
        put(digits);
    }
    put("\n");
}
