/* tests/unit/test_bsdf.c -- measured layers: what files say of themselves, and what is read. */
#include "materials/bsdf_parts.h"
#include "tests/bsdf_twin.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

/* ---- bases -------------------------------------------------------------------------------------
 */

static const twin_basis *const bases[] = { &twin_full, &twin_half, &twin_quarter };

TEST(projected_solid_angles_sum_to_pi)
{
    for (int i = 0; i < 3; i++) {
        klems k;
        double sum = 0;
        assert_true(klems_known(bases[i]->name, &k));
        assert_int_equal(k.cells, bases[i]->cells);
        for (int cell = 0; cell < k.cells; cell++) {
            double area = (double)lane(vklems_area(&k, vsplat_int(cell)), 0);
            assert_near(area, twin_area(bases[i], cell), 2e-7); /* of floats */
            sum += area;
        }
        assert_near(sum, pi, 1e-6);
    }
    klems k;
    assert_false(klems_known("LBNL/Klems Third", &k));
}

TEST(a_direction_drawn_in_a_cell_is_found_in_it)
{
    for (int i = 0; i < 3; i++) {
        klems k;
        klems_known(bases[i]->name, &k);
        for (int cell = 0; cell < k.cells; cell++)
            for (int j = 0; j < 25; j++) { /* a hundredth within the edges */
                vfloat u = vsplat(0.01f + 0.98f * (float)(j % 5) / 4);
                vfloat v = vsplat(0.01f + 0.98f * (float)(j / 5) / 4); /* NOLINT */
                vvec3 d  = vklems_direction(&k, vsplat_int(cell), u, v);
                assert_near(lane(vlength(d), 0), 1, 1e-6);
                assert_int_equal(lane(vklems_cell(&k, d.x, d.y, d.z), 0), cell);
            }
    }
}

static int cell_at(const klems *k, double theta_deg, double phi_deg)
{
    double t = theta_deg * pi / 180, p = phi_deg * pi / 180;
    return lane(vklems_cell(k, vsplat((float)(sin(t) * cos(p))), vsplat((float)(sin(t) * sin(p))),
                            vsplat((float)cos(t))),
                0);
}

/* Of the full basis: 1 + 8 + 16 cells are nearer to the normal than 25 degrees, and so on */
TEST(cells_at_edges_are_those_of_the_table)
{
    klems k;
    klems_known("LBNL/Klems Full", &k);
    assert_int_equal(cell_at(&k, 0, 0), 0);
    assert_int_equal(cell_at(&k, 4.999, 200), 0);
    assert_int_equal(cell_at(&k, 5.001, 0), 1);
    assert_int_equal(cell_at(&k, 10, 22.4), 1);
    assert_int_equal(cell_at(&k, 10, 22.6), 2);
    assert_int_equal(cell_at(&k, 10, -22.4), 1);
    assert_int_equal(cell_at(&k, 10, -22.6), 8);
    assert_int_equal(cell_at(&k, 30, 90), 25 + 5);
    assert_int_equal(cell_at(&k, 89.999, 180), 133 + 6);
    assert_int_equal(cell_at(&k, 90, 0), 133);
    assert_int_equal(cell_at(&k, 90, 345.1), 133);
    vvec3 nan = vspread((vec3){ NAN, NAN, NAN });
    int wild  = lane(vklems_cell(&k, nan.x, nan.y, nan.z), 0);
    assert_true(wild >= 0 && wild < 145);
}

TEST(a_file_s_own_basis_is_taken)
{
    klems k;
    const klems_ring ring[] = { { 0, 30, 2 }, { 30, 90.0001, 4 } };
    assert_null(klems_make(&k, "mine", ring, 2));
    assert_int_equal(k.cells, 6);
    assert_near(k.area[0], pi / 2 * 0.25, 1e-6);
    assert_non_null(klems_make(&k, "mine", ring, 1));
    const klems_ring gap[] = { { 0, 30, 2 }, { 31, 90, 4 } };
    assert_non_null(klems_make(&k, "mine", gap, 2));
    const klems_ring none[] = { { 0, 30, 2 }, { 30, 90, 0 } };
    assert_non_null(klems_make(&k, "mine", none, 2));
    const klems_ring many[] = { { 0, 30, 2 }, { 30, 90, 1999 } };
    assert_non_null(klems_make(&k, "mine", many, 2));
    const klems_ring nan[] = { { 0, (double)NAN, 2 }, { (double)NAN, 90, 4 } };
    assert_non_null(klems_make(&k, "mine", nan, 2));
}

/* ---- figures of made files ---------------------------------------------------------------------
 */

