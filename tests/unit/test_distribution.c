/* tests/unit/test_distribution.c -- tabulated densities: their sums, and what is drawn by them. */
#include "core/distribution.h"
#include "core/sampler.h"
#include "tests/test.h"

enum { MOST_CELLS = 64 };
static const float just_below_one = 0x1.fffffep-1f;

typedef struct drawn {
    int cell;
    float rest, share;
} drawn;

/* One draw, asked for in all lanes. */
static drawn draw(const float *cdf, int first, int count, float u)
{
    vfloat rest, share;
    vint cell = vdistribution_draw(cdf, vsplat_int(first), count, vsplat(u), &rest, &share);
    assert_true(vall(cell == vsplat_int(lane(cell, 0))));
    return (drawn){ lane(cell, 0), lane(rest, 0), lane(share, 0) };
}

/* Even numbers in [0, 1). */
static vfloat even(uint32_t n, uint32_t seed)
{
    vuint bits = vhash_combine(vsplat_uint(seed), vunsigned(vlane_index()) + n);
    return vto_float(vsigned(bits >> 8)) * 0x1p-24f;
}

static void assert_rises_to_one(const float *cdf, int count)
{
    assert_true(cdf[0] == 0.0f && cdf[count] == 1.0f);
    for (int i = 0; i < count; i++)
        assert_true(cdf[i + 1] >= cdf[i]);
}

/* Cells' shares are their weights over the sum, to the rounding of two sums near 1 (2^-25 each). */
TEST(shares_are_weights_over_their_sum)
{
    static const double weights[] = { 0.5, 0, 3, 1e-3, 2, 0, 0, 7.25, 1 };
    enum { N = sizeof weights / sizeof *weights };
    float cdf[N + 1];
    double sum = distribution_make(cdf, weights, N);
    assert_near(sum, 13.751, 1e-15);
    assert_rises_to_one(cdf, N);
    for (int i = 0; i < N; i++) {
        double share = (double)cdf[i + 1] - (double)cdf[i];
        assert_true(fabs(share - weights[i] / sum) <= 0x1p-24);
        assert_true(weights[i] > 0.0 || share == 0.0);
    }
}

/* At both ends and in the middle, where every u of 24 bits is tried that borders on one. */
TEST(cells_of_no_weight_are_never_drawn)
{
    static const double rows[][5] = {
        { 0, 0, 1, 0, 0 },     { 1, 0, 0, 0, 0 }, { 0, 0, 0, 0, 1 }, { 0, 2, 0, 1, 0 },
        { 1, 0, 1e-30, 0, 1 }, { 3, 0, 0, 0, 7 }, { 0, 1, 1, 1, 0 }, { 1e-30, 1, 0, 1, 1e-30 },
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        float cdf[6];
        distribution_make(cdf, rows[r], 5);
        assert_rises_to_one(cdf, 5);
        for (int k = 0; k <= 5; k++)
            for (int off = -2; off <= 2; off++) {
                float u = cdf[k] + 0x1p-24f * (float)off;
                u       = fminf(fmaxf(u, 0.0f), just_below_one);
                drawn d = draw(cdf, 0, 5, u);
                assert_in_range(d.cell, 0, 4);
                assert_true(rows[r][d.cell] > 0.0);
                assert_true(d.share > 0.0f);
                assert_true(d.rest >= 0.0f && d.rest < 1.0f);
            }
    }
}

TEST(where_all_weights_are_zero_all_cells_weigh_the_same)
{
    static const double none[7] = { 0 };
    float cdf[8];
    assert_true(distribution_make(cdf, none, 7) == 0.0);
    assert_rises_to_one(cdf, 7);
    for (int i = 0; i < 7; i++) {
        drawn d = draw(cdf, 0, 7, ((float)i + 0.5f) / 7.0f);
        assert_int_equal(d.cell, i);
        assert_true(fabsf(d.share - 1.0f / 7.0f) <= 0x1p-24f); /* two roundings of 2^-25 */
        assert_true(fabsf(d.rest - 0.5f) <= 8 * 0x1p-24f);     /* those over the share */
    }
}

TEST(one_cell_is_always_drawn_and_passes_u_on)
{
    static const double weights[] = { 0.0, 1.0, 1e300, 1e-300 };
    for (int k = 0; k < 4; k++) {
        float cdf[2];
        assert_true(distribution_make(cdf, &weights[k], 1) == weights[k]);
        assert_true(cdf[0] == 0.0f && cdf[1] == 1.0f);
        for (int n = 0; n <= 16; n++) {
            float u = n < 16 ? (float)n / 16.0f : just_below_one;
            drawn d = draw(cdf, 0, 1, u);
            assert_int_equal(d.cell, 0);
            assert_true(d.rest == u && d.share == 1.0f);
        }
    }
}

