/* tests/bench/bench_sky.c -- evaluating and sampling each kind of sky, in packets and in plain C.
 *
 *     bench_sky ONE_LANE_PROGRAM    the table; the program is this one, built with WIDTH=1
 *     bench_sky --times             what runs in that: prints the nanoseconds of each case
 *
 * Directions are anywhere above the horizon, neighbours far apart: the worst that a panorama's
 * cache may meet. A sample is a direction drawn by the dome, with its density, and the sky's
 * radiance there. The panorama is the clear sky, 256 x 128 pixels. All sides take turns in short
 * rounds, so that whatever else the machine does meets all of them; the best round counts, by the
 * thread's own clock. Before the clock starts, what packets and plain C (plain_sky.c) make of each
 * direction is compared.
 */
#include "core/image.h"
#include "core/packet_math.h"
#include "sky/dome.h"
#include "sky/gradation.h"
#include "sky/panorama.h"
#include "tests/bench/plain_sky.h"
#include "tests/other_times.h"
#include "tests/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { POINTS = 2048, PACKETS = POINTS / LANES, PASSES = 16, ROUNDS = 4 };
enum { UNIFORM, OVERCAST, TYPE_1, TYPE_7, TYPE_12, PEREZ, PANORAMA, KINDS };
enum { WIDE = 256, HIGH = 128 };

static const char *const names[KINDS] = { "uniform",     "overcast", "CIE type 1", "CIE type 7",
                                          "CIE type 12", "Perez",    "panorama" };
static const vec3 to_sun = { 0.48f, -0.64f, 0.6f }, white = { 1, 1, 1 };

typedef struct bench_case {
    const sky *sky;
    const dome *dome;
    plain_sky plain;
} bench_case;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void require(const void *made, const lux_error *err)
{
    if (!made) {
        fprintf(stderr, "bench_sky: %s\n", err->text);
        exit(1);
    }
}

/* ---- the skies, each twice ------------------------------------------------------------------- */

static vec3 packet_radiance(const sky *s, vec3 way)
{
    vvec3 wi = vspread(way);
    vrgb l   = sky_radiance(s, &wi, ALL_LANES);
    return (vec3){ lane(l.x, 0), lane(l.y, 0), lane(l.z, 0) };
}

/* A file beside the program, read again and removed */
static const sky *make_panorama(arena *a, const sky *clear, plain_sky *plain, const char *program,
                                lux_error *err)
{
    float *rgba = arena_array(a, float, (size_t)4 * WIDE * HIGH, err);
    float *flat = arena_array(a, float, (size_t)3 * WIDE * HIGH, err);
    require(rgba ? flat : NULL, err);
    for (int i = 0; i < WIDE * HIGH; i++) {
        double polar = M_PI * (i / WIDE + 0.5) / HIGH;
        double turn  = 2.0 * M_PI * ((i % WIDE + 0.5) / WIDE - 0.5);
        vec3 way     = { (float)(sin(polar) * sin(turn)), (float)(sin(polar) * cos(turn)),
                         (float)cos(polar) };
        vec3 l       = packet_radiance(clear, way);
        rgba[4 * i] = flat[i] = l.x;
        rgba[4 * i + 1] = flat[WIDE * HIGH + i] = l.y;
        rgba[4 * i + 2] = flat[2 * WIDE * HIGH + i] = l.z;
    }
    image_channel rgb[3] = { { "R", flat },
                             { "G", flat + WIDE * HIGH },
                             { "B", flat + 2 * WIDE * HIGH } };
    image im             = { .width = WIDE, .height = HIGH, .channel_count = 3, .channels = rgb };
    char path[480];
    snprintf(path, sizeof path, "%s.%d.exr", program, LANES);
    if (!image_write_exr(path, &im, false, NULL, err))
        require(NULL, err);
    panorama_desc d = { .path = path, .scale = 1, .horizontal = (double)NAN, .keep_sun = true };
    panorama_sun sun;
    const sky *s = sky_panorama(a, &d, &sun, NULL, err);
    remove(path);
    require(s, err);
    plain->rgba   = rgba;
    plain->width  = WIDE;
    plain->height = HIGH;
    return s;
}

