/* tests/unit/test_study.c -- what a good study comes to, field by field. */
#include "sim/study.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;

static const study *good(const char *text)
{
    lux_error err  = { 0 };
    const study *s = study_parse(&memory, "job/office.yaml", NULL, text, strlen(text), NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static void assert_place(dvec3 p, double x, double y, double z)
{
    assert_true(p.x == x && p.y == y && p.z == z);
}

static void assert_rgb(vec3 c, double r, double g, double b)
{
    assert_near(c.x, r, 1e-6); /* floats */
    assert_near(c.y, g, 1e-6);
    assert_near(c.z, b, 1e-6);
}

TEST(what_is_not_given_has_its_default)
{
    const study *s = good("lux4: 1\n");
    assert_string_equal(s->path, "job/office.yaml");
    assert_string_equal(s->folder, "job");
    assert_false(s->room.given || s->maintenance_given);
    assert_true(s->maintenance == 1.0 && isnan(s->accuracy));
    assert_int_equal(s->scene_count + s->luminaire_count + s->light_count, 0);
    assert_int_equal(s->material_count + s->grid_count + s->view_count, 0);
}

TEST(a_room_has_a_size_and_reflectances)
{
    const study *s = good("lux4: 1\n"
                          "room: {size: [10, 6.5, 3e0],\n"
                          "       reflectance: {ceiling: 0.7, walls: [0.1, 0.2, 0.3], floor: 1}}\n"
                          "sky: {model: none}\nmaintenance: 0.8\naccuracy: 2%\n");
    assert_true(s->room.given && s->maintenance_given);
    assert_place(s->room.size, 10, 6.5, 3);
    assert_rgb(s->room.ceiling, 0.7, 0.7, 0.7);
    assert_rgb(s->room.walls, 0.1, 0.2, 0.3);
    assert_rgb(s->room.floor, 1, 1, 1);
    assert_int_equal(s->room.where.line, 2);
    assert_int_equal(s->room.where.column, 7);
    assert_near(s->maintenance, 0.8, 0);
    assert_near(s->accuracy, 0.02, 1e-15);

    s = good("lux4: 1\nroom: {size: [1, 1, 1], reflectance: 0.5}\naccuracy: 0.5 %");
    assert_rgb(s->room.ceiling, 0.5, 0.5, 0.5);
    assert_rgb(s->room.walls, 0.5, 0.5, 0.5);
    assert_rgb(s->room.floor, 0.5, 0.5, 0.5);
    assert_near(s->accuracy, 0.005, 1e-15);
}

TEST(a_scene_is_a_file_or_a_list_of_them)
{
    const study *s = good("lux4: 1\nscene: office.glb\n");
    assert_int_equal(s->scene_count, 1);
    assert_string_equal(s->scenes[0].file, "job/office.glb");
    assert_int_equal(s->scenes[0].at_count, 1);
    assert_place(s->scenes[0].at[0], 0, 0, 0);
    assert_true(s->scenes[0].lights && s->scenes[0].scale == 1.0);

    s = good("lux4: 1\n"
             "scene:\n"
             "  - {file: /abs/office.glb, scale: 0.001, lights: off}\n"
             "  - {file: ../desk.glb, at: [[2, 1.5, 0], [4, 1.5, 0]], rotate: -90, lights: true}\n"
             "  - {file: one.glb, at: [1, 2, 3]}\n"
             "  - plain.glb\n");
    assert_int_equal(s->scene_count, 4);
    assert_string_equal(s->scenes[0].file, "/abs/office.glb");
    assert_true(s->scenes[0].scale == 0.001 && !s->scenes[0].lights);
    assert_string_equal(s->scenes[1].file, "job/../desk.glb");
    assert_int_equal(s->scenes[1].at_count, 2);
    assert_place(s->scenes[1].at[1], 4, 1.5, 0);
    assert_true(s->scenes[1].rotate_deg == -90.0 && s->scenes[1].lights);
    assert_place(s->scenes[2].at[0], 1, 2, 3);
    assert_string_equal(s->scenes[3].file, "job/plain.glb");
    assert_int_equal(s->scenes[3].where.line, 6);
}

TEST(a_luminaire_has_photometry_and_places)
{
    static const char text[] = "lux4: 1\n"
                               "luminaires:\n"
                               "  - {name: downlight, photometry: downlight.ies,\n"
                               "     at: [[2.5, 1.5, 2.99], [7.5, 1.5, 2.99]],\n"
                               "     aim: [0, 1, -1], rotate: 45, dimming: 0.5,\n"
                               "     lumens: 3000, color: [2, 2, 2], watts: 24}\n"
                               "  - photometry: b.ldt\n"
                               "    at: [0, 0, 3]\n"
                               "    lamp_lumens: 4000\n";
    const study *s           = good(text);
    const study_luminaire *l = s->luminaires;
    assert_int_equal(s->luminaire_count, 2);
    assert_string_equal(l->name, "downlight");
    assert_string_equal(l->photometry, "job/downlight.ies");
    assert_int_equal(l->at_count, 2);
    assert_place(l->at[1], 7.5, 1.5, 2.99);
    assert_place(l->aim, 0, 1, -1);
    assert_true(l->rotate_deg == 45.0 && l->lumens == 3000.0 && l->watts == 24.0);
    assert_true(isnan(l->lamp_lumens) && l->emission.dimming == 0.5);
    assert_rgb(l->emission.color, 1, 1, 1);
    assert_null(l->emission.group);

    l = &s->luminaires[1];
    assert_null(l->name);
    assert_true(l->lamp_lumens == 4000.0 && isnan(l->lumens) && isnan(l->watts));
    assert_true(l->rotate_deg == 0.0 && l->emission.dimming == 1.0);
    assert_place(l->aim, 0, 0, -1);
    assert_rgb(l->emission.color, 1, 1, 1);
    assert_int_equal(l->where.line, 7);
    assert_int_equal(l->where.column, 5);
}

TEST(a_point_light_has_candelas_or_lumens)
{
    const study *s =
        good("lux4: 1\n"
             "lights:\n"
             "  - {type: point, at: [0, 0, 3], intensity: 100, name: bulb}\n"
             "  - {lumens: 1256.6370614359172, at: [[0, 0, 3], [1, 0, 3]], type: point,\n"
             "     color: [1, 0, 0], dimming: 2}\n");
    assert_int_equal(s->light_count, 2);
    assert_string_equal(s->lights[0].name, "bulb");
    assert_true(s->lights[0].intensity == 100.0);
    assert_true(s->lights[1].lumens == 1256.6370614359172 && isnan(s->lights[1].intensity));
    assert_int_equal(s->lights[1].at_count, 2);
    assert_rgb(s->lights[1].emission.color, 1.0 / 0.2126, 0, 0);
    assert_true(s->lights[1].emission.dimming == 2.0);
}

TEST(a_material_has_a_pattern_and_a_reflectance)
{
    const study *s = good("lux4: 1\nmaterials:\n"
                          "  - {match: \"Wall*\", reflectance: 0.5}\n"
                          "  - {match: Floor \xc3\xa9, reflectance: [0.3, 0.25, 0.2]}\n");
    assert_int_equal(s->material_count, 2);
    assert_string_equal(s->materials[0].match, "Wall*");
    assert_rgb(s->materials[0].reflectance, 0.5, 0.5, 0.5);
    assert_string_equal(s->materials[1].match, "Floor \xc3\xa9");
    assert_rgb(s->materials[1].reflectance, 0.3, 0.25, 0.2);
}

TEST(a_grid_is_a_plane_a_file_or_over_the_room)
{
    const study *s =
        good("lux4: 1\n"
             "grids:\n"
             "  - {name: desk, on: room, height: 0.75, margin: 0.5, spacing: en12464,\n"
             "     require: {average: 500, minimum: 300, uniformity: 0.6}}\n"
             "  - {name: plane, origin: [0, 0, 0.75], u: [10, 0, 0], v: [0, 6, 0], spacing: 0.5}\n"
             "  - {name: probes, points: probes.csv}\n"
             "  - {name: floor, on: room, height: 0, spacing: 100}\n"
             "room: {size: [10, 6, 3], reflectance: 0.5}\n");
    double along_u, along_v;
    assert_int_equal(s->grid_count, 4);
    const study_grid *g = s->grids;
    assert_string_equal(g->name, "desk");
    assert_place(g->origin, 0.5, 0.5, 0.75);
    assert_place(g->u, 9, 0, 0);
    assert_place(g->v, 0, 5, 0);
    assert_true(g->on == SIDE_ROOM && g->en12464);
    assert_near(g->spacing, 9.0 / 11.0, 1e-15); /* p(9 m) = 0.928 m: 9.7 cells, so 11 */
    assert_true(g->require_average == 500.0 && g->require_minimum == 300.0);
    assert_near(g->require_uniformity, 0.6, 0);
    study_grid_counts(g, &along_u, &along_v);
    assert_true(along_u == 11.0 && along_v == 7.0); /* 5 m / 0.818 m = 6.1 */

    g++;
    assert_place(g->origin, 0, 0, 0.75);
    assert_place(g->v, 0, 6, 0);
    assert_true(g->spacing == 0.5 && !g->on && !g->points && isnan(g->require_average));
    study_grid_counts(g, &along_u, &along_v);
    assert_true(along_u == 20.0 && along_v == 12.0);

    g++;
    assert_string_equal(g->points, "job/probes.csv");

    g++;
    assert_place(g->u, 10, 0, 0); /* no margin */
    study_grid_counts(g, &along_u, &along_v);
    assert_true(along_u == 1.0 && along_v == 1.0); /* never none */
}

TEST(a_view_is_an_eye_or_a_camera)
{
    const study *s = good(
        "lux4: 1\n"
        "views:\n"
        "  - {name: corner, eye: [0.2, 0.2, 1.6], target: [5, 3, 1], fov: 70, size: [1920, 1080]}\n"
        "  - {name: plan, eye: [5, 3, 9], target: [5, 3, 0], projection: orthographic, width: 12}\n"
        "  - {name: cam, camera: Camera.001}\n"
        "  - {name: plain, eye: [0, 0, 0], target: [1, 0, 0], projection: perspective}\n");
    assert_int_equal(s->view_count, 4);
    const study_view *v = s->views;
    assert_place(v->eye, 0.2, 0.2, 1.6);
    assert_place(v->target, 5, 3, 1);
    assert_true(v->fov_deg == 70.0 && v->size_given && v->projection == PROJECTION_PERSPECTIVE);
    assert_int_equal(v->width, 1920);
    assert_int_equal(v->height, 1080);
    assert_true(v[1].projection == PROJECTION_ORTHOGRAPHIC && v[1].width_m == 12.0);
    assert_string_equal(v[2].camera, "Camera.001");
    assert_int_equal(v[2].width, 1024);
    assert_int_equal(v[2].height, 768);
    assert_false(v[2].size_given);
    assert_true(v[3].fov_deg == 60.0 && isnan(v[3].width_m) && !v[3].camera);
}

TEST(numbers_are_those_of_yaml_1_2)
{
    static const struct {
        const char *text;
        double value;
    } table[] = {
        { "7", 7 },      { "+7", 7 },    { "-.5", -0.5 }, { "5.", 5 },    { "1.25e-3", 1.25e-3 },
        { "1E3", 1000 }, { "0x1F", 31 }, { "0xaB", 171 }, { "0o17", 15 }, { "017", 17 }
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char text[100];
        snprintf(text, sizeof text, "lux4: 1\nscene: {file: a, rotate: %s}\n", table[i].text);
        assert_true(good(text)->scenes[0].rotate_deg == table[i].value);
    }
}

TEST(byte_order_marks_crlf_comments_and_aliases_are_understood)
{
    const study *s = good("\xef\xbb\xbf%YAML 1.2\r\n---\r\nlux4: 1 # the version\r\n"
                          "scene: {file: a, at: &p [1, 2, 3]}\r\n"
                          "lights: [{type: point, at: *p, intensity: 1}]\r\n...\r\n");
    assert_place(s->lights[0].at[0], 1, 2, 3);
    assert_int_equal(s->scenes[0].where.line, 4);
    assert_int_equal(good("\xef\xbb\xbfscene: {file: a}\nlux4: 1")->scenes[0].where.column, 8);
}

TEST(paths_start_at_the_folder_of_the_study)
{
    static const char *const table[][3] = { { "a.yaml", ".", "./x.glb" },
                                            { "a/b/c.yaml", "a/b", "a/b/x.glb" },
                                            { "/c.yaml", "/", "/x.glb" },
                                            { "./c.yaml", ".", "./x.glb" } };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        static const char text[] = "{lux4: 1, scene: x.glb}";
        const study *s = study_parse(&memory, table[i][0], NULL, text, strlen(text), NULL, NULL);
        assert_string_equal(s->folder, table[i][1]);
        assert_string_equal(s->scenes[0].file, table[i][2]);
    }
}

/* EN 12464-1:2011, table A.1: side, largest cell (rounded, and above the formula for areas below
 * 1 m), number of points at least. */
TEST(spacings_are_those_of_en_12464_1)
{
    static const double table[][3] = { { 0.4, 0.15, 3 }, { 0.6, 0.2, 3 }, { 1, 0.2, 5 },
                                       { 2, 0.3, 6 },    { 5, 0.6, 8 },   { 10, 1, 10 },
                                       { 25, 2, 12 },    { 50, 3, 17 },   { 100, 5, 20 } };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        double side    = table[i][0], cells, other;
        double spacing = study_counts_en12464(side, side, &cells, &other);
        assert_true(spacing <= table[i][1] * (1 + 1e-9));
        assert_true(cells >= table[i][2] && fmod(cells, 2.0) == 1.0);
        assert_true(other == cells);
        assert_near(spacing, side / cells, 1e-15);
        assert_true(side / (cells - 2) > 0.2 * pow(5.0, log10(side))); /* no two too many */
    }
}

