/* tests/bench/bench_lights.c -- one sample of each kind of light, in packets and in plain C.
 *
 *     bench_lights ONE_LANE_PROGRAM    the table; the program is this one, built with WIDTH=1
 *     bench_lights --times             what runs in that: prints the nanoseconds of each kind
 *
 * This is table 2 of Barladian et al. (2007), who had four lanes of SSE against scalar code on the
 * x87. A sample and the cosine of the surface that it lights are timed, without the shadow ray;
 * points lie in a room below the lamp. All sides take turns in short rounds, so that whatever else
 * the machine does meets all of them; the best round counts, by the thread's own clock. Plain C is
 * plain_lights.c, with libm and a branch wherever one saves work. Before the clock starts, what
 * both make of each point is compared.
 */
#include "core/sampler.h"
#include "lights/light.h"
#include "lights/photometry.h"
#include "tests/bench/plain_lights.h"
#include "tests/other_times.h"
#include "tests/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { POINTS = 1024, PACKETS = POINTS / LANES, PASSES = 24, ROUNDS = 25 };

static const struct {
    const char *name;
    double paper; /* how many times faster four lanes were in 2007 */
} kinds[PLAIN_KINDS] = {
    { "uniform point", 7.24 }, { "cone", 3.87 }, { "parallel", 4.31 },    { "cosine", 6.24 },
    { "linear", 5.83 },        { "disk", 5.79 }, { "rectangular", 5.96 }, { "goniodiagram", 4.38 },
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
        fprintf(stderr, "bench_lights: %s\n", err->text);
        exit(1);
    }
}

/* ---- the lamps, each twice ------------------------------------------------------------------ */

static const vec3 lamp = { 0.2f, -0.3f, 3.0f }, down = { 0, 0, -1 }, power = { 1, 2, 3 };

static const light *make(arena *a, plain_kind kind, lux_error *err)
{
    vec3 end = { lamp.x + 1.5f, lamp.y, lamp.z }, up = { 0, 1, 0 };
    switch (kind) {
    case PLAIN_POINT:
        return light_point(a, &(point_desc){ lamp, power }, err);
    case PLAIN_CONE:
        return light_cone(a, &(cone_desc){ lamp, down, power, 0.5f, 1.2f }, err);
    case PLAIN_PARALLEL:
        return light_parallel(a, &(parallel_desc){ .aim = down, .irradiance = power }, err);
    case PLAIN_COSINE:
        return light_cosine(a, &(cosine_desc){ lamp, down, power, 12.5f }, err);
    case PLAIN_LINEAR:
        return light_linear(a, &(linear_desc){ lamp, end, power }, err);
    case PLAIN_DISK:
        return light_disk(a, &(disk_desc){ lamp, down, 0.5f, power }, err);
    case PLAIN_RECT:
        return light_rect(a, &(rect_desc){ lamp, down, up, 0.6f, 1.2f, power }, err);
    default:;
        const photometry *web = photometry_read(a, "data/office/panel.ldt", NULL, err);
        return web ? light_luminaire(a,
                                     &(luminaire_desc){ .position = lamp,
                                                        .aim      = down,
                                                        .scale    = power,
                                                        .web      = web,
                                                        .point    = true },
                                     err)
                   : NULL;
    }
}

/* An axis of a web, in rad */
static const float *radians(arena *a, const float *deg, int count, lux_error *err)
{
    float *rad = arena_array(a, float, (size_t)count, err);
    require(rad, err);
    for (int i = 0; i < count; i++)
        rad[i] = (float)((double)deg[i] * (M_PI / 180.0));
    return rad;
}

static plain_light make_plain(arena *a, plain_kind kind, lux_error *err)
{
    plain_light l = { .kind = kind, .position = lamp, .axis = down, .strength = power };
    v3_frame(l.axis, &l.u, &l.v);
    l.cos_inner = cosf(0.5f);
    l.cos_outer = cosf(1.2f);
    l.exponent  = 12.5f;
    l.length    = kind == PLAIN_LINEAR ? 1.5f : kind == PLAIN_DISK ? 0.5f : 1.2f;
    l.width     = 0.6f;
    if (kind == PLAIN_LINEAR) {
        l.axis     = (vec3){ 1, 0, 0 };
        l.strength = v3_scale(power, 1 / l.length);
    } else if (kind == PLAIN_RECT) {
        l.u = (vec3){ -1, 0, 0 };
        l.v = (vec3){ 0, 1, 0 };
    } else if (kind == PLAIN_LUMINAIRE) {
        const photometry *web = photometry_read(a, "data/office/panel.ldt", NULL, err);
        require(web, err);
        l.u             = (vec3){ 1, 0, 0 };
        l.v             = (vec3){ 0, 1, 0 };
        l.planes        = web->plane_count;
        l.gammas        = web->gamma_count;
        l.plane         = radians(a, web->plane_deg, l.planes, err);
        l.gamma         = radians(a, web->gamma_deg, l.gammas, err);
        l.candela       = web->candela;
        l.plane_density = (float)l.planes / 6.28318531f;
        l.gamma_density = (float)(l.gammas - 1) / (l.gamma[l.gammas - 1] - l.gamma[0]);
    }
    return l;
}

/* ---- the points ----------------------------------------------------------------------------- */

static struct points {
    vec3 p[POINTS], n[POINTS];
    float s[POINTS], t[POINTS];
    vvec3 vp[PACKETS], vn[PACKETS];
    vfloat vs[PACKETS], vt[PACKETS];
} points;

static vvec3 load3(const vec3 *from)
{
    float x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        x[i] = from[i].x;
        y[i] = from[i].y;
        z[i] = from[i].z;
    }
    return (vvec3){ vload(x), vload(y), vload(z) };
}

