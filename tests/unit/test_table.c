/* tests/unit/test_table.c -- tables in packets against the same in double, one lane at a time. */
#include "core/table.h"
#include "tests/test.h"

#include <math.h>

static const float uneven[]         = { -1.0f, -0.5f, 0.0f, 0.25f, 2.0f, 2.5f, 7.0f };
static const float around[]         = { 0.25f, 1.0f, 1.5f, 4.0f, 6.0f };
static const table_axis open_axis   = { uneven, 7, false, 0.0f };
static const table_axis closed_axis = { around, 5, true, 6.28318531f };

/* The twin: where x is along an axis, in double. */
static void find_double(const table_axis *axis, double x, int *i, int *j, double *f)
{
    double first = (double)axis->at[0], end = (double)axis->at[axis->count - 1];
    if (axis->periodic) {
        end = first + (double)axis->period;
        x   = first + fmod(fmod(x - first, (double)axis->period) + (double)axis->period,
                           (double)axis->period);
    }
    x  = fmin(fmax(x, first), end);
    *i = 0;
    while (*i + 1 < axis->count && (double)axis->at[*i + 1] <= x)
        ++*i;
    if (!axis->periodic && *i + 1 == axis->count && axis->count > 1)
        --*i;
    *j          = *i + 1 < axis->count ? *i + 1 : 0;
    double high = *i + 1 < axis->count ? (double)axis->at[*j] : end;
    double low  = (double)axis->at[*i];
    *f          = high > low ? (x - low) / (high - low) : 0.0;
}

static double look_double(const float *v, const table_axis a[2], double x, double y)
{
    int i, j, k, l;
    double s, t;
    find_double(&a[0], x, &i, &j, &s);
    find_double(&a[1], y, &k, &l, &t);
    int n = a[1].count;
    return (1 - s) * ((1 - t) * (double)v[i * n + k] + t * (double)v[i * n + l]) +
           s * ((1 - t) * (double)v[j * n + k] + t * (double)v[j * n + l]);
}

static void fill(float *values, int count)
{
    uint32_t seed = 1;
    for (int i = 0; i < count; i++) {
        seed      = seed * 1664525u + 1013904223u;
        values[i] = (float)(seed >> 8) * 0x1p-24f;
    }
}

/* In the cells the slopes are at most 1 / 0.25 a unit, and rounding x costs 1e-6: 1e-5. */
TEST(a_table_of_two_axes_is_its_twin_in_double)
{
    float values[35];
    fill(values, 35);
    const table_axis axes[2] = { closed_axis, open_axis };
    for (int i = -60; i <= 120; i++) {
        for (int j = -20; j <= 90; j++) {
            float x = 0.1f * (float)i + 0.013f;
            float y = 0.1f * (float)j + 0.007f;
            vfloat got =
                vtable_lookup2(values, axes, x + vto_float(vlane_index()) * 0.01f, vsplat(y));
            for (int k = 0; k < LANES; k++) {
                float xk    = x + (float)k * 0.01f;
                double want = look_double(values, axes, (double)xk, (double)y);
                assert_true(fabs((double)lane(got, k) - want) < 1e-5);
            }
        }
    }
}

TEST(at_its_places_a_table_is_exact)
{
    float values[35];
    fill(values, 35);
    const table_axis axes[2] = { closed_axis, open_axis };
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 7; j++)
            assert_true(lane(vtable_lookup2(values, axes, vsplat(around[i]), vsplat(uneven[j])),
                             0) == values[7 * i + j]);
}

TEST(beyond_its_ends_an_open_axis_stays_at_the_border)
{
    const float far[] = { -INFINITY, -1e30f, -1.0f, 7.0f, 8.0f, 1e30f, INFINITY };
    for (int i = 0; i < 7; i++) {
        vtable_place p = vtable_find(&open_axis, vsplat(far[i]));
        assert_int_equal(lane(p.below, 0), i < 3 ? 0 : 5);
        assert_true(lane(p.fraction, 0) == (i < 3 ? 0.0f : 1.0f));
    }
}

