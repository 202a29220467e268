/* tests/physics/test_orientation.c -- which way lamps shine, from the study's text to the lux at
 * sensors: the conventions of photometric webs, `rotate`, `aim`, and the nodes of glTF files.
 *
 * The web differs in all four quadrants, so that no two directions can be taken for each other.
 * Sensors stand 2 m from the lamp and face it: E = I / 4.
 */
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>

#define S 0.70710678118654752440 /* of 45 degrees */

/* cd at gamma 0, 45, 90, 135, 180 of C0, C90, C180, C270 */
#define C0   "50 100 110 120 60\n"
#define C90  "50 200 210 220 60\n"
#define C180 "50 300 310 320 60\n"
#define C270 "50 400 410 420 60\n"

static const char ies[] = "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] 2026-01-01\n"
                          "[MANUFAC] none\nTILT=NONE\n1 -1 1 5 5 1 2 0 0 0\n1 1 10\n"
                          "0 45 90 135 180\n0 90 180 270 360\n" C0 C90 C180 C270 C0;

/* cd/klm of 1000 lm; four planes, no symmetry */
static const char ldt[] =
    "none\n2\n0\n4\n90\n5\n45\nnone\nnone\nnone\nweb.ldt\nnone\n500\n400\n30\n0\n0\n0\n0\n0\n0\n"
    "100\n100\n1\n0\n1\n1\nLED\n1000\n3000\n80\n10\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n"
    "0\n90\n180\n270\n0\n45\n90\n135\n180\n"
    "50\n100\n110\n120\n60\n50\n200\n210\n220\n60\n50\n300\n310\n320\n60\n50\n400\n410\n420\n60\n";

typedef struct seen { /* candelas that are to be seen in that direction from the lamp */
    dvec3 toward;     /* unit */
    double candelas;
} seen;

/* Writes the points file of sensors 2 m from the lamp. */
static void write_sensors(const char *folder, dvec3 lamp, const seen *s, int count)
{
    char csv[8192];
    int n = snprintf(csv, sizeof csv, "x,y,z,nx,ny,nz\n");
    for (int k = 0; k < count; k++) {
        dvec3 t = s[k].toward, p = d3_add(lamp, d3_scale(t, 2.0));
        n += snprintf(csv + n, sizeof csv - (size_t)n, "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", p.x,
                      p.y, p.z, -t.x, -t.y, -t.z);
    }
    folder_write(folder, "probes.csv", csv);
}

/* Runs the study, whose lamp is in the text, and compares what its sensors get. */
static void compare(const char *folder, const char *lamps, dvec3 at, const seen *s, int count)
{
    arena a = { 0 };
    char yaml[2048];
    snprintf(yaml, sizeof yaml, "lux4: 1\n%s\ngrids: [{name: g, points: \"%s/probes.csv\"}]\n",
             lamps, folder);
    write_sensors(folder, at, s, count);
    const scene *made = scene_of_text(&a, yaml);
    grid_result r;
    grid_of_scene(&a, made, 0, &(run_options){ .seed = 1 }, &r);
    assert_int_equal(r.sensor_count, count);
    for (int k = 0; k < count; k++)
        if (!(fabs(4.0 * r.illuminance[k] - s[k].candelas) <= 1e-4 * fmax(s[k].candelas, 1.0)))
            fail_msg("%s: toward (%g, %g, %g) %g cd, not %g", lamps, s[k].toward.x, s[k].toward.y,
                     s[k].toward.z, 4.0 * r.illuminance[k], s[k].candelas);
    arena_clear(&a);
}

/* A luminaire with these keys, by both formats. */
static void webs_show(const char *keys, const seen *s, int count)
{
    const dvec3 at = { 7, -3, 2.5 };
    char *folder   = folder_new(), lamps[1024];
    folder_write(folder, "web.ies", ies);
    folder_write(folder, "web.ldt", ldt);
    for (int format = 0; format < 2; format++) {
        snprintf(lamps, sizeof lamps,
                 "luminaires: [{photometry: \"%s/web.%s\", at: [7, -3, 2.5]%s}]", folder,
                 format ? "ldt" : "ies", keys);
        compare(folder, lamps, at, s, count);
    }
    folder_free(folder);
}

#define SHOW(keys, ...)                                                                            \
    do {                                                                                           \
        const seen all[] = { __VA_ARGS__ };                                                        \
        webs_show(keys, all, sizeof all / sizeof *all);                                            \
    } while (0)