static void assert_counts(double side, double other, double along_side, double along_other)
{
    double a, b;
    study_counts_en12464(side, other, &a, &b);
    if (a != along_side || b != along_other)
        fail_msg("%g by %g m: %g by %g", side, other, a, b);
}

TEST(counts_by_en_12464_1_are_odd_on_both_sides)
{
    assert_counts(10, 10, 11, 11);         /* p = 1 m: 10, made odd */
    assert_counts(10 + 1e-12, 10, 11, 11); /* 11 - 2 * 0.5, rounded */
    assert_counts(1, 1, 5, 5);             /* p = 0.2 m: 5, whatever pow() rounds to */
    assert_counts(10, 5.1, 11, 5);         /* 5.1 / (10 / 11) = 5.61: 5 is nearer than 7 */
    assert_counts(10, 5.6, 11, 7);         /* 6.16: 7 is */
    assert_counts(5.1, 10, 5, 11);
    assert_counts(20, 10, 23,
                  11); /* twice as long: d is the shorter side; 22, of the two the more */
    assert_counts(10, 100, 11, 111);     /* 110, likewise */
    assert_counts(100, 100, 21, 21);     /* p = 5 m */
    assert_counts(1000, 1000, 101, 101); /* 25 m by the formula, 10 m at most */
}

