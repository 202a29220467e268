/* tests/physics/test_layers.c -- the glazing and the blind that lux4 ships: their models against
 * closed forms and a random walk, and the files against their models. */
#define _GNU_SOURCE /* open_memstream */
#include "data/materials/bsdf_models.h"
#include "materials/bsdf.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

static bsdf_model model;

static void assert_file_is(const char *path)
{
    char *made  = NULL;
    size_t size = 0;
    FILE *to    = open_memstream(&made, &size);
    assert_true(to && model_write(&model, to));
    assert_int_equal(fclose(to), 0);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *kept        = malloc(size + 1);
    const size_t read = fread(kept, 1, size + 1, f);
    fclose(f);
    assert_int_equal(read, size);
    assert_memory_equal(kept, made, size);
    assert_true(size < 600000);
    free(kept);
    free(made);
}

TEST(the_files_in_the_repository_are_those_that_the_program_makes)
{
    const slats blind = slats_shipped();
    model_glazing(&model);
    assert_file_is("data/materials/glazing.xml");
    assert_true(model_blind(&model, &blind));
    assert_file_is("data/materials/blind.xml");
}

/* ---- glazing -----------------------------------------------------------------------------------
 */

/* The unpolarised slab, with passages to and fro: published figures to four digits */
TEST(a_pane_passes_what_the_closed_form_says)
{
    static const double deg[]     = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 85 };
    static const double perfect[] = { .9183, .9183, .9179, .9160, .9095,
                                      .8912, .8435, .7247, .4560, .2456 };
    static const double real[]    = { .8828, .8826, .8816, .8786, .8709,
                                      .8515, .8036, .6876, .4268, .2217 };
    for (int i = 0; i < 10; i++) {
        pane_share p = pane_of(1.52, 1.0, cos(deg[i] * pi / 180));
        pane_share q = pane_of(1.53, 0.964, cos(deg[i] * pi / 180));
        assert_true(fabs(0.5 * (p.passed[0] + p.passed[1]) - perfect[i]) < 6e-5);
        assert_true(fabs(0.5 * (q.passed[0] + q.passed[1]) - real[i]) < 6e-5);
        for (int k = 0; k < 2; k++)
            assert_near(p.passed[k] + p.reflected[k], 1, 1e-12);
    }
}

/* Light followed to and fro between two panes until none is left */
TEST(two_panes_are_the_sum_of_all_passages)
{
    for (int deg = 0; deg < 90; deg += 7) {
        pane_share a = pane_of(1.53, 0.964, cos(deg * pi / 180));
        pane_share b = pane_of(1.70, 0.5, cos(deg * pi / 180)), both = pane_behind_pane(a, b);
        for (int k = 0; k < 2; k++) {
            double passed = 0, reflected = a.reflected[k];
            for (double light = a.passed[k]; light > 1e-18;) {
                passed += light * b.passed[k];
                light *= b.reflected[k];
                reflected += light * a.passed[k];
                light *= a.reflected[k];
            }
            assert_near(both.passed[k], passed, 1e-12);
            assert_near(both.reflected[k], reflected, 1e-12);
        }
    }
}

TEST(the_glazing_has_the_figures_of_its_model)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = bsdf_read(&a, "data/materials/glazing.xml", &n, NULL);
    assert_non_null(b);
    const bsdf_figures *f = bsdf_figure(b);
    pane_share pane = pane_of(1.53, 0.964, 1), both = pane_behind_pane(pane, pane);
    for (int side = 0; side < 2; side++) { /* within 5 deg of the normal little changes */
        assert_near(f->normal_transmittance[side], both.passed[0], 1e-3);
        assert_near(f->normal_reflectance[side], both.reflected[0], 1e-3);
    }
    double sum = 0; /* T of diffuse light: of 2 cos d(cos), by midpoints */
    for (int i = 0; i < 2000; i++) {
        double z         = (i + 0.5) / 2000;
        pane_share outer = pane_of(1.53, 0.964, z), two = pane_behind_pane(outer, outer);
        sum += (two.passed[0] + two.passed[1]) * z / 2000;
    }
    assert_near(f->transmittance[BSDF_FRONT], sum, 1e-3);
    assert_true(f->most < 1 && f->reciprocity == 0 && n.count == 0);
    arena_clear(&a);
}

/* ---- the blind ---------------------------------------------------------------------------------
 */

static double sum_of(double (*f)[FULL_CELLS], int in)
{
    double sum = 0;
    for (int out = 0; out < FULL_CELLS; out++)
        sum += f[in][out] * full_area(out);
    return sum;
}