static double diffuse(int part, int in, int out, const void *with)
{
    (void)in, (void)out, (void)with;
    return (part < 2 ? 0.5 : part == 2 ? 0.1 : 0.3) / pi;
}

static double clear(int part, int in, int out, const void *with)
{
    return in != out ? 0 : (part < 2 ? 0.9 : 0.08) / twin_area(with, in);
}

TEST(a_diffuse_layer_has_its_figures)
{
    for (int i = 0; i < 3; i++) {
        arena a       = { 0 };
        notices n     = { .a = &a };
        lux_error err = { 0 };
        char *text    = twin_text(bases[i], 15, false, diffuse, NULL);
        const bsdf *b = twin_read(&a, text, &n, &err);
        assert_non_null(b);
        const bsdf_figures *f = bsdf_figure(b);
        assert_string_equal(f->basis, bases[i]->name);
        assert_int_equal(f->directions, bases[i]->cells);
        for (int side = 0; side < 2; side++) { /* 9 digits; sums of floats */
            assert_near(f->transmittance[side], 0.5, 1e-6);
            assert_near(f->normal_transmittance[side], 0.5, 1e-6);
            assert_near(f->reflectance[side], side == BSDF_FRONT ? 0.1 : 0.3, 1e-6);
            assert_near(f->normal_reflectance[side], side == BSDF_FRONT ? 0.1 : 0.3, 1e-6);
        }
        assert_near(f->most, 0.8, 1e-6);
        assert_true(f->scale == 1 && f->reciprocity < 1e-6 && n.count == 0);
        free(text);
        arena_clear(&a);
    }
}

TEST(a_clear_pane_has_its_figures)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    char *text    = twin_text(&twin_full, 15, true, clear, &twin_full);
    const bsdf *b = twin_read(&a, text, &n, NULL);
    assert_non_null(b);
    const bsdf_figures *f = bsdf_figure(b);
    assert_near(f->transmittance[0], 0.9, 1e-6);
    assert_near(f->reflectance[1], 0.08, 1e-6);
    assert_near(f->most, 0.98, 1e-6);
    assert_true(f->reciprocity < 1e-6 && n.count == 0);
    free(text);
    arena_clear(&a);
}

static bool told(const notices *n, const char *what)
{
    for (const notice *l = n->first; l; l = l->next)
        if (strstr(l->text, what))
            return true;
    return false;
}

static double gaining(int part, int in, int out, const void *with)
{
    return 1.25 * diffuse(part, in, out, with); /* 0.625 + 0.375 at the back: 1; */
}
static double gaining_more(int part, int in, int out, const void *with)
{
    return 2 * diffuse(part, in, out, with);
}

TEST(what_gains_energy_is_scaled_and_told)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    char *text    = twin_text(&twin_quarter, 15, false, gaining, NULL);
    const bsdf *b = twin_read(&a, text, &n, NULL);
    assert_near(bsdf_figure(b)->most, 1, 1e-6);
    assert_int_equal(n.count, 0); /* but for rounding */
    free(text);

    text = twin_text(&twin_quarter, 15, false, gaining_more, NULL);
    b    = twin_read(&a, text, &n, NULL);
    assert_near(bsdf_figure(b)->most, 1.6, 1e-6);
    assert_near(bsdf_figure(b)->scale, 1 / 1.6, 1e-6);
    assert_near(bsdf_figure(b)->reflectance[BSDF_BACK], 0.375, 1e-6);
    assert_near(bsdf_figure(b)->transmittance[BSDF_FRONT], 0.625, 1e-6);
    assert_true(n.count == 1 && told(&n, "add up to 1.600: all of it is multiplied by 0.6250"));
    free(text);
    arena_clear(&a);
}

/* Of each side its own transmission: Front 0.8, Back 0.1 (no such layer is at rest) */
static double exchanged(int part, int in, int out, const void *with)
{
    static const double share[4] = { 0.8, 0.1, 0.7, 0.1 };
    (void)in, (void)out, (void)with;
    return share[part] / pi;
}

TEST(exchanged_names_are_told)
{
    arena a    = { 0 };
    notices n  = { .a = &a };
    char *text = twin_text(&twin_quarter, 15, false, exchanged, NULL);
    assert_non_null(twin_read(&a, text, &n, NULL));
    assert_true(told(&n, "look exchanged") && told(&n, "far from reciprocal"));
    free(text);
    arena_clear(&a);
}

/* ---- what is missing ---------------------------------------------------------------------------
 */

