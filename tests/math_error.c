/* tests/math_error.c -- see math_error.h. */
#include "tests/math_error.h"
#include "core/parallel.h"

enum { MOST_THREADS = 256, CHUNK = 1 << 20 };

const math_function math_functions[MATH_FUNCTIONS] = {
    { "log2", vlog2, log2, 0x1p-149f, 3.40282347e38f, 2.0, HUGE_VAL },
    { "exp2", vexp2, exp2, -150.0f, 127.999992f, 2.0, HUGE_VAL },
    { "sin", vsin, sin, -1000.0f, 1000.0f, HUGE_VAL, 0x1p-23 },
    { "cos", vcos, cos, -1000.0f, 1000.0f, HUGE_VAL, 0x1p-23 },
    { "asin", vasin, asin, -1.0f, 1.0f, 3.0, HUGE_VAL },
    { "acos", vacos, acos, -1.0f, 1.0f, 2.0, HUGE_VAL },
};

/* The distance of floats at a, which is 2^-149 for denormals. */
static double float_spacing(double a)
{
    int exponent;
    frexp(a, &exponent);
    return ldexp(1.0, exponent < -125 ? -149 : exponent - 24);
}

/* Floats counted from 0: neighbours differ by 1. */
static int64_t rank_of(float a)
{
    int32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits < 0 ? -(int64_t)(bits & INT32_MAX) : bits;
}

static float of_rank(int64_t rank)
{
    int32_t bits = (int32_t)(rank < 0 ? -rank : rank);
    float a;
    memcpy(&a, &bits, sizeof a);
    return rank < 0 ? -a : a;
}

typedef struct measurement {
    const math_function *f;
    int64_t first, last, stride; /* ranks */
    math_error worst[MOST_THREADS];
} measurement;

static void measure_lane(const math_function *f, float x, float got, math_error *worst)
{
    double want     = f->exact((double)x);
    double absolute = fabs((double)got - want);
    double ulps     = absolute / float_spacing(want);
    if (!(absolute <= worst->absolute)) { /* NaN is worst */
        worst->absolute    = absolute;
        worst->absolute_at = x;
    }
    if (!(ulps <= worst->ulps)) {
        worst->ulps    = ulps;
        worst->ulps_at = x;
    }
}

static void measure_chunk(void *context, int item, int thread)
{
    measurement *m = context;
    int64_t first  = m->first + item * m->stride * CHUNK;
    int64_t last   = first + m->stride * (CHUNK - 1);
    last           = last < m->last ? last : m->last;
    for (int64_t rank = first; rank <= last; rank += m->stride * LANES) {
        float x[LANES], got[LANES];
        for (int i = 0; i < LANES; i++) {
            int64_t own = rank + i * m->stride;
            x[i]        = of_rank(own < last ? own : last);
        }
        vstore(got, m->f->packet(vload(x)));
        for (int i = 0; i < LANES; i++)
            measure_lane(m->f, x[i], got[i], &m->worst[thread]);
    }
}

static int threads(void)
{
    int processors = parallel_processors();
    return processors < MOST_THREADS ? processors : MOST_THREADS;
}

math_error math_measure(const math_function *f, int64_t stride)
{
    measurement m = { .f = f, .first = rank_of(f->low), .last = rank_of(f->high) };
    m.stride      = stride;
    int chunks    = (int)((m.last - m.first) / stride / CHUNK) + 1;
    parallel_for(chunks, threads(), measure_chunk, &m, NULL);

    math_error worst = m.worst[0];
    for (int i = 1; i < MOST_THREADS; i++) {
        const math_error *w = &m.worst[i];
        if (!(w->absolute <= worst.absolute)) {
            worst.absolute    = w->absolute;
            worst.absolute_at = w->absolute_at;
        }
        if (!(w->ulps <= worst.ulps)) {
            worst.ulps    = w->ulps;
            worst.ulps_at = w->ulps_at;
        }
    }
    return worst;
}

/* A stream of 64 random bits (Steele, Lea, Flood, "Fast splittable pseudorandom number
 * generators", OOPSLA 2014). */
static uint64_t splitmix(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z          = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z          = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

static float finite_float(uint64_t *state)
{
    for (;;) {
        uint32_t bits = (uint32_t)splitmix(state);
        float a;
        memcpy(&a, &bits, sizeof a);
        if (isfinite(a))
            return a;
    }
}

static double signed_unit(uint64_t *state) { return (double)(splitmix(state) >> 11) * 0x1p-52 - 1; }

typedef struct pairs {
    int64_t count;
    double (*error)(uint64_t *state); /* the worst of a packet of pairs */
    double worst[MOST_THREADS];
} pairs;

static double atan2_packet(uint64_t *state)
{
    float x[LANES], y[LANES], got[LANES];
    for (int i = 0; i < LANES; i++) {
        y[i]       = finite_float(state);
        float near = (float)((double)y[i] * exp2(8.0 * signed_unit(state)));
        float sign = signed_unit(state) < 0.0 ? -1.0f : 1.0f;
        x[i]       = splitmix(state) & 1 && isfinite(near) ? sign * near : finite_float(state);
    }
    vstore(got, vatan2(vload(y), vload(x)));
    double worst = 0.0;
    for (int i = 0; i < LANES; i++) {
        double want = atan2((double)y[i], (double)x[i]);
        double off  = fabs((double)got[i] - want) / float_spacing(want);
        worst       = off <= worst ? worst : off;
    }
    return worst;
}

static double pow_packet(uint64_t *state)
{
    float x[LANES], y[LANES], got[LANES];
    for (int i = 0; i < LANES; i++) {
        bool near_1 = splitmix(state) & 1;
        x[i] = near_1 ? (float)exp2(pow(signed_unit(state), 5.0)) : fabsf(finite_float(state));
        double log  = log2((double)x[i]);
        double most = fmin(126.0 / fmax(fabs(log), 1e-30), 1e30);
        y[i]        = (float)(most * signed_unit(state));
    }
    vstore(got, vpow(vload(x), vload(y)));
    double worst = 0.0;
    for (int i = 0; i < LANES; i++) {
        double want = x[i] > 0.0f ? pow((double)x[i], (double)y[i]) : (double)got[i];
        double off  = fabs((double)got[i] / want - 1.0) / (1.0 + fabs(log2(want)));
        if (x[i] > 0.0f)
            worst = off <= worst ? worst : off;
    }
    return worst;
}

static void pairs_chunk(void *context, int item, int thread)
{
    pairs *p       = context;
    uint64_t state = (uint64_t)item << 40;
    int64_t left   = p->count - (int64_t)item * CHUNK;
    for (int64_t n = 0; n < left && n < CHUNK; n += LANES) {
        double off       = p->error(&state);
        p->worst[thread] = off <= p->worst[thread] ? p->worst[thread] : off;
    }
}

static double over_pairs(int64_t count, double (*error)(uint64_t *))
{
    pairs p = { .count = count, .error = error };
    parallel_for((int)(count / CHUNK) + 1, threads(), pairs_chunk, &p, NULL);
    double worst = 0.0;
    for (int i = 0; i < MOST_THREADS; i++)
        worst = p.worst[i] <= worst ? worst : p.worst[i];
    return worst;
}

double math_atan2_error(int64_t count) { return over_pairs(count, atan2_packet); }
double math_pow_error(int64_t count) { return over_pairs(count, pow_packet); }
