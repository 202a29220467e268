/* tests/physics/test_plan_pairs.c -- pairs of scenes (plan_pairs.h) of lamps and their extent,
 * shadows, interreflection, daylight, colour and what materials do; and what is forced off.
 * test_plan_pairs_more.c and test_plan_pairs_views.c have the other effects.
 */
#include "tests/physics/plan_pairs.h"
#include "tests/slab.h"

/* ---- bounded --------------------------------------------------------------------------------- */

/* A study with a number in it, by which the bound grows. */
typedef struct numbered {
    const char *before, *after;
    double off, on; /* numbers where the effect is off; is on */
} numbered;

static const char *study_at(lab *l, const numbered *n, double number)
{
    return text_of(&l->a, "%s%.9g%s", n->before, number, n->after);
}

static plan planned_at(lab *l, const numbered *n, double number)
{
    plan p        = { 0 };
    lux_error err = { 0 };
    if (!plan_make(lab_scene(l, study_at(l, n, number)), &as_planned, &p, NULL, &err))
        fail_msg("%s", err.text);
    return p;
}

/* Just below the number where the bound is all that may be left out the effect is off, and agrees;
 * just above it is on. */
static void assert_on_by_a_hair(lab *l, effect e, numbered n)
{
    outcome o, forced;
    assert_false(planned_at(l, &n, n.off).effects[e].on);
    assert_true(planned_at(l, &n, n.on).effects[e].on);
    while (n.on > 1.002 * n.off) {
        double middle                                               = sqrt(n.off * n.on);
        *(planned_at(l, &n, middle).effects[e].on ? &n.on : &n.off) = middle;
    }
    run(l, study_at(l, &n, n.off), &as_planned, &o);
    run(l, study_at(l, &n, n.off), &all_is_on, &forced);
    assert_false(is_on(&o, e));
    assert_true(is_on(&forced, e));
    assert_near(o.plan.bound, 0.2 * o.plan.accuracy, 0.01);
    for (int k = 0; k < o.grid.sensor_count; k++)
        assert_true(o.grid.half_width[k] >= o.plan.bound * o.grid.illuminance[k] * (1.0 - 1e-12));
    assert_agree(&o, &forced);
    run(l, study_at(l, &n, n.on), &as_planned, &o);
    assert_true(is_on(&o, e));
    assert_near(o.plan.bound, 0.0, 0.0);
}

TEST(interreflection_of_an_all_but_black_room_is_off_to_a_hair)
{
    lab l;
    lab_open(&l);
    assert_on_by_a_hair(
        &l, EFFECT_INTERREFLECTION,
        (numbered){ "lux4: 1\naccuracy: 10%\nroom: {size: [4, 3, 2.5], reflectance: ",
                    "}\nlights: [" POINT "]\n" GRID, 1e-6, 0.01 });
    lab_close(&l);
}

TEST(a_small_disk_is_a_point_to_a_hair)
{
    lab l;
    lab_open(&l);
    assert_on_by_a_hair(
        &l, EFFECT_AREA_LIGHTS,
        (numbered){ ROOM("0") "lights: [{type: disk, at: [2, 1.5, 2.2], lumens: 1000, radius: ",
                    "}]\n" GRID, 0.005, 0.4 });
    lab_close(&l);
}

TEST(a_small_opening_is_a_point_to_a_hair)
{
    lab l;
    lab_open(&l);
    lab_write(&l, "lamp.ies",
              "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
              "1 -1 1 3 1 1 2 -0.02 0 0\n1 1 25\n0 45 90\n0\n100 70.71 0\n");
    outcome o, forced;
    const char *small = ROOM("0") "luminaires: [{photometry: lamp.ies, at: [2, 1.5, 2.2]}]\n" GRID;
    run(&l, small, &as_planned, &o);
    run(&l, small, &all_is_on, &forced);
    assert_false(is_on(&o, EFFECT_NEAR_FIELD));
    assert_true(o.plan.bound > 0.0 && is_on(&forced, EFFECT_NEAR_FIELD));
    assert_agree(&o, &forced);
    lab_write(&l, "lamp.ies",
              "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
              "1 -1 1 3 1 1 2 -0.8 0 0\n1 1 25\n0 45 90\n0\n100 70.71 0\n");
    run(&l, small, &as_planned, &o);
    assert_true(is_on(&o, EFFECT_NEAR_FIELD));
    lab_close(&l);
}

