/* tests/bench/bench_texture.c -- trilinear look-ups of RGBA in packets and in plain C.
 *
 *     bench_texture ONE_LANE_PROGRAM   the table; the program is this one, built with WIDTH=1
 *     bench_texture --times            what runs in that: prints the nanoseconds of each case
 *
 * Random look-ups are anywhere in the picture, 1 to 64 texels wide; coherent ones are those of the
 * pixels of a view along a floor, neighbours side by side; near ones are less than a texel wide and
 * need one level alone. All sides take turns in short rounds, so that whatever else the machine
 * does meets all of them; the best round counts, by the thread's own clock. Plain C is
 * plain_texture.c. Before the clock starts, what both make of each look-up is compared.
 */
#include "materials/texture.h"
#include "tests/bench/plain_texture.h"
#include "tests/other_times.h"
#include "tests/shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { POINTS = 4096, PASSES = 8, ROUNDS = 25, CASES = 5 };

typedef enum pattern { RANDOM, COHERENT, NEAR } pattern;

static const struct {
    const char *name;
    pattern pattern;
    int side; /* of the picture, texels */
} cases[CASES] = {
    { "random, 256 x 256", RANDOM, 256 },     { "random, 1024 x 1024", RANDOM, 1024 },
    { "coherent, 256 x 256", COHERENT, 256 }, { "coherent, 1024 x 1024", COHERENT, 1024 },
    { "random, one level", NEAR, 256 },
};

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void require(const void *made, const lux_error *err)
{
    if (!made) {
        fprintf(stderr, "bench_texture: %s\n", err->text);
        exit(1);
    }
}

/* ---- the pictures, each twice --------------------------------------------------------------- */

static float *noise(arena *a, int side, lux_error *err)
{
    uint32_t seed = 5;
    size_t count  = 4 * (size_t)side * (size_t)side;
    float *rgba   = arena_array(a, float, count, err);
    require(rgba, err);
    for (size_t i = 0; i < count; i++)
        rgba[i] = random_unit(&seed);
    return rgba;
}

static plain_texture make_plain(arena *a, const float *rgba, int side, lux_error *err)
{
    plain_texture t = { 1, { side }, { rgba } };
    for (; t.side[t.levels - 1] > 1; t.levels++) {
        int n              = t.side[t.levels - 1] / 2;
        const float *above = t.texel[t.levels - 1];
        float *to          = arena_array(a, float, 4 * (size_t)n * (size_t)n, err);
        require(to, err);
        for (int i = 0; i < 4 * n * n; i++) {
            const float *from = above + 16 * n * (i / 4 / n) + 8 * (i / 4 % n) + i % 4;
            to[i]             = 0.25f * (from[0] + from[4] + from[8 * n] + from[8 * n + 4]);
        }
        t.side[t.levels]  = n;
        t.texel[t.levels] = to;
    }
    return t;
}

/* ---- the places ----------------------------------------------------------------------------- */

typedef struct places {
    float u[POINTS], v[POINTS], width[POINTS];
} places;

static void make_places(places *p, pattern kind, int side)
{
    uint32_t seed = 3;
    float texel   = 1.0f / (float)side;
    for (int i = 0; i < POINTS; i++) {
        if (kind == COHERENT) { /* 64 x 64 pixels from 1.5 to 8 pictures away */
            float row = (float)(i / 64) / 64, far = 1.0f / (0.667f - 0.542f * row);
            p->u[i]     = far * ((float)(i % 64) / 64 - 0.5f);
            p->v[i]     = far;
            p->width[i] = far * texel * 1.3f;
        } else {
            p->u[i]     = 4 * random_unit(&seed) - 2;
            p->v[i]     = 4 * random_unit(&seed) - 2;
            p->width[i] = texel * exp2f(6 * random_unit(&seed) - (kind == NEAR ? 6 : 0));
        }
    }
}

static void packet_sum(const texture *t, const places *p, float rgba[4])
{
    vtexel sum = { 0 };
    for (int i = 0; i < POINTS; i += LANES) {
        vtexel one =
            vtexture_lookup(t, vload(p->u + i), vload(p->v + i), vload(p->width + i), ALL_LANES);
        sum.red   = sum.red + one.red;
        sum.green = sum.green + one.green;
        sum.blue  = sum.blue + one.blue;
        sum.alpha = sum.alpha + one.alpha;
    }
    rgba[0] = vsum(sum.red);
    rgba[1] = vsum(sum.green);
    rgba[2] = vsum(sum.blue);
    rgba[3] = vsum(sum.alpha);
}

