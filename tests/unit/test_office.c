/* tests/unit/test_office.c -- the office as shipped is what its program makes, and is sound. */
#define _GNU_SOURCE /* open_memstream */
#include "data/office/layout.h"
#include "data/office/paints.h"
#include "data/office/web.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool write_glb(FILE *to)
{
    model m = { 0 };
    office_build(&m, 1.0);
    const bool done = model_write_glb(&m, to);
    model_clear(&m);
    return done;
}

static void assert_file_is(const char *path, bool (*write)(FILE *))
{
    char *made  = NULL;
    size_t size = 0;
    FILE *to    = open_memstream(&made, &size);
    assert_true(to && write(to));
    assert_int_equal(fclose(to), 0);

    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *kept        = malloc(size + 1);
    const size_t read = fread(kept, 1, size + 1, f);
    fclose(f);
    assert_int_equal(read, size);
    assert_memory_equal(kept, made, size);
    free(kept);
    free(made);
}

TEST(the_files_in_the_repository_are_those_that_the_program_makes)
{
    assert_file_is("data/office/office.glb", write_glb);
    assert_file_is("data/office/panel.ldt", panel_write);
    assert_file_is("data/office/downlight.ies", downlight_write);
}

/* ---- the triangles ------------------------------------------------------------------------ */

typedef struct edge {
    uint32_t from, to;
} edge;

static int edge_order(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : (p->to > q->to) - (p->to < q->to);
}

/* Every edge is used once each way: the patch is a set of closed surfaces. */
static bool patch_is_closed(const patch *t)
{
    const uint32_t n = 3 * t->triangle_count;
    edge *there = calloc(2 * (size_t)n + 1, sizeof *there), *back = there + n;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t a = t->corners[i], b = t->corners[i % 3 == 2 ? i - 2 : i + 1];
        there[i] = (edge){ a, b };
        back[i]  = (edge){ b, a };
    }
    qsort(there, n, sizeof *there, edge_order);
    qsort(back, n, sizeof *back, edge_order);
    bool closed = memcmp(there, back, n * sizeof *there) == 0;
    for (uint32_t i = 1; i < n; i++)
        closed &= edge_order(&there[i - 1], &there[i]) != 0;
    free(there);
    return closed;
}

static point corner(const patch *t, uint32_t i)
{
    const float *p = t->xyz + 3 * t->corners[i];
    return (point){ (double)p[0], (double)p[1], (double)p[2] };
}

static point cross_of(point a, point b, point c)
{
    const point e = { b.x - a.x, b.y - a.y, b.z - a.z }, f = { c.x - a.x, c.y - a.y, c.z - a.z };
    return (point){ e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x };
}

/* The least area of a triangle, and six times the volume inside: positive if faces look out. */
static double least_area(const patch *t, double *volume6)
{
    double least = HUGE_VAL;
    *volume6     = 0.0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i += 3) {
        const point a = corner(t, i), n = cross_of(a, corner(t, i + 1), corner(t, i + 2));
        const double area = 0.5 * sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        assert_true(isfinite(area));
        least = fmin(least, area);
        *volume6 += a.x * n.x + a.y * n.y + a.z * n.z;
    }
    return least;
}

static void assert_sound(const shape *s)
{
    for (int k = 0; k < PAINT_COUNT; k++) {
        const patch *t = &s->patches[k];
        double volume6;
        if (!t->triangle_count)
            continue;
        if (!patch_is_closed(t) || !(least_area(t, &volume6) > 1e-9) || !(volume6 > 0.0))
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
