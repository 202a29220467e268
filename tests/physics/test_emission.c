/* tests/physics/test_emission.c -- particles as they set out in whole scenes give surfaces what
 * these get who ask lights, suns and skies from there: nothing is lost, nothing counted twice,
 * whatever daylight comes in by.
 */
#include "core/color.h"
#include "sim/emission.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

/* 16 sets of particles, followed to the first surface that they meet. */
enum { SETS = 16, EACH = 1 << 14, PACKETS = 256 / LANES, BATCH = PACKETS * LANES };

/* A rectangle parallel to two axes, on a surface: what falls on it is told. */
typedef struct patch {
    dvec3 centre, u, v, normal; /* m, in the user's frame: to the middles of its sides; unit */
} patch;

enum { MOST_PATCHES = 6, MOST_GROUPS = 48 };

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
    lab_probe probes[MOST_PATCHES * SIDE * SIDE] = { 0 };
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

typedef struct comparison {
    const char *what, *yaml;
    const patch *patches;
    int count;
    double rule;        /* how far the sensors' mean may be off that of a patch */
    const int *portals; /* which of the scene's are known of; NULL: all */
    int portal_count;
} comparison;

static const emission *lab_emission(lab *l, const scene *s)
{
    lux_error err     = { 0 };
    const emission *e = emission_new(&l->a, s, &err);
    if (!e)
        fail_msg("%s", err.text);
    return e;
}

static scene with_portals(lab *l, const scene *s, const comparison *c)
{
    scene changed = *s;
    if (!c->portals)
        return changed;
    portal *list = arena_array(&l->a, portal, (size_t)c->portal_count + 1, NULL);
    for (int i = 0; i < c->portal_count; i++)
        list[i] = s->portal_list[c->portals[i]];
    changed.portal_list  = list;
    changed.portal_count = c->portal_count;
    return changed;
}

/* What patches get by particles is what sensors get there. */
static void agree(lab *l, const comparison *c)
{
    double want[MOST_PATCHES], off[MOST_PATCHES];
    measure(l, c->yaml, c->patches, c->count, want, off);
    const scene s     = with_portals(l, lab_scene(l, text_of(&l->a, "lux4: 1\n%s", c->yaml)), c);
    const emission *e = lab_emission(l, &s);
    fallen got        = let_fall(&s, e, c->patches, c->count, EACH);
    double all        = LUMENS_PER_WATT * emission_flux(e);
    print_message("           %s: %.5g lm, %+.4f of that in particles\n", c->what, all,
                  got.flux / all - 1.0);
    for (int q = 0; q < c->count; q++)
        print_message("             %9.4g lx %+.4f +- %.4f (%.4f)\n", want[q],
                      got.lux[q] / want[q] - 1.0, got.error[q] / want[q], off[q] / want[q]);
    for (int q = 0; q < c->count; q++)
        if (fabs(got.lux[q] - want[q]) > 4.0 * hypot(got.error[q], off[q]) + c->rule * want[q])
            fail_msg("%s: patch %d gets %g lx, not %g", c->what, q, got.lux[q], want[q]);
    assert_near(got.flux, all, 0.003 + 4.0 * got.flux_error / got.flux); /* of tables of skies */
}

/* ---- indoors --------------------------------------------------------------------------------- */

