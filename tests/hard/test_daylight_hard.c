/* tests/hard/test_daylight_hard.c -- suns, skies and windows at their limits, against closed forms.
 *
 * The disk of a sun of radius a, whose centre stands at an angle h << 1 above a plane, gives it
 *
 *     E = E_0 a f(h / a),    f(t) = (t acos(-t) + (2 + t^2) sqrt(1 - t^2) / 3) / pi,    |t| <= 1
 *
 * (the mean of what is above the plane over an even disk).
 */
#include "core/image.h"
#include "sim/moment_sky.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

static lab l;

static int prepare(void **state)
{
    (void)state;
    lab_open(&l);
    return 0;
}

static int forget(void **state)
{
    (void)state;
    lab_close(&l);
    return 0;
}

static const dvec3 up = { 0, 0, 1 }, down = { 0, 0, -1 }, north = { 0, 1, 0 }, south = { 0, -1, 0 };

enum { MOST = 8 };

static void assert_lux(const char *yaml, const lab_probe *p, const double *want, int count,
                       double accuracy)
{
    grid_result r;
    lab_measure(&l, yaml, NULL, p, count, &(run_options){ .accuracy = accuracy, .threads = 2 }, &r);
    for (int k = 0; k < count; k++)
        assert_true(isfinite(r.illuminance[k]) && r.direct[k] >= 0.0 && r.indirect[k] >= 0.0);
    lab_check(yaml, &r, want, 1e-4, accuracy); /* floats */
}

/* ---- the sun --------------------------------------------------------------------------------- */

#define NOTHING "scene: [speck.gltf]\n"
#define SUN(azimuth, elevation)                                                                    \
    "sky: {model: uniform, sun: disk, horizontal: 0, sun_illuminance: 50000, ground: 0, "          \
    "sun_at: {azimuth: " azimuth ", elevation: " elevation "}}\n"

/* rad, of the sun of `sun_at` */
static double sun_radius(void)
{
    lux_error err   = { 0 };
    moment_light on = { 0 };
    moment m        = { .sun_known = true, .to_sun = { 0, 0, 1 } };
    const study *s  = lab_scene(&l, "lux4: 1\n" NOTHING SUN("0", "90"))->study;
    assert_true(moment_light_of(&l.a, s, &m, &on, &err));
    return 0.5 * on.diameter_deg * M_PI / 180.0;
}

static double grazing(double h, double a)
{
    double t = h / a;
    return a * (t * acos(-t) + (2.0 + t * t) * sqrt(1.0 - t * t) / 3.0) / M_PI;
}

TEST(a_sun_at_the_zenith_lights_level_ground_fully_and_grazes_walls)
{
    lab_speck(&l, "speck.gltf");
    const lab_probe p[] = { { { 0, 0, 0 }, up }, { { 0, 0, 0 }, north }, { { 0, 0, 0 }, down } };
    const double want[] = { 50000.0, 50000.0 * grazing(0.0, sun_radius()), 0.0 };
    assert_lux(NOTHING SUN("123", "90"), p, want, 3, 0.01);
}

TEST(a_sun_on_the_horizon_is_down_and_one_just_above_is_cut_by_level_ground)
{
    lab_speck(&l, "speck.gltf");
    double a = sun_radius(), h = 0.01 * M_PI / 180.0;
    const lab_probe p[]  = { { { 0, 0, 0 }, up }, { { 0, 0, 0 }, south }, { { 0, 0, 0 }, north } };
    const double dark[3] = { 0 }, low[] = { 50000.0 * grazing(h, a), 50000.0, 0.0 };
    const double higher[] = { 50000.0 * sin(0.5 * M_PI / 180.0), 50000.0, 0.0 };
    assert_lux(NOTHING SUN("180", "0"), p, dark, 3, 0.01);
    assert_lux(NOTHING SUN("180", "-5"), p, dark, 3, 0.01);
    assert_lux(NOTHING SUN("180", "0.01"), p, low, 3, 0.01);
    assert_lux(NOTHING SUN("180", "0.5"), p, higher, 3, 0.01);
}

