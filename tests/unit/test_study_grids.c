/* tests/unit/test_study_grids.c -- grids on the surfaces of the room, and what they measure. */
#include "tests/study_text.h"
#include "tests/test.h"

#include <string.h>

#define ROOM "room: {size: [5, 4, 3], reflectance: 0.5}\n"

static arena memory;

static const study *good(const char *text) { return study_of_text(&memory, NULL, text); }

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static void assert_place(dvec3 p, double x, double y, double z)
{
    if (!(fabs(p.x - x) < 1e-12 && fabs(p.y - y) < 1e-12 && fabs(p.z - z) < 1e-12)) /* roundings */
        fail_msg("(%g, %g, %g), not (%g, %g, %g)", p.x, p.y, p.z, x, y, z);
}

TEST(grids_lie_on_every_surface_of_the_room_and_look_inside)
{
    const study *s                  = good("lux4: 1\n" ROOM "grids:\n"
                                                            "  - {name: r, on: room, height: 0.75, spacing: 1}\n"
                                                            "  - {name: f, on: floor, spacing: 1}\n"
                                                            "  - {name: c, on: ceiling, spacing: 1}\n"
                                                            "  - {name: s, on: south, spacing: 1}\n"
                                                            "  - {name: e, on: east, spacing: 1}\n"
                                                            "  - {name: n, on: north, spacing: 1}\n"
                                                            "  - {name: w, on: west, spacing: 1}\n");
    static const study_side sides[] = { SIDE_ROOM, SIDE_FLOOR, SIDE_CEILING, SIDE_SOUTH,
                                        SIDE_EAST, SIDE_NORTH, SIDE_WEST };
    static const dvec3 normals[]    = { { 0, 0, 1 },  { 0, 0, 1 },  { 0, 0, -1 }, { 0, 1, 0 },
                                        { -1, 0, 0 }, { 0, -1, 0 }, { 1, 0, 0 } };
    static const double heights[]   = { 0.75, 0, 3, 0, 0, 0, 0 }; /* of the origin */
    assert_int_equal(s->grid_count, 7);
    for (int i = 0; i < 7; i++) {
        const study_grid *g = &s->grids[i];
        dvec3 n             = d3_cross(g->u, g->v);
        dvec3 far           = d3_add(g->origin, d3_add(g->u, g->v));
        assert_int_equal(g->on, sides[i]);
        assert_near(d3_dot(n, normals[i]), d3_length(n), 1e-15);
        assert_true(g->origin.z == heights[i]);
        /* From corner to corner of the surface */
        assert_true((g->origin.x == 0 || g->origin.x == 5) && (far.x == 0 || far.x == 5));
        assert_true((g->origin.y == 0 || g->origin.y == 4) && (far.y == 0 || far.y == 4));
        assert_true(i < 3 || (far.z == 3 && g->v.z == 3)); /* walls: v is up */
    }
    /* Who looks up with the north ahead has the east at his left */
    assert_place(s->grids[2].origin, 5, 0, 3);
    assert_place(s->grids[2].u, -5, 0, 0);
    /* Who faces the south wall has the east at his left */
    assert_place(s->grids[3].origin, 5, 0, 0);
    assert_place(s->grids[3].u, -5, 0, 0);
    assert_place(s->grids[4].origin, 5, 4, 0);
    assert_place(s->grids[6].origin, 0, 0, 0);
}

TEST(margins_leave_all_edges_of_a_surface_out)
{
    const study *s = good("lux4: 1\n" ROOM "grids:\n"
                          "  - {name: e, on: east, margin: 0.5, spacing: 0.5}\n"
                          "  - {name: c, on: ceiling, margin: 0.25, spacing: 0.5}\n");
    assert_place(s->grids[0].origin, 5, 3.5, 0.5);
    assert_place(s->grids[0].u, 0, -3, 0);
    assert_place(s->grids[0].v, 0, 0, 2);
    assert_true(s->grids[0].count[0] == 6 && s->grids[0].count[1] == 4);
    assert_place(s->grids[1].origin, 4.75, 0.25, 3);
    assert_place(s->grids[1].v, 0, 3.5, 0);
}

