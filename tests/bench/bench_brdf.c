/* tests/bench/bench_brdf.c -- an anisotropic table looked up in packets and in plain C.
 *
 *     bench_brdf ONE_LANE_PROGRAM    the table; the program is this one, built with WIDTH=1
 *     bench_brdf --times             what runs in that: prints the nanoseconds of each case
 *
 * This is table 1 of Barladian et al. (2007): 17 x 7 x 17 x 13 places, uneven in every angle, three
 * colours, 100,000, 200,000 and 400,000 look-ups. Pairs of directions are either random, or as a
 * camera's rays have them: wo turns slowly, a lamp's wi too. Plain C is plain_brdf.c: libm, binary
 * search. All sides take turns in short rounds; the best round counts, by the thread's own clock.
 *
 * Where the time goes is measured by leaving parts out: the angles alone, and with them the cells,
 * what is left being the corners; and by other ways to the same cells and corners.
 */
#include "materials/brdf_parts.h"
#include "tests/bench/plain_brdf.h"
#include "tests/other_times.h"
#include "tests/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 400000, ROUNDS = 15, SIZES = 3 };

static const int sizes[SIZES]    = { 100000, 200000, 400000 };
static const double paper[SIZES] = { 3.43, 3.17, 3.17 };

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *need(size_t bytes)
{
    void *p = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!p) {
        fprintf(stderr, "bench_brdf: no memory\n");
        exit(1);
    }
    return p;
}

/* ---- the table ------------------------------------------------------------------------------- */

static const brdf *make_table(arena *a)
{
    static const double thetas[17]  = { 0,  3,  7,  12, 18, 24, 30, 37, 44,
                                        50, 56, 62, 68, 74, 80, 86, 90 };
    static const double phi_in[7]   = { 0, 40, 95, 150, 210, 255, 310 };
    static const double phi_out[13] = {
        0, 20, 45, 80, 110, 140, 165, 190, 220, 250, 285, 310, 340
    };
    enum { PLACES = 17 * 7 * 17 * 13 };
    static float rgb[3 * PLACES];
    uint32_t seed = 5;
    lux_error err = { 0 };
    for (int i = 0; i < 3 * PLACES; i++)
        rgb[i] = 0.25f * random_unit(&seed);
    brdf_data d   = { .name   = "bench",
                      .kind   = BRDF_ANISOTROPIC,
                      .counts = { 17, 7, 17, 13 },
                      .deg    = { thetas, phi_in, thetas, phi_out },
                      .rgb    = rgb };
    const brdf *b = brdf_make(a, &d, NULL, &err);
    if (!b) {
        fprintf(stderr, "bench_brdf: %s\n", err.text);
        exit(1);
    }
    return b;
}

static plain_table plain_of(const brdf *b)
{
    plain_table t = { .values = b->values };
    for (int k = 0; k < 4; k++)
        t.axes[k] = (plain_axis){ b->axes[k].at, b->axes[k].count, b->axes[k].periodic };
    return t;
}

/* ---- directions ------------------------------------------------------------------------------ */

typedef struct pairs {
    vec3 *wo, *wi;
    vvec3 *vwo, *vwi;
} pairs;

static vec3 above(uint32_t *seed)
{
    vec3 w = random_direction(seed);
    return (vec3){ w.x, w.y, fabsf(w.z) + 1e-6f };
}

static vec3 unit(float x, float y, float z)
{
    return v3_scale((vec3){ x, y, z }, 1.0f / sqrtf(x * x + y * y + z * z));
}

static pairs make_pairs(bool coherent)
{
    pairs p       = { need(MOST * sizeof(vec3)), need(MOST * sizeof(vec3)),
                      need(MOST / LANES * sizeof(vvec3)), need(MOST / LANES * sizeof(vvec3)) };
    uint32_t seed = 9;
    for (int i = 0; i < MOST; i++) { /* a picture of 800 x 500 of a floor below a lamp */
        float x = (float)(i % 800) / 400 - 1, y = (float)(i / 800) / 250 - 1;
        p.wo[i] = coherent ? unit(-2.0f * x, -2.0f * y - 2.5f, 1.5f) : above(&seed);
        p.wi[i] = coherent ? unit(0.4f - 2.0f * x, 0.3f - 2.0f * y, 1.2f) : above(&seed);
    }
    for (int k = 0; k < MOST / LANES; k++) {
        float w[6][LANES];
        for (int i = 0; i < LANES; i++) {
            vec3 o = p.wo[k * LANES + i], n = p.wi[k * LANES + i];
            w[0][i] = o.x, w[1][i] = o.y, w[2][i] = o.z;
            w[3][i] = n.x, w[4][i] = n.y, w[5][i] = n.z;
        }
        p.vwo[k] = (vvec3){ vload(w[0]), vload(w[1]), vload(w[2]) };
        p.vwi[k] = (vvec3){ vload(w[3]), vload(w[4]), vload(w[5]) };
    }
    return p;
}

