/* tests/physics/test_scene_lights.c -- lights that come with a model: luminaires at its nodes,
 * whose bodies do not shade them; EXT_lights_ies, EXT_lights_area; and what colour does not change.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <string.h>

static const dvec3 up = { 0, 0, 1 };

/* 900 cd straight down, as the cosine: LM-63 in 5 deg steps; and one that tells C0 from C180. */
static void write_webs(lab *l)
{
    char *text = text_of(&l->a, "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 181 1 1 2 0 0 0\n1 1 0\n");
    for (int i = 0; i <= 180; i++)
        text = text_of(&l->a, "%s%g%c", text, 0.5 * i, i % 15 == 14 ? '\n' : ' ');
    text = text_of(&l->a, "%s\n0\n", text);
    for (int i = 0; i <= 180; i++)
        text = text_of(&l->a, "%s%.9g%c", text, 900.0 * fmax(cos(i * M_PI / 360.0), 0.0),
                       i % 10 == 9 ? '\n' : ' ');
    lab_write(l, "cosine.ies", "%s\n", text);
    lab_write(l, "wing.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 4 1 2 0 0 0\n1 1 0\n0 180\n0 90 180 270\n"
              "700 700\n500 500\n300 300\n400 400\n");
}

/* A model of nodes of mesh 0, a closed cube of 20 cm about the origin, or of other lists. */
static void write_model(lab *l, const char *nodes, const char *extensions)
{
    quad box[6];
    quads_of_box((dvec3){ -0.1, -0.1, -0.1 }, (dvec3){ 0.1, 0.1, 0.1 }, box);
    lab_write(l, "model.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
              "\"nodes\":[{\"name\":\"Root\",\"children\":[1,2]},%s],\"materials\":[{\"name\":"
              "\"Body\"}],%s%s}",
              nodes, lab_mesh(l, box, 6, NULL, 0), extensions);
}

static double cosine_lamp(dvec3 lamp, dvec3 at)
{
    dvec3 d   = d3_sub(lamp, at);
    double d2 = d3_dot(d, d);
    return 900.0 * d.z * d.z / (d2 * d2);
}

/* ---- nodes ----------------------------------------------------------------------------------- */

/* (x, y, z) = (1, 1, 2) and (3, 2, 2) of ours */
static const char spots[] = "{\"name\":\"Spot.001\",\"mesh\":0,\"translation\":[1,2,-1]},"
                            "{\"name\":\"Spot.002\",\"mesh\":0,\"translation\":[3,2,-2]}";

static const lab_probe below[] = { { { 1, 1, 0 }, { 0, 0, 1 } },
                                   { { 1.5, 0.5, 0 }, { 0, 0, 1 } },
                                   { { 3, 2, 0 }, { 0, 0, 1 } },
                                   { { 2, 1.5, 0 }, { 0, 0, 1 } } };

TEST(luminaires_at_nodes_shine_through_their_own_bodies)
{
    lab l;
    lab_open(&l);
    write_webs(&l);
    write_model(&l, spots, "");
    double want[4];
    for (int i = 0; i < 4; i++)
        want[i] = cosine_lamp((dvec3){ 1, 1, 2 }, below[i].at) +
                  cosine_lamp((dvec3){ 3, 2, 2 }, below[i].at);
    grid_result r;
    lab_measure(&l,
                "scene: model.gltf\nmaterials: [{match: Body, reflectance: 0}]\n"
                "luminaires: [{photometry: cosine.ies, nodes: 'Spot.*', aim: [0, 0, -1]}]",
                NULL, below, 4, &(run_options){ 0 }, &r);
    for (int i = 0; i < 4; i++)
        assert_near(r.illuminance[i], want[i], 2e-5); /* the web is linear between rings */
    lab_close(&l);
}

/* One of the two bodies carries the lamp; a point within the other is dark, and a lamp above the
 * first is shaded by it while the first's own is not. */
