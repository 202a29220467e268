/* tests/unit/test_office.c -- the office as shipped is what its program makes, and is sound. */
#include "data/office/layout.h"
#include "data/office/paints.h"
#include "data/office/web.h"
#include "tests/solids.h"
#include "tests/test.h"

static bool write_glb(FILE *to)
{
    model m = { 0 };
    office_build(&m, 1.0);
    const bool done = model_write_glb(&m, to);
    model_clear(&m);
    return done;
}

TEST(the_files_in_the_repository_are_those_that_the_program_makes)
{
    assert_file_is("data/office/office.glb", write_glb);
    assert_file_is("data/office/panel.ldt", panel_write);
    assert_file_is("data/office/downlight.ies", downlight_write);
}

/* ---- the triangles ------------------------------------------------------------------------ */

static void assert_sound(const shape *s)
{
    for (int k = 0; k < PAINT_COUNT; k++) {
        const patch *t = &s->patches[k];
        double volume6;
        if (!t->triangle_count)
            continue;
        if (!patch_is_closed(t) || !(patch_least_area(t, &volume6) > 1e-9) || !(volume6 > 0.0))
            fail_msg("%s, %s: open, inside out, or a triangle under 0.001 mm^2", s->name,
                     office_paints[k].name);
    }
}

TEST(every_solid_is_closed_and_looks_outward_and_no_triangle_is_flat)
{
    model m = { 0 };
    office_build(&m, 1.0);
    for (int i = 0; i < m.shape_count; i++)
        assert_sound(&m.shapes[i]);
    model_clear(&m);
}

TEST(mirrored_things_are_not_inside_out)
{
    model m = { 0 };
    office_build(&m, 1.0);
    shape all = model_baked(&m);
    assert_sound(&all);
    solid_clear(&all);
    model_clear(&m);
}

TEST(about_twelve_thousand_triangles_are_placed)
{
    model m = { 0 };
    office_build(&m, 1.0);
    assert_in_range(model_triangles(&m), 11500, 12500);
    assert_false(m.overflow);
    model_clear(&m);
}

TEST(bench_scenes_have_about_the_triangles_asked_for)
{
    model m = { 0 };
    bench_build(&m, 65000);
    assert_near(model_triangles(&m), 65000.0, 0.03); /* segments are whole numbers */
    assert_int_equal(m.shape_count, 1);
    assert_sound(&m.shapes[0]);
    model_clear(&m);
}

/* ---- the photometry ----------------------------------------------------------------------- */

/* Simpson's rule, 2 pi a turn of C, of a web in cd per lumen: its lumens per lumen. */
static double lumens(double (*web)(double c_deg, double gamma_deg))
{
    enum { RINGS = 360, PLANES = 24 };
    const double h = 0.5 * M_PI / RINGS;
    double sum     = 0.0;
    for (int p = 0; p < PLANES; p++)
        for (int i = 0; i <= RINGS; i++) {
            const double weight = i == 0 || i == RINGS ? 1.0 : i % 2 ? 4.0 : 2.0;
            sum += weight * web(360.0 * p / PLANES, 90.0 * i / RINGS) * sin(i * h);
        }
    return sum * h / 3.0 * 2.0 * M_PI / PLANES;
}

static double downlight_plane(double c_deg, double gamma_deg)
{
    (void)c_deg;
    return downlight_web(gamma_deg);
}

TEST(webs_send_out_the_lumens_that_their_files_state)
{
    assert_near(lumens(panel_web), 1.0, 1e-3);
    assert_near(lumens(downlight_plane), 1.0, 1e-3);

    /* The closed forms: I0 = 1 / (2 pi (1/4 + 2.25/12)) and 5 / (2 pi) */
    assert_near(panel_web(0.0, 0.0), 1.0 / (2.0 * M_PI * 0.4375), 1e-3);
    assert_near(downlight_web(0.0), 5.0 / (2.0 * M_PI), 1e-3);
    assert_near(panel_web(90.0, 60.0) / panel_web(0.0, 60.0), 1.375 / 4.0, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_files_in_the_repository_are_those_that_the_program_makes),
        cmocka_unit_test(every_solid_is_closed_and_looks_outward_and_no_triangle_is_flat),
        cmocka_unit_test(mirrored_things_are_not_inside_out),
        cmocka_unit_test(about_twelve_thousand_triangles_are_placed),
        cmocka_unit_test(bench_scenes_have_about_the_triangles_asked_for),
        cmocka_unit_test(webs_send_out_the_lumens_that_their_files_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
