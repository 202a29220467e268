/* tests/unit/test_portals_found.c -- what daylight comes in by: windows of the room, what a study
 * names, and glazing that has the sky on one side.
 */
#include "sim/flat_pieces.h"
#include "sim/scene.h"
#include "tests/quads_gltf.h"
#include "tests/test.h"
#include "tests/told_scene.h"

#include <stdio.h>
#include <string.h>

static const char *const materials[] = { "Wall", "Glass", "Glass door" };
enum { WALL, GLASS, DOOR };

/* A house of 6 x 5 x 3 m; its south wall has an opening from (1, 0, 0.9) to (4, 0, 2.4). */
static const quad house[] = {
    { "Floor", WALL, -1, { 0, 0, 0 }, { 6, 0, 0 }, { 0, 5, 0 } },
    { "Roof", WALL, -1, { 0, 0, 3 }, { 6, 0, 0 }, { 0, 5, 0 } },
    { "North", WALL, -1, { 0, 5, 0 }, { 6, 0, 0 }, { 0, 0, 3 } },
    { "East", WALL, -1, { 6, 0, 0 }, { 0, 5, 0 }, { 0, 0, 3 } },
    { "West", WALL, -1, { 0, 0, 0 }, { 0, 5, 0 }, { 0, 0, 3 } },
    { "South 1", WALL, -1, { 0, 0, 0 }, { 6, 0, 0 }, { 0, 0, 0.9 } },
    { "South 2", WALL, -1, { 0, 0, 2.4 }, { 6, 0, 0 }, { 0, 0, 0.6 } },
    { "South 3", WALL, -1, { 0, 0, 0.9 }, { 1, 0, 0 }, { 0, 0, 1.5 } },
    { "South 4", WALL, -1, { 4, 0, 0.9 }, { 2, 0, 0 }, { 0, 0, 1.5 } },
};
enum { WALLS = sizeof house / sizeof *house };

#define SKY "sky: {model: overcast, horizontal: 10000}\n"

/* The house with `more` in it or beside it. */
static const scene *house_with(const quad *more, int count, const char *keys)
{
    quad all[64];
    char text[1000];
    memcpy(all, house, sizeof house);
    if (count > 0)
        memcpy(all + WALLS, more, (size_t)count * sizeof *more);
    quads_gltf_write(told_folder(), "house.gltf", all, WALLS + count, materials, 3);
    snprintf(text, sizeof text, "scene: {file: house.gltf%s}\n" SKY, keys);
    return told_scene_of(text);
}

/* That rectangle, in the user's frame, and no more than 0.1 mm beyond each side; never less. */
static void assert_portal(const scene *s, int k, dvec3 low, dvec3 high, dvec3 outward)
{
    const portal *p = &s->portal_list[k];
    dvec3 centre    = d3_add(d3_from(p->centre), s->centre);
    dvec3 u = d3_from(p->u), v = d3_from(p->v);
    assert_true(fabs(d3_dot(u, v)) < 1e-6);
    assert_true(d3_length(d3_sub(d3_from(p->outward), outward)) < 1e-6);
    dvec3 half          = { fabs(u.x) + fabs(v.x), fabs(u.y) + fabs(v.y), fabs(u.z) + fabs(v.z) };
    dvec3 more_low      = d3_sub(low, d3_sub(centre, half)),
          more_high     = d3_sub(d3_add(centre, half), high);
    const double more[] = { more_low.x,  more_low.y,  more_low.z,
                            more_high.x, more_high.y, more_high.z };
    const double flat[] = { outward.x, outward.y, outward.z };
    for (int i = 0; i < 6; i++)
        assert_true(more[i] < 1e-4 && (more[i] >= 0.0 || flat[i % 3] != 0.0));
}

TEST(each_window_of_the_room_is_a_portal)
{
    const scene *s =
        told_scene_of("room: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"
                      "  {wall: south, at: [0.5, 0.9], size: [1.2, 1.5]},\n"
                      "  {wall: east, at: [1, 0.2], size: [1.5, 2], transmittance: 0.8},\n"
                      "  {wall: ceiling, at: [1, 2], size: [0.7, 1]}]}\n" SKY);
    assert_int_equal(s->portal_count, 3);
    assert_string_equal(s->portals_from, "3 room windows");
    assert_non_null(s->portals);
    assert_non_null(s->dome);
    assert_portal(s, 0, (dvec3){ 2.3, 0, 0.9 }, (dvec3){ 3.5, 0, 2.4 }, (dvec3){ 0, -1, 0 });
    assert_portal(s, 1, (dvec3){ 4, 3.5, 0.2 }, (dvec3){ 4, 5, 2.2 }, (dvec3){ 1, 0, 0 });
    assert_portal(s, 2, (dvec3){ 1, 2, 3 }, (dvec3){ 1.7, 3, 3 }, (dvec3){ 0, 0, 1 });
}