/* ---- webs ------------------------------------------------------------------------------------ */

TEST(aimed_down_c0_lies_along_x_and_c90_along_y)
{
    SHOW("", { { 0, 0, -1 }, 50 }, { { S, 0, -S }, 100 }, { { 0, S, -S }, 200 },
         { { -S, 0, -S }, 300 }, { { 0, -S, -S }, 400 }, { { 1, 0, 0 }, 110 }, { { 0, 1, 0 }, 210 },
         { { -1, 0, 0 }, 310 }, { { 0, -1, 0 }, 410 }, { { S, 0, S }, 120 }, { { 0, S, S }, 220 },
         { { -S, 0, S }, 320 }, { { 0, -S, S }, 420 }, { { 0, 0, 1 }, 60 });
}

TEST(between_planes_light_changes_evenly)
{
    SHOW("", { { S, S, 0 }, 160 }, { { -S, S, 0 }, 260 }, { { -S, -S, 0 }, 360 },
         { { S, -S, 0 }, 260 });
}

TEST(rotate_is_counter_clockwise_seen_from_above)
{
    SHOW(", rotate: 90", { { 0, S, -S }, 100 }, { { -S, 0, -S }, 200 }, { { 0, -S, -S }, 300 },
         { { S, 0, -S }, 400 }, { { 0, 1, 0 }, 110 }, { { 0, 0, -1 }, 50 });
    const double c = 0.86602540378443864676; /* of 30 degrees */
    SHOW(", rotate: 30", { { c, 0.5, 0 }, 110 }, { { -0.5, c, 0 }, 210 }, { { -c, -0.5, 0 }, 310 },
         { { 0.5, -c, 0 }, 410 });
    SHOW(", rotate: -90", { { 0, -1, 0 }, 110 }, { { 1, 0, 0 }, 210 });
}

/* The shortest turn of -z to +x is about y: +x goes up, y stays. */
TEST(aimed_sideways_a_web_turns_the_shortest_way)
{
    SHOW(", aim: [3, 0, 0]", { { 1, 0, 0 }, 50 }, { { 0, 0, 1 }, 110 }, { { 0, 1, 0 }, 210 },
         { { 0, 0, -1 }, 310 }, { { 0, -1, 0 }, 410 }, { { S, 0, S }, 100 }, { { S, S, 0 }, 200 },
         { { -1, 0, 0 }, 60 });
    SHOW(", aim: [0, 1, 0]", { { 0, 1, 0 }, 50 }, { { 1, 0, 0 }, 110 }, { { 0, 0, 1 }, 210 },
         { { -1, 0, 0 }, 310 }, { { 0, 0, -1 }, 410 });
    SHOW(", aim: [-1, 0, 0]", { { -1, 0, 0 }, 50 }, { { 0, 0, -1 }, 110 }, { { 0, 1, 0 }, 210 },
         { { 0, 0, 1 }, 310 }, { { 0, -1, 0 }, 410 });
}

TEST(aimed_aslant_a_web_turns_as_far_as_its_aim)
{
    SHOW(", aim: [1, 0, -1]", { { S, 0, -S }, 50 }, { { 1, 0, 0 }, 100 }, { { S, 0, S }, 110 },
         { { 0, 1, 0 }, 210 }, { { 0, 0, -1 }, 300 }, { { 0, -1, 0 }, 410 });
}

TEST(aimed_up_a_web_turns_about_its_c0_axis)
{
    SHOW(", aim: [0, 0, 1]", { { 0, 0, 1 }, 50 }, { { 1, 0, 0 }, 110 }, { { 0, -1, 0 }, 210 },
         { { -1, 0, 0 }, 310 }, { { 0, 1, 0 }, 410 }, { { S, 0, S }, 100 }, { { 0, -S, S }, 200 });
    SHOW(", aim: [0, 0, 1], rotate: 90", { { 0, 1, 0 }, 110 }, { { 1, 0, 0 }, 210 },
         { { 0, -1, 0 }, 310 }, { { -1, 0, 0 }, 410 });
}

/* Turned by 90 degrees, C0 lies along +y, which the turn of -z to +x keeps; C90, along -x, goes
 * down. The other order would leave C0 upright. */