/* Tiny shares at the end, where the sum of floats would not reach 1, and where it would pass it. */
TEST(the_largest_u_draws_the_last_cell_of_weight)
{
    for (int count = 1; count <= MOST_CELLS; count++)
        for (int zeros = 0; zeros < count && zeros < 3; zeros++) {
            double weights[MOST_CELLS] = { 0 };
            float cdf[MOST_CELLS + 1];
            for (int i = 0; i < count - zeros; i++)
                weights[i] = 0.1 + 1.0 / (i + 3);
            distribution_make(cdf, weights, count);
            assert_rises_to_one(cdf, count);
            drawn d = draw(cdf, 0, count, just_below_one);
            assert_int_equal(d.cell, count - zeros - 1);
            assert_true(d.rest > 0.99f && d.rest < 1.0f);
            assert_int_equal(draw(cdf, 0, count, 0.0f).cell, 0);
            assert_true(draw(cdf, 0, count, 0.0f).rest == 0.0f);
        }
}

/* u - low and the share of a cell that ends at 1 are halfway between two floats here, and every
 * other time round to the same. */
TEST(what_is_left_of_u_is_below_one_though_differences_round_up)
{
    int clamped = 0;
    for (int k = 0; k < 64; k++) {
        double low             = 0.25 + (2 * k + 1) * 0x1p-25;
        const double weights[] = { low, 1.0 - low };
        float cdf[3];
        distribution_make(cdf, weights, 2);
        assert_true((double)cdf[1] == low);
        drawn d = draw(cdf, 0, 2, just_below_one);
        assert_true(d.rest < 1.0f);
        clamped += just_below_one - cdf[1] == d.share;
    }
    assert_int_equal(clamped, 32);
}

/* How often each cell is drawn, and that what is left of u is even in it. */
TEST(draws_follow_the_weights)
{
    enum { CELLS = 37, PARTS = 8, DRAWS = 1 << 19 };
    static int cells[CELLS], parts[CELLS * PARTS];
    double weights[CELLS], expected[CELLS], expected_parts[CELLS * PARTS];
    float cdf[CELLS + 1];
    for (int i = 0; i < CELLS; i++)
        weights[i] = i % 5 == 3 ? 0.0 : 1.0 + (i * 29) % 17;
    double sum = distribution_make(cdf, weights, CELLS);
    for (int i = 0; i < CELLS * PARTS; i++) {
        expected[i / PARTS] = DRAWS * weights[i / PARTS] / sum;
        expected_parts[i]   = expected[i / PARTS] / PARTS;
    }
    for (uint32_t n = 0; n < DRAWS; n += LANES) {
        vfloat rest, share;
        vint cell = vdistribution_draw(cdf, vsplat_int(0), CELLS, even(n, 9), &rest, &share);
        for (int i = 0; i < LANES; i++) {
            int at = lane(cell, i);
            assert_true(lane(share, i) == cdf[at + 1] - cdf[at]);
            assert_true(lane(rest, i) >= 0.0f && lane(rest, i) < 1.0f);
            cells[at]++;
            parts[at * PARTS + (int)(lane(rest, i) * PARTS)]++;
        }
    }
    for (int i = 0; i < CELLS; i++)
        assert_true(weights[i] > 0.0 || cells[i] == 0);
    assert_true(chi_square_test(expected, cells, CELLS) > 1e-4); /* once in 10,000 by chance */
    assert_true(chi_square_test(expected_parts, parts, CELLS * PARTS) > 1e-4);
}

/* Rows of random weights, a third of them 0: the search against looking at every cell. */
TEST(each_lane_draws_from_its_own_row)
{
    enum { ROWS = 64, CELLS = 13 };
    static float cdf[ROWS * (CELLS + 1)];
    for (int r = 0; r < ROWS; r++) {
        double weights[CELLS];
        for (int i = 0; i < CELLS; i++) {
            double x   = (double)lane(even((uint32_t)(LANES * (r * CELLS + i)), 4), 0);
            weights[i] = x < 1.0 / 3.0 ? 0.0 : x * x;
        }
        distribution_make(cdf + r * (CELLS + 1), weights, CELLS);
    }
    for (uint32_t n = 0; n < 1 << 15; n += LANES) {
        vfloat u = even(n, 5), rest, share;
        vint row = vto_int(even(n, 6) * (float)ROWS);
        vint c   = vdistribution_draw(cdf, row * (CELLS + 1), CELLS, u, &rest, &share);
        for (int i = 0; i < LANES; i++) {
            const float *own = cdf + lane(row, i) * (CELLS + 1);
            int want         = 0;
            while (own[want + 1] <= lane(u, i))
                want++;
            double part = ((double)lane(u, i) - (double)own[want]) /
                          ((double)own[want + 1] - (double)own[want]);
            assert_int_equal(lane(c, i), want);
            assert_true(lane(share, i) == own[want + 1] - own[want]);
            assert_true(fabs((double)lane(rest, i) - part) <= 3 * 0x1p-24); /* three roundings */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_weights_over_their_sum),
        cmocka_unit_test(cells_of_no_weight_are_never_drawn),
        cmocka_unit_test(where_all_weights_are_zero_all_cells_weigh_the_same),
        cmocka_unit_test(one_cell_is_always_drawn_and_passes_u_on),
        cmocka_unit_test(the_largest_u_draws_the_last_cell_of_weight),
        cmocka_unit_test(what_is_left_of_u_is_below_one_though_differences_round_up),
        cmocka_unit_test(draws_follow_the_weights),
        cmocka_unit_test(each_lane_draws_from_its_own_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
