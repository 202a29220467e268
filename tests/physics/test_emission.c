/* tests/physics/test_emission.c -- particles as they set out in whole scenes give surfaces what
 * these get who ask lights, suns and skies from there: nothing is lost, nothing counted twice,
 * whatever daylight comes in by.
 */
#include "core/color.h"
#include "sim/emission.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <string.h>

/* 16 sets of particles, followed to the first surface that they meet. */
enum { SETS = 16, PACKETS = 256 / LANES, BATCH = PACKETS * LANES };

/* A rectangle parallel to two axes, on a surface: what falls on it is told. */
typedef struct patch {
    dvec3 centre, u, v, normal; /* m, in the user's frame: to the middles of its sides; unit */
} patch;

enum { MOST_PATCHES = 6, MOST_GROUPS = 8 };

typedef struct fallen {
    double lux[MOST_PATCHES], error[MOST_PATCHES]; /* mean over each, and of that */
    double flux, flux_error;                       /* lm, of all particles */
    double of_group[MOST_GROUPS];                  /* lm */
    int in_group[MOST_GROUPS], none;               /* particles; numbers without one */
} fallen;

static vmask on_patch(const scene *s, const patch *p, const vvec3 *at, const vvec3 *way)
{
    vvec3 off = vsub(*at, vspread(scene_place(s, p->centre)));
    vvec3 u = vspread(d3_to_float(p->u)), v = vspread(d3_to_float(p->v));
    vvec3 n = vspread(d3_to_float(p->normal));
    return (vdot(*way, n) < 0.0f) & (vabs(vdot(off, n)) < 1e-3f) &
           (vabs(vdot(off, u)) <= vdot(u, u)) & (vabs(vdot(off, v)) <= vdot(v, v));
}

static double area_of(const patch *p) { return 4.0 * d3_length(p->u) * d3_length(p->v); }

typedef struct one_set {
    double lux[MOST_PATCHES], flux;
} one_set;

static void count(const emission *e, uint32_t seed, int first, fallen *out, vparticle *of,
                  vmask *lit, int k)
{
    vuint index = vunsigned(vlane_index() + first);
    lit[k]      = emission_draw(e, index, vsplat_uint(seed), ALL_LANES, &of[k]);
    vfloat y    = vrgb_luminance(of[k].flux);
    for (int i = 0; i < LANES; i++) {
        bool drawn = (vbits(lit[k]) >> i) & 1;
        assert_true(isfinite(lane(y, i)) && (drawn ? lane(y, i) > 0.0f : lane(y, i) == 0.0f));
        out->none += !drawn;
        if (drawn && lane(of[k].group, i) < MOST_GROUPS) {
            out->of_group[lane(of[k].group, i)] += LUMENS_PER_WATT * (double)lane(y, i);
            out->in_group[lane(of[k].group, i)]++;
        }
    }
}

/* Lamps' own bodies are not looked at: scenes here have none. */
static one_set follow(const scene *s, const emission *e, const patch *p, int patches, int each,
                      uint32_t seed, fallen *out)
{
    one_set sums = { 0 };
    for (int first = 0; first < each; first += BATCH) {
        vparticle of[PACKETS];
        vray rays[PACKETS];
        vmask lit[PACKETS];
        vhit hits[PACKETS];
        for (int k = 0; k < PACKETS; k++) {
            count(e, seed, first + k * LANES, out, of, lit, k);
            rays[k] = of[k].ray;
        }
        world_first_hit(s->world, rays, lit, PACKETS, RAYS_INCOHERENT, hits);
        for (int k = 0; k < PACKETS; k++) {
            vmask met = lit[k] & (hits[k].instance >= 0);
            vvec3 at  = valong(rays[k].origin, rays[k].direction, hits[k].distance);
            vfloat y  = vrgb_luminance(of[k].flux);
            for (int i = 0; i < LANES; i++)
                sums.flux += LUMENS_PER_WATT * (double)lane(y, i) / each;
            for (int q = 0; q < patches; q++) {
                vfloat here = vkeep(met & on_patch(s, &p[q], &at, &rays[k].direction), y);
                for (int i = 0; i < LANES; i++)
                    sums.lux[q] += LUMENS_PER_WATT * (double)lane(here, i) / each / area_of(&p[q]);
            }
        }
    }
    return sums;
}

static double deviation(double sum, double squares)
{
    return sqrt(fmax(squares / SETS - sum * sum / (SETS * SETS), 0.0) / (SETS - 1));
}

static fallen let_fall(const scene *s, const emission *e, const patch *p, int patches, int each)
{
    fallen out                   = { 0 };
    double squares[MOST_PATCHES] = { 0 }, of_flux = 0.0;
    for (uint32_t set = 0; set < SETS; set++) {
        one_set one = follow(s, e, p, patches, each, 1000 + set, &out);
        for (int q = 0; q < patches; q++) {
            out.lux[q] += one.lux[q];
            squares[q] += one.lux[q] * one.lux[q];
        }
        out.flux += one.flux;
        of_flux += one.flux * one.flux;
    }
    for (int q = 0; q < patches; q++) {
        out.error[q] = deviation(out.lux[q], squares[q]);
        out.lux[q] /= SETS;
    }
    out.flux_error = deviation(out.flux, of_flux);
    out.flux /= SETS;
    for (int g = 0; g < MOST_GROUPS; g++)
        out.of_group[g] /= (double)SETS * each;
    return out;
}

/* ---- against who asks ------------------------------------------------------------------------ */

enum { SIDE = 5 };