TEST(rotate_comes_before_aim)
{
    SHOW(", aim: [1, 0, 0], rotate: 90", { { 1, 0, 0 }, 50 }, { { 0, 1, 0 }, 110 },
         { { 0, 0, -1 }, 210 }, { { 0, -1, 0 }, 310 }, { { 0, 0, 1 }, 410 });
}

/* ---- a spot of a glTF file --------------------------------------------------------------------
 *
 * By hand, in glTF's frame: the child, turned by 45 degrees about y, shines along (-1, 0, -1) from
 * (1, 1, 0). Its parent scales by (-2, 3, 1): along (2, 0, -1) from (-2, 3, 0); turns by 90 degrees
 * about y, (x, y, z) -> (z, y, -x): along (-1, 0, -2) from (0, 3, 2); moves by (1, 2, 3): from
 * (1, 5, 5). In the world's frame, (x, y, z) -> (x, -z, y): along (-1, 2, 0) from (1, -5, 5).
 * `scale: 0.5` takes that to (0.5, -2.5, 2.5), `rotate: 90`, (x, y) -> (-y, x), along (-2, -1, 0)
 * from (2.5, 0.5, 2.5), `at` to (12.5, 20.5, 3.5). Candelas keep what they are.
 */
static const char spot[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"extensionsUsed\": [\"KHR_lights_punctual\"],"
    "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"spot\","
    "\"intensity\": 100, \"spot\": {\"innerConeAngle\": 0.349065850398866,"
    "\"outerConeAngle\": 0.523598775598299}}]}},"
    "\"scene\": 0, \"scenes\": [{\"nodes\": [0]}],"
    "\"nodes\": [{\"children\": [1], \"translation\": [1, 2, 3], \"scale\": [-2, 3, 1],"
    "\"rotation\": [0, 0.707106781186548, 0, 0.707106781186548]},"
    "{\"translation\": [1, 1, 0], \"rotation\": [0, 0.38268343236509, 0, 0.923879532511287],"
    "\"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}}]}";

/* Off the aim by an angle, toward a unit vector square to it. */
static dvec3 aside(dvec3 aim, dvec3 toward, double degrees)
{
    double angle = degrees * (M_PI / 180.0);
    return d3_add(d3_scale(aim, cos(angle)), d3_scale(toward, sin(angle)));
}

TEST(a_gltf_spot_shines_where_its_nodes_and_its_copy_turn_it)
{
    const double f  = 1.0 / sqrt(5.0);
    const dvec3 aim = { -2 * f, -f, 0 }, at = { 12.5, 20.5, 3.5 };
    const dvec3 ways[] = { { 0, 0, 1 }, { 0, 0, -1 }, { f, -2 * f, 0 }, { -f, 2 * f, 0 } };
    /* KHR_lights_punctual: the square of a ramp in the cosine from the outer to the inner angle */
    const double ramp = (cos(25 * M_PI / 180) - cos(30 * M_PI / 180)) /
                        (cos(20 * M_PI / 180) - cos(30 * M_PI / 180));
    seen all[14] = { { aim, 100 }, { d3_scale(aim, -1.0), 0 } };
    for (int k = 0; k < 4; k++) {
        all[2 + 3 * k] = (seen){ aside(aim, ways[k], 19.5), 100 };
        all[3 + 3 * k] = (seen){ aside(aim, ways[k], 25), 100 * ramp * ramp };
        all[4 + 3 * k] = (seen){ aside(aim, ways[k], 30.5), 0 };
    }
    char *folder = folder_new(), lamps[1024];
    folder_write(folder, "spot.gltf", spot);
    snprintf(lamps, sizeof lamps,
             "scene: {file: \"%s/spot.gltf\", at: [10, 20, 1], rotate: 90, scale: 0.5}", folder);
    compare(folder, lamps, at, all, 14);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aimed_down_c0_lies_along_x_and_c90_along_y),
        cmocka_unit_test(between_planes_light_changes_evenly),
        cmocka_unit_test(rotate_is_counter_clockwise_seen_from_above),
        cmocka_unit_test(aimed_sideways_a_web_turns_the_shortest_way),
        cmocka_unit_test(aimed_aslant_a_web_turns_as_far_as_its_aim),
        cmocka_unit_test(aimed_up_a_web_turns_about_its_c0_axis),
        cmocka_unit_test(rotate_comes_before_aim),
        cmocka_unit_test(a_gltf_spot_shines_where_its_nodes_and_its_copy_turn_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
