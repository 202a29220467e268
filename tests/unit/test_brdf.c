/* tests/unit/test_brdf.c -- tables of reflection: look-up, energy, and what is drawn from them. */
#include "core/packet_math.h"
#include "tests/brdf_twin.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static const double DEG = M_PI / 180.0;

static arena memory;

static uint32_t seed = 7;
static double random_number(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) * 0x1p-24;
}

static vvec3 spread(dvec w) { return vspread((vec3){ (float)w.x, (float)w.y, (float)w.z }); }

/* ---- look-up --------------------------------------------------------------------------------- */

/* Anywhere above; a third of them within a hundredth of the pole or of the horizon. */
static dvec random_above(void)
{
    double pick = random_number(), u = random_number();
    double theta = pick < 0.16   ? 1e-2 * u * u
                   : pick < 0.33 ? 0.5 * M_PI - 1e-2 * u * u
                                 : acos(sqrt(u));
    dvec w       = direction_of(theta, 2.0 * M_PI * random_number());
    return (dvec){ (double)(float)w.x, (double)(float)w.y, fmax((double)(float)w.z, 1e-7) };
}

/* Off the twin by at most 1e-5 of the largest value: floats of the angles are off by 2.4e-7, of
 * which steps of 7 degrees and more make 2e-6, and three or four of them add up. */
static void compare_with_twin(const brdf_data *d, int pairs)
{
    lux_error err = { 0 };
    const brdf *b = brdf_make(&memory, d, NULL, &err);
    assert_string_equal(err.text, "");
    double worst = 0.0;
    for (int i = 0; i < pairs; i += LANES) {
        dvec in[LANES], out[LANES];
        float x[6][LANES];
        for (int k = 0; k < LANES; k++) {
            in[k]   = random_above();
            out[k]  = random_above();
            x[0][k] = (float)in[k].x, x[1][k] = (float)in[k].y, x[2][k] = (float)in[k].z;
            x[3][k] = (float)out[k].x, x[4][k] = (float)out[k].y, x[5][k] = (float)out[k].z;
            in[k].z = (double)x[2][k], out[k].z = (double)x[5][k];
        }
        vvec3 wi = { vload(x[0]), vload(x[1]), vload(x[2]) };
        vvec3 wo = { vload(x[3]), vload(x[4]), vload(x[5]) };
        vrgb got = vbrdf_value(b, &wo, &wi, ALL_LANES);
        for (int k = 0; k < LANES; k++)
            worst = fmax(worst, fabs((double)lane(got.x, k) - twin_value(d, in[k], out[k])));
    }
    assert_in_range((int)(1e8 * worst), 0, 1000);
    arena_clear(&memory);
}

static const double uneven_theta[] = { 0, 10, 25, 40, 47, 60, 70, 85, 90 };
static const double uneven_phi[]   = { -170, -120, -100, -45, 0, 20, 33, 90, 150 };
static const double uneven_half[]  = { 0, 22, 45, 60, 100, 140, 165 };
static const double uneven_delta[] = { 0, 9, 30, 60, 120, 180 };

/* Of values in [0, 0.1], so that none is scaled. */
static float *random_values(size_t count)
{
    float *rgb = malloc(count * sizeof *rgb);
    for (size_t i = 0; i < count; i++)
        rgb[i] = (float)(0.1 * random_number());
    return rgb;
}

TEST(an_isotropic_table_is_its_twin_in_double)
{
    float *rgb  = random_values(3 * 9 * 9 * 6);
    brdf_data d = { .name   = "t",
                    .kind   = BRDF_ISOTROPIC,
                    .counts = { 9, 9, 6 },
                    .deg    = { uneven_theta, uneven_theta, uneven_delta },
                    .rgb    = rgb };
    compare_with_twin(&d, 400000);
    d.counts[2] = 9; /* with handedness */
    d.deg[2]    = uneven_phi;
    free(rgb);
    d.rgb = rgb = random_values(3 * 9 * 9 * 9);
    compare_with_twin(&d, 200000);
    free(rgb);
}