/* Sensors in the middle of SIDE x SIDE parts of each patch. */
static void measure(lab *l, const char *yaml, const patch *p, int patches, double *want,
                    double *off)
{
    lab_probe probes[MOST_PATCHES * SIDE * SIDE];
    for (int q = 0; q < patches; q++)
        for (int i = 0; i < SIDE * SIDE; i++) {
            double x = 2.0 * (i % SIDE + 0.5) / SIDE - 1.0, y = 2.0 * (i / SIDE + 0.5) / SIDE - 1.0;
            dvec3 at = d3_add(p[q].centre, d3_add(d3_scale(p[q].u, x), d3_scale(p[q].v, y)));
            probes[q * SIDE * SIDE + i] = (lab_probe){ at, p[q].normal };
        }
    grid_result r;
    run_options o = { .accuracy = 0.01 };
    lab_measure(l, yaml, NULL, probes, patches * SIDE * SIDE, &o, &r);
    for (int q = 0; q < patches; q++) {
        want[q] = off[q] = 0.0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            want[q] += r.illuminance[q * SIDE * SIDE + i] / (SIDE * SIDE);
            off[q] += r.half_width[q * SIDE * SIDE + i] / (SIDE * SIDE) / SIDE;
        }
    }
}

/* What patches get by particles, and as asked for there but for `rule` of it: that of the midpoint
 * rule. */
static void agree(const char *what, const char *yaml, const patch *p, int patches, int each,
                  double rule)
{
    lab l;
    lab_open(&l);
    lab_speck(&l, "speck.gltf");
    double want[MOST_PATCHES], off[MOST_PATCHES];
    measure(&l, yaml, p, patches, want, off);
    const scene *s    = lab_scene(&l, yaml);
    const emission *e = emission_new(&l.a, s, NULL);
    assert_non_null(e);
    fallen got = let_fall(s, e, p, patches, each);
    print_message("           %s: %.5g lm, %+.4f of that in particles\n", what,
                  LUMENS_PER_WATT * emission_flux(e),
                  got.flux / (LUMENS_PER_WATT * emission_flux(e)) - 1.0);
    for (int q = 0; q < patches; q++)
        print_message("             %9.4g lx %+.4f +- %.4f (%.4f)\n", want[q],
                      got.lux[q] / want[q] - 1.0, got.error[q] / want[q], off[q] / want[q]);
    for (int q = 0; q < patches; q++)
        if (fabs(got.lux[q] - want[q]) > 4.0 * hypot(got.error[q], off[q]) + rule * want[q])
            fail_msg("%s: patch %d gets %g lx, not %g", what, q, got.lux[q], want[q]);
    assert_near(got.flux, LUMENS_PER_WATT * emission_flux(e),
                0.003 + 4.0 * got.flux_error / got.flux);
    lab_close(&l);
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static const patch floor_patches[] = {
    { { 1.5, 1.0, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 } },
    { { 2.4, 2.8, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 } },
    { { 1.6, 4.0, 1.2 }, { 0.5, 0, 0 }, { 0, 0, 0.5 }, { 0, -1, 0 } },
    { { 1.6, 2.0, 2.5 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, { 0, 0, -1 } },
};

static const char room[]   = "room: {size: [3, 4, 2.5], reflectance: 0%s}\n";
static const char window[] = ", windows: [{wall: south, at: [0.9, 0.8], size: [1.2, 1.2]},"
                             " {wall: east, at: [1, 0.5], size: [0.5, 1.5]}]";

static char *study_of(lab *l, const char *windows, const char *rest)
{
    char *text = text_of(&l->a, room, windows);
    return text_of(&l->a, "%s%s\n", text, rest);
}

static void in_room(const char *what, const char *windows, const char *rest, int patches, int each,
                    double rule)
{
    lab l;
    lab_open(&l);
    agree(what, study_of(&l, windows, rest), floor_patches, patches, each, rule);
    lab_close(&l);
}

TEST(lamps_of_all_kinds_together)
{
    in_room("lamps", "",
            "lights: [{type: point, at: [1, 1, 2], intensity: 300},"
            " {type: cone, at: [2, 3, 2.4], aim: [0, 0, -1], intensity: 900, inner: 20, outer: 40},"
            " {type: rect, at: [1.5, 2, 2.4], aim: [0, 0, -1], up: [0, 1, 0], size: [1.2, 0.3],"
            " luminance: 4000},"
            " {type: disk, at: [0.6, 3.2, 2.3], aim: [0.2, 0, -1], radius: 0.2, luminance: 5000},"
            " {type: linear, from: [0.5, 0.5, 1.9], to: [1.7, 0.5, 1.9], intensity: 200}]",
            4, 1 << 14, 0.01);
}

TEST(sun_through_windows)
{
    const patch lit[] = {
        { { 1.5, 1.9, 0 }, { 0.9, 0, 0 }, { 0, 1.5, 0 }, { 0, 0, 1 } },
    };
    lab l;
    lab_open(&l);
    char *yaml = study_of(&l, window,
                           "sky: {model: clear, sun_at: {azimuth: 170, elevation: 35},"
                           " horizontal: 1e-3, ground: 0, sun: disk, sun_illuminance: 40000}");
    agree("sun", yaml, lit, 1, 1 << 14, 0.08); /* edges between sensors */
    lab_close(&l);
}

TEST(sky_through_windows)
{
    in_room("sky", window,
            "sky: {model: clear, sun_at: {azimuth: 170, elevation: 35}, horizontal: 15000,"
            " ground: 0.2, sun: off}",
            4, 1 << 14, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_all_kinds_together),
        cmocka_unit_test(sun_through_windows),
        cmocka_unit_test(sky_through_windows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