TEST(a_beam_along_the_slats_passes_and_one_square_to_them_does_not)
{
    const slats s        = slats_shipped();
    const double c       = sqrt(0.5);
    const double along[] = { 0, c, c }, square[] = { 0, -c, c }, normal[] = { 0, 0, 1 };
    const double aslant[] = { 0.6, 0.8 * c, 0.8 * c }; /* along, and along their length */
    assert_near(slats_open(&s, 0, along), 1, 1e-12);   /* no thickness */
    assert_near(slats_open(&s, 0, aslant), 1, 1e-12);
    assert_near(slats_open(&s, 0, square) + 1, 1, 1e-12);
    assert_near(slats_open(&s, 0, normal), 1 - 0.025 * c / 0.020, 1e-12);
    assert_near(slats_open(&s, 1, square), 1, 1e-12); /* from the room: down along them */
    assert_near(slats_open(&s, 1, along) + 1, 1, 1e-12);
}

TEST(black_slats_pass_what_meets_none_and_white_ones_lose_nothing)
{
    slats s = slats_shipped();
    for (int white = 0; white < 2; white++) {
        s.reflectance = white;
        assert_true(model_blind(&model, &s));
        for (int in = 0; in < FULL_CELLS; in++)
            for (int side = 0; side < 2; side++) {
                double through  = sum_of(model.transmission[side], in);
                double back     = sum_of(model.reflection[side], in);
                double straight = model.transmission[side][in][in] * full_area(in);
                if (white) /* 24 strips a face, 256 samples a cell */
                    assert_near(through + back, 1, 5e-3);
                else
                    assert_true(back == 0 && fabs(through - straight) < 1e-12);
            }
    }
}

TEST(the_model_of_the_blind_is_reciprocal)
{
    const slats s = slats_shipped();
    assert_true(model_blind(&model, &s));
    int opposite[FULL_CELLS];
    for (int i = 0; i < FULL_CELLS; i++) { /* half around its ring */
        static const int count[] = { 1, 8, 16, 20, 24, 24, 24, 16, 12 };
        int ring = 0, first = 0;
        for (; i >= first + count[ring]; ring++)
            first += count[ring];
        opposite[i] = first + (i - first + count[ring] / 2) % count[ring];
    }
    for (int in = 0; in < FULL_CELLS; in++)
        for (int out = 0; out < FULL_CELLS; out++) {
            int from = opposite[out], to = opposite[in];
            assert_true(fabs(model.transmission[0][in][out] - model.transmission[1][from][to]) <
                        1e-9);
            assert_true(fabs(model.reflection[0][in][out] - model.reflection[0][from][to]) < 1e-9);
            assert_true(fabs(model.reflection[1][in][out] - model.reflection[1][from][to]) < 1e-9);
        }
}

/* ---- a random walk between the slats -----------------------------------------------------------
 */

typedef struct walk {
    double y, z, way[3];
} walk;

/* Goes on to the next slat or out: -1 outside, 1 the room, else 0 and *face, 0 lower, 1 upper. Both
 * are planes y = z tan(tilt) + face spacing. */
static int step(const slats *s, walk *w, int *face)
{
    const double slope = tan(s->tilt), deep = s->width * cos(s->tilt);
    double rate = w->way[1] - slope * w->way[2], height = w->y - slope * w->z;
    double target  = rate > 0 ? s->spacing : 0;
    double to_slat = rate == 0 ? HUGE_VAL : (target - height) / rate;
    double to_end  = w->way[2] > 0 ? (deep - w->z) / w->way[2] : -w->z / w->way[2];
    if (to_end <= to_slat)
        return w->way[2] > 0 ? 1 : -1;
    w->y += to_slat * w->way[1];
    w->z += to_slat * w->way[2];
    *face = rate > 0;
    return 0;
}

/* Off a face: Lambert's cosine about (0, cos tilt, -sin tilt), or its opposite */
static void reflect(const slats *s, walk *w, int face, uint32_t *seed)
{
    double zz = (double)random_unit(seed), phi = 2 * pi * (double)random_unit(seed);
    double r = sqrt(zz), up = sqrt(1 - zz) * (face ? -1 : 1);
    double c = cos(s->tilt), d = sin(s->tilt);
    w->way[0] = r * cos(phi);
    w->way[1] = r * sin(phi) * d + up * c;
    w->way[2] = r * sin(phi) * c - up * d;
}

