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

/* ---- more than one thing in the way ---------------------------------------------------------- */

static quad across(double y, double x0, double x1, double z0, double z1)
{
    return (quad){ { { x0, y, z0 }, { x1, y, z0 }, { x1, y, z1 }, { x0, y, z1 } } };
}

/* Before the hole a porch of 1.5 m, as wide as it, with a surface of nothing over its far end: of
 * `portals` one or both, which lie one behind the other. */
TEST(portals_one_behind_the_other_let_the_sun_in_once)
{
    static const char yaml[] =
        "scene: [box.gltf, porch.gltf, {file: air.gltf, portals: Air}, {file: far.gltf%s}]\n"
        "materials: [{match: Box, reflectance: 0.5}]\n" SUN_ALONE("185", "25", "disk") "0}\n";
    quad side[6], porch[4], far = across(-1.5, 1, 3, 1, 2.2);
    int count = 0;
    grid_result one, both;
    lab l;
    lab_open(&l);
    write_box(&l);
    quads_of_box((dvec3){ 1, -1.5, 1 }, (dvec3){ 3, 0, 2.2 }, side);
    for (int i = 0; i < 6; i++) {
        bool level = true;
        for (int k = 1; k < 4; k++)
            level = level && side[i].corner[k].y == side[i].corner[0].y;
        if (!level)
            porch[count++] = side[i];
    }
    lab_quads(&l, "porch.gltf", porch, count, "\"name\":\"Box\"");
    lab_quads(&l, "far.gltf", &far, 1,
              "\"name\":\"Air\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
              "\"baseColorFactor\":[1,1,1,0]}");
    run_options o = { .accuracy = 0.02, .threads = 2 };
    lab_measure(&l, text_of(&l.a, yaml, ""), NULL, probe, SENSORS, &o, &one);
    lab_measure(&l, text_of(&l.a, yaml, ", portals: Air"), NULL, probe, SENSORS, &o, &both);
    grid_moment want = light_of(&one), got = light_of(&both);
    assert_true(one.illuminance[1] > 1.0);
    assert_agree("one portal and two", &got, &want, SENSORS);
    lab_close(&l);
}

/* A sheet that lets a twentieth through, between the patch and the rear of the room: what the patch
 * lights there is a twentieth as bright, whether a sun or a lamp of the same light makes the patch.
 */
TEST(light_of_a_patch_is_dimmed_by_what_stands_in_the_room)
{
    static const char scene_of[] = "scene: [box.gltf, {file: air.gltf, portals: Air}, sheet.gltf]\n"
                                   "materials: [{match: Box, reflectance: 0.5}]\n";
    static const char lamp[] =
        "lights: [{type: parallel, aim: [0, 0.76604444, -0.64278761], illuminance: 50000}]\n";
    quad sheet = across(3.2, 0, 4, 0, 3);
    grid_result sun, by_lamp;
    lab l;
    lab_open(&l);
    write_box(&l);
    lab_quads(&l, "sheet.gltf", &sheet, 1,
              "\"name\":\"Sheet\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
              "\"baseColorFactor\":[0.2,0.2,0.2,0.95]}");
    run_options o = { .accuracy = 0.04, .threads = 2 };
    lab_measure(&l, text_of(&l.a, "%s%s", scene_of, SUN_ALONE("180", "40", "point") "0}\n"), NULL,
                probe, SENSORS, &o, &sun);
    lab_measure(&l, text_of(&l.a, "%s%s", scene_of, lamp), NULL, probe, SENSORS, &o, &by_lamp);
    grid_moment want = light_of(&by_lamp), got = light_of(&sun);
    assert_agree("sun and lamp", &got, &want, SENSORS);
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
        cmocka_unit_test(portals_one_behind_the_other_let_the_sun_in_once),
        cmocka_unit_test(light_of_a_patch_is_dimmed_by_what_stands_in_the_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