/* A floor of two greys, 200 and 201 of 255, and one of 200 and 220. */
TEST(textures_of_all_but_one_colour_are_off)
{
    static const char yaml[] = ROOM("0.02") "scene: floor.gltf\nlights: [" POINT "]\n" GRID;
    static const char matt[] =
        "\"name\":\"Picture\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
        "\"baseColorFactor\":[0.03,0.03,0.03,1],\"baseColorTexture\":{"
        "\"index\":0}}";
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 1.5, 0.01, 1);
    for (int step = 1; step <= 20; step += 19) {
        uint8_t other   = (uint8_t)(200 + step);
        uint8_t grey[8] = { 200, 200, 200, 255, other, other, other, 255 };
        outcome o, forced;
        lab_picture(&l, "floor.gltf", &q, &(picture){ 2, 1, grey, NEAREST_TEXEL }, matt);
        run(&l, yaml, &as_planned, &o);
        assert_int_equal(is_on(&o, EFFECT_TEXTURES), step > 1);
        assert_int_equal(o.scene->textured, step > 1); /* so that it costs nothing */
        if (step > 1)
            continue;
        run(&l, yaml, &all_is_on, &forced);
        assert_true(o.plan.bound > 0.0 && forced.scene->textured);
        assert_agree(&o, &forced);
    }
    lab_close(&l);
}

/* ---- without effect -------------------------------------------------------------------------- */

#define OVERCAST "sky: {model: overcast, horizontal: 5000}\n"
#define WINDOW                                                                                     \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.3, windows: [{wall: south, at: [1, 1], "    \
    "size: [2, 1]}]}\naccuracy: 20%\n"
#define SUN_AT(elevation)                                                                          \
    "sky: {model: clear, horizontal: 5000, sun_illuminance: 20000, sun: point, sun_at: {azimuth: " \
    "180, elevation: " elevation "}}\n"

TEST(a_closed_room_needs_no_daylight)
{
    lab l;
    lab_open(&l);
    assert_pair(&l, EFFECT_SKY, ROOM("0.3") "lights: [" POINT "]\n" OVERCAST GRID,
                WINDOW "lights: [" POINT "]\n" OVERCAST GRID);
    assert_pair(&l, EFFECT_SUN, ROOM("0.3") "lights: [" POINT "]\n" SUN_AT("40") GRID,
                WINDOW "lights: [" POINT "]\n" SUN_AT("40") GRID);
    lab_close(&l);
}

/* Of the daylight scene nothing is left to be asked. */
TEST(what_a_closed_room_keeps_out_costs_nothing)
{
    lab l;
    outcome o;
    lab_open(&l);
    run(&l, ROOM("0.3") "lights: [" POINT "]\n" SUN_AT("40") GRID, &as_planned, &o);
    assert_int_equal(o.scene->sky_count + o.scene->sun_count, 0);
    assert_null(o.scene->dome);
    assert_false(is_on(&o, EFFECT_SHADOWS));
    lab_close(&l);
}

/* A sensor outside of the room sees the sky after all. */
TEST(one_sensor_outside_turns_the_sky_on)
{
    lab l;
    outcome o;
    lab_open(&l);
    lab_write(&l, "p.csv", "x,y,z,nx,ny,nz\n2,1,1,0,0,1\n2,1,2.6,0,0,1\n");
    run(&l, ROOM("0.3") "lights: [" POINT "]\n" OVERCAST "grids: [{name: g, points: p.csv}]\n",
        &as_planned, &o);
    assert_true(is_on(&o, EFFECT_SKY));
    assert_near(o.grid.illuminance[1], 5000.0, 0.2); /* as accurate as asked for */
    lab_close(&l);
}

TEST(the_sun_is_off_below_the_horizon)
{
    lab l;
    lab_open(&l);
    assert_pair(&l, EFFECT_SUN, WINDOW "lights: [" POINT "]\n" SUN_AT("-0.05") GRID,
                WINDOW "lights: [" POINT "]\n" SUN_AT("0.05") GRID);
    lab_close(&l);
}

TEST(shadows_are_off_until_something_stands_in_the_room)
{
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 1, 1.5, 0.2);
    lab_quads(&l, "sheet.gltf", &q, 1,
              "\"name\":\"S\",\"pbrMetallicRoughness\":{\"metallicFactor\":0}");
    assert_pair(&l, EFFECT_SHADOWS, ROOM("0.3") "lights: [" POINT "]\n" GRID,
                ROOM("0.3") "scene: sheet.gltf\nlights: [" POINT "]\n" GRID);
    lab_close(&l);
}

#define OF_FLOOR(what) "materials: [{match: 'room: floor', " what "}]\n"

TEST(what_materials_do_is_off_where_no_material_does_it)
{
    lab l;
    lab_open(&l);
    lab_write(&l, "flat.brdf",
              "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\n"
              "delta_phi 0\nvalues 0.08\n");
    static const char plain[] = ROOM("0.3") "lights: [" POINT "]\n" GRID;
    assert_pair(&l, EFFECT_MIRRORS, plain,
                ROOM("0.3") "lights: [" POINT "]\n" GRID OF_FLOOR("mirror: 0.1"));
    assert_pair(&l, EFFECT_TINTED_SHADOWS, plain,
                ROOM("0.3") "lights: [" POINT "]\n" GRID OF_FLOOR("transmittance: 0.9"));
    assert_pair(&l, EFFECT_MEASURED_BRDF, plain,
                ROOM("0.3") "lights: [" POINT "]\n" GRID OF_FLOOR("brdf: flat.brdf"));
    assert_pair(&l, EFFECT_COLOR, plain,
                ROOM("0.3") "lights: [" POINT "]\n" GRID OF_FLOOR("reflectance: [0.3, 0.3, 0.31]"));
    lab_close(&l);
}

