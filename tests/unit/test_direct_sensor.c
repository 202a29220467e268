/* tests/unit/test_direct_sensor.c -- light straight from many lamps among blocks, against every
 * lamp asked at every sensor.
 *
 * The twin asks lamps one by one in double sums: those without extent once, the others from 24 x 24
 * places; it shares light_sample() and the world's shadow rays with what is tested, which have
 * tests of their own.
 */
#include "core/color.h"
#include "sim/direct.h"
#include "sim/direct_sensor.h"
#include "tests/block.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LAMPS = 200, SENSORS = 48, SIDE = 24 };

/* ---- scenes ---------------------------------------------------------------------------------- */

typedef struct yaml {
    char text[65536];
    size_t size;
} yaml;

__attribute__((format(printf, 2, 3))) static void put(yaml *y, const char *format, ...)
{
    va_list more;
    va_start(more, format);
    y->size += (size_t)vsnprintf(y->text + y->size, sizeof y->text - y->size, format, more);
    va_end(more);
    assert_true(y->size < sizeof y->text);
}

static double part(int i, int of) /* of [0,1), evenly spread and in no order */
{
    double x = i * (of == 0 ? 0.754877666246693 : of == 1 ? 0.569840290998053 : 0.414213562373095);
    return x - floor(x);
}

/* One of the lamps: they differ by a factor of 1000 in strength, in where they are and in kind. */
static void put_lamp(yaml *y, int i, bool mixed)
{
    double u = 11.0 * part(i, 0) + 0.5, v = 8.0 * part(i, 1) + 0.5, z = 2.4 + 1.4 * part(i, 2);
    double lumens     = pow(10.0, 1.0 + 3.0 * part(i, 2));
    const char *group = i % 3 ? "large" : "small";
    put(y, "  - {group: %s, lumens: %g, ", group, i % 3 ? lumens : 0.05 * lumens);
    int kind = i % (mixed ? 6 : 3);
    if (kind == 4) {
        put(y, "type: linear, from: [%g, %g, %g], to: [%g, %g, %g]}\n", u, v, z, u + 0.4, v, z);
        return;
    }
    put(y, "at: [%g, %g, %g], ", u, v, z);
    switch (kind) {
    case 0:
        put(y, "type: point}\n");
        break;
    case 1:
        put(y, "type: cone, inner: 20, outer: 70}\n");
        break;
    case 2:
        put(y, "type: cosine, exponent: 2}\n");
        break;
    case 3:
        put(y, "type: disk, radius: 0.2}\n");
        break;
    default:
        put(y, "type: rect, size: [0.6, 0.2]}\n");
    }
}

/* A room of 12 x 9 x 4 m with blocks; sensors in 6 rows of 8, of which none is in a block. */
static const char *room_text(arena *a, int lamps, bool mixed, const char *top)
{
    yaml *y = arena_new(a, yaml, NULL);
    put(y, "lux4: 1\nroom: {size: [12, 9, 4], reflectance: 0.5}\n%s", top);
    put(y, "scene: [{file: %s, at: [[3, 3, 0], [6, 5, 0.5], [9, 6, 0]]}]\n",
        block_write(a, "block.gltf", (vec3){ 0.4f, 5.0f, 2.0f }));
    put(y, "grids: [{name: g, origin: [0, 0, 0.2], u: [12, 0, 0], v: [0, 9, 0], spacing: 1.5}]\n"
           "lights:\n");
    for (int i = 0; i < lamps; i++)
        put_lamp(y, i, mixed);
    return y->text;
}

static const scene *layered_scene(arena *a, const char *text)
{
    char *folder = folder_new(), path[4096];
    folder_write(folder, "study.yaml", text);
    snprintf(path, sizeof path, "%s/study.yaml", folder);
    lux_error err     = { 0 };
    const study *from = study_read(a, path, NULL, NULL, &err);
    const scene *s =
        from ? scene_new(a, from, &(scene_options){ .threads = 1, .layered = true }, NULL, &err)
             : NULL;
    if (!s)
        fail_msg("%s", err.text);
    folder_free(folder);
    return s;
}