TEST(a_periodic_axis_goes_over_its_seam)
{
    float values[5]    = { 10, 0, 0, 0, 20 };
    table_axis axes[2] = { closed_axis, { uneven, 1, false, 0.0f } };
    float gap          = 0.25f + 6.28318531f - 6.0f;
    float middle       = 6.0f + 0.5f * gap; /* half way from the last place to the first */
    assert_near(lane(vtable_lookup2(values, axes, vsplat(middle), vsplat(0.0f)), 0), 15.0, 1e-6);
    assert_near(lane(vtable_lookup2(values, axes, vsplat(middle - 6.28318531f), vsplat(0.0f)), 0),
                15.0, 1e-6);
}

TEST(one_place_is_the_value_everywhere)
{
    const float at = 3.0f, value = 42.0f;
    const table_axis axes[2] = { { &at, 1, true, 6.0f }, { &at, 1, false, 0.0f } };
    for (float x = -3.0f; x < 12.0f; x += 0.37f)
        assert_true(lane(vtable_lookup2(&value, axes, vsplat(x), vsplat(-x)), 0) == 42.0f);
}

TEST(no_input_reads_outside_of_the_table)
{
    const float wild[]    = { NAN, -NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e-40f, -0.0f };
    const table_axis *a[] = { &open_axis, &closed_axis };
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 2; k++) {
            vtable_place p = vtable_find(a[k], vsplat(wild[i]));
            for (int l = 0; l < LANES; l++) {
                assert_true(lane(p.below, l) >= 0 && lane(p.below, l) < a[k]->count);
                assert_true(lane(p.above, l) >= 0 && lane(p.above, l) < a[k]->count);
                assert_true(lane(p.fraction, l) >= 0.0f && lane(p.fraction, l) <= 1.0f);
            }
        }
    }
}

TEST(lanes_are_found_each_by_itself)
{
    float x[LANES];
    for (int i = 0; i < LANES; i++)
        x[i] = uneven[(3 * i + 2) % 6] + 0.1f;
    vtable_place p = vtable_find(&open_axis, vload(x));
    for (int i = 0; i < LANES; i++)
        assert_int_equal(lane(p.below, i), (3 * i + 2) % 6);
}

TEST(an_axis_that_does_not_ascend_is_refused)
{
    lux_error err      = { 0 };
    const float bad[]  = { 0.0f, 1.0f, 1.0f };
    const float nan_[] = { 0.0f, NAN };
    assert_true(table_axis_check(&open_axis, "t", &err));
    assert_true(table_axis_check(&closed_axis, "t", &err));
    assert_false(table_axis_check(&(table_axis){ bad, 3 }, "t", &err));
    assert_string_equal(err.text, "t: place 3 (1) is not larger than the one before (1)");
    assert_false(table_axis_check(&(table_axis){ nan_, 2 }, "t", &err));
    assert_false(table_axis_check(&(table_axis){ bad, 0 }, "t", &err));
    assert_false(table_axis_check(&(table_axis){ bad, 2, true, 1.0f }, "t", &err));
    assert_false(table_axis_check(&(table_axis){ bad, 2, true, NAN }, "t", &err));
}

/* ---- bins, and four values a place ------------------------------------------------------------
 */

/* x near each place and between, in and beyond the axis: with bins and without, the same to the
 * bit. */
static void compare_bins(const table_axis *plain, bool wanted)
{
    arena a           = { 0 };
    lux_error err     = { 0 };
    table_axis binned = *plain;
    assert_true(table_axis_bins(&binned, &a, &err));
    assert_true((binned.bins != NULL) == wanted);
    float low = plain->at[0] - 1.0f, high = plain->at[plain->count - 1] + 1.0f;
    for (int i = 0; i < 4000 + 3 * plain->count; i++) {
        float x = low + (high - low) * (float)i / 4000.0f;
        if (i >= 4000) {
            float at = plain->at[(i - 4000) / 3];
            x        = i % 3 == 0 ? at : nextafterf(at, i % 3 == 1 ? INFINITY : -INFINITY);
        }
        vtable_place p = vtable_find(plain, vsplat(x)), q = vtable_find(&binned, vsplat(x));
        assert_int_equal(lane(p.below, 0), lane(q.below, 0));
        assert_int_equal(lane(p.above, 0), lane(q.above, 0));
        assert_true(lane(p.fraction, 0) == lane(q.fraction, 0));
    }
    const float wild[] = { NAN, INFINITY, -INFINITY, 3e38f };
    for (int i = 0; i < 4; i++) {
        vtable_place q = vtable_find(&binned, vsplat(wild[i]));
        assert_true(lane(q.below, 0) >= 0 && lane(q.above, 0) < plain->count);
    }
    arena_clear(&a);
}