TEST(an_anisotropic_table_is_its_twin_in_double)
{
    float *rgb  = random_values(3 * 9 * 9 * 9 * 9);
    brdf_data d = { .name   = "t",
                    .kind   = BRDF_ANISOTROPIC,
                    .counts = { 9, 9, 9, 9 },
                    .deg    = { uneven_theta, uneven_phi, uneven_theta, uneven_phi },
                    .rgb    = rgb };
    compare_with_twin(&d, 1000000);
    free(rgb);
}

/* Where wi and wo are nearly mirror images phi_d means little: places at theta_h = 0 agree. */
TEST(a_table_of_half_angles_is_its_twin_in_double)
{
    float *rgb = random_values(3 * 9 * 9 * 7);
    for (int i = 0; i < 9; i++) {
        for (int j = 0; j < 7; j++)
            for (int c = 0; c < 3; c++) {
                rgb[3 * (7 * i + j) + c]  = rgb[3 * 7 * i + c];  /* theta_h = 0 */
                rgb[3 * (63 * i + j) + c] = rgb[3 * 63 * i + c]; /* theta_d = 0 */
            }
    }
    brdf_data d = { .name   = "t",
                    .kind   = BRDF_HALF,
                    .counts = { 9, 9, 7 },
                    .deg    = { uneven_theta, uneven_theta, uneven_half },
                    .rgb    = rgb };
    compare_with_twin(&d, 1000000);
    free(rgb);
}

/* The mean error over pairs up to 70 degrees off the normal. */
static double mean_error(brdf_kind kind, double step, closed_form *f)
{
    notices n       = { 0 };
    const brdf *b   = table_of_form(&memory, kind, step, f, &n);
    double sum      = 0.0;
    const int pairs = 20000;
    for (int i = 0; i < pairs; i++) {
        dvec in  = direction_of(70.0 * DEG * random_number(), 2.0 * M_PI * random_number());
        dvec out = direction_of(70.0 * DEG * random_number(), 2.0 * M_PI * random_number());
        vvec3 wi = spread(in), wo = spread(out);
        sum += fabs((double)lane(vbrdf_value(b, &wo, &wi, ALL_LANES).x, 0) - f(in, out));
    }
    arena_clear(&memory);
    return sum / pairs;
}

/* Halved steps: a quarter of the error, but for terms of higher order. */
TEST(tables_of_closed_forms_converge_at_second_order)
{
    double coarse = mean_error(BRDF_ISOTROPIC, 5.0, phong);
    double fine   = mean_error(BRDF_ISOTROPIC, 2.5, phong);
    assert_near(coarse / fine, 4.0, 0.1);
    coarse = mean_error(BRDF_HALF, 5.0, phong);
    fine   = mean_error(BRDF_HALF, 2.5, phong);
    assert_near(coarse / fine, 4.0, 0.1);
    coarse = mean_error(BRDF_ANISOTROPIC, 15.0, ward);
    fine   = mean_error(BRDF_ANISOTROPIC, 7.5, ward);
    assert_near(coarse / fine, 4.0, 0.15);
}

/* Along delta_phi alone, second differences are at most h^2/8 max |f''| = h^2/8 * 12 * peak. */
TEST(a_table_of_phong_is_within_the_bound_of_its_interpolation)
{
    const brdf *b = table_of_form(&memory, BRDF_ISOTROPIC, 2.5, phong, NULL);
    double h = 2.5 * DEG, peak = 0.3 * 14.0 / (2.0 * M_PI);
    double bound = 3.0 * h * h / 8.0 * (12.0 + 12.0) * peak; /* three angles */
    for (int i = 0; i < 20000; i++) {
        dvec in  = direction_of(85.0 * DEG * random_number(), 2.0 * M_PI * random_number());
        dvec out = direction_of(85.0 * DEG * random_number(), 2.0 * M_PI * random_number());
        vvec3 wi = spread(in), wo = spread(out);
        double got = (double)lane(vbrdf_value(b, &wo, &wi, ALL_LANES).x, 0);
        assert_true(fabs(got - phong(in, out)) < bound);
    }
    arena_clear(&memory);
}