/* In the plane of the window half of its disk shines in, and grazes what lies beside it. */
TEST(a_sun_in_the_plane_of_a_window_hardly_comes_in)
{
    static const char *const kinds[] = { SUN("90", "40"), SUN("270", "20"), SUN("0", "90") };
    const lab_probe p[]              = { { { 2, 1, 0.01 }, up },
                                         { { 2, 4, 1.5 }, south },
                                         { { 2, 2, 2 }, down } };
    for (int i = 0; i < 3; i++) {
        grid_result r;
        const char *yaml = text_of(&l.a,
                                   "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: "
                                   "south, at: [1, 1], size: [2, 1.2]}]}\n%s",
                                   kinds[i]);
        lab_measure(&l, yaml, NULL, p, 3, &(run_options){ .accuracy = 0.5, .threads = 2 }, &r);
        /* What comes in: 50,000 lx by 2.4 m^2 by grazing() = 0.001 are 118 lm. */
        for (int k = 0; k < 3; k++)
            assert_true(r.illuminance[k] >= 0.0 && r.illuminance[k] <= 118.0);
    }
}

TEST(north_turns_the_sun_whatever_its_angle)
{
    static const double angles[] = { 0, 90, -90, 180, 359.999, 360, -360, 45.5, 1e-9 };
    lab_speck(&l, "speck.gltf");
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        double turn         = (angles[i] + 100.0) * M_PI / 180.0;
        const lab_probe p[] = { { { 0, 0, 0 }, { sin(turn), cos(turn), 0 } },
                                { { 0, 0, 0 }, { cos(turn), -sin(turn), 0 } },
                                { { 0, 0, 0 }, up } };
        grid_result r;
        lab_measure(&l,
                    text_of(&l.a, NOTHING "site: {place: 50N 0E, north: %.17g}\n%s", angles[i],
                            SUN("100", "30")),
                    NULL, p, 3, &(run_options){ .accuracy = 0.01, .threads = 1 }, &r);
        assert_near(r.illuminance[0], 50000.0 * sqrt(0.75), 1e-4);
        assert_near(r.illuminance[2], 25000.0, 1e-4);
        assert_true(r.illuminance[1] <= 50000.0 * sun_radius()); /* its disk grazes the plane */
    }
}

/* ---- skies ----------------------------------------------------------------------------------- */

#define UNIFORM "sky: {model: uniform, horizontal: 10000, ground: 0.2}\n"
#define BLACK                                                                                      \
    "room: {size: [4, 5, 3], reflectance: 0, windows: [{wall: south, at: [1, 1], size: [2, "       \
    "1.2]}]}\n"

/* Half of the sky and half of the ground that is 0.2 times as bright: at the opening's middle. On
 * its sill half of the sky, level. */
TEST(sensors_in_a_window_see_what_is_outside)
{
    const lab_probe p[] = { { { 2, 0, 1.6 }, up },    { { 2, 0, 1.6 }, down },
                            { { 2, 0, 1.6 }, south }, { { 2, 0, 1.6 }, north },
                            { { 2, 0, 1 }, up },      { { 1, 0, 1.5 }, { 1, 0, 0 } } };
    const double want[] = { 5000, 1000, 6000, 0, 5000, 3000 };
    assert_lux(BLACK UNIFORM, p, want, 6, 0.01);
}

TEST(outside_the_ground_is_seen_from_the_line_where_it_begins)
{
    lab_speck(&l, "speck.gltf");
    const lab_probe p[] = { { { 9, 9, 0 }, up },    { { 9, 9, 0 }, down },
                            { { 9, 9, 0 }, south }, { { 9, 9, 50 }, down },
                            { { 9, 9, -1 }, up },   { { 9, 9, 0 }, { 0, 0.6, -0.8 } } };
    const double want[] = { 10000, 2000, 6000, 2000, 10000, 0.9 * 2000 + 0.1 * 10000 };
    assert_lux(NOTHING UNIFORM, p, want, 6, 0.01);
}