/* Light that comes in front, from above, goes down; else a little */
static double directional(int part, int in, int out, const void *with)
{
    double i[3], o[3];
    twin_middle(with, in, i);
    twin_middle(with, out, o);
    double f = 0.02 + 0.1 * (1 + o[1]) * (1 - i[1]) + 0.03 * (1 + i[0]); /* ways of light */
    return part < 2 ? f : 0.05 * (1 + i[2] * o[2]);
}

/* The other way: from -o to -i */
static double directional_back(int part, int in, int out, const void *with)
{
    double i[3], o[3];
    twin_middle(with, in, i);
    twin_middle(with, out, o);
    int in2  = twin_cell(with, -o[0], -o[1], o[2]);
    int out2 = twin_cell(with, -i[0], -i[1], i[2]);
    return part == 1 ? directional(0, in2, out2, with) : directional(part, in, out, with);
}

static void same_transmission(const bsdf *b, const bsdf *c, double tolerance)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 41; i++)
            for (int j = 0; j < 41; j++) {
                double p[3], q[3];
                twin_middle(&twin_quarter, i, p);
                twin_middle(&twin_quarter, j, q);
                vvec3 in          = vspread((vec3){ (float)p[0], (float)p[1], (float)p[2] });
                vvec3 out         = vspread((vec3){ (float)q[0], (float)q[1], (float)q[2] });
                vbsdf_place at    = vbsdf_find(b, &in, &out);
                bsdf_side_name of = (bsdf_side_name)side;
                vfloat x          = vbsdf_value(b, of, BSDF_TRANSMIT, &at, ALL_LANES);
                vfloat y          = vbsdf_value(c, of, BSDF_TRANSMIT, &at, ALL_LANES);
                assert_near(lane(x, 0), (double)lane(y, 0), tolerance);
            }
}

TEST(one_way_through_stands_for_the_other)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    char *both    = twin_text(&twin_quarter, 15, false, directional_back, &twin_quarter);
    char *front   = twin_text(&twin_quarter, 1, false, directional_back, &twin_quarter);
    char *back    = twin_text(&twin_quarter, 2, true, directional_back, &twin_quarter);
    const bsdf *b = twin_read(&a, both, &n, NULL);
    assert_true(bsdf_figure(b)->reciprocity < 1e-6 && n.count == 0);
    const bsdf *f = twin_read(&a, front, &n, NULL);
    assert_true(told(&n, "no Transmission Back: taken from Transmission Front by reciprocity"));
    assert_true(told(&n, "no Reflection Front: taken as black"));
    assert_true(told(&n, "no Reflection Back"));
    assert_int_equal(n.count, 3);
    const bsdf *k = twin_read(&a, back, &n, NULL);
    assert_true(told(&n, "no Transmission Front: taken from Transmission Back"));
    same_transmission(b, f, 0);
    same_transmission(b, k, 0);
    assert_true(bsdf_figure(f)->reciprocity < 1e-6 && bsdf_figure(k)->reciprocity < 1e-6);
    assert_true(bsdf_figure(f)->reflectance[0] == 0 && bsdf_figure(f)->reflectance[1] == 0);
    assert_near(bsdf_figure(f)->transmittance[0], bsdf_figure(f)->transmittance[1], 1e-6);
    free(both);
    free(front);
    free(back);

    char *mirror  = twin_text(&twin_quarter, 8, false, directional, &twin_quarter);
    const bsdf *m = twin_read(&a, mirror, &n, NULL);
    assert_true(told(&n, "no Transmission: taken as opaque"));
    assert_true(bsdf_figure(m)->transmittance[0] == 0 && bsdf_figure(m)->reflectance[1] > 0);
    free(mirror);
    arena_clear(&a);
}

TEST(of_a_tree_one_way_through_stands_for_the_other)
{
    arena a = { 0 };
    for (int rank = 3; rank <= 4; rank++) {
        char *text    = twin_tree_text(rank, 1);
        const bsdf *b = twin_read(&a, text, NULL, NULL);
        assert_non_null(b);
        /* Even where it is averaged on a grid, as much passes; rank 4 to the bit */
        assert_near(bsdf_figure(b)->transmittance[0], bsdf_figure(b)->transmittance[1],
                    rank == 3 ? 0.05 : 1e-6);
        assert_true(bsdf_figure(b)->reciprocity < (rank == 3 ? 0.6 : 1e-6));
        free(text);
    }
    arena_clear(&a);
}

/* ---- files that others made, where they are at hand --------------------------------------------
 */