/* ---- what is timed --------------------------------------------------------------------------- */

typedef vrgb packet_look(const brdf *b, const vvec3 *wo, const vvec3 *wi);

static vrgb whole(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    return vbrdf_value(b, wo, wi, ALL_LANES);
}

static void angles_of(const vvec3 *wo, const vvec3 *wi, vfloat angle[4])
{
    angle[0] = vatan2(vsqrt(wo->x * wo->x + wo->y * wo->y), wo->z);
    angle[1] = vatan2(wo->y, wo->x);
    angle[2] = vatan2(vsqrt(wi->x * wi->x + wi->y * wi->y), wi->z);
    angle[3] = vatan2(wi->y, wi->x);
}

static vrgb angles_alone(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    vfloat angle[4];
    (void)b;
    angles_of(wo, wi, angle);
    return (vrgb){ angle[0] + angle[1], angle[2], angle[3] };
}

static vrgb cells_alone(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    vbrdf_place p;
    vbrdf_find(b, wo, wi, false, &p);
    vint sum = p.axes[0].below + p.axes[1].below + p.axes[2].above + p.axes[3].above;
    return (vrgb){ p.axes[0].fraction + p.axes[1].fraction, p.axes[2].fraction + p.axes[3].fraction,
                   vto_float(sum) };
}

/* The same with binary search, and each corner's colours brought together in packets. */
static brdf searched; /* the table without bins */

static vrgb by_search(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    (void)b;
    return vbrdf_value(&searched, wo, wi, ALL_LANES);
}

static vrgb by_gathers(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    vbrdf_place p;
    vbrdf_find(b, wo, wi, false, &p);
    vrgb sum = { 0 };
    for (int corner = 0; corner < 16; corner++) {
        vint at       = vsplat_int(0);
        vfloat weight = vsplat(1.0f), rgb[4];
        for (int k = 0; k < 4; k++) {
            const vtable_place *q = &p.axes[k];
            bool up               = corner >> (3 - k) & 1;
            at                    = at * b->axes[k].count + (up ? q->above : q->below);
            weight                = weight * (up ? q->fraction : 1.0f - q->fraction);
        }
        vgather4(b->values, at, rgb);
        sum = vadd(sum, vscale((vrgb){ rgb[0], rgb[1], rgb[2] }, weight));
    }
    return sum;
}

enum { WHOLE, ANGLES, CELLS, SEARCH, GATHERS, LOOKS };
static packet_look *const looks[LOOKS] = { whole, angles_alone, cells_alone, by_search,
                                           by_gathers };

static volatile float kept; /* so that no sum is left out */

static double packet_ns(const brdf *b, const pairs *p, int count, int look)
{
    double start = seconds();
    vrgb sum     = { 0 };
    for (int k = 0; k < count / LANES; k++)
        sum = vadd(sum, looks[look](b, &p->vwo[k], &p->vwi[k]));
    kept = vsum(sum.x) + vsum(sum.y) + vsum(sum.z);
    return (seconds() - start) * 1e9 / count;
}

static double plain_ns(const plain_table *t, const pairs *p, int count, plain_sum *sum)
{
    double start = seconds();
    vec3 all     = sum(t, p->wo, p->wi, count);
    kept         = all.x + all.y + all.z;
    return (seconds() - start) * 1e9 / count;
}

/* Ends the program if a look-up is off by more than 1e-4 of the largest value. */
static void compare(const brdf *b, const plain_table *t, const pairs *p)
{
    for (int i = 0; i < 10000; i++) {
        vvec3 wo = vspread(p->wo[i]), wi = vspread(p->wi[i]);
        vec3 want = plain_value(t, p->wo[i], p->wi[i]);
        for (int look = 0; look < LOOKS; look++) {
            if (look == ANGLES || look == CELLS)
                continue;
            vrgb got  = looks[look](b, &wo, &wi);
            float off = fabsf(lane(got.x, 0) - want.x) + fabsf(lane(got.z, 0) - want.z);
            if (!(off < 2.5e-5f)) {
                fprintf(stderr, "bench_brdf: look-up %d is off by %g\n", i, (double)off);
                exit(1);
            }
        }
    }
}

/* ---- the tables ------------------------------------------------------------------------------ */

enum { CASES = 2 * (SIZES + LOOKS) }; /* random and coherent: the sizes, and the parts */