TEST(light_is_in_proportion_however_bright_the_sky)
{
    static const char *const lux[] = { "1", "1e6", "1e-6", "1e-12" };
    static const double factor[]   = { 1, 1e6, 1e-6, 1e-12 };
    const lab_probe p[]            = { { { 2, 1, 0.8 }, up },
                                       { { 2, 4, 0.8 }, up },
                                       { { 2, 4.9, 2 }, south } };
    grid_result first              = { 0 }, r;
    for (int i = 0; i < 4; i++) {
        const char *yaml =
            text_of(&l.a,
                    "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], "
                    "size: [2, 1.2]}]}\nsky: {model: overcast, horizontal: %s}\n",
                    lux[i]);
        lab_measure(&l, yaml, NULL, p, 3, &(run_options){ .accuracy = 0.05, .threads = 2 },
                    i ? &r : &first);
        for (int k = 0; i > 0 && k < 3; k++)
            assert_near(r.illuminance[k], factor[i] * first.illuminance[k], 1e-5); /* floats */
    }
}

/* ---- openings -------------------------------------------------------------------------------- */

static double through(double x0, double x1, double z0, double z1, dvec3 p, dvec3 normal)
{
    const dvec3 corner[4] = { { x0, 0, z0 }, { x1, 0, z0 }, { x1, 0, z1 }, { x0, 0, z1 } };
    return 10000.0 / M_PI * polygon_lux(corner, 4, p, normal);
}

TEST(a_slit_of_a_millimetre_lets_in_what_its_solid_angle_tells)
{
    const lab_probe p[] = { { { 2, 1, 0.5 }, up },
                            { { 2, 0.01, 0.5 }, north },
                            { { 2, 4, 2 }, south },
                            { { 2.0005, 0.001, 2 }, south } };
    double want[4];
    for (int k = 0; k < 4;
         k++) /* the south side is seen from within; above the horizon it is sky */
        want[k] = through(2, 2.001, fmax(0.2, p[k].at.z), 3.2, p[k].at, p[k].normal) +
                  0.2 * through(2, 2.001, 0.2, fmax(0.2, p[k].at.z), p[k].at, p[k].normal);
    assert_lux("room: {size: [4, 5, 3.5], reflectance: 0, windows: [{wall: south, at: [1.999, 0.2],"
               " size: [0.001, 3]}]}\n" UNIFORM,
               p, want, 4, 0.01);
}

TEST(a_hundred_windows_let_in_what_each_does)
{
    const lab_probe p[] = { { { 5, 2, 1 }, up },
                            { { 1, 4.9, 1.2 }, south },
                            { { 9.9, 1, 2 }, { -1, 0, 0 } } };
    double want[3]      = { 0 };
    char *list          = text_of(&l.a, "%s", "");
    for (int i = 0; i < 100; i++) {
        double x = 0.3 + i % 10, z = 0.2 + 0.5 * (i / 10);
        list = text_of(&l.a, "%s%s{wall: south, at: [%.17g, %.17g], size: [0.4, 0.3]}", list,
                       i ? ", " : "", 10.0 - x - 0.4, z);
        for (int k = 0; k < 3; k++) {
            double line = fmin(fmax(p[k].at.z, z), z + 0.3); /* the horizon */
            want[k] += through(x, x + 0.4, line, z + 0.3, p[k].at, p[k].normal) +
                       0.2 * through(x, x + 0.4, z, line, p[k].at, p[k].normal);
        }
    }
    assert_lux(
        text_of(&l.a, "room: {size: [10, 5, 5.5], reflectance: 0, windows: [%s]}\n" UNIFORM, list),
        p, want, 3, 0.01);
}