/* ---- forced off ------------------------------------------------------------------------------ */

static double average_without(lab *l, const char *yaml, effect e, bool missed)
{
    plan_options o = as_planned;
    outcome got;
    o.no = 1u << e;
    run(l, yaml, &o, &got);
    assert_false(is_on(&got, e));
    assert_int_equal(got.plan.effects[e].missed, missed);
    assert_true(got.plan.bound == 0.0);
    return got.grid.average;
}

/* What stands in keeps the light: a flat table is a matt surface, a grey that of its colour; where
 * all is matt otherwise a mirror's light comes back as well, though elsewhere. */
TEST(what_stands_in_for_an_effect_keeps_the_light)
{
    lab l;
    lab_open(&l);
    lab_write(&l, "flat.brdf",
              "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\n"
              "delta_phi 0\nvalues 0.08\n");
    outcome o;
    static const char table[] =
        ROOM("0.5") "lights: [" POINT "]\n" GRID OF_FLOOR("brdf: flat.brdf");
    run(&l, table, &as_planned, &o);
    assert_near(average_without(&l, table, EFFECT_MEASURED_BRDF, true), o.grid.average, 0.1);
    static const char color[] =
        ROOM("0.5") "lights: [" POINT "]\n" GRID OF_FLOOR("reflectance: [0.5, 0.5, 0.6]");
    run(&l, color, &as_planned, &o);
    assert_near(average_without(&l, color, EFFECT_COLOR, true), o.grid.average, 0.1);
    static const char disk[] =
        ROOM("0") "lights: [{type: disk, at: [2, 1.5, 2.2], lumens: 1000, radius: 0.3}]\n" GRID;
    run(&l, disk, &as_planned, &o);
    assert_near(average_without(&l, disk, EFFECT_AREA_LIGHTS, true), o.grid.average, 0.1);
    lab_close(&l);
}

/* A pane of 0.5 above the sensors: with it the lamp gives half, without its tint all. */
TEST(panes_without_tint_let_all_light_pass)
{
    lab l;
    lab_open(&l);
    outcome o;
    quad q = quad_level(2, 1.5, 1.5, 4);
    lab_quads(&l, "pane.gltf", &q, 1,
              "\"name\":\"P\",\"pbrMetallicRoughness\":{\"metallicFactor\":0}");
    static const char open[] =
        "lux4: 1\naccuracy: 10%\nscene: pane.gltf\nlights: [{type: parallel, "
        "aim: [0, 0, -1], illuminance: 100}]\ngrids: [{name: g, origin: [1, "
        "1, 0.5], u: [2, 0, 0], v: [0, 1, 0], spacing: 1}]\n"
        "materials: [{match: P, transmittance: 0.5}]\n";
    run(&l, open, &as_planned, &o);
    assert_near(o.grid.average, 50.0, 1e-4);
    assert_near(average_without(&l, open, EFFECT_TINTED_SHADOWS, true), 100.0, 1e-4);
    lab_close(&l);
}

/* A closed sheet between lamp and sensors. */
TEST(without_shadows_lamps_shine_through)
{
    lab l;
    lab_open(&l);
    outcome o;
    quad q = quad_level(2, 1.5, 1.5, 4);
    lab_quads(
        &l, "sheet.gltf", &q, 1,
        "\"name\":\"S\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0,"
        "0,0,1]}");
    static const char yaml[] =
        "lux4: 1\naccuracy: 10%\nscene: sheet.gltf\nlights: [{type: parallel, "
        "aim: [0, 0, -1], illuminance: 100}]\ngrids: [{name: g, origin: [1, "
        "1, 0.5], u: [2, 0, 0], v: [0, 1, 0], spacing: 1}]\n";
    run(&l, yaml, &as_planned, &o);
    assert_near(o.grid.average, 0.0, 0.0);
    assert_near(average_without(&l, yaml, EFFECT_SHADOWS, true), 100.0, 1e-4);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interreflection_of_an_all_but_black_room_is_off_to_a_hair),
        cmocka_unit_test(a_small_disk_is_a_point_to_a_hair),
        cmocka_unit_test(a_small_opening_is_a_point_to_a_hair),
        cmocka_unit_test(textures_of_all_but_one_colour_are_off),
        cmocka_unit_test(a_closed_room_needs_no_daylight),
        cmocka_unit_test(what_a_closed_room_keeps_out_costs_nothing),
        cmocka_unit_test(one_sensor_outside_turns_the_sky_on),
        cmocka_unit_test(the_sun_is_off_below_the_horizon),
        cmocka_unit_test(shadows_are_off_until_something_stands_in_the_room),
        cmocka_unit_test(what_materials_do_is_off_where_no_material_does_it),
        cmocka_unit_test(what_stands_in_for_an_effect_keeps_the_light),
        cmocka_unit_test(panes_without_tint_let_all_light_pass),
        cmocka_unit_test(without_shadows_lamps_shine_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