static const bsdf *shared(arena *a, const char *name, notices *n)
{
    char path[300];
    lux_error err         = { 0 };
    const char *folders[] = { getenv("LUX4_BSDF"), "../shared/data/bsdf", "shared/data/bsdf" };
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folders[i] ? folders[i] : "/none", name);
        FILE *f = fopen(path, "rb");
        if (!f)
            continue;
        fclose(f);
        const bsdf *b = bsdf_read(a, path, n, &err);
        if (!b)
            print_message("%s\n", err.text);
        return b;
    }
    return NULL;
}

/* Its name and comment: diffuse, td 0.5 */
TEST(a_shared_diffuse_file_lets_half_through)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = shared(&a, "honeybee-radiance-folder__diffuse50.xml", &n);
    if (b) {
        const bsdf_figures *f = bsdf_figure(b);
        assert_near(f->transmittance[0], 0.5, 1e-3);
        assert_near(f->transmittance[1], 0.5, 1e-3);
        assert_near(f->normal_transmittance[0], 0.5, 1e-3);
        assert_true(f->reflectance[0] == 0 && n.count == 3);
    }
    arena_clear(&a);
}

TEST(a_shared_clear_file_lets_all_through)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = shared(&a, "honeybee-radiance-folder__clear.xml", &n);
    if (b) {
        const bsdf_figures *f = bsdf_figure(b);
        for (int side = 0; side < 2; side++) {
            assert_near(f->transmittance[side], 1, 1e-6);
            assert_near(f->normal_transmittance[side], 1, 1e-6);
            assert_true(f->reflectance[side] == 0);
        }
        assert_true(n.count == 0 && f->reciprocity < 1e-6);
    }
    arena_clear(&a);
}

static double passes(const bsdf *b, bsdf_side_name side, double x, double y, double z)
{
    vvec3 in = vspread((vec3){ (float)x, (float)y, (float)z });
    return (double)lane(vgather(b->side[side].share[BSDF_TRANSMIT], vbsdf_row(b, &in)), 0);
}

/* The file's geometry: slats 25 mm deep at 30 deg, higher toward the room, 24.78 mm apart, no
 * thickness. Light along them passes but for what the cells' width takes; what goes against them
 * does not. From the room along them is down, from the outside up. */
TEST(a_shared_blind_lets_through_along_its_slats)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = shared(&a, "frads__blinds30.xml", &n);
    if (b) {
        double s = sin(30 * pi / 180), c = cos(30 * pi / 180);
        assert_true(passes(b, BSDF_BACK, 0, -s, c) > 0.55);
        assert_true(passes(b, BSDF_BACK, 0, s, c) < 0.15);
        assert_true(passes(b, BSDF_FRONT, 0, s, c) > 0.55);
        assert_true(passes(b, BSDF_FRONT, 0, -s, c) < 0.15);
        assert_true(told(&n, "no Transmission Front: taken from Transmission Back"));
    }
    arena_clear(&a);
}

/* A pane on the room's side of a blind of matt slats (0.5): from the room its mirror image shows,
 * and the slats but through glass of 0.6, twice; from the outside they are seen as they are */
TEST(a_shared_tree_has_its_glass_on_the_room_s_side)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = shared(&a, "pyradiance__blindsT3.xml", &n);
    if (b) {
        const bsdf_figures *f = bsdf_figure(b);
        assert_string_equal(f->basis, "tensor tree of rank 3");
        assert_true(f->normal_reflectance[BSDF_FRONT] > 1.3 * f->normal_reflectance[BSDF_BACK]);
        assert_near(f->transmittance[0], f->transmittance[1], 0.02); /* rays were drawn, 10,000 */
        assert_true(f->most < 1 && f->transmittance[0] < 0.6);
    }
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projected_solid_angles_sum_to_pi),
        cmocka_unit_test(a_direction_drawn_in_a_cell_is_found_in_it),
        cmocka_unit_test(cells_at_edges_are_those_of_the_table),
        cmocka_unit_test(a_file_s_own_basis_is_taken),
        cmocka_unit_test(a_diffuse_layer_has_its_figures),
        cmocka_unit_test(a_clear_pane_has_its_figures),
        cmocka_unit_test(what_gains_energy_is_scaled_and_told),
        cmocka_unit_test(exchanged_names_are_told),
        cmocka_unit_test(one_way_through_stands_for_the_other),
        cmocka_unit_test(of_a_tree_one_way_through_stands_for_the_other),
        cmocka_unit_test(a_shared_diffuse_file_lets_half_through),
        cmocka_unit_test(a_shared_clear_file_lets_all_through),
        cmocka_unit_test(a_shared_blind_lets_through_along_its_slats),
        cmocka_unit_test(a_shared_tree_has_its_glass_on_the_room_s_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