/* ---- the material ---------------------------------------------------------------------------- */

static const material *material_of(const brdf *b)
{
    lux_error err     = { 0 };
    const material *m = material_brdf(&memory, &(brdf_desc){ .table = b, .up = { 1, 0, 0 } }, &err);
    assert_string_equal(err.text, "");
    return m;
}

static vshading shading(double theta, double phi)
{
    return (vshading){ .wo       = spread(direction_of(theta, phi)),
                       .n        = vspread((vec3){ 0, 0, 1 }),
                       .flat     = vspread((vec3){ 0, 0, 1 }),
                       .front    = ALL_LANES,
                       .distance = vsplat(1.0f) };
}

static const double incidences[] = { 0, 30, 60, 80, 89, 89.99 };

/* Of reflect() over the hemisphere, red, by midpoints in sin^2 theta and azimuth. */
static double integral(const material *m, const vshading *s, int thetas, int phis)
{
    double sum = 0.0;
    for (int i = 0; i < thetas; i++) {
        double theta = 0.5 * M_PI * (i + 0.5) / thetas;
        double ring  = 0.0;
        for (int j = 0; j < phis; j += LANES) {
            vfloat phi = (vto_float(j + vlane_index()) + 0.37f) * (float)(2.0 * M_PI / phis);
            vvec3 wi   = { (float)sin(theta) * vcos(phi), (float)sin(theta) * vsin(phi),
                           vsplat((float)cos(theta)) };
            ring += (double)vsum(m->type->reflect(m, s, &wi, ALL_LANES, NULL).x);
        }
        sum += ring * sin(theta);
    }
    return sum * (0.5 * M_PI / thetas) * (2.0 * M_PI / phis);
}

static void check_furnace(const brdf *b, int thetas, int phis)
{
    const material *m = material_of(b);
    for (int i = 0; i < 6; i++) {
        vshading s    = shading(incidences[i] * DEG, 0.4);
        vrgb albedo   = m->type->albedo(m, &s, ALL_LANES);
        double stated = (double)lane(albedo.x, 0);
        assert_true(stated <= 1.0);
        assert_true(fabs(stated - integral(m, &s, thetas, phis)) < 1e-3);
    }
    arena_clear(&memory);
}

TEST(the_albedo_is_the_integral_at_every_incidence)
{
    check_furnace(table_of_form(&memory, BRDF_ISOTROPIC, 5.0, phong, NULL), 360, 360);
    check_furnace(table_of_form(&memory, BRDF_ANISOTROPIC, 15.0, ward, NULL), 360, 360);
    check_furnace(table_of_form(&memory, BRDF_HALF, 5.0, phong, NULL), 720, 720);
}

static double mirror_like(dvec in, dvec out)
{
    double half = (in.z + out.z) / sqrt(2.0 + 2.0 * (in.x * out.x + in.y * out.y + in.z * out.z));
    double tan2 = 1.0 / (half * half) - 1.0;
    return 1.0 * exp(-tan2 / 0.01) / (4.0 * M_PI * 0.01 * fmax(in.z * out.z, 0.02));
}

TEST(gained_light_is_scaled_away_and_the_user_is_told)
{
    const brdf_kind kinds[] = { BRDF_ISOTROPIC, BRDF_HALF };
    for (int k = 0; k < 2; k++) {
        notices n             = { .a = &memory };
        const brdf *b         = table_of_form(&memory, kinds[k], 5.0, mirror_like, &n);
        const brdf_figures *f = brdf_figures_of(b);
        assert_true(f->albedo_most > 1.1f);
        assert_true(f->scale_least < 1.0f && f->scale_least > 0.1f);
        assert_int_equal(n.count, 1);
        assert_non_null(strstr(n.first->text, "times the light"));
        const material *m = material_of(b);
        for (double t = 0.0; t < 90.0; t += 0.7) {
            vshading s = shading(t * DEG, 0.0);
            assert_true(lane(m->type->albedo(m, &s, ALL_LANES).x, 0) <= 1.0f);
        }
        assert_true(m->reflectance.x <= 1.0f);
        arena_clear(&memory);
    }
}

