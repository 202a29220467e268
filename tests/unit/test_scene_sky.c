/* tests/unit/test_scene_sky.c -- what a scene holds of daylight: skies, suns, the ground, moments.
 */
#include "core/color.h"
#include "core/image.h"
#include "sim/moment_sky.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static lab l;
static notices said;

static int prepare(void **state)
{
    (void)state;
    lab_open(&l);
    said = (notices){ .a = &l.a };
    return 0;
}

static int forget(void **state)
{
    (void)state;
    lab_close(&l);
    return 0;
}

#define ROOM   "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
#define GRID   "grids: [{name: g, on: floor, spacing: 1}]\n"
#define LAMP   "lights: [{type: point, at: [1, 1, 1], intensity: 100, group: desk}]\n"
#define MOSCOW "site: {place: 55.7558N 37.6173E, altitude: 150, zone: Europe/Moscow}\n"

static const study *study_in_lab(const char *variant, const char *yaml)
{
    char path[4096];
    lux_error err = { 0 };
    lab_write(&l, "study.yaml", "%s", yaml);
    snprintf(path, sizeof path, "%s/study.yaml", l.folder);
    const study *s = study_read(&l.a, path, variant, &said, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static const scene *scene_with(const study *s, const scene_options *o)
{
    lux_error err       = { 0 };
    scene_options plain = { .threads = 1 };
    const scene *made   = scene_new(&l.a, s, o ? o : &plain, &said, &err);
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

static const scene *scene_in_lab(const char *yaml)
{
    return scene_with(study_in_lab(NULL, yaml), NULL);
}

static void assert_said(const char *what)
{
    for (const notice *n = said.first; n; n = n->next)
        if (strstr(n->text, what))
            return;
    fail_msg("`%s` is not said", what);
}

/* ---- what is measured ------------------------------------------------------------------------ */

static double lux(vec3 irradiance) { return LUMENS_PER_WATT * (double)rgb_luminance(irradiance); }

/* cd/m^2 straight up or down. */
static double luminance(const sky *s, float up)
{
    vvec3 wi = vspread((vec3){ 0, 0, up });
    vrgb all = sky_radiance(s, &wi, ALL_LANES);
    vec3 one = { lane(all.x, 0), lane(all.y, 0), lane(all.z, 0) };
    return LUMENS_PER_WATT * (double)rgb_luminance(one);
}

/* lx square to it. */
static double lux_of_sun(const scene *s, int i)
{
    return LUMENS_PER_WATT * (double)light_bounds_of(s->lights[i]).peak;
}

static const char *group(const scene *s, int number) { return s->groups[number]; }

/* ---- one moment ------------------------------------------------------------------------------ */

TEST(without_a_sky_there_is_no_daylight)
{
    const scene *s = scene_in_lab(ROOM LAMP GRID "sky: {model: none}\n");
    assert_int_equal(s->sky_count + s->sun_count + s->moment_count, 0);
    assert_null(s->moments);
    s = scene_in_lab(ROOM LAMP GRID);
    assert_int_equal(s->sky_count + s->sun_count + s->moment_count, 0);
}

TEST(an_overcast_sky_lights_the_ground_and_has_no_sun)
{
    const scene *s = scene_in_lab(ROOM LAMP GRID "sky: {model: overcast, horizontal: 10000}\n");
    assert_int_equal(s->sky_count, 2);
    assert_int_equal(s->sun_count, 0);
    assert_int_equal(s->moment_count, 1);
    assert_string_equal(group(s, s->skies[0].group), "sky");
    assert_string_equal(group(s, s->skies[1].group), "sky");
    assert_true(!s->skies[0].ground && s->skies[1].ground);
    assert_near(lux(s->skies[0].sky->horizontal), 10000.0, 1e-6); /* floats */
    assert_near(luminance(s->skies[1].sky, -1.0f), 0.2 * 10000.0 / M_PI, 1e-6);
    assert_near(luminance(s->skies[1].sky, 1.0f), 0.0, 0.0);
    /* Moon and Spencer: the zenith has 9 / (7 pi) of it */
    assert_near(luminance(s->skies[0].sky, 1.0f), 10000.0 * 9.0 / (7.0 * M_PI), 1e-5);
}

#define SUNNY                                                                                      \
    "sky: {model: clear, horizontal: 10000, sun_illuminance: 60000, ground: [0.1, 0.2, 0.4],\n"    \
    "      sun_at: {azimuth: 90, elevation: 30}"

TEST(a_clear_sky_has_a_sun_and_a_ground_that_both_light)
{
    const scene *s = scene_in_lab(ROOM LAMP GRID SUNNY "}\n");
    assert_int_equal(s->sky_count, 3);
    assert_int_equal(s->sun_count, 1);
    assert_int_equal(s->light_count, 2);
    const scene_light *sun = &s->light_info[1];
    assert_true(sun->sun && !s->light_info[0].sun);
    assert_string_equal(sun->name, "sun");
    assert_string_equal(group(s, sun->group), "sun");
    assert_true(isinf(sun->lumens) && sun->dimming == 1.0f && sun->dimmed_to == 1.0);
    assert_near(sun->at.x, -sqrt(0.75), 1e-6);
    assert_near(sun->at.z, -0.5, 1e-6);
    assert_near(lux_of_sun(s, 1), 60000.0, 1e-5);
    assert_true(light_has_extent(s->lights[1]));

    /* 30,000 lx of sun and 10,000 lx of sky on level ground, each in its group */
    double share = 0.2126 * 0.1 + 0.7152 * 0.2 + 0.0722 * 0.4;
    double sum   = 0.0;
    for (int i = 0; i < 3; i++)
        sum += s->skies[i].ground ? luminance(s->skies[i].sky, -1.0f) : 0.0;
    assert_near(sum, share * 40000.0 / M_PI, 1e-5);
    assert_string_equal(group(s, s->skies[2].group), "sun");
    assert_near(luminance(s->skies[2].sky, -1.0f), share * 30000.0 / M_PI, 1e-5);
}

TEST(a_sun_may_be_a_point_or_off)
{
    const scene *s = scene_in_lab(ROOM GRID SUNNY ", sun: point}\n");
    assert_int_equal(s->sun_count, 1);
    assert_false(light_has_extent(s->lights[0]));
    assert_near(lux_of_sun(s, 0), 60000.0, 1e-5);
    s = scene_in_lab(ROOM GRID "sky: {model: clear, horizontal: 10000, sun: off,\n"
                               "      sun_at: {azimuth: 90, elevation: 30}}\n");
    assert_int_equal(s->sun_count, 0);
    assert_int_equal(s->sky_count, 2);
    s = scene_in_lab(ROOM GRID "sky: {model: overcast, sun: disk, sun_illuminance: 5,\n"
                               "      sun_at: {azimuth: 90, elevation: 30}}\n");
    assert_int_equal(s->sun_count, 1);
}

TEST(black_ground_is_none)
{
    const scene *s =
        scene_in_lab(ROOM GRID "sky: {model: overcast, horizontal: 10000, ground: 0}\n");
    assert_int_equal(s->sky_count, 1);
}

TEST(what_is_not_given_in_lux_is_worked_out_by_formula)
{
    const scene *s       = scene_in_lab(ROOM GRID MOSCOW
                                        "when: 2026-06-21T10:00\nsky: {model: clear, turbidity: 4}\n");
    const sun_place *sun = &s->moments[0].sun;
    double h             = sun->apparent_elevation_deg;
    assert_near(lux(s->skies[0].sky->horizontal), sky_diffuse_lx(12, h, 150.0, 4.0), 1e-6);
    assert_near(lux_of_sun(s, 0), sky_sun_lx(h, 150.0, 4.0, sun->distance_au), 1e-5);
    assert_string_equal(s->moments[0].text, "2026-06-21T10:00+03:00");
}

TEST(a_sky_of_perez_has_his_figures)
{
    const study *of =
        study_in_lab(NULL, ROOM GRID "sky: {sun_at: {azimuth: 180, elevation: 45}, perez: "
                                     "{direct_normal: 600, diffuse_horizontal: 120}}\n");
    const scene *s = scene_with(of, NULL);
    moment_light m;
    lux_error err = { 0 };
    assert_true(moment_light_of(&l.a, of, &s->moments[0], &m, &err));
    assert_near(lux(s->skies[0].sky->horizontal), m.perez.diffuse_lx, 1e-5);
    assert_near(lux_of_sun(s, 0), m.perez.direct_normal_lx, 1e-5);
    assert_true(m.perez.direct_normal_lx > 40000.0 && m.perez.diffuse_lx > 10000.0);
}

TEST(at_night_all_is_dark_and_that_is_said)
{
    const scene *s =
        scene_in_lab(ROOM LAMP GRID MOSCOW "when: 2026-06-21T00:00\nsky: {model: clear}\n");
    assert_int_equal(s->sky_count + s->sun_count, 0);
    assert_int_equal(s->moment_count, 1);
    assert_said("study.yaml:7:6: the sun is below the horizon: the sky is dark");
    /* A sky that does not look at the sun, and is given in lux, is not */
    s = scene_in_lab(ROOM LAMP GRID MOSCOW
                     "when: 2026-06-21T00:00\nsky: {model: overcast, horizontal: 10}\n");
    assert_int_equal(s->sky_count, 2);
}

TEST(a_sun_that_gives_nothing_is_no_lamp)
{
    const scene *s =
        scene_in_lab(ROOM GRID "sky: {model: clear, horizontal: 10, sun_illuminance: 0,\n"
                               "      sun_at: {azimuth: 90, elevation: 30}}\n");
    assert_int_equal(s->sun_count, 0);
    assert_int_equal(s->sky_count, 2);
}

TEST(a_zone_far_from_the_place_is_doubted)
{
    scene_in_lab(ROOM GRID "site: {place: 55.7558N 37.6173W, zone: Europe/Moscow}\n"
                           "when: 2026-06-21T10:00\nsky: {model: clear}\n");
    assert_said("study.yaml:4:7: clocks of the zone (UTC+3 h) are far from the sun's time at "
                "longitude -37.62 (UTC-2.5 h): is the place right?");
}

/* ---- panoramas ------------------------------------------------------------------------------- */

TEST(a_panorama_brings_its_own_ground)
{
    enum { W = 8, H = 4 };
    static float pixels[3 * W * H];
    char path[4096];
    lux_error err = { 0 };
    for (int i = 0; i < 3 * W * H; i++)
        pixels[i] = 2.0f;
    image_channel channels[] = { { "R", pixels }, { "G", pixels }, { "B", pixels } };
    image im = { .width = W, .height = H, .channel_count = 3, .channels = channels };
    snprintf(path, sizeof path, "%s/sky.exr", l.folder);
    assert_true(image_write_exr(path, &im, false, &said, &err));
    const scene *s = scene_in_lab(ROOM GRID "sky: {panorama: {file: sky.exr, scale: 3}}\n");
    assert_int_equal(s->sky_count, 1);
    assert_false(s->skies[0].ground);
    assert_near(lux(s->skies[0].sky->horizontal), 179.0 * 6.0 * M_PI, 1e-5);
    assert_near(luminance(s->skies[0].sky, -1.0f), 179.0 * 6.0, 1e-6);
}

/* ---- variants and what is left out ----------------------------------------------------------- */

TEST(a_variant_changes_the_sky_of_a_scene)
{
    const char *yaml = ROOM LAMP GRID SUNNY "}\nvariants:\n  evening: {sky: {model: none}}\n"
                                            "  dull: {sky: {model: overcast, sun: off, "
                                            "sun_illuminance: ~}}\n";
    const scene *s   = scene_with(study_in_lab("evening", yaml), NULL);
    assert_int_equal(s->sky_count + s->sun_count, 0);
    s = scene_with(study_in_lab("dull", yaml), NULL);
    assert_int_equal(s->sun_count, 0);
    assert_int_equal(s->sky_count, 2);
}

TEST(lamps_and_glowing_surfaces_may_be_left_out)
{
    const quad q = { { { 1, 1, 1 }, { 2, 1, 1 }, { 2, 2, 1 }, { 1, 2, 1 } } };
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 100.0));
    const study *of = study_in_lab(NULL, ROOM LAMP GRID "scene: glow.gltf\n" SUNNY "}\n");
    const scene *s  = scene_with(of, NULL);
    assert_int_equal(s->light_count, 2);
    assert_int_equal(s->emitter_count, 2);
    s = scene_with(of, &(scene_options){ .threads = 1, .lamps_off = true });
    assert_int_equal(s->light_count, 1);
    assert_int_equal(s->sun_count, 1);
    assert_int_equal(s->emitter_count, 0);
    assert_false(s->glows);
}

/* ---- series ---------------------------------------------------------------------------------- */

TEST(each_moment_of_a_series_is_a_group_of_its_sun_and_sky)
{
    const study *of = study_in_lab(NULL, ROOM LAMP GRID MOSCOW
                                   "when: {date: 2026-03-21, from: 00:00, to: 12:00, step: 240}\n"
                                   "sky: {model: clear}\n");
    int count;
    lux_error err       = { 0 };
    const moment *all   = moments_of(&l.a, of, &of->when, &count, &said, &err);
    scene_options hours = { .threads = 1, .moments = all, .moment_count = count };
    const scene *s      = scene_with(of, &hours);
    assert_int_equal(count, 4); /* 00, 04: night; 08, 12: day */
    assert_int_equal(s->moment_count, 4);
    assert_int_equal(s->group_count, 5);
    assert_string_equal(group(s, 0), "lamps");
    for (int h = 0; h < 4; h++)
        assert_string_equal(group(s, 1 + h), all[h].text);
    assert_int_equal(s->sun_count, 2);
    assert_int_equal(s->sky_count, 6);
    assert_int_equal(s->light_info[0].group, 0);
    for (int k = 0; k < 2; k++) {
        assert_true(s->light_info[1 + k].sun);
        assert_int_equal(s->light_info[1 + k].group, 3 + k);
        for (int i = 0; i < 3; i++)
            assert_int_equal(s->skies[3 * k + i].group, 3 + k);
    }
    for (const notice *n = said.first; n; n = n->next) /* its command tells of all batches */
        assert_null(strstr(n->text, "below the horizon"));
}

#define WHOLE(test) cmocka_unit_test_setup_teardown(test, prepare, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WHOLE(without_a_sky_there_is_no_daylight),
        WHOLE(an_overcast_sky_lights_the_ground_and_has_no_sun),
        WHOLE(a_clear_sky_has_a_sun_and_a_ground_that_both_light),
        WHOLE(a_sun_may_be_a_point_or_off),
        WHOLE(black_ground_is_none),
        WHOLE(what_is_not_given_in_lux_is_worked_out_by_formula),
        WHOLE(a_sky_of_perez_has_his_figures),
        WHOLE(at_night_all_is_dark_and_that_is_said),
        WHOLE(a_sun_that_gives_nothing_is_no_lamp),
        WHOLE(a_zone_far_from_the_place_is_doubted),
        WHOLE(a_panorama_brings_its_own_ground),
        WHOLE(a_variant_changes_the_sky_of_a_scene),
        WHOLE(lamps_and_glowing_surfaces_may_be_left_out),
        WHOLE(each_moment_of_a_series_is_a_group_of_its_sun_and_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