TEST(a_room_far_from_the_origin_is_lit_as_one_at_it)
{
    quad side[6], box[6], air = { { { 1, 0, 1 }, { 3, 0, 1 }, { 3, 0, 2.2 }, { 1, 0, 2.2 } } };
    int count = 0;
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 4, 5, 3 }, side);
    for (int i = 0; i < 6; i++) /* the south is open */
        if (side[i].corner[0].y + side[i].corner[1].y + side[i].corner[2].y != 0.0)
            box[count++] = side[i];
    assert_int_equal(count, 5);
    lab_quads(&l, "box.gltf", box, count, "\"name\":\"Box\"");
    lab_quads(&l, "air.gltf", &air, 1,
              "\"name\":\"Air\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
              "\"baseColorFactor\":[1,1,1,0]}");
    static const dvec3 at[] = { { 0, 0, 0 }, { 4e5, 6e6, 150 } };
    grid_result r[2];
    for (int i = 0; i < 2; i++) {
        const lab_probe p[] = { { d3_add(at[i], (dvec3){ 2, 1, 0.8 }), up },
                                { d3_add(at[i], (dvec3){ 1, 4, 0.001 }), up },
                                { d3_add(at[i], (dvec3){ 3, 4.999, 2 }), south } };
        const char *place   = text_of(&l.a, "at: [%.17g, %.17g, %.17g]", at[i].x, at[i].y, at[i].z);
        lab_measure(&l,
                    text_of(&l.a,
                            "scene: [{file: box.gltf, %s}, {file: air.gltf, portals: Air, %s}]\n"
                            "materials: [{match: Box, reflectance: 0.5}]\n"
                            "sky: {model: clear, sun_at: {azimuth: 190, elevation: 30}}\n",
                            place, place),
                    NULL, p, 3, &(run_options){ .accuracy = 0.02, .threads = 2 }, &r[i]);
    }
    lab_check("far away", &r[1], r[0].illuminance, 0.02, 0.02); /* both are as accurate as that */
}

/* ---- panoramas ------------------------------------------------------------------------------- */

static void write_panorama(int width, int height, const float *values)
{
    char path[4096];
    lux_error err      = { 0 };
    float *one         = (float *)(uintptr_t)values;
    image_channel c[3] = { { "B", one }, { "G", one }, { "R", one } };
    image im           = { .width = width, .height = height, .channel_count = 3, .channels = c };
    snprintf(path, sizeof path, "%s/sky.exr", l.folder);
    if (!image_write_exr(path, &im, false, NULL, &err))
        fail_msg("%s", err.text);
}

/* L pi outside whichever way one looks, and through a window by Lambert's formula. */
TEST(even_panoramas_of_any_shape_are_even)
{
    static const struct {
        int width, height;
    } shapes[] = { { 1, 1 }, { 2, 1 }, { 3, 1000 }, { 1000, 3 }, { 1, 2 } };
    static float even[3000];
    lab_speck(&l, "speck.gltf");
    for (int i = 0; i < 3000; i++)
        even[i] = 10.0f;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const lab_probe out[]   = { { { 0, 0, 0 }, up }, { { 0, 0, 0 }, { 0.6, 0, -0.8 } } };
        const double all[]      = { 1790.0 * M_PI, 1790.0 * M_PI };
        const lab_probe in[]    = { { { 2, 2, 0.5 }, up }, { { 1, 4, 1.7 }, south } };
        const dvec3 corner[4]   = { { 1, 0, 1 }, { 3, 0, 1 }, { 3, 0, 2.2 }, { 1, 0, 2.2 } };
        const double of_hole[2] = { 1790.0 * polygon_lux(corner, 4, in[0].at, in[0].normal),
                                    1790.0 * polygon_lux(corner, 4, in[1].at, in[1].normal) };
        write_panorama(shapes[i].width, shapes[i].height, even);
        assert_lux(NOTHING "sky: {model: panorama, file: sky.exr}\n", out, all, 2, 0.01);
        assert_lux(BLACK "sky: {model: panorama, file: sky.exr}\n", in, of_hole, 2, 0.01);
    }
}

#define WHOLE(test) cmocka_unit_test_setup_teardown(test, prepare, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WHOLE(a_sun_at_the_zenith_lights_level_ground_fully_and_grazes_walls),
        WHOLE(a_sun_on_the_horizon_is_down_and_one_just_above_is_cut_by_level_ground),
        WHOLE(a_sun_in_the_plane_of_a_window_hardly_comes_in),
        WHOLE(north_turns_the_sun_whatever_its_angle),
        WHOLE(sensors_in_a_window_see_what_is_outside),
        WHOLE(outside_the_ground_is_seen_from_the_line_where_it_begins),
        WHOLE(light_is_in_proportion_however_bright_the_sky),
        WHOLE(a_slit_of_a_millimetre_lets_in_what_its_solid_angle_tells),
        WHOLE(a_hundred_windows_let_in_what_each_does),
        WHOLE(a_room_far_from_the_origin_is_lit_as_one_at_it),
        WHOLE(even_panoramas_of_any_shape_are_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
