/* tests/unit/test_room_windows.c -- windows of the plain room: where they are, what is left of the
 * walls, that rays leave by nothing else, and what is refused.
 */
#include "sim/room.h"
#include "sim/scene.h"
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

#define ROOM "lux4: 1\nroom: {size: [4, 6, 3], reflectance: 0.5, windows: "
#define MANY                                                                                       \
    "[{wall: south, at: [0.5, 0.9], size: [1.2, 1.5], transmittance: 0.8}, "                       \
    "{wall: south, at: [1.7, 0.7], size: [1.1, 1.6]}, " /* beside it */                            \
    "{wall: south, at: [0.6, 2.5], size: [0.3, 0.3], transmittance: 0.5}, "                        \
    "{wall: east, at: [1, 0.2], size: [4.1, 2.7], transmittance: 0.8}, "                           \
    "{wall: north, at: [0.001, 0.001], size: [3.998, 2.998]}, "                                    \
    "{wall: west, at: [0.1, 1], size: [0.37, 1.1]}, {wall: west, at: [3, 2], size: [2, 0.5]}, "    \
    "{wall: ceiling, at: [1, 2], size: [0.7, 3]}, {wall: floor, at: [2, 1], size: [1, 1]}]}"

static arena memory;

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static const study *study_with(const char *windows)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s", ROOM, windows);
    return study_of_text(&memory, NULL, text);
}