TEST(bodies_shade_all_lights_but_their_own)
{
    lab l;
    lab_open(&l);
    write_webs(&l);
    write_model(&l, spots, "");
    grid_result r;
    lab_measure(&l,
                "scene: model.gltf\nmaterials: [{match: Body, reflectance: 0}]\n"
                "luminaires: [{photometry: cosine.ies, nodes: Spot.001, aim: [0, 0, -1]}]\n"
                "lights: [{type: point, at: [1, 1, 4], intensity: 1000},"
                " {type: point, at: [3, 2, 2], intensity: 1000}]",
                NULL, below, 4, &(run_options){ 0 }, &r);
    for (int i = 0; i < 4; i++) {
        dvec3 d     = d3_sub((dvec3){ 1, 1, 4 }, below[i].at);
        double lamp = i == 0 ? 0.0 : 1000.0 * d.z / pow(d3_dot(d, d), 1.5);
        assert_near(r.illuminance[i], cosine_lamp((dvec3){ 1, 1, 2 }, below[i].at) + lamp, 2e-5);
    }
    lab_close(&l);
}

/* With an opening, sampled: a part of the light would be lost in a body that counts. */
TEST(a_luminaire_with_an_opening_shines_through_its_body)
{
    lab l;
    lab_open(&l);
    lab_write(&l, "globe.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -0.1 -0.1 -0.1\n1 1 0\n0 90 180\n0\n"
              "400 400 400\n");
    write_model(&l, spots, "");
    double want[4];
    for (int i = 0; i < 4; i++) {
        dvec3 a = d3_sub((dvec3){ 1, 1, 2 }, below[i].at);
        dvec3 b = d3_sub((dvec3){ 3, 2, 2 }, below[i].at);
        want[i] = 400.0 * (a.z / pow(d3_dot(a, a), 1.5) + b.z / pow(d3_dot(b, b), 1.5));
    }
    grid_result r;
    lab_measure(&l,
                "scene: model.gltf\nmaterials: [{match: Body, reflectance: 0}]\n"
                "luminaires: [{photometry: globe.ies, nodes: 'Spot.*'}]",
                NULL, below, 4, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("globes", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* A luminaire hangs at its node as it was delivered: gamma 0 to glTF's -y, down, C0 along x. Of a
 * web of 700, 500, 300 and 400 cd in the planes C0 to C270, at any gamma, what arrives 1 m below
 * and 1 m to the east, north, west and south. */
static void wing_at(const char *rotation, const char *keys, double east, double north, double west,
                    double south)
{
    const double want[] = { east, north, west, south };
    lab l;
    lab_open(&l);
    write_webs(&l);
    write_model(&l,
                text_of(&l.a,
                        "{\"name\":\"Lamp\",\"translation\":[1,2,-1],\"rotation\":[%s]},"
                        "{\"name\":\"Cube\",\"mesh\":0,\"translation\":[50,0,0]}",
                        rotation),
                "");
    lab_probe p[4];
    for (int i = 0; i < 4; i++) {
        double x = i == 0 ? 1 : i == 2 ? -1 : 0, y = i == 1 ? 1 : i == 3 ? -1 : 0;
        p[i] = (lab_probe){ { 1 + x, 1 + y, 1 }, up };
    }
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "scene: model.gltf\nluminaires: [{photometry: wing.ies, nodes: Lamp%s}]",
                        keys),
                NULL, p, 4, &(run_options){ .direct_only = true }, &r);
    for (int i = 0; i < 4; i++)
        assert_near(r.illuminance[i], want[i] / pow(2.0, 1.5), 1e-4);
    lab_close(&l);
}

TEST(a_node_that_is_not_turned_has_c0_in_the_east) { wing_at("0,0,0,1", "", 700, 500, 300, 400); }

TEST(a_node_turned_about_the_vertical_takes_c0_along)
{
    wing_at("0,0.707106781,0,0.707106781", "", 400, 700, 500, 300); /* x comes to -z, north */
    wing_at("0,0.707106781,0,0.707106781", ", rotate: -90", 700, 500, 300, 400);
}

TEST(a_node_upside_down_shines_up_with_c90_in_the_south)
{
    wing_at("1,0,0,0", "", 700, 400, 300, 500);
}

TEST(an_aim_in_the_study_comes_before_the_nodes_own)
{
    wing_at("0,0.707106781,0,0.707106781", ", aim: [0, 0, -1]", 700, 500, 300, 400);
    wing_at("1,0,0,0", ", aim: [0, 0, -1], rotate: 90", 400, 700, 500, 300);
}

/* ---- EXT_lights_ies, EXT_lights_area --------------------------------------------------------- */

#define TURNED "\"rotation\":[-0.707106781,0,0,0.707106781]"

TEST(a_measured_light_of_a_model_gives_what_its_file_says)
{
    lab l;
    lab_open(&l);
    write_webs(&l);
    write_model(&l,
                "{\"name\":\"Lamp\",\"translation\":[1,2,-1]," TURNED ",\"extensions\":{"
                "\"EXT_lights_ies\":{\"light\":0,\"multiplier\":2,\"color\":[1,0.5,0.25]}}},"
                "{\"name\":\"Cube\",\"mesh\":0,\"translation\":[50,0,0]}",
                ",\"extensionsUsed\":[\"EXT_lights_ies\"],\"extensions\":{\"EXT_lights_ies\":{"
                "\"lights\":[{\"uri\":\"cosine.ies\"}]}}");
    grid_result r;
    lab_measure(&l, "scene: model.gltf", NULL, below, 4, &(run_options){ .direct_only = true }, &r);
    for (int i = 0; i < 4; i++)
        assert_near(r.illuminance[i], 2.0 * cosine_lamp((dvec3){ 1, 1, 2 }, below[i].at), 2e-5);
    lab_close(&l);
}

/* 2000 cd/m^2: a square of 0.8 m, scaled by 1.5 in its node, turned by 90 deg to look down; and a
 * disk of the diameter 1, under its middle pi L a^2 / (a^2 + h^2). */
TEST(areas_of_a_model_give_their_closed_forms)
{
    lab l;
    lab_open(&l);
    write_model(&l,
                "{\"name\":\"Square\",\"translation\":[1,2,-1],\"scale\":[1.5,1.5,1.5]," TURNED
                ",\"extensions\":{\"EXT_lights_area\":{\"light\":0}}},"
                "{\"name\":\"Disk\",\"translation\":[31,2,-1]," TURNED
                ",\"extensions\":{\"EXT_lights_area\":{\"light\":1}}}",
                ",\"extensionsUsed\":[\"EXT_lights_area\"],\"extensions\":{\"EXT_lights_area\":{"
                "\"lights\":[{\"type\":\"rect\",\"intensity\":2000,\"size\":0.8},"
                "{\"type\":\"disk\",\"intensity\":2000,\"size\":1}]}}");
    const dvec3 corner[] = { { 0.4, 0.4, 2 }, { 1.6, 0.4, 2 }, { 1.6, 1.6, 2 }, { 0.4, 1.6, 2 } };
    const lab_probe p[]  = { below[0], below[1], { { 31, 1, 0 }, { 0, 0, 1 } } };
    double want[3];
    for (int i = 0; i < 2; i++)
        want[i] = 2000.0 * polygon_lux(corner, 4, p[i].at, p[i].normal);
    want[2] = 2000.0 * M_PI * 0.25 / (0.25 + 4.0);
    grid_result r;
    lab_measure(&l, "scene: model.gltf", NULL, p, 3, &(run_options){ .accuracy = 0.01 }, &r);

    /* Each sees the other, 30 m away, at cos^4 of some 86 deg: less than 1e-5 of its own */
    lab_check("areas", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* ---- far from the origin --------------------------------------------------------------------- */

/* In a country's grid, where a float resolves half a metre, all is as it is at the origin. */
TEST(lights_far_from_the_origin_lose_nothing)
{
    static const dvec3 far = { 500000, 5400000, 100 };
    const dvec3 glow[4]    = {
           { 3.0, 1.0, 1.0 }, { 3.0, 2.0, 1.0 }, { 3.5, 2.0, 2.0 }, { 3.5, 1.0, 2.0 }
    };
    const dvec3 rect[4] = { { 0.4, 0.7, 2 }, { 1.6, 0.7, 2 }, { 1.6, 1.3, 2 }, { 0.4, 1.3, 2 } };
    const lab_probe p[] = { { { 1, 1, 0 }, { 0, 0, 1 } },
                            { { 2.2, 1.4, 0.5 }, { 0.6, 0, 0.8 } },
                            { { 1, 2, 1.5 }, { 1, -1, 1 } } };
    enum { N = sizeof p / sizeof *p };
    lab l;
    lab_open(&l);
    quad q;
    memcpy(q.corner, glow, sizeof glow);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 2000.0));
    lab_probe there[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        there[i] = (lab_probe){ d3_add(p[i].at, far), p[i].normal };
        want[i]  = 2000.0 * polygon_lux(glow, 4, p[i].at, p[i].normal) +
                  1000.0 * polygon_lux(rect, 4, p[i].at, p[i].normal);
    }
    grid_result r;
    lab_measure(&l,
                "scene: {file: glow.gltf, at: [500000, 5400000, 100]}\n"
                "lights: [{type: rect, at: [500001, 5400001, 102], size: [1.2, 0.6], "
                "luminance: 1000}]",
                NULL, there, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("far from the origin", &r, want, 5e-5, 0.01);
    lab_close(&l);
}

/* ---- colour ---------------------------------------------------------------------------------- */

static void colored(const char *lamp)
{
    static const char *const colors[] = { "", ", color: [1, 0.5, 0.2]", ", color: 3000K",
                                          ", color: [0, 0, 1]" };
    const lab_probe p[] = { { { 1, 2, 0.5 }, { 0, 0, 1 } }, { { 3, 1, 1 }, { 0, 1, 0 } } };
    grid_result white   = { 0 };
    lab l;
    lab_open(&l);
    for (int c = 0; c < 4; c++) {
        grid_result r;
        lab_measure(&l,
                    text_of(&l.a,
                            "room: {size: [4, 3, 2.5], reflectance: {ceiling: 0.7, walls: 0.5, "
                            "floor: 0.2}}\nlights: [{%s%s}]",
                            lamp, colors[c]),
                    NULL, p, 2, &(run_options){ .accuracy = 0.05 }, &r);
        if (c == 0)
            white = r;
        for (int i = 0; i < 2; i++) { /* the same paths, but for roundings */
            assert_near(r.illuminance[i], white.illuminance[i], 2e-5);
            assert_near(r.direct[i], white.direct[i], 2e-5);
        }
    }
    lab_close(&l);
}

/* Surfaces are gray: what comes back has the colour of the light. */
TEST(the_color_of_a_point_changes_no_lux) { colored("type: point, at: [1, 1, 2], intensity: 300"); }
TEST(the_color_of_a_rectangle_changes_no_lux)
{
    colored("type: rect, at: [2, 1.5, 2.4], size: [1, 0.5], lumens: 3000");
}
TEST(the_color_of_a_line_changes_no_lux)
{
    colored("type: linear, from: [1, 1.5, 2.3], to: [3, 1.5, 2.3], lumens: 3000");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(luminaires_at_nodes_shine_through_their_own_bodies),
        cmocka_unit_test(bodies_shade_all_lights_but_their_own),
        cmocka_unit_test(a_luminaire_with_an_opening_shines_through_its_body),
        cmocka_unit_test(a_node_that_is_not_turned_has_c0_in_the_east),
        cmocka_unit_test(a_node_turned_about_the_vertical_takes_c0_along),
        cmocka_unit_test(a_node_upside_down_shines_up_with_c90_in_the_south),
        cmocka_unit_test(an_aim_in_the_study_comes_before_the_nodes_own),
        cmocka_unit_test(a_measured_light_of_a_model_gives_what_its_file_says),
        cmocka_unit_test(areas_of_a_model_give_their_closed_forms),
        cmocka_unit_test(lights_far_from_the_origin_lose_nothing),
        cmocka_unit_test(the_color_of_a_point_changes_no_lux),
        cmocka_unit_test(the_color_of_a_rectangle_changes_no_lux),
        cmocka_unit_test(the_color_of_a_line_changes_no_lux),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