/* ---- the twin -------------------------------------------------------------------------------- */

/* The packet of sensors that begins with `first`, looking up. */
static vsurface sensors_at(const scene *s, int first)
{
    float x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        int k  = first + i < SENSORS ? first + i : 0;
        vec3 p = scene_place(s, (dvec3){ 1.5 * (k % 8) + 0.75, 1.5 * (k / 8) + 0.75, 0.2 });
        x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    return (vsurface){ .position = { vload(x), vload(y), vload(z) },
                       .normal   = vspread((vec3){ 0, 0, 1 }),
                       .error    = vsplat(1e-5f) };
}

/* W/m^2 of lamp l at each sensor, shadows and all. */
static void add_lamp(const scene *s, int l, double e[SENSORS])
{
    int side = light_has_extent(s->lights[l]) ? SIDE : 1;
    for (int first = 0; first < SENSORS; first += LANES) {
        vsurface at = sensors_at(s, first);
        for (int k = 0; k < side * side; k++) {
            vlight_sample lamp;
            vfloat u  = vsplat(((float)(k % side) + 0.5f) / (float)side);
            vfloat v  = vsplat(((float)(k / side) + 0.5f) / (float)side);
            vmask lit = light_sample(s->lights[l], &at.position, u, v, ALL_LANES, &lamp);
            vray ray  = direct_shadow_ray(&at, &lamp.wi, lamp.dist);
            vmask blocked;
            world_any_hit(s->world, &ray, &lit, NULL, 1, RAYS_COHERENT, &blocked);
            vfloat cosine = vmax(vdot(at.normal, lamp.wi), vsplat(0.0f));
            vfloat got    = vkeep(lit & ~blocked, vrgb_luminance(lamp.e) * cosine);
            for (int i = 0; i < LANES && first + i < SENSORS; i++)
                e[first + i] +=
                    (double)s->light_info[l].dimming * (double)lane(got, i) / (side * side);
        }
    }
}

static void add_all(const scene *s, double e[SENSORS])
{
    memset(e, 0, SENSORS * sizeof *e);
    for (int l = 0; l < s->light_count; l++)
        add_lamp(s, l, e);
}

/* What direct_sensor_sum() makes of all sensors; the rays that it took. */
static int64_t sum_all(arena *a, const scene *s, double accuracy, uint32_t seed, double e[SENSORS],
                       double bound[SENSORS])
{
    sensor_ask ask = { .accuracy = accuracy, .in_room = true, .seed = seed };
    lux_error err;
    direct_sensor *w = direct_sensor_new(a, s, &ask, &err);
    sensor_sum *sums = arena_array(a, sensor_sum, 1 + (size_t)s->group_count, &err);
    assert_true(w && sums);
    for (int first = 0; first < SENSORS; first += LANES) {
        vsurface at  = sensors_at(s, first);
        vmask active = (vlane_index() + first) < SENSORS;
        direct_sensor_sum(w, &at, active, (uint32_t)first, sums);
        for (int i = 0; i < LANES && first + i < SENSORS; i++) {
            e[first + i]     = (double)lane(sums[0].e, i);
            bound[first + i] = (double)lane(sums[0].bound, i);
        }
    }
    return direct_sensor_rays(w);
}

/* ---- tests ----------------------------------------------------------------------------------- */

/* 1e-5: 200 terms in floats, and the cosine's rounding. */
TEST(few_lamps_are_summed_without_a_bound)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(&a, room_text(&a, 16, false, ""));
    double want[SENSORS], got[SENSORS], bound[SENSORS];
    add_all(s, want);
    sum_all(&a, s, 0.02, 1, got, bound);
    for (int k = 0; k < SENSORS; k++) {
        assert_near(got[k], want[k], 1e-5);
        assert_true(bound[k] == 0.0);
    }
    arena_clear(&a);
}

/* The bound holds as a 95 % interval does, and is a fortieth of the accuracy asked for: a tenth,
 * and what 16 rays make of it. */
