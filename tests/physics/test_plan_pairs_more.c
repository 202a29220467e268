/* tests/physics/test_plan_pairs_more.c -- pairs of scenes (plan_pairs.h) of many lamps, portals,
 * pictures and motion. test_plan_pairs_views.c has what views show.
 */
#include "sim/daylight.h"
#include "tests/physics/plan_pairs.h"
#include "tests/slab.h"

#include <stdio.h>

/* ---- many lamps ------------------------------------------------------------------------------ */

static const char *lamps_of(lab *l, int count)
{
    const char *list = "lights: [";
    for (int i = 0; i < count; i++)
        list = text_of(&l->a, "%s%s{type: point, at: [%g, %g, 2.2], lumens: %d}", list,
                       i ? ", " : "", 0.4 + 0.8 * (i % 5), 0.3 + 0.6 * (i / 5), 100 + 20 * i);
    return text_of(&l->a, "%s]\n", list);
}

/* Where light comes back, FEW_LAMPS are looked at for each reflection. */
TEST(few_lamps_are_all_asked_and_one_more_turns_choosing_on)
{
    lab l;
    lab_open(&l);
    assert_pair(&l, EFFECT_MANY_LIGHTS,
                text_of(&l.a, "%s%s%s", ROOM("0.3"), lamps_of(&l, FEW_LAMPS), GRID),
                text_of(&l.a, "%s%s%s", ROOM("0.3"), lamps_of(&l, FEW_LAMPS + 1), GRID));
    lab_close(&l);
}

/* In a black room with a sheet in it sensors ask ASKED_LAMPS; of more, the strongest. */
TEST(of_many_hidden_lamps_some_are_asked_and_all_when_choosing_is_left_out)
{
    static const char with_sheet[] = ROOM("0") "scene: sheet.gltf\n";
    outcome chosen, all;
    plan_options none = as_planned;
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 1, 1.5, 0.4);
    lab_quads(&l, "sheet.gltf", &q, 1,
              "\"name\":\"S\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":["
              "0,0,0,1]}");
    const char *few = text_of(&l.a, "%s%s%s", with_sheet, lamps_of(&l, 16), GRID);
    const char *one = text_of(&l.a, "%s%s%s", with_sheet, lamps_of(&l, 17), GRID);
    assert_pair(&l, EFFECT_MANY_LIGHTS, few, one);
    none.no = 1u << EFFECT_MANY_LIGHTS;
    run(&l, one, &as_planned, &chosen);
    run(&l, one, &none, &all);
    assert_true(is_on(&chosen, EFFECT_MANY_LIGHTS) && all.scene->asks_all);
    assert_false(all.plan.effects[EFFECT_MANY_LIGHTS].missed); /* results are the same */
    assert_agree(&chosen, &all);
    lab_close(&l);
}

/* ---- portals --------------------------------------------------------------------------------- */

#define OVERCAST "sky: {model: overcast, horizontal: 5000}\n"
#define OPEN(width)                                                                                \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.3, windows: [{wall: south, at: [1, 1], "    \
    "size: [" width ", " width "]}]}\naccuracy: 20%\nlights: [" POINT "]\n"

/* Of no opening, or of one that no sky is behind, and of one of 2 cm. */
TEST(portals_are_on_where_a_sky_comes_in_by_the_smallest_opening)
{
    lab l;
    lab_open(&l);
    assert_pair(&l, EFFECT_PORTALS, ROOM("0.3") "lights: [" POINT "]\n" OVERCAST GRID,
                OPEN("0.02") OVERCAST GRID);
    assert_pair(&l, EFFECT_PORTALS, OPEN("1") GRID, OPEN("1") OVERCAST GRID);
    lab_close(&l);
}

