/* tests/unit/test_emission.c -- drawing among many sources: each has its share, lanes are alone,
 * nothing is drawn where nothing shines, and memory may be out.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "sim/emission.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <string.h>

static const emission *of_scene(lab *l, const scene *s)
{
    lux_error err     = { 0 };
    const emission *e = emission_new(&l->a, s, &err);
    if (!e)
        fail_msg("%s", err.text);
    return e;
}

static const emission *of_study(lab *l, const char *yaml)
{
    return of_scene(l, lab_scene(l, yaml));
}

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [3, 4, 2.5], reflectance: 0.5, windows: [{wall: south, at: [0.9, "      \
    "0.8], size: [1, 1]}]}\n"
#define LAMPS                                                                                      \
    "lights: [{type: point, at: [1, 1, 2], lumens: 1000},"                                         \
    " {type: rect, at: [2, 3, 2.4], lumens: 3000, up: [0, 1, 0], size: [0.5, 0.5]}]\n"
#define DAY                                                                                        \
    "sky: {model: clear, sun_at: {azimuth: 170, elevation: 35}, horizontal: 15000, ground: 0.2,"   \
    " sun: disk, sun_illuminance: 40000}\n"

/* ---- shares ---------------------------------------------------------------------------------- */

/* W of lamps, and of emitters, in so many particles. */
static void sum_up(const scene *s, const emission *e, int count, double *lamps, double *emitters)
{
    *lamps = *emitters = 0.0;
    for (int i = 0; i < count; i += LANES) {
        vparticle p;
        vmask lit = emission_draw(e, vunsigned(vlane_index() + i), vsplat_uint(3), ALL_LANES, &p);
        for (int k = 0; k < LANES; k++) {
            double y = (double)lane(vrgb_luminance(p.flux), k) / count;
            assert_true((vbits(lit) >> k) & 1);
            assert_true(lane(p.source, k) >= 0 &&
                        lane(p.source, k) < s->light_count + s->emitter_count);
            *(lane(p.source, k) < s->light_count ? lamps : emitters) += y;
        }
    }
}

/* 20,000 small triangles that glow beside a lamp a thousand times as strong as all of them: of one
 * table of floats most of their shares would be none. */
TEST(many_faint_emitters_keep_their_light)
{
    enum { QUADS = 10000 };
    lab l;
    lab_open(&l);
    quad *q = arena_array(&l.a, quad, QUADS, NULL);
    for (int i = 0; i < QUADS; i++) {
        double x = 0.01 * (i % 100), y = 0.01 * (i / 100.0);
        q[i] = (quad){
            { { x, y, 0 }, { x + 0.01, y, 0 }, { x + 0.01, y + 0.01, 0 }, { x, y + 0.01, 0 } }
        };
    }
    lab_quads(&l, "glow.gltf", q, QUADS, lab_glow(&l, 1.0));
    const scene *s = lab_scene(&l, "lux4: 1\nscene: glow.gltf\n"
                                   "lights: [{type: point, at: [0.5, 0.5, 2], lumens: 7000}]\n");
    assert_int_equal(s->emitter_count, 2 * QUADS);
    double lamps, emitters;
    sum_up(s, of_scene(&l, s), 1 << 19, &lamps, &emitters);
    assert_near(LUMENS_PER_WATT * lamps, 7000.0, 0.001);
    assert_near(LUMENS_PER_WATT * emitters, 2.0 * M_PI, 0.02); /* of 1 m^2 */
    lab_close(&l);
}

TEST(flux_and_what_is_missing_are_told)
{
    lab l;
    lab_open(&l);
    const scene *s    = lab_scene(&l, ROOM LAMPS);
    scene textured    = *s;
    const emission *e = of_scene(&l, s);
    assert_near(LUMENS_PER_WATT * emission_flux(e), 4000.0, 1e-5);
    assert_true(emission_missing(e) == 0.0);
    textured.glow_watts = 2.5;
    assert_near(emission_missing(of_scene(&l, &textured)), 2.5, 1e-12);
    lab_close(&l);
}

TEST(what_is_dimmed_to_nothing_is_not_drawn)
{
    lab l;
    lab_open(&l);
    vparticle p;
    const emission *e = of_study(&l, ROOM "dimming: {other: 0}\n" LAMPS);
    assert_false(vany(emission_draw(e, vunsigned(vlane_index()), vsplat_uint(1), ALL_LANES, &p)));
    lab_close(&l);
}

