/* tests/unit/test_inside.c -- which places furniture takes up: solids, shells, and what is neither.
 */
#include "sim/inside.h"
#include "tests/shapes.h"
#include "tests/test.h"

enum { MOST_PLACES = 4096 };

typedef struct fixture {
    shape s;
    arena a;
    bool inside[MOST_PLACES], shell_outward;
} fixture;

static const vec3 room_low = { 0, 0, 0 }, room_high = { 6, 5, 3 };

static void turn_over(shape *s, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; i++) {
        uint32_t *c = s->corners + (size_t)3 * i, other = c[1];
        c[1] = c[2], c[2] = other;
    }
}

/* A box whose front is inside */
static void add_room(shape *s)
{
    uint32_t first = s->triangle_count;
    shape_box(s, room_low, room_high, 1);
    turn_over(s, first, s->triangle_count);
}

static void add_box(shape *s, vec3 low, vec3 high) { shape_box(s, low, high, 1); }

/* shape_box's last two triangles of six pairs: x low, x high, y low, y high, z low, z high. */
static void add_open_box(shape *s, vec3 low, vec3 high)
{
    add_box(s, low, high);
    s->triangle_count -= 2;
}

static int find(fixture *f, const vec3 *places, int count)
{
    static const world_instance once = { .place = TRANSFORM_IDENTITY };
    lux_error err                    = { 0 };
    mesh m                           = shape_mesh(&f->s);
    const world *w =
        world_new(&f->a, &(world_desc){ &m, 1, &once, 1, TRIANGLE_WATERTIGHT, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return inside_find(w, places, count, f->inside, &f->shell_outward);
}

static void tear_down(fixture *f)
{
    arena_clear(&f->a);
    shape_clear(&f->s);
}

/* Whether one place is inside, asked together with two that are in the open: the first of these
 * outside of everything. */
static bool is_inside(fixture *f, vec3 place)
{
    const vec3 places[] = { { -50, -40, 30 }, place, { 5.9f, 4.9f, 2.95f } };
    int count           = find(f, places, 3);
    assert_false(f->shell_outward);
    assert_false(f->inside[0]);
    assert_false(f->inside[2]);
    assert_int_equal(count, f->inside[1]);
    return f->inside[1];
}

TEST(a_closed_box_and_a_torus_hold_what_is_in_them)
{
    fixture f = { 0 };
    add_room(&f.s);
    add_box(&f.s, (vec3){ 1, 1, 0.2f }, (vec3){ 2, 2, 1 });
    shape_torus(&f.s, (vec3){ 4, 3, 1.5f }, 0.6f, 0.2f, 16);
    assert_true(is_inside(&f, (vec3){ 1.5f, 1.5f, 0.5f }));
    assert_true(is_inside(&f, (vec3){ 1.001f, 1.999f, 0.999f }));
    assert_true(is_inside(&f, (vec3){ 4.6f, 3.05f, 1.55f }));
    assert_false(is_inside(&f, (vec3){ 4.0f, 3.0f, 1.5f })); /* the hole of the ring */
    assert_false(is_inside(&f, (vec3){ 0.999f, 1.5f, 0.5f }));
    assert_false(is_inside(&f, (vec3){ 1.5f, 1.5f, 1.001f }));
    tear_down(&f);
}

/* The cupboard's foot lies in the floor, its back in the wall: to the bit, and to some roundings.
 */
TEST(a_cupboard_on_the_floor_and_against_the_wall_is_solid)
{
    for (int k = -1; k <= 1; k++) {
        fixture f = { 0 };
        float off = (float)k * 0x1p-22f;
        add_room(&f.s);
        add_box(&f.s, (vec3){ 1, off, -off }, (vec3){ 2, 0.6f, 2 });
        add_box(&f.s, (vec3){ 2 + off, off, off }, (vec3){ 3, 0.6f, 2 }); /* beside the other */
        assert_true(is_inside(&f, (vec3){ 1.4f, 0.3f, 0.75f }));
        assert_true(is_inside(&f, (vec3){ 2.4f, 0.3f, 0.75f }));
        assert_false(is_inside(&f, (vec3){ 1.5f, 0.61f, 0.75f }));
        assert_false(is_inside(&f, (vec3){ 1.5f, 0.3f, 2.1f }));
        tear_down(&f);
    }
}

TEST(solids_may_stand_in_and_through_each_other)
{
    fixture f = { 0 };
    add_room(&f.s);
    add_box(&f.s, (vec3){ 1, 1, 0 }, (vec3){ 3, 3, 1 });
    add_box(&f.s, (vec3){ 2, 2, 0.5f }, (vec3){ 4, 4, 1.5f });             /* through it */
    add_box(&f.s, (vec3){ 1.2f, 1.2f, 0.2f }, (vec3){ 1.6f, 1.6f, 0.6f }); /* in it */
    assert_true(is_inside(&f, (vec3){ 1.8f, 1.5f, 0.4f }));  /* only in the first, sees both */
    assert_true(is_inside(&f, (vec3){ 2.5f, 2.5f, 0.75f })); /* in both */
    assert_true(is_inside(&f, (vec3){ 1.4f, 1.4f, 0.4f }));
    assert_true(is_inside(&f, (vec3){ 3.5f, 3.5f, 1.2f }));
    assert_false(is_inside(&f, (vec3){ 1.5f, 1.5f, 1.2f }));
    tear_down(&f);
}

TEST(open_boxes_tables_and_gaps_between_walls_hold_nothing)
{
    fixture f = { 0 };
    add_room(&f.s);
    add_open_box(&f.s, (vec3){ 1, 1, 0.5f }, (vec3){ 2, 2, 1.5f });
    assert_false(is_inside(&f, (vec3){ 1.5f, 1.5f, 0.9f }));
    assert_false(is_inside(&f, (vec3){ 1.5f, 1.5f, 0.6f })); /* deep down */

    add_box(&f.s, (vec3){ 3, 1, 0.7f }, (vec3){ 5, 2, 0.74f }); /* a board ... */
    for (int leg = 0; leg < 4; leg++) {
        float x = leg & 1 ? 4.9f : 3.0f, y = leg & 2 ? 1.9f : 1.0f;
        add_box(&f.s, (vec3){ x, y, 0 }, (vec3){ x + 0.1f, y + 0.1f, 0.7f });
    }
    assert_false(is_inside(&f, (vec3){ 4.0f, 1.5f, 0.35f }));
    assert_false(is_inside(&f, (vec3){ 4.0f, 1.5f, 0.699f }));
    assert_false(is_inside(&f, (vec3){ 4.0f, 1.5f, 0.75f }));
    assert_true(is_inside(&f, (vec3){ 4.0f, 1.5f, 0.72f }));   /* in the board */
    assert_true(is_inside(&f, (vec3){ 4.95f, 1.95f, 0.72f })); /* over a leg */
    assert_true(is_inside(&f, (vec3){ 4.95f, 1.95f, 0.3f }));  /* in a leg */

    add_box(&f.s, (vec3){ 0.5f, 3, 0 }, (vec3){ 5.5f, 3.2f, 2.9f });
    add_box(&f.s, (vec3){ 0.5f, 3.3f, 0 }, (vec3){ 5.5f, 3.5f, 2.9f });
    assert_false(is_inside(&f, (vec3){ 3.0f, 3.25f, 1.5f }));
    assert_true(is_inside(&f, (vec3){ 3.0f, 3.1f, 1.5f }));
    tear_down(&f);
}

TEST(a_place_on_a_surface_is_not_inside)
{
    fixture f = { 0 };
    add_room(&f.s);
    add_box(&f.s, (vec3){ 1, 1, 0.3f }, (vec3){ 2.1f, 2.1f, 0.75f });
    for (int k = -2; k <= 2; k++) {
        float off = (float)k * 0x1p-23f; /* some roundings below and above */
        assert_false(is_inside(&f, (vec3){ 1.5f, 1.3f, 0.75f + off }));
        assert_false(is_inside(&f, (vec3){ 2.1f + off, 1.3f, 0.5f }));
        assert_false(is_inside(&f, (vec3){ 2.1f + off, 2.1f + off, 0.5f }));
    }
    assert_true(is_inside(&f, (vec3){ 1.5f, 1.3f, 0.7499f })); /* 0.1 mm below */
    tear_down(&f);
}

TEST(a_solid_with_a_side_turned_over_is_not_judged)
{
    fixture f = { 0 };
    add_room(&f.s);
    uint32_t first = f.s.triangle_count;
    add_box(&f.s, (vec3){ 1, 1, 0.2f }, (vec3){ 2, 2, 1 });
    turn_over(&f.s, first, first + 2);
    assert_false(is_inside(&f, (vec3){ 1.5f, 1.5f, 0.6f }));
    tear_down(&f);
}

/* ---- whole grids ----------------------------------------------------------------------------- */

static int grid(vec3 *places)
{
    int count = 0;
    for (int i = 0; i < 24; i++)
        for (int j = 0; j < 20; j++)
            places[count++] = (vec3){ 0.125f + 0.25f * (float)i, 0.125f + 0.25f * (float)j, 0.75f };
    return count;
}

static void add_furniture(shape *s)
{
    add_box(s, (vec3){ 1, 1, 0 }, (vec3){ 2, 2, 1 });       /* holds 4 x 4 of the places */
    add_box(s, (vec3){ 3, 1, 0.5f }, (vec3){ 5, 2, 0.7f }); /* below them */
    add_box(s, (vec3){ 4, 3, 0 }, (vec3){ 4.5f, 4.5f, 3 }); /* a column, 2 x 6 */
}

TEST(of_a_grid_those_within_furniture_are_told)
{
    fixture f = { 0 };
    vec3 places[MOST_PLACES];
    int count = grid(places), wrong = 0;
    add_room(&f.s);
    add_furniture(&f.s);
    assert_int_equal(find(&f, places, count), 16 + 12);
    assert_false(f.shell_outward);
    for (int i = 0; i < count; i++) {
        vec3 p      = places[i];
        bool box    = p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2;
        bool column = p.x > 4 && p.x < 4.5f && p.y > 3 && p.y < 4.5f;
        wrong += f.inside[i] != (box || column);
    }
    assert_int_equal(wrong, 0);
    tear_down(&f);
}

/* Then all places are within the building as furniture holds what is in it, however furnished. */
TEST(a_shell_that_faces_outward_is_told_and_leaves_nothing_out)
{
    for (int furnished = 0; furnished < 2; furnished++) {
        fixture f = { 0 };
        vec3 places[MOST_PLACES];
        int count = grid(places);
        add_box(&f.s, room_low, room_high);
        if (furnished)
            add_furniture(&f.s);
        assert_int_equal(find(&f, places, count), 0);
        assert_true(f.shell_outward);
        for (int i = 0; i < count; i++)
            assert_false(f.inside[i]);
        tear_down(&f);
    }
}

TEST(nothing_is_inside_where_there_is_nothing)
{
    fixture f           = { 0 };
    const vec3 places[] = { { 0, 0, 0 }, { NAN, 1, INFINITY } };
    assert_int_equal(find(&f, places, 2), 0);
    assert_int_equal(find(&f, places, 0), 0);
    assert_false(f.shell_outward);
    tear_down(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_box_and_a_torus_hold_what_is_in_them),
        cmocka_unit_test(a_cupboard_on_the_floor_and_against_the_wall_is_solid),
        cmocka_unit_test(solids_may_stand_in_and_through_each_other),
        cmocka_unit_test(open_boxes_tables_and_gaps_between_walls_hold_nothing),
        cmocka_unit_test(a_place_on_a_surface_is_not_inside),
        cmocka_unit_test(a_solid_with_a_side_turned_over_is_not_judged),
        cmocka_unit_test(of_a_grid_those_within_furniture_are_told),
        cmocka_unit_test(a_shell_that_faces_outward_is_told_and_leaves_nothing_out),
        cmocka_unit_test(nothing_is_inside_where_there_is_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