/* The form is reciprocal, its table is so at its places, and linear in each angle between them. */
TEST(scaling_leaves_a_table_reciprocal)
{
    const brdf *b = table_of_form(&memory, BRDF_ISOTROPIC, 5.0, mirror_like, NULL);
    for (int i = 0; i < 2000; i++) {
        vvec3 w[2];
        for (int k = 0; k < 2; k++)
            w[k] = spread(direction_of(85.0 * DEG * random_number(), 6.0 * random_number()));
        double f = (double)lane(vbrdf_value(b, &w[0], &w[1], ALL_LANES).x, 0);
        double g = (double)lane(vbrdf_value(b, &w[1], &w[0], ALL_LANES).x, 0);
        assert_true(fabs(f - g) <= 1e-4 * fmax(f, 1e-3));
    }
    assert_true(brdf_figures_of(b)->reciprocity_worst < 1e-4f);
    arena_clear(&memory);
}

static double one_way(dvec in, dvec out)
{
    (void)out;
    return 0.1 + 0.1 * in.z;
}

TEST(a_table_that_is_not_reciprocal_is_reported_so)
{
    const brdf_figures *f =
        brdf_figures_of(table_of_form(&memory, BRDF_ISOTROPIC, 10.0, one_way, NULL));
    /* 1 - (1 + cos 1.48) / (1 + cos 0.15), to the interpolation of cosines in steps of 10 degrees
     */
    assert_near(f->reciprocity_worst, 1.0 - (1.0 + cos(1.48)) / (1.0 + cos(0.15)), 0.01);
    arena_clear(&memory);
}

/* ---- draws ----------------------------------------------------------------------------------- */

enum { ROWS = 12, COLUMNS = 16, CELLS = ROWS * COLUMNS, FINE = 24 };

static int cell_of(double z, double phi)
{
    int row    = (int)((1.0 - z * z) * ROWS);
    int column = (int)((phi + M_PI) / (2.0 * M_PI) * COLUMNS);
    return (row < ROWS ? row : ROWS - 1) * COLUMNS + (column < COLUMNS ? column : COLUMNS - 1);
}

/* The pdf over cells that are even in sin^2 theta and azimuth; returns its integral. */
static double integrate_pdf(const material *m, const vshading *s, double expected[CELLS])
{
    double sum = 0.0;
    memset(expected, 0, CELLS * sizeof *expected);
    for (int i = 0; i < ROWS * FINE; i++) {
        double s2 = (i + 0.5) / (ROWS * FINE), sine = sqrt(s2), z = sqrt(1.0 - s2);
        for (int j = 0; j < COLUMNS * FINE; j += LANES) {
            double step = 2.0 * M_PI / (COLUMNS * FINE), phi[LANES];
            float x[LANES], y[LANES];
            for (int k = 0; k < LANES; k++) {
                phi[k] = -M_PI + (j + k + 0.5) * step;
                x[k] = (float)(sine * cos(phi[k])), y[k] = (float)(sine * sin(phi[k]));
            }
            vvec3 wi = { vload(x), vload(y), vsplat((float)z) };
            vfloat pdf;
            m->type->reflect(m, s, &wi, ALL_LANES, &pdf);
            for (int k = 0; k < LANES; k++) {
                double part = (double)lane(pdf, k) / z * 0.5 * step / (ROWS * FINE);
                expected[cell_of(z, phi[k])] += part;
                sum += part;
            }
        }
    }
    return sum;
}