static const sky *make_cie(arena *a, int type, lux_error *err)
{
    cie_desc d   = { type, to_sun, 100, white };
    const sky *s = sky_cie(a, &d, err);
    require(s, err);
    return s;
}

/* Plain C has the numbers of cie.c; the scale comes of one direction. */
static void make_plain(bench_case *c, float a, float b, const float f[4])
{
    plain_sky *p = &c->plain;
    p->a         = a;
    p->b         = b;
    p->c         = f[0];
    p->d         = f[1];
    p->e         = f[2];
    p->f0        = f[3];
    p->to_sun    = to_sun;
    p->scale     = white;
    vec3 up      = { 0, 0, 1 };
    float scale  = packet_radiance(c->sky, up).y / plain_sky_radiance(p, up).y;
    p->scale     = v3_scale(white, scale);
}

/* A shape such as Perez's eighth bin has */
static const sky *make_perez(arena *a, lux_error *err)
{
    gradation_desc d = { .what       = "bench",
                         .shape      = { -1.0, -0.2, 1.0, 15.0, -6.0, 0.5 },
                         .to_sun     = to_sun,
                         .horizontal = 100,
                         .color      = white,
                         .columns    = 256,
                         .rows       = 128 };
    return gradation_sky(a, &d, err);
}

static void make_all(arena *a, bench_case cases[KINDS], const char *program, lux_error *err)
{
    static const int types[] = { SKY_UNIFORM, SKY_TRADITIONAL, 1, 7, 12 };
    const float still[4]     = { 0, -1, 0, 1 };
    const float bright[4]    = { 5, -2.5f, 0.3f, 1 - 5 * expf(-1.25f * (float)M_PI) };
    const float corona[4]    = { 10, -3, 0.45f, 1 - 10 * expf(-1.5f * (float)M_PI) };
    const float narrow[4]    = { 15, -6, 0.5f, 1 };
    for (int k = UNIFORM; k <= TYPE_12; k++)
        cases[k].sky = make_cie(a, types[k], err);
    require(cases[PEREZ].sky = make_perez(a, err), err);
    cases[OVERCAST].plain.overcast = true;
    make_plain(&cases[UNIFORM], 0, -1, still);
    make_plain(&cases[OVERCAST], 0, -1, still);
    make_plain(&cases[TYPE_1], 4, -0.7f, still);
    make_plain(&cases[TYPE_7], 0, -1, bright);
    make_plain(&cases[TYPE_12], -1, -0.32f, corona);
    make_plain(&cases[PEREZ], -1, -0.2f, narrow);
    cases[PANORAMA].sky =
        make_panorama(a, cases[TYPE_12].sky, &cases[PANORAMA].plain, program, err);
    for (int k = 0; k < KINDS; k++)
        require(cases[k].dome = dome_new(a, &cases[k].sky, 1, err), err);
}

/* ---- the directions -------------------------------------------------------------------------- */

static struct points {
    vec3 wi[POINTS];
    vvec3 packet[PACKETS];
    vfloat s[PACKETS], t[PACKETS];
} points;

static void make_points(void)
{
    uint32_t seed = 3;
    for (int i = 0; i < POINTS; i++) {
        points.wi[i]   = random_direction(&seed);
        points.wi[i].z = fabsf(points.wi[i].z);
    }
    for (int k = 0; k < PACKETS; k++) {
        float x[LANES], y[LANES], z[LANES], s[LANES], t[LANES];
        for (int i = 0; i < LANES; i++) {
            x[i] = points.wi[k * LANES + i].x;
            y[i] = points.wi[k * LANES + i].y;
            z[i] = points.wi[k * LANES + i].z;
            s[i] = random_unit(&seed);
            t[i] = random_unit(&seed);
        }
        points.packet[k] = (vvec3){ vload(x), vload(y), vload(z) };
        points.s[k]      = vload(s);
        points.t[k]      = vload(t);
    }
}

/* Ends the program if a radiance differs by more than 1e-3 of itself: that much the arc cosine of
 * plain C is off next to the sun. On the border of pixels either may be right. */