TEST(patterns_match_whole_names)
{
    static const struct {
        const char *pattern, *name;
        bool matches;
    } table[] = { { "Wall", "Wall", true },   { "Wall", "Wall2", false },
                  { "Wall", "Wal", false },   { "Wall*", "Wall", true },
                  { "Wall*", "Walls", true }, { "*", "", true },
                  { "", "", true },           { "", "a", false },
                  { "?", "", false },         { "?", "a", true },
                  { "?", "\xc3\xa9", true },  { "??", "\xc3\xa9", false },
                  { "*a*b", "xaxxb", true },  { "*a*b", "xaxxbc", false },
                  { "a*", "ba", false },      { "*.00?", "A.00.001", true },
                  { "a**b", "ab", true },     { "*ab", "aab", true },
                  { "?*?", "a", false },      { "a", "A", false } };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (study_match(table[i].pattern, table[i].name) != table[i].matches)
            fail_msg("%s on %s", table[i].pattern, table[i].name);
}

TEST(a_hostile_pattern_costs_no_more_than_its_length_times_the_name)
{
    char name[10001], pattern[1001];
    memset(name, 'a', 10000), name[10000] = '\0';
    for (int i = 0; i < 998; i += 2)
        pattern[i] = '*', pattern[i + 1] = 'a';
    strcpy(pattern + 998, "*b");
    assert_false(study_match(pattern, name)); /* 2^500 steps where each * is tried anew */
}