TEST(walls_become_four_grids)
{
    const study *s                   = good("lux4: 1\n" ROOM "grids:\n"
                                                              "  - {name: a, points: a.csv}\n"
                                                              "  - {name: w, on: walls, spacing: 0.5, require: {maximum: 75}}\n"
                                                              "  - {name: z, on: floor, spacing: 0.5}\n");
    static const char *const names[] = { "a", "w-south", "w-east", "w-north", "w-west", "z" };
    assert_int_equal(s->grid_count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(s->grids[i].name, names[i]);
    for (int i = 1; i < 5; i++) {
        assert_int_equal(s->grids[i].on, SIDE_SOUTH + i - 1);
        assert_true(s->grids[i].require_maximum == 75.0 && isnan(s->grids[i].require_minimum));
        assert_int_equal(s->grids[i].count[0], i % 2 ? 10 : 8);
        assert_int_equal(s->grids[i].count[1], 6);
    }
}

TEST(a_grid_measures_one_of_four_quantities)
{
    const study *s =
        good("lux4: 1\n" ROOM "grids:\n"
             "  - {name: a, on: floor, spacing: 1}\n"
             "  - {name: b, on: room, height: 1.2, spacing: 1, quantity: cylindrical}\n"
             "  - {name: c, on: room, height: 1.2, spacing: 1, quantity: vertical,\n"
             "     facing: [3, -4, 0]}\n"
             "  - {name: d, points: a.csv, quantity: semicylindrical, facing: [0, 2, 1e-9]}\n"
             "  - {name: e, on: east, spacing: 1, quantity: vertical}\n"
             "  - {name: f, origin: [0, 0, 0], u: [2, 2, 0], v: [0, 0, 2], spacing: 1,\n"
             "     quantity: semicylindrical}\n"
             "  - {name: g, on: east, spacing: 1, quantity: vertical, facing: [0, 1, 0]}\n"
             "  - {name: h, on: east, spacing: 1, quantity: planar}\n");
    const study_grid *g = s->grids;
    assert_true(g[0].quantity == QUANTITY_PLANAR && g[1].quantity == QUANTITY_CYLINDRICAL);
    assert_place(g[1].facing, 0, 0, 0);
    assert_int_equal(g[2].quantity, QUANTITY_VERTICAL);
    assert_place(g[2].facing, 0.6, -0.8, 0);
    assert_int_equal(g[3].quantity, QUANTITY_SEMICYLINDRICAL);
    assert_true(g[3].facing.y == 1.0 && g[3].facing.z == 0.0); /* level to the last bit */
    assert_place(g[4].facing, -1, 0, 0);                       /* as the wall does */
    assert_place(g[5].facing, sqrt(0.5), -sqrt(0.5), 0);       /* u x v */
    assert_place(g[6].facing, 0, 1, 0);
    assert_place(g[7].facing, 0, 0, 0);
}

TEST(counts_by_the_standard_are_what_the_grid_has)
{
    const study *s = good("lux4: 1\n"
                          "room: {size: [11, 6, 3], reflectance: 0.5}\n"
                          "grids: [{name: a, on: room, height: 0.75, margin: 0.5,\n"
                          "         spacing: en12464}]\n");
    double along_u, along_v;
    study_grid_counts(s->grids, &along_u, &along_v); /* 10 by 5 m: d is the shorter side */
    assert_true(along_u == 19.0 && along_v == 9.0);  /* 5 / 0.2 5^0.699 = 8.1; 10 m: 18 */
    assert_near(s->grids[0].spacing, 5.0 / 9.0, 1e-15);
    study_grid by_hand = { .u = { 2, 0, 0 }, .v = { 0, 0.1, 0 }, .spacing = 0.5 };
    study_grid_counts(&by_hand, &along_u, &along_v);
    assert_true(along_u == 4.0 && along_v == 1.0);
}

TEST(grids_that_contradict_themselves_are_refused)
{
    static const broken_study table[] = {
        { "grids: [{name: a, on: walls, spacing: 1}]",
          "2:9: a grid with `on` needs a room, but there is no `room`" },
        { "grids: [{name: a, on: floor, height: 1, spacing: 1}]",
          "2:38: `height` does not go with `on: floor`" },
        { "grids: [{name: a, on: walls, height: 1, spacing: 1}]",
          "2:38: `height` does not go with `on: walls`" },
        { "grids: [{name: a, on: ceiling}]", "2:9: a grid with `on` needs the key `spacing`" },
        { ROOM "grids: [{name: a, on: west, margin: 1.5, spacing: 1}]",
          "3:9: `margin: 1.5` leaves nothing of a wall of 4 by 3 m" },
        { ROOM "grids: [{name: a, on: ceiling, margin: 2, spacing: 1}]",
          "3:9: `margin: 2` leaves nothing of a ceiling of 5 by 4 m" },
        { ROOM "grids:\n- {name: a, on: walls, spacing: 1}\n- {name: a-east, points: b}",
          "5:3: the name `a-east` is taken by the grid or view of line 4" },
        { "grids: [{quantity: round}]", "2:20: expected planar or vertical or cylindrical or "
                                        "semicylindrical, found `round`" },
        { "grids: [{facing: [0, 1, 0.1]}]",
          "2:18: expected a level direction, [x, y, 0], found 0.1 upward" },
        { "grids: [{facing: [0, 0, 1]}]",
          "2:18: expected a level direction, [x, y, 0], found 1 upward" },
        { "grids: [{facing: [0, 0, 0]}]", "2:18: expected a direction, found no length" },
        { "grids: [{name: a, points: a, facing: [1, 0, 0]}]",
          "2:38: `facing` does not go with `quantity: planar`" },
        { "grids: [{name: a, points: a, quantity: cylindrical, facing: [1, 0, 0]}]",
          "2:61: `facing` does not go with `quantity: cylindrical`" },
        { "grids: [{name: a, points: a, quantity: vertical}]",
          "2:9: `quantity: vertical` of `points` needs the key `facing`" },
        { ROOM "grids: [{name: a, on: floor, spacing: 1, quantity: semicylindrical}]",
          "3:9: `quantity: semicylindrical` needs the key `facing`, as the grid does not stand "
          "upright" },
        { "grids: [{name: a, origin: [0,0,0], u: [1,0,0.1], v: [0,1,0], spacing: 1, "
          "quantity: vertical}]",
          "2:9: `quantity: vertical` needs the key `facing`, as the grid does not stand "
          "upright" },
        { "grids: [{require: {maximum: 0}}]", "2:29: expected a number > 0, found `0`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(grids_lie_on_every_surface_of_the_room_and_look_inside, forget),
        cmocka_unit_test_teardown(margins_leave_all_edges_of_a_surface_out, forget),
        cmocka_unit_test_teardown(walls_become_four_grids, forget),
        cmocka_unit_test_teardown(a_grid_measures_one_of_four_quantities, forget),
        cmocka_unit_test_teardown(counts_by_the_standard_are_what_the_grid_has, forget),
        cmocka_unit_test(grids_that_contradict_themselves_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