static int leaves(const slats *s, walk w, uint32_t *seed) /* 0: absorbed */
{
    for (;;) {
        int face, end = step(s, &w, &face);
        if (end != 0)
            return end;
        if ((double)random_unit(seed) >= s->reflectance)
            return 0;
        reflect(s, &w, face, seed);
    }
}

TEST(a_random_walk_between_the_slats_gives_the_same_sums)
{
    enum { WALKS = 20000 };
    const slats s = slats_shipped();
    uint32_t seed = 9;
    assert_true(model_blind(&model, &s));
    for (int cell = 3; cell < FULL_CELLS; cell += 17)
        for (int side = 0; side < 2; side++) {
            int through = 0, back = 0;
            for (int i = 0; i < WALKS; i++) {
                walk w = { .z = side ? s.width * cos(s.tilt) : 0 };
                full_sample(cell, i % FULL_SAMPLES, i / FULL_SAMPLES % FULL_SAMPLES, w.way);
                w.y      = w.z * tan(s.tilt) + s.spacing * (double)random_unit(&seed);
                w.way[2] = side ? -w.way[2] : w.way[2];
                int end  = leaves(&s, w, &seed);
                through += end == (side ? -1 : 1);
                back += end == (side ? 1 : -1);
            }
            /* Four standard deviations, and what strips and samples come to */
            const double off = 4 * sqrt(0.25 / WALKS) + 2e-3;
            assert_true(fabs((double)through / WALKS - sum_of(model.transmission[side], cell)) <
                        off);
            assert_true(fabs((double)back / WALKS - sum_of(model.reflection[side], cell)) < off);
        }
}

/* ---- the blind as a material -------------------------------------------------------------------
 */

/* f from the sky or ground outside, wi, to the room, wo: the blind in z = 0, the room above it */
static double seen(const material *m, double wo_y, double wo_z, double wi_y, double wi_z)
{
    vshading s = { .wo       = vspread((vec3){ 0, (float)wo_y, (float)wo_z }),
                   .n        = vspread((vec3){ 0, 0, 1 }),
                   .front    = ALL_LANES,
                   .distance = vsplat(1.0f) };
    s.flat     = s.n;
    vvec3 wi   = vspread((vec3){ 0, (float)wi_y, (float)wi_z });
    return (double)lane(m->type->reflect(m, &s, &wi, ALL_LANES, NULL).y, 0) / fabs(wi_z);
}

TEST(the_blind_throws_light_from_above_to_the_ceiling)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    const bsdf *b = bsdf_read(&a, "data/materials/blind.xml", &n, NULL);
    assert_non_null(b);
    const bsdf_desc d = { .data = b, .up = { 0, 1, 0 } };
    const material *m = material_bsdf(&a, &d, NULL);
    assert_non_null(m);
    const double s = sin(60 * pi / 180), c = cos(60 * pi / 180), h = sqrt(0.5);

    /* The sun shines on the slats' upper faces: what is higher than 45 deg in the room sees them,
     * all else sees lower faces */
    assert_true(seen(m, s, c, h, -h) > 2 * seen(m, -s, c, h, -h));
    assert_true(seen(m, -s, c, h, -h) > 0);

    /* From the floor outside along the slats to the ceiling, hardly weakened; not from the sky */
    assert_true(seen(m, h, h, -h, -h) > 10);
    assert_true(seen(m, -h, h, h, -h) < 0.2);

    const bsdf_figures *f = bsdf_figure(b);
    assert_true(f->most < 0.97 && f->scale == 1 && n.count == 0);
    assert_true(f->reciprocity < 1e-3); /* three digits */
    assert_near(f->transmittance[0], f->transmittance[1], 1e-4);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_files_in_the_repository_are_those_that_the_program_makes),
        cmocka_unit_test(a_pane_passes_what_the_closed_form_says),
        cmocka_unit_test(two_panes_are_the_sum_of_all_passages),
        cmocka_unit_test(the_glazing_has_the_figures_of_its_model),
        cmocka_unit_test(a_beam_along_the_slats_passes_and_one_square_to_them_does_not),
        cmocka_unit_test(black_slats_pass_what_meets_none_and_white_ones_lose_nothing),
        cmocka_unit_test(the_model_of_the_blind_is_reciprocal),
        cmocka_unit_test(a_random_walk_between_the_slats_gives_the_same_sums),
        cmocka_unit_test(the_blind_throws_light_from_above_to_the_ceiling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