/* Draws against the pdf; weights have the albedo as their mean, to four standard errors. */
static void check_draws(const brdf *b, double theta, double phi)
{
    enum { DRAWS = 64000 };
    const material *m = material_of(b);
    vshading s        = shading(theta, phi);
    double expected[CELLS], sum = 0.0, squares = 0.0;
    int count[CELLS] = { 0 }, gone = 0;
    double total = integrate_pdf(m, &s, expected);
    assert_true(total < 1.005);
    for (int i = 0; i < DRAWS; i += LANES) {
        float q[3][LANES];
        for (int k = 0; k < 3 * LANES; k++)
            q[k / LANES][k % LANES] = (float)random_number();
        vscatter out;
        vmask goes =
            m->type->scatter(m, &s, vload(q[0]), vload(q[1]), vload(q[2]), ALL_LANES, &out);
        for (int k = 0; k < LANES; k++) {
            if (!(lane(goes, k) & 1)) {
                gone++;
                continue;
            }
            double w = (double)lane(out.weight.x, k);
            count[cell_of((double)lane(out.wi.z, k),
                          atan2((double)lane(out.wi.y, k), (double)lane(out.wi.x, k)))]++;
            sum += w;
            squares += w * w;
        }
    }
    /* The midpoints of 288 x 384 cells are good to some 5e-3 of a pdf that has steps */
    for (int i = 0; i < CELLS; i++)
        expected[i] *= (DRAWS - gone) / total;
    assert_true(chi_square_test(expected, count, CELLS) > 1e-4);
    assert_true(fabs(gone / (double)DRAWS - (1.0 - total)) < 8e-3);
    double mean = sum / DRAWS, error = sqrt((squares / DRAWS - mean * mean) / DRAWS);
    double want = (double)lane(m->type->albedo(m, &s, ALL_LANES).x, 0);
    assert_true(fabs(mean - want) < 4.0 * error + 1e-3 * want);
}

TEST(draws_have_the_density_that_is_stated)
{
    const double thetas[] = { 0.0, 0.31, 0.8, 1.3, 1.55 };
    const brdf *b[]       = { table_of_form(&memory, BRDF_ISOTROPIC, 10.0, phong, NULL),
                              table_of_form(&memory, BRDF_ANISOTROPIC, 20.0, ward, NULL),
                              table_of_form(&memory, BRDF_HALF, 10.0, phong, NULL) };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++)
            check_draws(b[i], thetas[k], 0.7 * k - 1.0);
    arena_clear(&memory);
}

/* A peak of 1/10 rad in a table of its own resolution: bounded weights, so a small variance. The
 * largest weight of a bilinear corner over its cell's mean is 4, its albedo 1, 8/7 for the cosine;
 * toward the pole 6. */
TEST(narrow_peaks_are_drawn_with_bounded_weights)
{
    const brdf_kind kinds[] = { BRDF_ISOTROPIC, BRDF_HALF };
    for (int i = 0; i < 2; i++) {
        const brdf *b     = table_of_form(&memory, kinds[i], 2.0, mirror_like, NULL);
        const material *m = material_of(b);
        for (double t = 0.01; t < 1.4; t += 0.1) {
            vshading s  = shading(t, 1.0);
            double most = 0.0;
            for (int k = 0; k < 4000; k++) {
                vscatter out;
                m->type->scatter(m, &s, vsplat((float)random_number()),
                                 vsplat((float)random_number()), vsplat((float)random_number()),
                                 ALL_LANES, &out);
                most = fmax(most, (double)lane(out.weight.x, 0));
            }
            assert_true(most < 12.0);
        }
        arena_clear(&memory);
    }
}

/* ---- frames and masks ------------------------------------------------------------------------ */

TEST(azimuth_0_is_where_up_lies_in_the_surface)
{
    const brdf *b     = table_of_form(&memory, BRDF_ANISOTROPIC, 15.0, ward, NULL);
    lux_error err     = { 0 };
    brdf_desc d       = { .table = b, .up = { 0, 0, 2 } };
    const material *m = material_brdf(&memory, &d, &err);

    /* A wall toward +x: the table's x is up, z, and its y is n x up = -y */
    vshading s = { .wo = vspread((vec3){ 0.8f, 0.0f, 0.6f }), .n = vspread((vec3){ 1, 0, 0 }) };
    vvec3 wi   = vspread((vec3){ 0.6f, 0.8f, 0.0f });
    vvec3 wo_t = vspread((vec3){ 0.6f, 0.0f, 0.8f }), wi_t = vspread((vec3){ 0.0f, -0.8f, 0.6f });
    float want = lane(vbrdf_value(b, &wo_t, &wi_t, ALL_LANES).x, 0) * 0.6f;
    assert_near(lane(m->type->reflect(m, &s, &wi, ALL_LANES, NULL).x, 0), want, 1e-5);

    /* A floor: up is square to it, and x takes its place */
    s    = (vshading){ .wo = wo_t, .n = vspread((vec3){ 0, 0, 1 }) };
    want = lane(vbrdf_value(b, &wo_t, &wi_t, ALL_LANES).x, 0) * 0.6f;
    assert_near(lane(m->type->reflect(m, &s, &wi_t, ALL_LANES, NULL).x, 0), want, 1e-5);
    assert_null(material_brdf(&memory, &(brdf_desc){ .table = b }, &err));
    assert_non_null(strstr(err.text, "is no direction"));
    arena_clear(&memory);
}