TEST(without_daylight_nothing_is_sought)
{
    const scene *s = told_scene_of("room: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"
                                   "  {wall: south, at: [0.5, 0.9], size: [1.2, 1.5]}]}\n");
    assert_int_equal(s->portal_count, 0);
    assert_null(s->dome);
}

TEST(a_house_without_glass_has_no_portal_but_a_dome)
{
    const scene *s = house_with(NULL, 0, "");
    assert_int_equal(s->portal_count, 0);
    assert_null(s->portals);
    assert_null(s->portals_from);
    assert_non_null(s->dome);
}

TEST(a_pane_in_a_wall_is_found_whichever_way_it_faces)
{
    const quad panes[] = {
        { "Pane", GLASS, -1, { 1, 0, 0.9 }, { 3, 0, 0 }, { 0, 0, 1.5 } },
        { "Pane", GLASS, -1, { 4, 0, 0.9 }, { -3, 0, 0 }, { 0, 0, 1.5 } },
    };
    for (int k = 0; k < 2; k++) {
        const scene *s = house_with(&panes[k], 1, "");
        assert_int_equal(s->portal_count, 1);
        assert_string_equal(s->portals_from, "1 of glazing \"Glass\"");
        assert_portal(s, 0, (dvec3){ 1, 0, 0.9 }, (dvec3){ 4, 0, 2.4 }, (dvec3){ 0, -1, 0 });
    }
}

TEST(of_a_closed_box_of_glass_one_face_is_a_portal)
{
    quad panes[12];
    quads_box(panes, "Outer", GLASS, (dvec3){ 1, -0.02, 0.9 }, (dvec3){ 4, 0, 2.4 });
    quads_box(panes + 6, "Inner", GLASS, (dvec3){ 1, 0.05, 0.9 }, (dvec3){ 4, 0.06, 2.4 });
    const scene *s = house_with(panes, 12, "");
    assert_int_equal(s->portal_count, 1);
    dvec3 at = d3_add(d3_from(s->portal_list[0].centre), s->centre);
    assert_true(at.y > -0.021 && at.y < 0.061);
    assert_true(s->portal_list[0].outward.y == -1.0f);
}

TEST(panes_that_do_not_part_inside_from_outside_are_none)
{
    const quad panes[] = {
        { "Shelter", GLASS, -1, { 0, -9, 0 }, { 3, 0, 0 }, { 0, 0, 2 } },
        { "Partition", DOOR, -1, { 3, 3.5, 0 }, { 0, 1.5, 0 }, { 0, 0, 3 } },
    };
    assert_int_equal(house_with(panes, 2, "")->portal_count, 0);
}

TEST(what_is_named_counts_alone)
{
    const quad panes[] = {
        { "Pane", GLASS, -1, { 1, 0, 0.9 }, { 1.5, 0, 0 }, { 0, 0, 1.5 } },
        { "Sash", DOOR, -1, { 2.5, 0, 0.9 }, { 1.5, 0, 0 }, { 0, 0, 1.5 } },
    };
    const scene *s = house_with(panes, 2, "");
    assert_int_equal(s->portal_count, 2);
    assert_string_equal(s->portals_from, "2 of glazing \"Glass\" and others");
    s = house_with(panes, 2, ", portals: [Sa?h]");
    assert_int_equal(s->portal_count, 1);
    assert_string_equal(s->portals_from, "1 named");
    assert_portal(s, 0, (dvec3){ 2.5, 0, 0.9 }, (dvec3){ 4, 0, 2.4 }, (dvec3){ 0, -1, 0 });
    s = house_with(panes, 2, ", portals: \"Glass d*\""); /* by material */
    assert_int_equal(s->portal_count, 1);
    s = house_with(panes, 2, ", at: [[0, 0, 0], [20, 0, 0]], rotate: 90, portals: [Sash]");
    assert_int_equal(s->portal_count, 2);
    assert_true(s->portal_list[0].outward.x > 0.999f);
}

TEST(what_is_named_in_vain_is_told)
{
    const quad more[] = {
        { "Shelter", GLASS, -1, { 0, -9, 0 }, { 3, 0, 0 }, { 0, 0, 2 } },
        { "Guide", WALL, -1, { 1, 0, 0.9 }, { 3, 0, 0 }, { 0, 0, 1.5 } },
    };
    const scene *s = house_with(more, 1, ", portals: [Shelter]");
    assert_int_equal(s->portal_count, 0);
    assert_true(was_told("1 surface that `portals` name, first at (1.5, -9, 1) m, is not between "
                         "inside and outside"));
    s = house_with(more, 2, ", portals: [Guide]");
    assert_int_equal(s->portal_count, 1);
    assert_true(was_told("2 of 2 triangles that `portals` name are opaque"));
}