static const scene *scene_with(const char *windows)
{
    lux_error err = { 0 };
    const scene *s =
        scene_new(&memory, study_with(windows), &(scene_options){ .threads = 1 }, NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static room_mesh mesh_with(const char *windows)
{
    room_mesh m;
    lux_error err = { 0 };
    if (!room_make(&memory, &study_with(windows)->room, &m, &err))
        fail_msg("%s", err.text);
    return m;
}

/* Twice the area, as a vector along the normal. */
static dvec3 twice_area(const room_mesh *m, uint32_t t)
{
    const uint32_t *c = &m->corners[3 * t];
    dvec3 a           = m->positions[c[0]];
    return d3_cross(d3_sub(m->positions[c[1]], a), d3_sub(m->positions[c[2]], a));
}

TEST(walls_and_windows_together_are_the_box)
{
    room_mesh m    = mesh_with(MANY);
    double made[5] = { 0 };
    for (uint32_t t = 0; t < m.triangle_count; t++) {
        double area = 0.5 * d3_length(twice_area(&m, t));
        assert_true(area > 0.0);
        assert_true(m.material[t] < 5);
        made[m.material[t]] += area;
    }
    /* Closed forms; 0.8 is the first transmittance met, 0.5 the second */
    double south = 1.2 * 1.5 + 1.1 * 1.6 + 0.09, east = 4.1 * 2.7, north = 3.998 * 2.998;
    double west = 0.37 * 1.1 + 2 * 0.5;
    assert_near(made[ROOM_MATERIALS], 1.2 * 1.5 + east, 1e-12);
    assert_near(made[ROOM_MATERIALS + 1], 0.09, 1e-12);
    assert_near(made[ROOM_CEILING], 24 - 0.7 * 3, 1e-12);
    assert_near(made[ROOM_FLOOR], 24 - 1, 1e-12);
    assert_near(made[ROOM_WALLS], 60 - south - east - north - west, 1e-12);
}

TEST(every_front_is_inside)
{
    room_mesh m  = mesh_with(MANY);
    dvec3 middle = { 2, 3, 1.5 };
    for (uint32_t t = 0; t < m.triangle_count; t++) {
        dvec3 to = d3_sub(middle, m.positions[m.corners[3 * t]]);
        assert_true(d3_dot(twice_area(&m, t), to) > 0.0);
    }
}

/* Every directed edge between two places is there once in each direction, but around holes: so no
 * edge of a triangle ends within another's. */
TEST(triangles_meet_edge_to_edge)
{
    room_mesh m  = mesh_with(MANY);
    int alone    = 0;
    double bound = 0.0;
    for (uint32_t i = 0; i < 3 * m.triangle_count; i++) {
        uint32_t from = m.corners[i], to = m.corners[i % 3 == 2 ? i - 2 : i + 1];
        int back = 0;
        for (uint32_t j = 0; j < 3 * m.triangle_count; j++)
            back += m.corners[j] == to && m.corners[j % 3 == 2 ? j - 2 : j + 1] == from;
        assert_true(back <= 1);
        if (back == 0) {
            alone++;
            bound += d3_length(d3_sub(m.positions[from], m.positions[to]));
        }
    }
    /* The borders of the open ones; beside the pane that touches one, that is the pane's */
    double open = 2 * (1.1 + 1.6) + 2 * (3.998 + 2.998) + 2 * (0.37 + 1.1) + 2 * 2.5 + 2 * 3.7 + 4;
    assert_true(alone > 24);
    assert_near(bound, open, 1e-9);
}

/* From a low-discrepancy set of places into a spiral of directions: rays meet a wall, or go out
 * where room_goes_out() says, as a twin in double finds by the box's faces. */
TEST(rays_leave_by_openings_alone)
{
    const scene *s      = scene_with(MANY);
    const study_room *r = &s->study->room;
    int left            = 0;
    for (int n = 0; n < 40000; n++) {
        double g = n * 0.61803398874989485, h = n * 0.75487766624669276,
               k = n * 0.56984029099805327;
        double z = 1 - 2 * (n + 0.5) / 40000, c = sqrt(1 - z * z), a = n * 2.39996322972865332;
        dvec3 from = { 4 * (g - floor(g)), 6 * (h - floor(h)), 3 * (k - floor(k)) };
        dvec3 to   = { c * cos(a), c * sin(a), z };
        vray ray   = { vspread(scene_place(s, from)), vspread(d3_to_float(to)), vsplat(INFINITY) };
        vmask one  = vlane_index() == 0;
        vhit hit;
        vsurface at;
        world_first_hit(s->world, &ray, &one, 1, RAYS_COHERENT, &hit);
        world_surface(s->world, &hit, one & (hit.instance >= 0), &at);
        bool pane = lane(at.material, 0) >= ROOM_MATERIALS;
        bool out  = lane(hit.instance, 0) < 0 || pane;
        left += out;
        if (out != room_goes_out(r, from, to))
            fail_msg("from (%g, %g, %g) along (%g, %g, %g)", from.x, from.y, from.z, to.x, to.y,
                     to.z);
    }
    assert_true(left > 4000 && left < 36000);
}

/* Rays to places on all edges of all triangles, where leaks would be. */
TEST(nothing_leaks_where_triangles_meet)
{
    const scene *s = scene_with("[{wall: south, at: [0.53, 0.91], size: [1.17, 1.53], "
                                "transmittance: 0.8}, {wall: east, at: [1.3, 0.17], "
                                "size: [1.1, 1.9], transmittance: 0.5}]}");
    room_mesh m    = mesh_with("[{wall: south, at: [0.53, 0.91], size: [1.17, 1.53], "
                                  "transmittance: 0.8}, {wall: east, at: [1.3, 0.17], "
                                  "size: [1.1, 1.9], transmittance: 0.5}]}");
    dvec3 from     = { 1.37, 2.91, 1.13 };
    for (uint32_t i = 0; i < 3 * m.triangle_count; i++) {
        if (m.material[i / 3] >= ROOM_MATERIALS) /* panes are another mesh than walls */
            continue;
        dvec3 a = m.positions[m.corners[i]];
        dvec3 b = m.positions[m.corners[i % 3 == 2 ? i - 2 : i + 1]];
        for (int k = 1; k < 500; k++) {
            dvec3 to = d3_sub(d3_add(d3_scale(a, k / 500.0), d3_scale(b, 1 - k / 500.0)), from);
            dvec3 d  = d3_scale(to, 1 / d3_length(to));
            vray ray = { vspread(scene_place(s, from)), vspread(d3_to_float(d)), vsplat(INFINITY) };
            vmask one = vlane_index() == 0;
            vhit hit;
            world_first_hit(s->world, &ray, &one, 1, RAYS_COHERENT, &hit);
            bool by_window =
                room_goes_out(&s->study->room, from, d3_scale(to, 1 - 1e-5)) ||
                room_goes_out(&s->study->room, d3_add(from, (dvec3){ 0, 0, 1e-5 }), to) ||
                room_goes_out(&s->study->room, d3_sub(from, (dvec3){ 0, 0, 1e-5 }), to) ||
                room_goes_out(&s->study->room, d3_add(from, (dvec3){ 1e-5, 1e-5, 0 }), to) ||
                room_goes_out(&s->study->room, d3_sub(from, (dvec3){ 1e-5, 1e-5, 0 }), to);
            assert_true(lane(hit.instance, 0) >= 0 || by_window);
        }
    }
}

static void assert_opening(const char *wall, dvec3 low, dvec3 high, dvec3 outward)
{
    char text[200];
    snprintf(text, sizeof text, "[{wall: %s, at: [0.5, 1], size: [2, 1.25]}]}", wall);
    const study_room *r = &study_with(text)->room;
    room_opening o      = room_opening_of(r->size, &r->windows[0]);
    assert_true(d3_length(d3_sub(o.low, low)) < 1e-12);
    assert_true(d3_length(d3_sub(o.high, high)) < 1e-12);
    assert_true(d3_length(d3_sub(o.outward, outward)) == 0.0);
}

/* The room is 4 m from west to east, 6 m from south to north. */
TEST(windows_count_from_the_left_end_seen_from_inside)
{
    assert_opening("south", (dvec3){ 1.5, 0, 1 }, (dvec3){ 3.5, 0, 2.25 }, (dvec3){ 0, -1, 0 });
    assert_opening("north", (dvec3){ 0.5, 6, 1 }, (dvec3){ 2.5, 6, 2.25 }, (dvec3){ 0, 1, 0 });
    assert_opening("west", (dvec3){ 0, 0.5, 1 }, (dvec3){ 0, 2.5, 2.25 }, (dvec3){ -1, 0, 0 });
    assert_opening("east", (dvec3){ 4, 3.5, 1 }, (dvec3){ 4, 5.5, 2.25 }, (dvec3){ 1, 0, 0 });
    assert_opening("ceiling", (dvec3){ 0.5, 1, 3 }, (dvec3){ 2.5, 2.25, 3 }, (dvec3){ 0, 0, 1 });
    assert_opening("floor", (dvec3){ 0.5, 1, 0 }, (dvec3){ 2.5, 2.25, 0 }, (dvec3){ 0, 0, -1 });
}

/* A lamp that hangs before a large open window sends a third of its light out: as it should. */
TEST(light_that_leaves_by_a_window_is_no_loss)
{
    notices told   = { .a = &memory };
    lux_error err  = { 0 };
    const study *s = study_with("[{wall: south, at: [0.01, 0.01], size: [3.98, 2.98]}]}\n"
                                "lights: [{type: point, at: [2, 1, 1.5], lumens: 900}]");
    assert_non_null(scene_new(&memory, s, &(scene_options){ .threads = 1 }, &told, &err));
    for (const notice *n = told.first; n; n = n->next)
        assert_null(strstr(n->text, "leaves the room"));
    s = study_with("[{wall: south, at: [0.01, 0.01], size: [3.98, 2]}]}\n"
                   "lights: [{type: point, at: [2, 1, 3], lumens: 900}]"); /* in the ceiling */
    assert_non_null(scene_new(&memory, s, &(scene_options){ .threads = 1 }, &told, &err));
    bool lost = false;
    for (const notice *n = told.first; n; n = n->next)
        lost |= strstr(n->text, "leaves the room") != NULL;
    assert_true(lost);
}

TEST(panes_of_one_transmittance_are_of_one_material)
{
    const scene *s = scene_with(MANY);
    assert_int_equal(s->material_count, ROOM_MATERIALS + 2);
    for (int k = 0; k < 2; k++) {
        const scene_material *m = &s->material_info[ROOM_MATERIALS + k];
        assert_string_equal(m->name, "room: windows");
        assert_true(m->used && !m->overridden);
    }
    assert_int_equal(room_pane(&s->study->room, 0), 0);
    assert_int_equal(room_pane(&s->study->room, 1), -1);
    assert_int_equal(room_pane(&s->study->room, 2), 1);
    assert_int_equal(room_pane(&s->study->room, 3), 0);
    assert_true(s->hollow);
}

TEST(a_room_without_windows_is_the_box_it_was)
{
    room_mesh m = mesh_with("[]}");
    assert_int_equal(m.position_count, ROOM_POSITIONS);
    assert_int_equal(m.triangle_count, ROOM_TRIANGLES);
}

/* 100 windows, staggered so that every one of them is met by as many strips as can be. */
TEST(as_many_windows_as_are_allowed_are_cut)
{
    char text[16384];
    size_t n = 0;
    for (int i = 0; i < 100; i++)
        n += (size_t)snprintf(text + n, sizeof text - n,
                              "%s{wall: south, at: [%g, %g], size: [0.03, 2]}", i ? ", " : "[",
                              0.01 + 0.0395 * i, 0.01 + 0.009 * i);
    char whole[20000];
    snprintf(whole, sizeof whole, "%s%s]}", ROOM, text);
    const study *s = study_of_text(&memory, NULL, whole);
    room_mesh m;
    lux_error err = { 0 };
    assert_true(room_make(&memory, &s->room, &m, &err));
    double area = 0.0;
    for (uint32_t t = 0; t < m.triangle_count; t++)
        area += 0.5 * d3_length(twice_area(&m, t));
    assert_near(area, 108 - 100 * 0.06, 1e-9);
}

#define WINDOWS(text) "room: {size: [4, 6, 3], reflectance: 0.5, windows: [" text "]}"
#define WINDOW(text)  WINDOWS("{wall: south, at: [1, 1], " text "}")

TEST(windows_that_do_not_fit_are_refused_with_what_would)
{
    static const broken_study table[] = {
        { WINDOW("size: [3, 1]"), "2:53: a window from 1 to 4 m along the south wall, which is 4 m "
                                  "long: expected it within 0.001 to 3.999 m" },
        { WINDOW("size: [1, 2]"), "2:53: a window from 1 to 3 m up the south wall, which is 3 m "
                                  "high: expected it within 0.001 to 2.999 m" },
        { WINDOWS("{wall: ceiling, at: [1, 0], size: [1, 1]}"),
          "2:53: a window from 0 to 1 m along y of the ceiling, which is 6 m long that way: "
          "expected it within 0.001 to 5.999 m" },
        { WINDOWS("{wall: east, at: [1, 1], size: [1, 1]}, {wall: east, at: [1.9, 1.5], "
                  "size: [1, 1]}"),
          "2:93: this window overlaps the one at 2:53, which takes 1 to 2 m along the east wall "
          "and 1 to 2 m up" },
        { WINDOW("size: [1, 1], transmittance: 0.95"),
          "2:108: expected a `transmittance` of at most 0.9183, or 1 for an open hole, found 0.95 "
          "(a pane of glass reflects the rest)" },
        { WINDOW("size: [1, 1], transmittance: 0"),
          "2:108: expected a number > 0 and at most 1, found "
          "`0`" },
        { WINDOW("size: [1, .nan]"), "2:89: expected a number > 0, found `.nan`" },
        { WINDOW("size: [1, 1, 1]"), "2:85: expected [width, height] in m, found a list of 3" },
        { WINDOW("size: [0, 1]"), "2:86: expected a number > 0, found `0`" },
        { WINDOWS("{wall: south, at: [-1, 1], size: [1, 1]}"),
          "2:72: expected a number >= 0, found `-1`" },
        { WINDOWS("{wall: up, at: [1, 1], size: [1, 1]}"),
          "2:60: expected floor or ceiling or south or east or north or west, found `up`" },
        { WINDOWS("{wall: south, size: [1, 1]}"), "2:53: a window needs the key `at`" },
        { WINDOWS("{wall: south, at: [1e308, 1], size: [1, 1]}"),
          "2:72: expected a number of at most 1e12, found `1e308`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(walls_and_windows_together_are_the_box, forget),
        cmocka_unit_test_teardown(every_front_is_inside, forget),
        cmocka_unit_test_teardown(triangles_meet_edge_to_edge, forget),
        cmocka_unit_test_teardown(rays_leave_by_openings_alone, forget),
        cmocka_unit_test_teardown(nothing_leaks_where_triangles_meet, forget),
        cmocka_unit_test_teardown(windows_count_from_the_left_end_seen_from_inside, forget),
        cmocka_unit_test_teardown(light_that_leaves_by_a_window_is_no_loss, forget),
        cmocka_unit_test_teardown(panes_of_one_transmittance_are_of_one_material, forget),
        cmocka_unit_test_teardown(a_room_without_windows_is_the_box_it_was, forget),
        cmocka_unit_test_teardown(as_many_windows_as_are_allowed_are_cut, forget),
        cmocka_unit_test_teardown(windows_that_do_not_fit_are_refused_with_what_would, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