static void ask_packets(const brdf *b, const pairs p[2], double best[CASES])
{
    for (int k = 0; k < CASES; k++) {
        int i     = k % (SIZES + LOOKS);
        int count = i < SIZES ? sizes[i] : sizes[0];
        best[k] =
            fmin(best[k], packet_ns(b, &p[k / (SIZES + LOOKS)], count, i < SIZES ? 0 : i - SIZES));
    }
}

static void print_parts(const double ours[CASES], const double one[CASES])
{
    static const char *const names[] = { "whole look-up",
                                         "angles",
                                         "cells",
                                         "corners",
                                         "whole, by binary search",
                                         "whole, by gathered corners" };
    for (int side = 0; side < 2; side++) {
        const double *b[2] = { ours + side * (SIZES + LOOKS) + SIZES,
                               one + side * (SIZES + LOOKS) + SIZES };
        printf("%s directions: where the time goes, ns   WIDTH=%d  WIDTH=1    ratio\n",
               side ? "coherent" : "random", LANES);
        for (int i = 0; i < 6; i++) {
            double ns[2];
            for (int w = 0; w < 2; w++)
                ns[w] = i == 0   ? b[w][WHOLE]
                        : i == 1 ? b[w][ANGLES]
                        : i == 2 ? b[w][CELLS] - b[w][ANGLES]
                        : i == 3 ? b[w][WHOLE] - b[w][CELLS]
                                 : b[w][i - 1];
            printf("  %-40s %8.2f %8.2f %8.2f\n", names[i], ns[0], ns[1], ns[1] / ns[0]);
        }
    }
}

static void table(const brdf *b, const plain_table *t, const pairs p[2], const char *one_lane)
{
    double ours[CASES], one[CASES], plain[2][2 * SIZES];
    for (int k = 0; k < CASES; k++)
        ours[k] = one[k] = HUGE_VAL;
    for (int k = 0; k < 2 * SIZES; k++)
        plain[0][k] = plain[1][k] = HUGE_VAL;
    for (int round = 0; round < ROUNDS; round++) {
        other_times(one_lane, CASES, one);
        ask_packets(b, p, ours);
        for (int k = 0; k < 2 * SIZES; k++) {
            const pairs *q = &p[k / SIZES];
            plain[0][k]    = fmin(plain[0][k], plain_ns(t, q, sizes[k % SIZES], plain_sum_brdf));
            plain[1][k] = fmin(plain[1][k], plain_ns(t, q, sizes[k % SIZES], plain_sum_brdf_387));
        }
    }
    printf(
        "nanoseconds a look-up, 17 x 7 x 17 x 13 places, one thread; best of %d rounds\n"
        "                                   plain C  plain C  WIDTH=%d is faster than\n"
        "look-ups          WIDTH=%d  WIDTH=1      SSE      x87  WIDTH=1      SSE      x87  paper\n",
        ROUNDS, LANES, LANES);
    for (int k = 0; k < 2 * SIZES; k++) {
        int at      = k / SIZES * (SIZES + LOOKS) + k % SIZES;
        double ns[] = { ours[at], one[at], plain[0][k], plain[1][k] };
        printf("%-9s %6d ", k < SIZES ? "random" : "coherent", sizes[k % SIZES]);
        for (int i = 0; i < 4; i++)
            printf("%8.2f ", ns[i]);
        for (int i = 1; i < 4; i++)
            printf("%8.2f ", ns[i] / ns[0]);
        printf("%6.2f\n", paper[k % SIZES]);
    }
    print_parts(ours, one);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "use: bench_brdf ONE_LANE_PROGRAM\n");
        return 2;
    }
    arena a       = { 0 };
    const brdf *b = make_table(&a);
    searched      = *b;
    for (int k = 0; k < 4; k++)
        searched.axes[k].bins = NULL;
    plain_table t = plain_of(b);
    pairs p[2]    = { make_pairs(false), make_pairs(true) };
    compare(b, &t, &p[0]);
    compare(b, &t, &p[1]);
    if (strcmp(argv[1], "--times")) {
        table(b, &t, p, argv[1]);
    } else {
        double ns[CASES];
        for (int k = 0; k < CASES; k++)
            ns[k] = HUGE_VAL;
        ask_packets(b, p, ns);
        for (int k = 0; k < CASES; k++)
            printf("%.9g\n", ns[k]);
    }
    for (int k = 0; k < 2; k++) {
        free(p[k].wo), free(p[k].wi);
        free(p[k].vwo), free(p[k].vwi);
    }
    arena_clear(&a);
    return 0;
}