static const patch inside[] = {
    { { 1.5, 1.0, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 } },
    { { 2.4, 2.8, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 } },
    { { 1.6, 4.0, 1.2 }, { 0.5, 0, 0 }, { 0, 0, 0.5 }, { 0, -1, 0 } },
    { { 1.6, 2.0, 2.5 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, { 0, 0, -1 } },
};

#define BARE "room: {size: [3, 4, 2.5], reflectance: 0}\n"
#define WINDOWS                                                                                    \
    "room: {size: [3, 4, 2.5], reflectance: 0, windows: ["                                         \
    "{wall: south, at: [0.9, 0.8], size: [1.2, 1.2]},"                                             \
    " {wall: east, at: [1, 0.5], size: [0.5, 1.5]}]}\n"
#define SKY                                                                                        \
    "sky: {model: clear, sun_at: {azimuth: 170, elevation: 35}, horizontal: 15000, ground: 0.2,"   \
    " sun: off}\n"

static void compare(comparison c)
{
    lab l;
    lab_open(&l);
    agree(&l, &c);
    lab_close(&l);
}

TEST(lamps_of_all_kinds_give_as_if_asked)
{
    compare((comparison){
        .what    = "lamps",
        .yaml    = BARE "lights: [{type: point, at: [1, 1, 2], intensity: 300},"
                        " {type: cone, at: [2, 3, 2.4], aim: [0, 0, -1], intensity: 900, inner: 20,"
                        " outer: 40},"
                        " {type: rect, at: [1.5, 2, 2.4], aim: [0, 0, -1], up: [0, 1, 0], size: [1.2,"
                        " 0.3], luminance: 4000},"
                        " {type: disk, at: [0.6, 3.2, 2.3], aim: [0.2, 0, -1], radius: 0.2,"
                        " luminance: 5000},"
                        " {type: linear, from: [0.5, 0.5, 1.9], to: [1.7, 0.5, 1.9], intensity: 200}]",
        .patches = inside,
        .count   = 4,
        .rule    = 0.005 });
}

/* The patch lies where the sun shines, by the room's plan; a second one where it does not. */
TEST(the_sun_through_a_window_gives_as_if_asked)
{
    const patch lit[] = { { { 1.15, 2, 0 }, { 0.3, 0, 0 }, { 0, 0.5, 0 }, { 0, 0, 1 } } };
    compare((comparison){ .what    = "sun",
                          .yaml    = WINDOWS "sky: {model: clear, sun_at: {azimuth: 170, elevation:"
                                             " 35}, horizontal: 1e-3, ground: 0, sun: disk,"
                                             " sun_illuminance: 40000}",
                          .patches = lit,
                          .count   = 1 });
}

TEST(the_sky_and_the_ground_through_windows_give_as_if_asked)
{
    compare((comparison){ .what    = "two windows, both known",
                          .yaml    = WINDOWS SKY,
                          .patches = inside,
                          .count   = 4,
                          .rule    = 0.005 });
}

/* Whatever is known of what light comes in by, it is the same light. */
TEST(portals_change_no_light)
{
    compare((comparison){ .what         = "two windows, one of them known",
                          .yaml         = WINDOWS SKY,
                          .patches      = inside,
                          .count        = 4,
                          .rule         = 0.005,
                          .portals      = (int[]){ 0 },
                          .portal_count = 1 });
    compare((comparison){ .what         = "two windows, one of them known twice",
                          .yaml         = WINDOWS SKY,
                          .patches      = inside,
                          .count        = 4,
                          .rule         = 0.005,
                          .portals      = (int[]){ 0, 1, 0 },
                          .portal_count = 3 });
    compare((comparison){ .what         = "two windows, none of them known",
                          .yaml         = WINDOWS SKY,
                          .patches      = inside,
                          .count        = 4,
                          .rule         = 0.005,
                          .portals      = (int[]){ 0 },
                          .portal_count = 0 });
}

/* Light of the sky and the sun that goes in by a window known of carries alike, and what is said of
 * the rest is how much more it has; a table's cells are as bright as their middles, within a fifth.
 */
TEST(particles_tell_what_more_they_carry_than_windows_let_in)
{
    lab l;
    lab_open(&l);
    const comparison c = { .portals = (int[]){ 0 }, .portal_count = 1 };
    const scene s      = with_portals(
             &l,
             lab_scene(&l, "lux4: 1\n" WINDOWS "sky: {model: clear, sun_at: {azimuth: 170, elevation:"
                                " 35}, horizontal: 15000, ground: 0.2, sun: disk, sun_illuminance:"
                                " 40000}"),
             &c);
    const emission *e = lab_emission(&l, &s);
    double sum = 0.0, square = 0.0, more = 1.0;
    int count = 0;
    for (int i = 0; i < EACH; i += LANES) {
        vparticle p;
        vmask drawn = emission_draw(e, vunsigned(vlane_index() + i), vsplat_uint(5), ALL_LANES, &p);
        for (int bits = vbits(drawn); bits; bits &= bits - 1, count++) {
            int k     = __builtin_ctz((unsigned)bits);
            double of = (double)lane(vrgb_luminance(p.flux), k) * (double)lane(p.even, k);
            more      = fmin(more, (double)lane(p.even, k));
            sum += of;
            square += of * of;
        }
    }
    double mean = sum / count, spread = sqrt(square / count - mean * mean);
    assert_true(more < 0.5); /* some carry more */
    assert_true(spread < 0.2 * mean);
    lab_close(&l);
}

/* ---- outside --------------------------------------------------------------------------------- */

static const char black[] =
    "\"name\":\"Block\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],"
    "\"metallicFactor\":0}";

/* A block to the south of the room; its top, its side toward the room, and inside the room. */
static const patch outside[] = {
    { { 1.5, -2.0, 1.5 }, { 0.8, 0, 0 }, { 0, 0.3, 0 }, { 0, 0, 1 } },
    { { 1.5, -1.5, 0.8 }, { 0.8, 0, 0 }, { 0, 0, 0.4 }, { 0, 1, 0 } },
    { { 1.5, 1.0, 0 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 } },
    { { 1.6, 4.0, 1.2 }, { 0.5, 0, 0 }, { 0, 0, 0.5 }, { 0, -1, 0 } },
};

static void beside_a_block(const char *what, const char *yaml, int first, int count)
{
    lab l;
    quad block[6];
    lab_open(&l);
    quads_of_box((dvec3){ 0, -2.5, 0 }, (dvec3){ 3, -1.5, 1.5 }, block);
    lab_quads(&l, "block.gltf", block, 6, black);
    agree(&l, &(comparison){ .what    = what,
                             .yaml    = yaml,
                             .patches = outside + first,
                             .count   = count,
                             .rule    = 0.005 });
    lab_close(&l);
}

TEST(skies_in_the_open_give_as_if_asked)
{
    beside_a_block("in the open", "scene: block.gltf\n" SKY, 0, 2);
    beside_a_block("under sun and sky",
                   "scene: block.gltf\nsky: {model: clear, sun_at: {azimuth: 20, elevation: 35},"
                   " horizontal: 15000, ground: 0.2, sun: disk, sun_illuminance: 60000}\n",
                   0, 2);
}

TEST(what_is_outside_a_room_is_lit_as_well)
{
    beside_a_block("beyond a window", WINDOWS "scene: block.gltf\n" SKY, 0, 4);
    beside_a_block("beyond a window, outside",
                   WINDOWS "scene: {file: block.gltf, exterior: Block}\n" SKY, 0, 4);
}

/* ---- sources and groups ---------------------------------------------------------------------- */

/* A lamp, one dimmed, a glowing quad, sun and sky; maintenance, which is not for us. */
static const char many[] =
    WINDOWS "scene: glow.gltf\nmaintenance: 0.5\ndimming: {desk: 0.25, other: 0.5}\n"
            "lights: [{type: point, at: [1, 1, 2], lumens: 1000, group: desk},"
            " {type: rect, at: [2, 3, 2.4], lumens: 3000, group: general, color: [1, 0.8, 0.5],"
            " up: [0, 1, 0], size: [0.5, 0.5]}]\n"
            "sky: {model: clear, sun_at: {azimuth: 170, elevation: 35}, horizontal: 15000,"
            " ground: 0.2, sun: disk, sun_illuminance: 40000}\n";

static const scene *scene_of_many(lab *l, const scene_options *o)
{
    quad q = { { { 1, 1, 1 }, { 1, 2, 1 }, { 2, 2, 1 }, { 2, 1, 1 } } };
    lab_quads(l, "glow.gltf", &q, 1, lab_glow(l, 300.0));
    lab_scene(l, text_of(&l->a, "lux4: 1\n%s", many));
    lux_error err = { 0 };
    const study *y =
        study_read(&l->a, text_of(&l->a, "%s/study.yaml", l->folder), NULL, NULL, &err);
    const scene *s = y ? scene_new(&l->a, y, o, NULL, &err) : NULL;
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static int group_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->group_count; i++)
        if (!strcmp(s->groups[i], name))
            return i;
    fail_msg("no group %s", name);
    return -1;
}