/* Neighbours are near each other, as sensors are; each has a sample of its own. */
static void make_points(void)
{
    uint32_t seed = 3;
    for (int i = 0; i < POINTS; i++) {
        float x = (float)(i % 32) / 32 - 0.5f, y = (float)(i / 32) / 32 - 0.5f;
        points.p[i] = (vec3){ 5 * x, 4 * y, 0.8f + 0.1f * random_unit(&seed) };
        points.n[i] = (vec3){ 0.6f * x, 0, sqrtf(1 - 0.36f * x * x) };
        points.s[i] = random_unit(&seed);
        points.t[i] = random_unit(&seed);
    }
    for (int k = 0; k < PACKETS; k++) {
        points.vp[k] = load3(points.p + k * LANES);
        points.vn[k] = load3(points.n + k * LANES);
        points.vs[k] = vload(points.s + k * LANES);
        points.vt[k] = vload(points.t + k * LANES);
    }
}

static vec3 sum_packets(const light *l)
{
    vrgb sum = vspread((vec3){ 0, 0, 0 });
    for (int k = 0; k < PACKETS; k++) {
        vlight_sample at;
        vmask lit    = light_sample(l, &points.vp[k], points.vs[k], points.vt[k], ALL_LANES, &at);
        vfloat cos_n = vdot(points.vn[k], at.wi);
        sum          = vadd(sum, vscale(at.e, vkeep(lit & (cos_n > 0.0f), cos_n)));
    }
    return (vec3){ vsum(sum.x), vsum(sum.y), vsum(sum.z) };
}

/* Ends the program if a sample differs by more than 1e-4 of itself, in place or in strength. */
static void compare(const light *l, const plain_light *plain)
{
    for (int i = 0; i < POINTS; i++) {
        vlight_sample at;
        plain_sample want;
        vvec3 p = vspread(points.p[i]);
        light_sample(l, &p, vsplat(points.s[i]), vsplat(points.t[i]), ALL_LANES, &at);
        plain_sample_light(plain, points.p[i], points.s[i], points.t[i], &want);
        float off = fabsf(lane(at.e.y, 0) - want.e.y) / fmaxf(want.e.y, 1e-6f) +
                    fabsf(lane(at.wi.x, 0) - want.wi.x) + fabsf(lane(at.wi.y, 0) - want.wi.y);
        if (!(off < 1e-4f)) {
            fprintf(stderr, "bench_lights: %s: sample %d is off by %g\n", kinds[plain->kind].name,
                    i, (double)off);
            exit(1);
        }
    }
}

/* ---- the clock ------------------------------------------------------------------------------ */

static volatile float kept; /* so that no sum is left out */

static double packet_ns(const light *l)
{
    double start = seconds();
    for (int i = 0; i < PASSES; i++)
        kept = sum_packets(l).y;
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

static double plain_ns(const plain_light *l, plain_sum *sum)
{
    double start = seconds();
    for (int i = 0; i < PASSES; i++)
        kept = sum(l, points.p, points.n, points.s, points.t, POINTS).y;
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

enum { OURS, ONE_LANE, PLAIN, PLAIN_X87, SIDES };

static void table(const light *l[PLAIN_KINDS], const plain_light plain[PLAIN_KINDS],
                  const char *one_lane)
{
    double best[SIDES][PLAIN_KINDS];
    for (int side = 0; side < SIDES; side++)
        for (int k = 0; k < PLAIN_KINDS; k++)
            best[side][k] = HUGE_VAL;
    for (int round = 0; round < ROUNDS; round++) {
        other_times(one_lane, PLAIN_KINDS, best[ONE_LANE]);
        for (int k = 0; k < PLAIN_KINDS; k++) {
            best[OURS][k]  = fmin(best[OURS][k], packet_ns(l[k]));
            best[PLAIN][k] = fmin(best[PLAIN][k], plain_ns(&plain[k], plain_sum_lights));
            best[PLAIN_X87][k] =
                fmin(best[PLAIN_X87][k], plain_ns(&plain[k], plain_sum_lights_387));
        }
    }
    printf("nanoseconds a point, one sample of one light, one thread; best of %d rounds\n"
           "                                plain C  plain C  WIDTH=%d is faster than\n"
           "light          WIDTH=%d  WIDTH=1      SSE      x87  WIDTH=1      SSE      x87  paper\n",
           ROUNDS, LANES, LANES);
    for (int k = 0; k < PLAIN_KINDS; k++) {
        printf("%-14s", kinds[k].name);
        for (int side = 0; side < SIDES; side++)
            printf("%8.2f ", best[side][k]);
        for (int side = ONE_LANE; side < SIDES; side++)
            printf("%8.2f ", best[side][k] / best[OURS][k]);
        printf("%6.2f\n", kinds[k].paper);
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "use: bench_lights ONE_LANE_PROGRAM\n");
        return 2;
    }
    arena a       = { 0 };
    lux_error err = { 0 };
    const light *l[PLAIN_KINDS];
    plain_light plain[PLAIN_KINDS];
    make_points();
    for (int k = 0; k < PLAIN_KINDS; k++) {
        l[k] = make(&a, (plain_kind)k, &err);
        require(l[k], &err);
        plain[k] = make_plain(&a, (plain_kind)k, &err);
        compare(l[k], &plain[k]);
    }
    if (strcmp(argv[1], "--times"))
        table(l, plain, argv[1]);
    else
        for (int k = 0; k < PLAIN_KINDS; k++)
            printf("%.9g\n", packet_ns(l[k]));
    arena_clear(&a);
    return 0;
}
