/* tests/physics/test_daylight_paths.c -- the same light of day whatever is known of openings, for
 * points and disks of suns, for groups of light, for each moment of a series.
 */
#include "tests/physics/daylight_paths.h"

TEST(a_sky_gives_the_same_whatever_is_known_of_the_opening)
{
    all_openings_agree("sky: {model: clear, sun: off, sun_at: {azimuth: 200, elevation: 40}}\n",
                       0.02, 0.06, 0.15);
}

TEST(a_sun_gives_the_same_whatever_is_known_of_the_opening)
{
    all_openings_agree(SUN_ALONE("200", "40", "disk") "0}\n", 0.02, 0.06, 0.15);
    all_openings_agree(SUN_ALONE("160", "30", "point") "0.4}\n", 0.02, 0.06, 0.15);
}

TEST(a_panorama_gives_the_same_whatever_is_known_of_the_opening)
{
    all_openings_agree("sky: {model: panorama, file: sky.exr}\n", 0.02, 0.06, 0.15);
}

TEST(a_point_and_a_disk_of_a_sun_give_the_same_far_from_shadow_edges)
{
    grid_result disk, point;
    lab l;
    lab_open(&l);
    measure(&l, ROOM_WINDOW, SUN_ALONE("170", "35", "disk") "0.2}\n", 0.01, &disk);
    measure(&l, ROOM_WINDOW, SUN_ALONE("170", "35", "point") "0.2}\n", 0.01, &point);
    grid_moment of_disk = light_of(&disk), of_point = light_of(&point);
    assert_agree("disk and point", &of_disk, &of_point, SENSORS);
    lab_close(&l);
}

/* ---- groups and moments ---------------------------------------------------------------------- */

#define FURNISHED                                                                                  \
    "site: {place: 52.5N 13.4E, zone: Europe/Berlin, north: 20}\nmaintenance: 0.8\n"               \
    "lights: [{type: rect, at: [1, 3, 2.9], size: [0.6, 0.6], lumens: 2000, dimming: 0.5}]\n"      \
    "grids: [{name: g, origin: [0.5, 0.5, 0.1], u: [3, 0, 0], v: [0, 4, 0], spacing: 1},\n"        \
    "        {name: roof, origin: [0, 0, 3.5], u: [1, 0, 0], v: [0, 1, 0], spacing: 1}]\n"         \
    "sky: {model: clear, turbidity: 4}\n"
#define SERIES "when: {date: 2026-03-21, from: \"09:00\", to: \"15:00\", step: 120}\n"
enum { HOURS = 4, CELLS = 12 };

static const study *study_of_lab(lab *l, const char *yaml)
{
    char path[4096];
    lux_error err = { 0 };
    lab_write(l, "study.yaml", "lux4: 1\n%s%s", walls[ROOM_WINDOW], yaml);
    snprintf(path, sizeof path, "%s/study.yaml", l->folder);
    const study *s = study_read(&l->a, path, NULL, NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static const scene *scene_with(lab *l, const study *s, const scene_options *o)
{
    lux_error err     = { 0 };
    const scene *made = scene_new(&l->a, s, o, NULL, &err);
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

static int group_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->group_count; i++)
        if (!strcmp(s->groups[i], name))
            return i;
    fail_msg("no group %s", name);
    return -1;
}

static void run(lab *l, const scene *s, int grid, grid_result *out)
{
    grid_of_scene(&l->a, s, grid, &(run_options){ .accuracy = 0.02, .seed = 3, .threads = 2 }, out);
}

TEST(sun_sky_and_lamps_add_up_to_all)
{
    grid_result plain, r;
    lab l;
    lab_open(&l);
    const study *of = study_of_lab(&l, FURNISHED "when: 2026-03-21T13:00\n");
    run(&l, scene_with(&l, of, &(scene_options){ .threads = 1 }), 0, &plain);
    const scene *s = scene_with(&l, of, &(scene_options){ .threads = 1, .layered = true });
    run(&l, s, 0, &r);
    assert_int_equal(r.layer_count, 3);
    const grid_layer *sun = &r.layers[group_of(s, "sun")], *of_sky = &r.layers[group_of(s, "sky")];
    const grid_layer *lamps = &r.layers[group_of(s, "other")];
    for (int k = 0; k < CELLS; k++) {
        double sum = 0.5 * lamps->illuminance[k] + sun->illuminance[k] + of_sky->illuminance[k];
        double all = 0.5 * lamps->direct[k] + sun->direct[k] + of_sky->direct[k];
        assert_near(sum, r.illuminance[k], 1e-5); /* floats */
        assert_near(all, r.direct[k], 1e-5);
        assert_true(sun->illuminance[k] > 0.0 && of_sky->illuminance[k] > 0.0);
    }
    grid_moment one = light_of(&plain), layered = light_of(&r);
    assert_agree("with layers and without", &one, &layered, CELLS);
    lab_close(&l);
}

/* Of the sun, all but light from the sun itself by way of its mean cosine is open: a hole. */
static void assert_sun_seen(const double *share, const scene *s, const grid_result *in,
                            const grid_result *roof)
{
    int group = group_of(s, "sun");
    for (int k = 0; k < CELLS; k++) {
        double seen = in->layers[group].direct[k] / roof->layers[group].direct[0];
        /* Half shadows are counted by rays of their own: 16 scrambles of 16 or more. */
        double chance = share[k] > 0.0 && share[k] < 1.0 ? 0.05 : 1e-4;
        if (!(fabs(seen - share[k]) <= chance))
            fail_msg("sensor %d sees %.4g of the sun, not %.4g", k, share[k], seen);
    }
}

TEST(each_moment_of_a_series_is_what_it_is_alone)
{
    grid_result all, one, roof;
    lab l;
    lab_open(&l);
    const study *of     = study_of_lab(&l, FURNISHED SERIES);
    lux_error err       = { 0 };
    int count           = 0;
    const moment *hours = moments_of(&l.a, of, &of->when, &count, NULL, &err);
    assert_int_equal(count, HOURS);
    run(&l,
        scene_with(&l, of,
                   &(scene_options){ .threads = 1, .moments = hours, .moment_count = HOURS }),
        0, &all);
    assert_int_equal(all.moment_count, HOURS);
    for (int h = 0; h < HOURS; h++) {
        const char *yaml = text_of(&l.a, FURNISHED "when: %s\n", hours[h].text);
        const scene *s   = scene_with(&l, study_of_lab(&l, yaml),
                                      &(scene_options){ .threads = 1, .layered = true });
        run(&l, s, 0, &one);
        run(&l, s, 1, &roof);
        grid_moment alone = light_of(&one);
        assert_agree(yaml, &all.moments[h], &alone, CELLS);
        assert_sun_seen(all.moments[h].sun, s, &one, &roof);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sky_gives_the_same_whatever_is_known_of_the_opening),
        cmocka_unit_test(a_sun_gives_the_same_whatever_is_known_of_the_opening),
        cmocka_unit_test(a_panorama_gives_the_same_whatever_is_known_of_the_opening),
        cmocka_unit_test(a_point_and_a_disk_of_a_sun_give_the_same_far_from_shadow_edges),
        cmocka_unit_test(sun_sky_and_lamps_add_up_to_all),
        cmocka_unit_test(each_moment_of_a_series_is_what_it_is_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