/* lm, that come in by the two windows: of the sun; of ground of that reflectance under it, on
 * upright windows. */
static double sun_in(void)
{
    double a = 170.0 * M_PI / 180.0, h = 35.0 * M_PI / 180.0;
    return 40000.0 * cos(h) * (1.44 * -cos(a) + 0.75 * sin(a));
}
static double ground_in(double horizontal) { return 0.5 * 0.2 * horizontal * (1.44 + 0.75); }

/* Lamps as dimmed, but for glowing surfaces, and not maintained. */
TEST(each_source_gives_its_light)
{
    lab l;
    lab_open(&l);
    const scene *s = scene_of_many(&l, &(scene_options){ .threads = 1 });
    fallen got     = let_fall(s, lab_emission(&l, s), NULL, 0, EACH);
    assert_near(got.of_group[group_of(s, "desk")], 250.0, 0.02);
    assert_near(got.of_group[group_of(s, "general")], 3000.0, 0.005);
    assert_near(got.of_group[group_of(s, "other")], 300.0 * 2.0 * M_PI, 0.005);
    assert_near(got.of_group[group_of(s, "sun")],
                sun_in() + ground_in(40000.0 * sin(35.0 * M_PI / 180.0)), 0.005);
    lab_close(&l);
}

TEST(each_group_of_a_layered_scene_has_an_equal_share)
{
    lab l;
    lab_open(&l);
    const scene *s = scene_of_many(&l, &(scene_options){ .threads = 1, .layered = true });
    fallen got     = let_fall(s, lab_emission(&l, s), NULL, 0, EACH);
    int all        = SETS * EACH;
    assert_int_equal(s->group_count, 5);
    for (int g = 0; g < 5; g++)
        print_message("           %-8s %8.1f lm, %.4f of the particles\n", s->groups[g],
                      got.of_group[g], (double)got.in_group[g] / all);
    for (int g = 0; g < 5; g++) /* some directions of the sky miss all windows */
        assert_near((double)got.in_group[g] / all, 0.2, 0.05);
    assert_near(got.of_group[group_of(s, "desk")], 1000.0, 0.003);
    assert_near(got.of_group[group_of(s, "general")], 3000.0, 0.003);
    assert_near(got.of_group[group_of(s, "other")], 300.0 * 2.0 * M_PI, 0.003);
    assert_near(got.of_group[group_of(s, "sun")],
                sun_in() + ground_in(40000.0 * sin(35.0 * M_PI / 180.0)), 0.003);
    lab_close(&l);
}

