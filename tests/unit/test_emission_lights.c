/* tests/unit/test_emission_lights.c -- light as it sets out, of every type of light: as much, and
 * in the directions, as those find who ask for it.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "tests/sources.h"
#include "tests/test.h"
#include "tests/webs.h"

#include <string.h>

/* ---- how much -------------------------------------------------------------------------------- */

enum { MANY = 1 << 14 };

static void flux_adds_up(const char *name, const light *l)
{
    double want   = (double)light_flux(l).y;
    double sum[3] = { 0 }, squares = 0.0;
    for (int i = 0; i < MANY; i += LANES) {
        vmask lit;
        vlight_ray ray = source_draw(l, i, 5, &lit);
        for (int k = 0; k < LANES; k++) {
            double y = (double)lane(ray.flux.y, k);
            assert_true(isfinite(y) && y >= 0.0);
            assert_true(((vbits(lit) >> k) & 1) || y == 0.0);
            if ((vbits(lit) >> k) & 1)
                assert_near(lane(vlength(ray.direction), k), 1.0, 2e-6);
            sum[0] += (double)lane(ray.flux.x, k) / MANY;
            sum[1] += y / MANY;
            sum[2] += (double)lane(ray.flux.z, k) / MANY;
            squares += y * y / MANY;
        }
    }
    print_message("           %-18s %+.1e, weights vary by %.3f\n", name, sum[1] / want - 1.0,
                  sqrt(fmax(squares / (sum[1] * sum[1]) - 1.0, 0.0)));
    assert_near(sum[0], 1.5 * want, 0.002);
    assert_near(sum[1], want, 0.002);
    assert_near(sum[2], 0.5 * want, 0.002);
    assert_true(squares < 1.0025 * sum[1] * sum[1]); /* weights are even to 5 % */
}

TEST(all_light_of_a_lamp_sets_out) { for_each_source(true, flux_adds_up); }

/* ---- where to -------------------------------------------------------------------------------- */

enum { ROWS = 24, COLUMNS = 24, CELLS = ROWS * COLUMNS, FINE = 24, DRAWN = 1 << 15 };

/* W/sr, as luminance, by what a point far away gets. */
static vfloat intensity(const light *l, vvec3 w)
{
    const float far = 100.0f;
    vvec3 p         = valong(vspread(source_at), w, vsplat(far));
    vlight_sample s;
    vfloat ignored;
    if (l->type->as_point)
        l->type->as_point(l, &p, ALL_LANES, &s, &ignored);
    else
        light_sample(l, &p, vsplat(0), vsplat(0), ALL_LANES, &s);
    return vrgb_luminance(s.e) * s.dist * s.dist;
}

/* W of each cell, equal steps of z and azimuth. */
static void expect(const light *l, double of[CELLS])
{
    memset(of, 0, CELLS * sizeof *of);
    for (int i = 0; i < CELLS * FINE * FINE; i += LANES) {
        vint number = vlane_index() + i;
        vint cell = number / (FINE * FINE), fine = number % (FINE * FINE);
        vfloat s = (vto_float(cell / COLUMNS) + (vto_float(fine / FINE) + 0.5f) / FINE) / ROWS;
        vfloat t = (vto_float(cell % COLUMNS) + (vto_float(fine % FINE) + 0.5f) / FINE) / COLUMNS;
        vfloat w = intensity(l, vwarp_sphere(s, t));
        for (int k = 0; k < LANES; k++)
            of[lane(cell, k)] += 4.0 * M_PI * (double)lane(w, k) / (CELLS * FINE * FINE);
    }
}

typedef struct tally {
    double sum;
    int count;
} tally;

static vfloat random_of(int first, uint32_t which)
{
    vuint n = vhash_combine(vunsigned(vlane_index() + first), vsplat_uint(which));
    return vto_float(vsigned(n >> 8)) * 0x1p-24f;
}

/* Independent random numbers: so the spread of sums over cells is that of Poisson's law. */
static void tally_up(const light *l, tally of[CELLS])
{
    memset(of, 0, CELLS * sizeof *of);
    for (int i = 0; i < DRAWN; i += LANES) {
        vlight_ray r;
        l->type->emit(l, &source_target, random_of(i, 1), random_of(i, 2), random_of(i, 3),
                      random_of(i, 4), ALL_LANES, &r);
        vfloat phi = vatan2(r.direction.y, r.direction.x) * (0.5f / WARP_PI);
        vfloat row = vmax(0.5f - 0.5f * r.direction.z, vsplat(0.0f)) * ROWS;
        vfloat col = vselect(phi < 0.0f, phi + 1.0f, phi) * COLUMNS;
        vint cell  = vto_int(vmin(row, vsplat(ROWS - 1.0f))) * COLUMNS +
                    vto_int(vmin(col, vsplat(COLUMNS - 1.0f)));
        vfloat y = vrgb_luminance(r.flux);
        for (int k = 0; k < LANES; k++) {
            double w = (double)lane(y, k) / DRAWN;
            tally *t = &of[lane(cell, k)];
            t->sum += w;
            t->count += w > 0.0;
        }
    }
}