/* A plate under the open sky: there is no opening. */
TEST(under_the_open_sky_no_portal_is_called_for)
{
    outcome planned, forced;
    static const char yaml[] =
        "lux4: 1\nscene: plate.gltf\naccuracy: 10%\n" OVERCAST
        "grids: [{name: g, origin: [1, 0.5, 0.5], u: [2, 0, 0], v: [0, 2, 0], spacing: 1}]\n";
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 1.5, 0, 4);
    lab_quads(&l, "plate.gltf", &q, 1, "\"name\":\"S\"");
    run(&l, yaml, &as_planned, &planned);
    run(&l, yaml, &all_is_on, &forced);
    assert_false(is_on(&planned, EFFECT_PORTALS));
    assert_true(is_on(&planned, EFFECT_SKY));
    assert_agree(&planned, &forced);
    assert_near(planned.grid.average, 5000.0, 0.01);
    lab_close(&l);
}

/* Without them the sky is looked for all around, and results are the same. */
TEST(a_window_gives_the_same_without_portals)
{
    outcome with, without;
    plan_options none = as_planned;
    none.no           = 1u << EFFECT_PORTALS;
    lab l;
    lab_open(&l);
    run(&l, OPEN("1") OVERCAST GRID, &as_planned, &with);
    run(&l, OPEN("1") OVERCAST GRID, &none, &without);
    assert_true(is_on(&with, EFFECT_PORTALS) && with.scene->portals);
    assert_null(without.scene->portals);
    assert_false(without.plan.effects[EFFECT_PORTALS].missed);
    assert_agree(&with, &without);
    lab_close(&l);
}

/* ---- pictures -------------------------------------------------------------------------------- */

enum { STRIPS = 20, DARK_STRIP = 10 };

/* A floor of strips 0.2 m wide, all of 201 of 255 but for one of 199; and the linear values. */
static void write_strips(lab *l)
{
    uint8_t texel[4 * STRIPS];
    for (int i = 0; i < STRIPS; i++) {
        uint8_t grey = i == DARK_STRIP ? 199 : 201;
        memcpy(texel + 4 * i, (uint8_t[]){ grey, grey, grey, 255 }, 4);
    }
    quad q = quad_level(2, 1.5, 0.01, 4);
    lab_picture(l, "floor.gltf", &q, &(picture){ STRIPS, 1, texel, NEAREST_TEXEL },
                "\"name\":\"Strips\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                "\"baseColorFactor\":[0.03,0.03,0.03,1],\"baseColorTexture\":{\"index\":0}}");
}

static double linear(double srgb) { return pow((srgb / 255.0 + 0.055) / 1.055, 2.4); }

/* All light falls on the darkest strip, and a sensor that looks down sees nothing else: results
 * are off by what that strip is darker than the mean, and the bound holds. */
TEST(a_spot_on_the_darkest_texels_stays_within_the_bound_of_textures)
{
    static const char yaml[] =
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\naccuracy: 40%\nscene: floor.gltf\n"
        "lights: [{type: cone, at: [2.1, 1.5, 0.5], aim: [0, 0, -1], inner: 8, outer: 10, "
        "lumens: 1000}]\ngrids: [{name: g, points: p.csv}]\n";
    outcome planned, forced;
    lab l;
    lab_open(&l);
    write_strips(&l);
    lab_write(&l, "p.csv", "x,y,z,nx,ny,nz\n2.1,1.3,0.2,0,0,-1\n2.1,1.7,0.25,0,0,-1\n");
    double dark = linear(199), bright = linear(201);
    double mean = bright + (dark - bright) / STRIPS, e = mean / dark - 1.0;
    run_with(&l, yaml, &as_planned, 0.002, &planned);
    run_with(&l, yaml, &all_is_on, 0.002, &forced);
    assert_false(is_on(&planned, EFFECT_TEXTURES));
    double times = ceil(log(1e-4) / log((1.0 + e) * 0.03 * mean));
    assert_near(planned.plan.bound, pow(1.0 + e, times) - 1.0, 0.01); /* texels in 8 bits */
    for (int k = 0; k < 2; k++) {
        double off = planned.grid.illuminance[k] / forced.grid.illuminance[k] - 1.0;
        assert_near(off, e, 0.2); /* the runs' own 0.2 % each */
        assert_true(off < planned.plan.bound);
    }
    lab_close(&l);
}