TEST(a_scene_without_light_draws_nothing)
{
    lab l;
    lab_open(&l);
    vparticle p;
    memset(&p, 0xff, sizeof p);
    const emission *e = of_study(&l, ROOM);
    assert_false(vany(emission_draw(e, vunsigned(vlane_index()), vsplat_uint(1), ALL_LANES, &p)));
    assert_true(emission_flux(e) == 0.0 && vsum(p.flux.x) == 0.0f);
    lab_close(&l);
}

/* Far light falls on a sphere of its own where there are no surfaces. */
TEST(a_scene_without_surfaces_has_particles)
{
    lab l;
    lab_open(&l);
    vparticle p;
    const emission *e = of_study(&l, "lux4: 1\n" DAY LAMPS);
    vmask lit         = emission_draw(e, vunsigned(vlane_index()), vsplat_uint(1), ALL_LANES, &p);
    assert_true(vall(lit) && isfinite(vsum(p.flux.x)) && isfinite(vsum(p.ray.origin.x)));
    lab_close(&l);
}

/* ---- lanes ----------------------------------------------------------------------------------- */

static void assert_alike(const vparticle *a, int i, const vparticle *b, int k)
{
    const float x[] = { lane(a->ray.origin.x, i),    lane(a->ray.origin.y, i),
                        lane(a->ray.origin.z, i),    lane(a->ray.direction.x, i),
                        lane(a->ray.direction.y, i), lane(a->ray.direction.z, i),
                        lane(a->ray.reach, i),       lane(a->flux.x, i),
                        lane(a->flux.y, i),          lane(a->flux.z, i) };
    const float y[] = { lane(b->ray.origin.x, k),    lane(b->ray.origin.y, k),
                        lane(b->ray.origin.z, k),    lane(b->ray.direction.x, k),
                        lane(b->ray.direction.y, k), lane(b->ray.direction.z, k),
                        lane(b->ray.reach, k),       lane(b->flux.x, k),
                        lane(b->flux.y, k),          lane(b->flux.z, k) };
    assert_memory_equal(x, y, sizeof x);
    assert_int_equal(lane(a->source, i), lane(b->source, k));
    assert_int_equal(lane(a->group, i), lane(b->group, k));
    assert_int_equal(lane(a->spare, i), lane(b->spare, k));
}

static const char *const whole = ROOM LAMPS DAY;

/* Each particle alone in lane 0 is to the bit what it is among others; dead lanes are zero. */
TEST(particles_do_not_depend_on_those_beside_them)
{
    lab l;
    lab_open(&l);
    const emission *e    = of_study(&l, whole);
    const vparticle none = { 0 };
    for (int i = 0; i < 1024; i += LANES) {
        vparticle all, one;
        vmask lit = emission_draw(e, vunsigned(vlane_index() + i), vsplat_uint(8), ALL_LANES, &all);
        for (int k = 0; k < LANES; k++) {
            vmask lone = emission_draw(e, vunsigned(vlane_index() + i + k), vsplat_uint(8),
                                       vlane_index() == 0, &one);
            assert_int_equal(vbits(lone), (vbits(lit) >> k) & 1);
            assert_alike(&one, 0, &all, k);
            for (int j = 1; j < LANES; j++)
                assert_alike(&one, j, &none, 0);
        }
    }
    lab_close(&l);
}

/* ---- memory ---------------------------------------------------------------------------------- */

TEST(memory_may_be_out)
{
    lab l;
    lab_open(&l);
    const scene *s = lab_scene(&l, whole);
    arena a        = { 0 };
    lux_error err  = { 0 };
    memory_is_out  = true;
    assert_null(emission_new(&a, s, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_faint_emitters_keep_their_light),
        cmocka_unit_test(flux_and_what_is_missing_are_told),
        cmocka_unit_test(what_is_dimmed_to_nothing_is_not_drawn),
        cmocka_unit_test(a_scene_without_light_draws_nothing),
        cmocka_unit_test(a_scene_without_surfaces_has_particles),
        cmocka_unit_test(particles_do_not_depend_on_those_beside_them),
        cmocka_unit_test(memory_may_be_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