/* All have nearly the same weight, as the first test says: so many are expected of it in a cell. */
static void directions_agree(const char *name, const light *l)
{
    const double one = (double)rgb_luminance(light_flux(l)) / DRAWN;
    double want[CELLS], chi_square = 0.0, off = 0.0, expected = 0.0;
    tally got[CELLS];
    int degrees = 0;
    expect(l, want);
    tally_up(l, got);
    for (int i = 0; i < CELLS; i++) {
        if (want[i] == 0.0 && got[i].count > 1)
            fail_msg("%s shines where it is dark", name);
        off += (got[i].sum - want[i]) / one;
        expected += want[i] / one;
        if (expected < 20.0 && i < CELLS - 1)
            continue;
        chi_square += off * off / fmax(expected, 1.0);
        degrees++;
        off = expected = 0.0;
    }
    double chance = chi_square_tail(chi_square, degrees);
    print_message("           %-18s chi-square %.1f of %d: %.3f\n", name, chi_square, degrees,
                  chance);
    assert_true(chance > 1e-4); /* one in 500 runs of other numbers */
}

TEST(directions_are_drawn_by_intensity) { for_each_source(false, directions_agree); }

/* ---- lanes ----------------------------------------------------------------------------------- */

static void assert_same(vfloat a, int i, vfloat b, int k)
{
    float x = lane(a, i), y = lane(b, k);
    assert_memory_equal(&x, &y, sizeof x);
}

/* Each number drawn alone, in lane 0, is to the bit what it is among others; dead lanes are zero.
 */
static void lanes_are_alone(const char *name, const light *l)
{
    (void)name;
    const vmask first = vlane_index() == 0;
    for (int i = 0; i < 256; i += LANES) {
        vmask lit;
        vlight_ray all = source_draw(l, i, 9, &lit);
        for (int k = 0; k < LANES; k++) {
            vlight_ray one;
            vsample4 u = vsobol4(vunsigned(vlane_index() + i + k), vsplat_uint(9));
            vmask lone = l->type->emit(l, &source_target, u.z, u.w, u.x, u.y, first, &one);
            assert_int_equal(vbits(lone), (vbits(lit) >> k) & 1);
            assert_same(one.origin.x, 0, all.origin.x, k);
            assert_same(one.origin.y, 0, all.origin.y, k);
            assert_same(one.origin.z, 0, all.origin.z, k);
            assert_same(one.direction.x, 0, all.direction.x, k);
            assert_same(one.direction.z, 0, all.direction.z, k);
            assert_same(one.flux.y, 0, all.flux.y, k);
            for (int j = 1; j < LANES; j++)
                assert_true(lane(one.flux.y, j) == 0.0f && lane(one.origin.x, j) == 0.0f &&
                            lane(one.direction.y, j) == 0.0f);
        }
    }
}

TEST(lanes_do_not_depend_on_those_beside_them) { for_each_source(true, lanes_are_alone); }

/* ---- edges ----------------------------------------------------------------------------------- */

static void numbers_are_finite(const char *name, const light *l)
{
    const float edge[] = { 0.0f, 0.5f, 0x1p-24f, 0x1.fffffep-1f };
    for (int i = 0; i < 256; i++) {
        vlight_ray r;
        vmask lit = l->type->emit(l, &source_target, vsplat(edge[i & 3]), vsplat(edge[i >> 2 & 3]),
                                  vsplat(edge[i >> 4 & 3]), vsplat(edge[i >> 6]), ALL_LANES, &r);
        float sum = lane(r.origin.x + r.origin.y + r.origin.z, 0) +
                    lane(r.direction.x + r.direction.y + r.direction.z, 0);
        float y = lane(r.flux.y, 0);
        if (!isfinite(sum) || !(y >= 0.0f && y < 4.0f * light_flux(l).y))
            fail_msg("%s: corner %d gives %g W, places %g", name, i, (double)y, (double)sum);
        if (vbits(lit) & 1)
            assert_near(lane(vlength(r.direction), 0), 1.0, 2e-6);
    }
}

TEST(corners_of_the_numbers_are_finite) { for_each_source(true, numbers_are_finite); }

/* No light is drawn from webs that have none. */
TEST(dark_webs_give_nothing)
{
    arena a            = { 0 };
    photometry *dark   = web_make(&a, web_isotropic, 4, 30.0);
    photometry *narrow = web_make(&a, web_isotropic, 1, 30.0); /* one angle: a cone without width */
    memset((void *)(uintptr_t)dark->candela, 0, sizeof(float) * 4 * 7);
    narrow->gamma_count = 1;
    for (int i = 0; i < 2; i++) {
        const luminaire_desc d = { .aim   = { 0, 0, -1 },
                                   .scale = { 1, 1, 1 },
                                   .web   = i ? narrow : dark };
        const light *l         = light_luminaire(&a, &d, NULL);
        vmask lit;
        vlight_ray r = source_draw(l, 0, 1, &lit);
        assert_true(!vany(lit) && vsum(r.flux.y) == 0.0f && vsum(r.origin.x) == 0.0f);
    }
    arena_clear(&a);
}

TEST(a_luminaire_needs_memory_for_its_cells)
{
    arena a         = { 0 };
    lux_error err   = { 0 };
    photometry *web = web_make(&a, web_batwing, 4, 5.0);
    memory_is_out   = true;
    assert_null(luminaire_model_new(&a, web, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_light_of_a_lamp_sets_out),
        cmocka_unit_test(directions_are_drawn_by_intensity),
        cmocka_unit_test(lanes_do_not_depend_on_those_beside_them),
        cmocka_unit_test(corners_of_the_numbers_are_finite),
        cmocka_unit_test(dark_webs_give_nothing),
        cmocka_unit_test(a_luminaire_needs_memory_for_its_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