TEST(bins_find_the_cells_that_a_search_finds)
{
    static const float two[] = { 1.0f, 5.0f };
    float tight[100]; /* each step twice as long as the one before: no bins */
    for (int i = 0; i < 100; i++)
        tight[i] = ldexpf(1.0f, i / 4) + (float)(i % 4) * ldexpf(0.25f, i / 4);
    compare_bins(&open_axis, true);
    compare_bins(&closed_axis, true);
    compare_bins(&(table_axis){ two, 2 }, false);
    compare_bins(&(table_axis){ two, 1 }, false);
    compare_bins(&(table_axis){ two, 2, true, 6.28318531f }, true);
    compare_bins(&(table_axis){ tight, 100 }, false);
}

/* Four values a place of three and four axes: their twin in double, and exact at its places. */
TEST(four_values_a_place_are_blended_as_one_is)
{
    enum { N = 5, M = 7, PLACES = N * M * N * M };
    static float values[4 * PLACES] __attribute__((aligned(16)));
    fill(values, 4 * PLACES);
    const table_axis axes[4] = { closed_axis, open_axis, closed_axis, open_axis };
    for (int i = 0; i < 3000; i++) {
        float x[4];
        fill(x, 4);
        for (int k = 0; k < 4; k++) {
            x[k] = (float)(i % (17 + k)) * 0.41f - 1.0f + x[k];
            if (i % 10 == 0)
                x[k] = axes[k].at[i / 10 % axes[k].count];
        }
        vtable_place p[4];
        int low[4], high[4];
        double f[4], four = 0.0, three = 0.0;
        for (int k = 0; k < 4; k++) {
            p[k] = vtable_find(&axes[k], x[k] + vto_float(vlane_index() * 0));
            find_double(&axes[k], (double)x[k], &low[k], &high[k], &f[k]);
        }
        for (int c = 0; c < 16; c++) {
            double weight = 1.0, last = 1.0;
            int at = 0, at3 = 0;
            for (int k = 0; k < 4; k++) {
                bool up = c >> k & 1;
                last    = up ? f[k] : 1.0 - f[k];
                at      = at * axes[k].count + (up ? high[k] : low[k]);
                at3     = k < 3 ? at : at3;
                weight *= last;
            }
            four += weight * (double)values[4 * at + 2];
            three += weight * (double)values[4 * at3 + 1]; /* the fourth axis adds up to 1 */
        }
        vfloat got4[4], got3[4];
        vtable_fours4(values, axes, p, got4);
        vtable_fours3(values, axes, p, got3);
        double tolerance = i % 10 == 0 ? 0.0 : 2e-5; /* four slopes of at most 4 a unit */
        for (int l = 0; l < LANES; l++) {
            assert_true(fabs((double)lane(got4[2], l) - four) <= tolerance);
            assert_true(fabs((double)lane(got3[1], l) - three) <= tolerance);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_of_two_axes_is_its_twin_in_double),
        cmocka_unit_test(at_its_places_a_table_is_exact),
        cmocka_unit_test(beyond_its_ends_an_open_axis_stays_at_the_border),
        cmocka_unit_test(a_periodic_axis_goes_over_its_seam),
        cmocka_unit_test(one_place_is_the_value_everywhere),
        cmocka_unit_test(no_input_reads_outside_of_the_table),
        cmocka_unit_test(lanes_are_found_each_by_itself),
        cmocka_unit_test(an_axis_that_does_not_ascend_is_refused),
        cmocka_unit_test(bins_find_the_cells_that_a_search_finds),
        cmocka_unit_test(four_values_a_place_are_blended_as_one_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
