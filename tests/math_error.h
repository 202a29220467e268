/* tests/math_error.h -- how far the functions of packet_math.h are from double precision. */
#ifndef TESTS_MATH_ERROR_H
#define TESTS_MATH_ERROR_H

#include "core/packet_math.h"

/* A function of one argument and its twin of libm, over the floats from low to high. */
typedef struct math_function {
    const char *name;
    vfloat (*packet)(vfloat);
    double (*exact)(double);
    float low, high;
    double most_ulps, most_absolute; /* what packet_math.h promises; HUGE_VAL: nothing */
} math_function;

/* All of them, with what packet_math.h promises. */
enum { MATH_FUNCTIONS = 6 };
extern const math_function math_functions[MATH_FUNCTIONS];

/* The largest errors that were met, and where. */
typedef struct math_error {
    double ulps, absolute;
    float ulps_at, absolute_at;
} math_error;

/* Over every stride-th float, on as many threads as there are processors. */
math_error math_measure(const math_function *f, int64_t stride);

/* Over `pairs` pairs of floats. atan2: all floats, half of the pairs no more than 2^8 apart, in
 * ulps. pow: x in (0, inf), y such that |log2(x^y)| <= 126, as relative error divided by
 * 1 + |log2(x^y)|. */
#define ATAN2_MOST_ULPS 3.0
#define POW_MOST_ERROR  1.5e-7
double math_atan2_error(int64_t pairs);
double math_pow_error(int64_t pairs);

#endif