TEST(later_stages_can_point_into_the_study)
{
    const study *s = good("lux4: 1\nscene: a.glb\n");
    lux_error err  = { 0 };
    assert_null(study_failed(s, s->scenes[0].where, &err, ERR_IO, "no file %s", "a.glb"));
    assert_string_equal(err.text, "job/office.yaml:2:8: no file a.glb");
    assert_int_equal(err.code, ERR_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_is_not_given_has_its_default, forget),
        cmocka_unit_test_teardown(a_room_has_a_size_and_reflectances, forget),
        cmocka_unit_test_teardown(a_scene_is_a_file_or_a_list_of_them, forget),
        cmocka_unit_test_teardown(a_luminaire_has_photometry_and_places, forget),
        cmocka_unit_test_teardown(a_point_light_has_candelas_or_lumens, forget),
        cmocka_unit_test_teardown(a_material_has_a_pattern_and_a_reflectance, forget),
        cmocka_unit_test_teardown(a_grid_is_a_plane_a_file_or_over_the_room, forget),
        cmocka_unit_test_teardown(a_view_is_an_eye_or_a_camera, forget),
        cmocka_unit_test_teardown(numbers_are_those_of_yaml_1_2, forget),
        cmocka_unit_test_teardown(byte_order_marks_crlf_comments_and_aliases_are_understood,
                                  forget),
        cmocka_unit_test_teardown(paths_start_at_the_folder_of_the_study, forget),
        cmocka_unit_test(spacings_are_those_of_en_12464_1),
        cmocka_unit_test(counts_by_en_12464_1_are_odd_on_both_sides),
        cmocka_unit_test(patterns_match_whole_names),
        cmocka_unit_test(a_hostile_pattern_costs_no_more_than_its_length_times_the_name),
        cmocka_unit_test_teardown(later_stages_can_point_into_the_study, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