TEST(of_many_lamps_the_weak_ones_are_drawn_within_their_bound)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(&a, room_text(&a, LAMPS, false, ""));
    double want[SENSORS], got[SENSORS], bound[SENSORS];
    add_all(s, want);
    int held = 0, all = 0, bounded = 0;
    for (uint32_t seed = 1; seed <= 20; seed++) {
        int64_t rays = sum_all(&a, s, 0.1, seed, got, bound);
        assert_true(rays < (int64_t)SENSORS * LAMPS * 3 / 4);
        for (int k = 0; k < SENSORS; k++) {
            all++;
            bounded += bound[k] > 0.0;
            held += fabs(got[k] - want[k]) <= bound[k] + 1e-5 * want[k];
            assert_true(bound[k] <= 0.1 * 0.1 * 0.2665 * got[k] * 1.02);
        }
    }
    assert_true(bounded > all * 3 / 4);
    assert_true(held >= 0.95 * all);
    arena_clear(&a);
}

/* The mean over seeds is off by no more than 4 of its standard deviations, at most bound / 2.1314 a
 * seed; 48 sensors by chance in one run of 300. */
TEST(what_is_drawn_of_weak_lamps_is_unbiased)
{
    enum { SEEDS = 400 };
    arena a        = { 0 };
    const scene *s = scene_of_text(&a, room_text(&a, LAMPS, false, ""));
    double want[SENSORS], mean[SENSORS] = { 0 }, spread[SENSORS] = { 0 }, moved = 0.0;
    add_all(s, want);
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        double got[SENSORS], bound[SENSORS];
        arena run = { 0 };
        sum_all(&run, s, 1.0, seed, got, bound);
        for (int k = 0; k < SENSORS; k++) {
            mean[k] += got[k] / SEEDS;
            spread[k] = bound[k] / 2.1314;
            moved += fabs(got[k] - want[k]) > 1e-4 * want[k];
        }
        arena_clear(&run);
    }
    for (int k = 0; k < SENSORS; k++)
        assert_true(fabs(mean[k] - want[k]) <= 4.0 * spread[k] / sqrt(SEEDS) + 1e-5 * want[k]);
    assert_true(moved > SEEDS * SENSORS / 4); /* it is drawn indeed */
    arena_clear(&a);
}

/* Below a lid hardly anything arrives: then nothing may be left to a bound on what would. */
TEST(in_full_shadow_every_lamp_is_asked)
{
    arena a   = { 0 };
    yaml *y   = arena_new(&a, yaml, NULL);
    char *lid = text_of(&a, "%s", block_write(&a, "lid.gltf", (vec3){ 11.9f, 8.9f, 0.1f }));
    put(y,
        "lux4: 1\nroom: {size: [12, 9, 4], reflectance: 0}\n"
        "scene: [{file: %s, at: [6, 4.5, 1]}]\nlights:\n",
        lid);
    for (int i = 0; i < LAMPS; i++)
        put_lamp(y, i, false);
    const scene *s = scene_of_text(&a, y->text);
    double want[SENSORS], got[SENSORS], bound[SENSORS];
    add_all(s, want);
    sum_all(&a, s, 0.5, 1, got, bound);
    for (int k = 0; k < SENSORS; k++) {
        assert_true(bound[k] <= 0.5 * 0.1 * 0.2665 * got[k] * 1.02);
        assert_true(fabs(got[k] - want[k]) <= 2.0 * bound[k] + 1e-5 * want[k]);
    }
    arena_clear(&a);
}

/* Lamps with extent too, by samples; the twin's places leave up to 1 % of what edges of shadows are
 * worth, of many lamps together 0.3 %. */
TEST(mixed_lamps_among_blocks_are_within_the_interval)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(&a, room_text(&a, LAMPS, true, ""));
    double want[SENSORS];
    add_all(s, want);
    int held = 0, all = 0;
    for (uint32_t seed = 1; seed <= 3; seed++) {
        grid_result r;
        grid_of_scene(&a, s, 0,
                      &(run_options){ .accuracy = 0.03, .seed = seed, .direct_only = true }, &r);
        assert_int_equal(r.sensor_count, SENSORS);
        assert_int_equal(r.missed, 0);
        for (int k = 0; k < SENSORS; k++, all++) {
            double lux = LUMENS_PER_WATT * want[k];
            held += fabs(r.illuminance[k] - lux) <= r.half_width[k] + 0.003 * lux;
        }
    }
    assert_true(held >= 0.95 * all);
    arena_clear(&a);
}