static moment moment_at(int number)
{
    double h = (10.0 + number) * M_PI / 180.0;
    moment m = { .at        = (double)NAN,
                 .sun_known = true,
                 .sun       = { .azimuth_deg            = 180.0,
                                .elevation_deg          = 10.0 + number,
                                .apparent_elevation_deg = 10.0 + number },
                 .to_sun    = { 0, (float)-cos(h), (float)sin(h) } };
    snprintf(m.text, sizeof m.text, "m%d", number);
    return m;
}

static fallen series_of(lab *l, const moment *list, int count)
{
    const scene *s = scene_of_many(
        l, &(scene_options){
               .threads = 1, .moments = list, .moment_count = count, .lamps_off = true });
    return let_fall(s, lab_emission(l, s), NULL, 0, EACH);
}

/* More moments than have tables of their own: each still gives what it gives as one of few. */
TEST(a_long_series_gives_each_moment_its_light)
{
    enum { MOMENTS = 40, FEW = 3, APART = 19 };
    lab l;
    lab_open(&l);
    moment all[MOMENTS], few[FEW];
    for (int i = 0; i < MOMENTS; i++)
        all[i] = moment_at(i);
    for (int i = 0; i < FEW; i++)
        few[i] = all[APART * i];
    fallen of_all = series_of(&l, all, MOMENTS), of_few = series_of(&l, few, FEW);
    for (int i = 0; i < FEW; i++) {
        double h  = (10.0 + APART * i) * M_PI / 180.0;
        double in = 40000.0 * cos(h) * 1.44 + ground_in(40000.0 * sin(h)) + ground_in(15000.0);
        print_message("           %s: %.6g lm, %.6g among many\n", few[i].text,
                      of_few.of_group[1 + i], of_all.of_group[1 + APART * i]);
        assert_true(of_few.of_group[1 + i] > in);
        assert_near(of_all.of_group[1 + APART * i], of_few.of_group[1 + i], 0.02);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_all_kinds_give_as_if_asked),
        cmocka_unit_test(the_sun_through_a_window_gives_as_if_asked),
        cmocka_unit_test(the_sky_and_the_ground_through_windows_give_as_if_asked),
        cmocka_unit_test(portals_change_no_light),
        cmocka_unit_test(particles_tell_what_more_they_carry_than_windows_let_in),
        cmocka_unit_test(skies_in_the_open_give_as_if_asked),
        cmocka_unit_test(what_is_outside_a_room_is_lit_as_well),
        cmocka_unit_test(each_source_gives_its_light),
        cmocka_unit_test(each_group_of_a_layered_scene_has_an_equal_share),
        cmocka_unit_test(a_long_series_gives_each_moment_its_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