/* A roof window, turned and tilted: the rectangle lies along its edges. */
TEST(rectangles_lie_along_edges)
{
    dvec3 u = { 0.8, 0.6, 0 }, v = { -0.3, 0.4, 0.86602540378443865 };
    const dvec3 a = { 1, 2, 3 }, b = d3_add(a, d3_scale(u, 2)), d = d3_add(a, v), c = d3_add(b, v);
    const dvec3 corners[] = { a, b, c, a, c, d, a, a, b /* without area */ };
    const uint32_t tags[] = { 7, 7, 7 };
    flat_piece *p;
    uint32_t n;
    assert_true(flat_pieces_of(told_memory(), corners, tags, 3, &p, &n, NULL));
    assert_int_equal(n, 1);
    assert_int_equal(p->tag, 7);
    assert_near(p->area, 2.0, 1e-12);
    assert_near(flat_piece_face(p), 2.0, 1e-12);
    assert_true(d3_length(d3_sub(p->centre, d3_scale(d3_add(a, c), 0.5))) < 1e-12);
    assert_near(fabs(d3_dot(p->normal, d3_cross(u, v))), 1.0, 1e-12);
}

TEST(pieces_end_where_planes_or_tags_do)
{
    const dvec3 o = { 0, 0, 0 }, x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 }, w = { 1, 1, 0 };
    const dvec3 corners[] = { o, x, y, x, w, y, o, x, z };
    flat_piece *p;
    uint32_t n;
    assert_true(flat_pieces_of(told_memory(), corners, (uint32_t[]){ 1, 1, 1 }, 3, &p, &n, NULL));
    assert_int_equal(n, 2);
    assert_near(p[0].area, 1.0, 1e-12);
    assert_near(p[1].area, 0.5, 1e-12);
    assert_true(flat_pieces_of(told_memory(), corners, (uint32_t[]){ 1, 2, 1 }, 3, &p, &n, NULL));
    assert_int_equal(n, 3);
    assert_true(flat_pieces_of(told_memory(), corners, NULL, 0, &p, &n, NULL));
    assert_int_equal(n, 0);
}

/* A strip of a wide cylinder, in steps of a quarter degree, hangs together and is as wide as its
 * chord; a thousand triangles at one edge, and numbers that square to infinity, do no harm. */
TEST(odd_surfaces_do_no_harm)
{
    enum { STEPS = 40, MANY = 1000 };
    dvec3 strip[6 * STEPS], fan[3 * MANY];
    static uint32_t tags[MANY];
    for (int k = 0; k < STEPS; k++) {
        double a = k * M_PI / 720, b = (k + 1) * M_PI / 720;
        dvec3 p = { 9 * sin(a), 9 * cos(a), 0 }, q = { 9 * sin(b), 9 * cos(b), 0 };
        dvec3 up          = { 0, 0, 2 };
        const dvec3 two[] = { p, q, d3_add(q, up), p, d3_add(q, up), d3_add(p, up) };
        memcpy(strip + 6 * k, two, sizeof two);
    }
    for (int k = 0; k < MANY; k++) {
        fan[3 * k] = (dvec3){ 0, 0, 0 }, fan[3 * k + 1] = (dvec3){ 0, 0, 1 };
        fan[3 * k + 2] = (dvec3){ cos(k), sin(k), 0 };
    }
    flat_piece *p;
    uint32_t n;
    assert_true(flat_pieces_of(told_memory(), strip, tags, 2 * STEPS, &p, &n, NULL));
    assert_int_equal(n, 1);
    assert_near(flat_piece_face(p), 2 * 18 * sin(STEPS * M_PI / 1440), 1e-3);
    assert_true(flat_pieces_of(told_memory(), fan, tags, MANY, &p, &n, NULL));
    assert_true(n > 900);
    fan[2] = (dvec3){ 1e200, 1e200, 0 };
    assert_true(flat_pieces_of(told_memory(), fan, tags, 1, &p, &n, NULL));
    assert_int_equal(n, 0);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, told_prepare, told_forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(each_window_of_the_room_is_a_portal),
        CASE(without_daylight_nothing_is_sought),
        CASE(a_house_without_glass_has_no_portal_but_a_dome),
        CASE(a_pane_in_a_wall_is_found_whichever_way_it_faces),
        CASE(of_a_closed_box_of_glass_one_face_is_a_portal),
        CASE(panes_that_do_not_part_inside_from_outside_are_none),
        CASE(what_is_named_counts_alone),
        CASE(what_is_named_in_vain_is_told),
        CASE(rectangles_lie_along_edges),
        CASE(pieces_end_where_planes_or_tags_do),
        CASE(odd_surfaces_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