/* ---- motion ---------------------------------------------------------------------------------- */

#define HOURS                                                                                      \
    "site: {place: 52.5N 13.4E, zone: Europe/Berlin}\nsky: {model: clear, turbidity: 4}\n"         \
    "when: {date: 2026-03-21, from: \"09:00\", to: \"15:00\", step: 180}\naccuracy: 30%\n"         \
    "room: {size: [4, 5, 3], reflectance: [0.5, 0.5, 0.4], windows: [{wall: south, at: [1, 1], "   \
    "size: [2, 1.2]}]}\n" GRID

static void run_series(lab *l, const plan_options *how, daylight *d, plan *p)
{
    char path[4096];
    lux_error err     = { 0 };
    plan_options asks = *how;
    asks.series       = true;
    lab_write(l, "study.yaml", "lux4: 1\n%s", HOURS);
    snprintf(path, sizeof path, "%s/study.yaml", l->folder);
    *d       = (daylight){ .a = &l->a, .threads = 1 };
    d->study = study_read(&l->a, path, NULL, NULL, &err);
    if (d->study)
        d->moments = moments_of(&l->a, d->study, &d->study->when, &d->moment_count, NULL, &err);
    run_options r = { .accuracy = (double)NAN, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    if (!d->moments || !daylight_begin(d, 3.0, &err) ||
        !plan_make(d->scene, &asks, p, NULL, &err) ||
        !daylight_plan(d, plan_without(p), p->on, &err))
        fail_msg("%s", err.text);
    plan_apply(p, &r);
    if (!daylight_run(d, &r, &err))
        fail_msg("%s", err.text);
    daylight_end(d);
}

/* A study has no word for what moves: from moment to moment all stands, and looking for motion
 * gives the same bytes; looking for all else as well, the same within the intervals. Nothing can
 * need it. */
TEST(nothing_moves_through_a_series)
{
    daylight planned, forced, all;
    plan p, q;
    lab l;
    lab_open(&l);
    run_series(&l, &as_planned, &planned, &p);
    plan_options with_motion = as_planned;
    with_motion.has_only     = true;
    for (int e = 0; e < EFFECTS; e++)
        with_motion.only |= (uint32_t)p.effects[e].on << e;
    with_motion.only |= 1u << EFFECT_MOTION;
    run_series(&l, &with_motion, &forced, &q);
    assert_false(p.effects[EFFECT_MOTION].on);
    assert_true(q.effects[EFFECT_MOTION].on);
    run_series(&l, &all_is_on, &all, &q);
    const daylight_series *a = planned.series, *b = forced.series, *c = all.series;
    size_t n = (size_t)a->plan.sensor_count * sizeof(double);
    assert_int_equal(a->count, 3);
    for (int h = 0; h < 3; h++) {
        assert_true(a->of[h].average > 1.0);
        assert_memory_equal(a->light[h].illuminance, b->light[h].illuminance, n);
        assert_memory_equal(a->light[h].half_width, b->light[h].half_width, n);
        for (int k = 0; k < a->plan.sensor_count; k++) {
            double wide = a->light[h].half_width[k] + c->light[h].half_width[k];
            double off  = a->light[h].illuminance[k] - c->light[h].illuminance[k];
            assert_true(fabs(off) <= INTERVALS_STRETCH * wide);
        }
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_lamps_are_all_asked_and_one_more_turns_choosing_on),
        cmocka_unit_test(of_many_hidden_lamps_some_are_asked_and_all_when_choosing_is_left_out),
        cmocka_unit_test(portals_are_on_where_a_sky_comes_in_by_the_smallest_opening),
        cmocka_unit_test(under_the_open_sky_no_portal_is_called_for),
        cmocka_unit_test(a_window_gives_the_same_without_portals),
        cmocka_unit_test(a_spot_on_the_darkest_texels_stays_within_the_bound_of_textures),
        cmocka_unit_test(nothing_moves_through_a_series),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