TEST(dark_lanes_and_directions_below_are_zero)
{
    const material *m = material_of(table_of_form(&memory, BRDF_ISOTROPIC, 15.0, phong, NULL));
    vshading s        = shading(0.5, 0.0);
    vvec3 below       = vspread((vec3){ 0.6f, 0, -0.8f });
    vvec3 nothing     = vspread((vec3){ NAN, NAN, NAN });
    vfloat pdf;
    vrgb f = m->type->reflect(m, &s, &below, ALL_LANES, &pdf);
    assert_true(lane(f.x, 0) == 0.0f && lane(pdf, 0) == 0.0f);
    s.wo = nothing;
    f    = m->type->reflect(m, &s, &nothing, (vmask){ 0 }, &pdf);
    assert_true(lane(f.x, 0) == 0.0f && lane(pdf, 0) == 0.0f);
    vscatter out;
    vfloat u   = vsplat(NAN);
    vmask goes = m->type->scatter(m, &s, u, u, u, (vmask){ 0 }, &out);
    assert_false(vany(goes));
    assert_true(lane(out.weight.x, 0) == 0.0f && lane(out.wi.z, 0) == 0.0f);
    assert_true(lane(m->type->albedo(m, &s, (vmask){ 0 }).x, 0) == 0.0f);
    arena_clear(&memory);
}

static double black(dvec in, dvec out)
{
    (void)in, (void)out;
    return 0.0;
}

TEST(a_black_table_is_drawn_by_the_cosine)
{
    const material *m = material_of(table_of_form(&memory, BRDF_ANISOTROPIC, 30.0, black, NULL));
    vshading s        = shading(0.5, 0.0);
    vscatter out;
    vmask goes = m->type->scatter(m, &s, vsplat(0.3f), vsplat(0.4f), vsplat(0.9f), ALL_LANES, &out);
    assert_true(vall(goes));
    assert_true(lane(out.weight.x, 0) == 0.0f);
    assert_near(lane(out.pdf, 0), (double)lane(out.wi.z, 0) / M_PI, 1e-5);
    arena_clear(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_isotropic_table_is_its_twin_in_double),
        cmocka_unit_test(an_anisotropic_table_is_its_twin_in_double),
        cmocka_unit_test(a_table_of_half_angles_is_its_twin_in_double),
        cmocka_unit_test(tables_of_closed_forms_converge_at_second_order),
        cmocka_unit_test(a_table_of_phong_is_within_the_bound_of_its_interpolation),
        cmocka_unit_test(the_albedo_is_the_integral_at_every_incidence),
        cmocka_unit_test(gained_light_is_scaled_away_and_the_user_is_told),
        cmocka_unit_test(scaling_leaves_a_table_reciprocal),
        cmocka_unit_test(a_table_that_is_not_reciprocal_is_reported_so),
        cmocka_unit_test(draws_have_the_density_that_is_stated),
        cmocka_unit_test(narrow_peaks_are_drawn_with_bounded_weights),
        cmocka_unit_test(azimuth_0_is_where_up_lies_in_the_surface),
        cmocka_unit_test(dark_lanes_and_directions_below_are_zero),
        cmocka_unit_test(a_black_table_is_drawn_by_the_cosine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