static void compare(const bench_case *c, int kind)
{
    int off = 0;
    for (int i = 0; i < POINTS; i++) {
        vec3 got  = packet_radiance(c->sky, points.wi[i]);
        vec3 want = plain_sky_radiance(&c->plain, points.wi[i]);
        off += !(fabsf(got.y - want.y) <= 1e-3f * want.y);
    }
    if (off > (kind == PANORAMA ? 4 : 0)) {
        fprintf(stderr, "bench_sky: %s: %d of %d directions differ\n", names[kind], off, POINTS);
        exit(1);
    }
}

/* ---- the clock ------------------------------------------------------------------------------- */

static volatile float kept; /* so that no sum is left out */

static double eval_ns(const bench_case *c)
{
    double start = seconds();
    for (int pass = 0; pass < PASSES; pass++) {
        vrgb sum = vspread((vec3){ 0, 0, 0 });
        for (int k = 0; k < PACKETS; k++)
            sum = vadd(sum, sky_radiance(c->sky, &points.packet[k], ALL_LANES));
        kept = vsum(sum.x) + vsum(sum.y) + vsum(sum.z);
    }
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

static double sample_ns(const bench_case *c)
{
    double start = seconds();
    for (int pass = 0; pass < PASSES; pass++) {
        vrgb sum = vspread((vec3){ 0, 0, 0 });
        for (int k = 0; k < PACKETS; k++) {
            vfloat pdf;
            vvec3 wi = dome_sample(c->dome, points.s[k], points.t[k], ALL_LANES, &pdf);
            vrgb l   = sky_radiance(c->sky, &wi, ALL_LANES);
            sum      = vadd(sum, vscale(l, 1.0f / pdf));
        }
        kept = vsum(sum.x) + vsum(sum.y) + vsum(sum.z);
    }
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

static double plain_ns(const bench_case *c)
{
    double start = seconds();
    for (int pass = 0; pass < PASSES; pass++)
        kept = plain_sky_sum(&c->plain, points.wi, POINTS).y;
    return (seconds() - start) * 1e9 / (PASSES * POINTS);
}

static void table(const bench_case cases[KINDS], const char *one_lane)
{
    double ours[2 * KINDS], one[2 * KINDS], plain[KINDS];
    for (int k = 0; k < 2 * KINDS; k++)
        ours[k] = one[k] = plain[k / 2] = HUGE_VAL;
    for (int round = 0; round < ROUNDS; round++) {
        other_times(one_lane, 2 * KINDS, one);
        for (int k = 0; k < KINDS; k++) {
            ours[2 * k]     = fmin(ours[2 * k], eval_ns(&cases[k]));
            ours[2 * k + 1] = fmin(ours[2 * k + 1], sample_ns(&cases[k]));
            plain[k]        = fmin(plain[k], plain_ns(&cases[k]));
        }
    }
    printf(
        "nanoseconds a direction, one thread; best of %d rounds\n"
        "              evaluating                 faster than      sampling           faster\n"
        "sky           WIDTH=%d  WIDTH=1  plain C  WIDTH=1 plain C  WIDTH=%d  WIDTH=1  than it\n",
        ROUNDS, LANES, LANES);
    for (int k = 0; k < KINDS; k++)
        printf("%-12s%9.2f%9.2f%9.2f%9.2f%8.2f%9.2f%9.2f%9.2f\n", names[k], ours[2 * k], one[2 * k],
               plain[k], one[2 * k] / ours[2 * k], plain[k] / ours[2 * k], ours[2 * k + 1],
               one[2 * k + 1], one[2 * k + 1] / ours[2 * k + 1]);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "use: bench_sky ONE_LANE_PROGRAM\n");
        return 2;
    }
    arena a       = { 0 };
    lux_error err = { 0 };
    static bench_case cases[KINDS];
    make_points();
    make_all(&a, cases, argv[0], &err);
    for (int k = 0; k < KINDS; k++)
        compare(&cases[k], k);
    if (strcmp(argv[1], "--times"))
        table(cases, argv[1]);
    else
        for (int k = 0; k < KINDS; k++)
            printf("%.9g\n%.9g\n", eval_ns(&cases[k]), sample_ns(&cases[k]));
    arena_clear(&a);
    return 0;
}