/* All samples of a sensor are multiplied by the same factors: up to rounding nothing is left. */
TEST(layers_add_up_as_dimmed)
{
    arena a = { 0 };
    const scene *s =
        layered_scene(&a, room_text(&a, LAMPS, true, "dimming: {large: 0.25, small: 3}\n"));
    double want[SENSORS];
    add_all(s, want);
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .accuracy = 0.05, .seed = 3, .direct_only = true }, &r);
    assert_int_equal(r.layer_count, 2);
    int held = 0;
    for (int k = 0; k < SENSORS; k++) {
        double sum = 0.0, half = 0.0;
        for (int l = 0; l < 2; l++) {
            double dimming = strcmp(s->groups[l], "large") ? 3.0 : 0.25;
            sum += dimming * r.layers[l].direct[k];
            half += dimming * r.layers[l].half_width[k];
        }
        assert_near(r.direct[k], sum, 1e-5);
        double lux = LUMENS_PER_WATT * want[k];
        held += fabs(sum - lux) <= half + 0.003 * lux;
    }
    assert_true(held >= 0.95 * SENSORS);
    arena_clear(&a);
}

/* A group of a hundredth of the light is as sure, relative to itself, as if it were alone: of the
 * samples it gets its half. */
TEST(a_small_layer_is_drawn_as_often_as_a_large_one)
{
    arena a          = { 0 };
    const scene *s   = layered_scene(&a, room_text(&a, LAMPS, true, ""));
    sensor_ask ask   = { .accuracy = 0.02, .in_room = true, .seed = 1 };
    direct_sensor *w = direct_sensor_new(&a, s, &ask, NULL);
    vsurface at      = sensors_at(s, 0);
    uint32_t index[256], seed[256];
    float e[256];
    int32_t lamp[256], of[2] = { 0 };
    for (uint32_t i = 0; i < 256; i++)
        index[i] = i, seed[i] = 7;
    direct_sensor_prepare(w, &at, vlane_index() == 0);
    direct_sensor_draw(w, 0, index, seed, 256, e, lamp);
    for (int i = 0; i < 256; i++) {
        assert_true(lamp[i] >= 0 && light_has_extent(s->lights[lamp[i]]));
        of[s->light_info[lamp[i]].group]++;
    }
    assert_true(abs(of[0] - of[1]) <= 4); /* even numbers: a net's 128 each, and rounding */
    arena_clear(&a);
}

TEST(dark_lanes_are_zero)
{
    arena a          = { 0 };
    const scene *s   = scene_of_text(&a, room_text(&a, LAMPS, true, ""));
    sensor_ask ask   = { .accuracy = 0.5, .in_room = true, .seed = 1 };
    direct_sensor *w = direct_sensor_new(&a, s, &ask, NULL);
    vsurface at      = sensors_at(s, 0);
    sensor_sum sum;
    vmask pending = direct_sensor_sum(w, &at, vlane_index() == 0, 0, &sum);
    assert_int_equal(vbits(pending), 1);
    for (int i = 1; i < LANES; i++)
        assert_true(lane(sum.e, i) == 0.0f && lane(sum.bound, i) == 0.0f);
    arena_clear(&a);
}

static int forget(void **state)
{
    (void)state;
    scratch_remove();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_lamps_are_summed_without_a_bound),
        cmocka_unit_test(of_many_lamps_the_weak_ones_are_drawn_within_their_bound),
        cmocka_unit_test(what_is_drawn_of_weak_lamps_is_unbiased),
        cmocka_unit_test(in_full_shadow_every_lamp_is_asked),
        cmocka_unit_test(mixed_lamps_among_blocks_are_within_the_interval),
        cmocka_unit_test(layers_add_up_as_dimmed),
        cmocka_unit_test(a_small_layer_is_drawn_as_often_as_a_large_one),
        cmocka_unit_test(dark_lanes_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, forget);
}