/* Ends the program if a look-up differs by more than 1e-4: 2 ulp of the level's number, 24 bits of
 * the coordinate times the side. */
static void compare(const texture *t, const plain_texture *plain, const places *p)
{
    for (int i = 0; i < POINTS; i++) {
        vtexel got =
            vtexture_lookup(t, vsplat(p->u[i]), vsplat(p->v[i]), vsplat(p->width[i]), ALL_LANES);
        float want[4];
        plain_texture_lookup(plain, p->u[i], p->v[i], p->width[i], want);
        float off = fabsf(lane(got.red, 0) - want[0]) + fabsf(lane(got.green, 0) - want[1]) +
                    fabsf(lane(got.blue, 0) - want[2]) + fabsf(lane(got.alpha, 0) - want[3]);
        if (!(off < 1e-4f)) {
            fprintf(stderr, "bench_texture: look-up %d is off by %g\n", i, (double)off);
            exit(1);
        }
    }
}

/* ---- the clock ------------------------------------------------------------------------------ */

static volatile float kept; /* so that no sum is left out */

static double packet_ns(const texture *t, const places *p)
{
    float rgba[4];
    double start = seconds();
    for (int i = 0; i < PASSES; i++) {
        packet_sum(t, p, rgba);
        kept = rgba[1];
    }
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

static double plain_ns(const plain_texture *t, const places *p)
{
    float rgba[4];
    double start = seconds();
    for (int i = 0; i < PASSES; i++) {
        plain_texture_sum(t, p->u, p->v, p->width, POINTS, rgba);
        kept = rgba[1];
    }
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

typedef struct setting {
    const texture *ours;
    plain_texture plain;
    places at;
} setting;

enum { OURS, ONE_LANE, PLAIN, SIDES };

static void table(const setting *s, const char *one_lane)
{
    double best[SIDES][CASES];
    for (int side = 0; side < SIDES; side++)
        for (int k = 0; k < CASES; k++)
            best[side][k] = HUGE_VAL;
    for (int round = 0; round < ROUNDS; round++) {
        other_times(one_lane, CASES, best[ONE_LANE]);
        for (int k = 0; k < CASES; k++) {
            best[OURS][k]  = fmin(best[OURS][k], packet_ns(s[k].ours, &s[k].at));
            best[PLAIN][k] = fmin(best[PLAIN][k], plain_ns(&s[k].plain, &s[k].at));
        }
    }
    printf("nanoseconds a trilinear look-up of RGBA, one thread; best of %d rounds\n"
           "                                                  WIDTH=%d is faster than\n"
           "look-ups                WIDTH=%d  WIDTH=1  plain C  WIDTH=1  plain C\n",
           ROUNDS, LANES, LANES);
    for (int k = 0; k < CASES; k++)
        printf("%-22s %8.2f %8.2f %8.2f %8.2f %8.2f\n", cases[k].name, best[OURS][k],
               best[ONE_LANE][k], best[PLAIN][k], best[ONE_LANE][k] / best[OURS][k],
               best[PLAIN][k] / best[OURS][k]);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "use: bench_texture ONE_LANE_PROGRAM\n");
        return 2;
    }
    static setting s[CASES];
    arena a       = { 0 };
    lux_error err = { 0 };
    for (int k = 0; k < CASES; k++) {
        int side          = cases[k].side;
        const float *rgba = noise(&a, side, &err);
        texture_desc d    = { .name = "noise", .width = side, .height = side, .rgba = rgba };
        s[k].ours         = texture_new(&a, &d, &err);
        require(s[k].ours, &err);
        s[k].plain = make_plain(&a, rgba, side, &err);
        make_places(&s[k].at, cases[k].pattern, side);
        compare(s[k].ours, &s[k].plain, &s[k].at);
        for (int i = 0; i < 4; i++) /* memory of its own is warm before the first round */
            packet_ns(s[k].ours, &s[k].at);
    }
    if (strcmp(argv[1], "--times"))
        table(s, argv[1]);
    else
        for (int k = 0; k < CASES; k++)
            printf("%.9g\n", packet_ns(s[k].ours, &s[k].at));
    arena_clear(&a);
    return 0;
}
