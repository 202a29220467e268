/* tests/unit/test_warp.c -- each warp against its pdf, by chi-square, and at its edges. */
#include "core/sampler.h"
#include "core/warp.h"
#include "tests/test.h"

#include <stdlib.h>

enum { SAMPLES = 1 << 18, ROWS = 16, COLUMNS = 32, CELLS = ROWS * COLUMNS };
static const double pi = 3.14159265358979324, by_chance = 1e-4;

/* Independent numbers in [0,1). */
static vfloat even(uint32_t n, uint32_t seed)
{
    vuint bits = vhash_combine(vsplat_uint(seed), vunsigned(vlane_index()) + n);
    return vto_float(vsigned(bits >> 8)) * 0x1p-24f;
}

/* Counts directions by z in [low, 1], and by their angle about z. */
static void count_directions(vvec3 (*warp)(vfloat, vfloat), float low, int *count)
{
    for (uint32_t n = 0; n < SAMPLES; n += LANES) {
        vvec3 w = warp(even(n, 1), even(n, 2));
        for (int i = 0; i < LANES; i++) {
            double turn = atan2((double)lane(w.y, i), (double)lane(w.x, i)) / (2.0 * pi);
            int row     = (int)((lane(w.z, i) - low) / (1.0f - low) * ROWS);
            int column  = (int)((turn < 0.0 ? turn + 1.0 : turn) * COLUMNS);
            row         = row < ROWS ? row : ROWS - 1;
            column      = column < COLUMNS ? column : COLUMNS - 1;
            count[row * COLUMNS + column]++;
        }
    }
}

/* What the pdf makes of the same cells: its integral over each row of z, by Simpson's rule. */
static void expect_directions(vfloat (*pdf)(vfloat), float low, double *expected)
{
    for (int row = 0; row < ROWS; row++) {
        float step = (1.0f - low) / ROWS, z = low + step * (float)row;
        double sum = (double)lane(pdf(vsplat(z)), 0) + (double)lane(pdf(vsplat(z + step)), 0) +
                     4.0 * (double)lane(pdf(vsplat(z + 0.5f * step)), 0);
        for (int column = 0; column < COLUMNS; column++)
            expected[row * COLUMNS + column] =
                SAMPLES * (double)step * sum / 6.0 * 2.0 * pi / COLUMNS;
    }
}

static vfloat sphere_pdf(vfloat z) { return 0.0f * z + WARP_SPHERE_PDF; }

TEST(cosine_directions_follow_their_pdf)
{
    int count[CELLS] = { 0 };
    double expected[CELLS];
    count_directions(vwarp_cosine, 0.0f, count);
    expect_directions(vwarp_cosine_pdf, 0.0f, expected);
    assert_true(chi_square_test(expected, count, CELLS) > by_chance);
    assert_true(vall(vwarp_cosine_pdf(vsplat(-0.5f)) == 0.0f));
}

TEST(sphere_directions_follow_their_pdf)
{
    int count[CELLS] = { 0 };
    double expected[CELLS];
    count_directions(vwarp_sphere, -1.0f, count);
    expect_directions(sphere_pdf, -1.0f, expected);
    assert_true(chi_square_test(expected, count, CELLS) > by_chance);
}

/* Small squares of (u, v); those on the diagonal are half in the triangle. */
TEST(triangle_places_are_even)
{
    enum { SIDE = 16 };
    int count[SIDE * SIDE] = { 0 };
    double expected[SIDE * SIDE];
    for (int a = 0; a < SIDE; a++)
        for (int b = 0; b < SIDE; b++)
            expected[a * SIDE + b] =
                (double)SAMPLES / (SIDE * SIDE) * (a + b < SIDE - 1 ? 2 : a + b == SIDE - 1);
    for (uint32_t n = 0; n < SAMPLES; n += LANES) {
        vfloat u, v;
        vwarp_triangle(even(n, 1), even(n, 2), &u, &v);
        for (int i = 0; i < LANES; i++)
            count[(int)(lane(u, i) * SIDE) * SIDE + (int)(lane(v, i) * SIDE)]++;
    }
    assert_true(chi_square_test(expected, count, SIDE * SIDE) > by_chance);
}

/* The corners, edges and middle lines of the square, and even numbers. */
static vfloat edge(int k)
{
    static const float at[8] = { 0.0f,        0x1p-24f, 0.5f,       0.49999997f,
                                 0.50000006f, 0.25f,    0.9999999f, 0x1.fffffep-1f };
    return vsplat(at[k & 7]);
}

TEST(results_are_whole_at_the_edges)
{
    for (int k = 0; k < 4096; k++) {
        vfloat s = k < 64 ? edge(k) : even((uint32_t)(k * LANES), 3);
        vfloat t = k < 64 ? edge(k >> 3) : even((uint32_t)(k * LANES), 4);
        vvec3 c = vwarp_cosine(s, t), w = vwarp_sphere(s, t);
        assert_true(vall((c.z >= 0.0f) & (c.z <= 1.0f)));
        assert_true(vall(vabs(vdot(c, c) - 1.0f) < 0x1p-21f));
        assert_true(vall(vabs(vdot(w, w) - 1.0f) < 0x1p-21f));
        vfloat u, v;
        vwarp_triangle(s, t, &u, &v);
        assert_true(vall((u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f)));
    }
}

/* A smaller disk, and a bow tie 45 degrees wide, get their share of the samples. */
TEST(square_to_disk_is_even_in_area)
{
    enum { N = 512 };
    int inside = 0, bow_tie = 0, out_of_range = 0;
    for (int n = 0; n < N * N; n += LANES) {
        vfloat x, y;
        vfloat s = (vto_float(vlane_index() + n % N) + 0.5f) / (float)N;
        vfloat t = vsplat(((float)(n / N) + 0.5f) / (float)N);
        vsquare_to_disk(s, t, &x, &y);
        vfloat r2 = x * x + y * y;
        inside += __builtin_popcount((unsigned)vbits(r2 < 0.25f));
        bow_tie += __builtin_popcount((unsigned)vbits(vabs(y) < 0.41421356f * vabs(x)));
        out_of_range += __builtin_popcount((unsigned)vbits(~(r2 <= 1.0f)));
    }
    assert_int_equal(out_of_range, 0);
    assert_near((double)inside / (N * N), 0.25, 1e-3);  /* the edge crosses few of the cells */
    assert_near((double)bow_tie / (N * N), 0.25, 1e-2); /* the edges run along the cells */
}

static void assert_lane(vvec3 a, int i, const float *want)
{
    assert_true(lane(a.x, i) == want[0] && lane(a.y, i) == want[1] && lane(a.z, i) == want[2]);
}

TEST(every_width_gives_the_same_places)
{
    for (uint32_t n = 0; n < 40000; n += LANES) {
        vfloat s = even(n, 5), t = even(n, 6), x, y, u, v;
        vvec3 c = vwarp_cosine(s, t), w = vwarp_sphere(s, t);
        vsquare_to_disk(s, t, &x, &y);
        vwarp_triangle(s, t, &u, &v);
        for (int i = 0; i < LANES; i++) {
            float want[3];
            one_lane_warp_cosine(lane(s, i), lane(t, i), want);
            assert_lane(c, i, want);
            one_lane_warp_sphere(lane(s, i), lane(t, i), want);
            assert_lane(w, i, want);
            one_lane_square_to_disk(lane(s, i), lane(t, i), want);
            assert_true(lane(x, i) == want[0] && lane(y, i) == want[1]);
            one_lane_warp_triangle(lane(s, i), lane(t, i), want);
            assert_true(lane(u, i) == want[0] && lane(v, i) == want[1]);
        }
    }
}

/* Critical values as tables print them (NIST/SEMATECH handbook, 1.3.6.7.4). */
TEST(chi_square_tails_are_those_of_the_tables)
{
    assert_near(chi_square_tail(3.841, 1), 0.05, 1e-3);
    assert_near(chi_square_tail(18.307, 10), 0.05, 1e-3);
    assert_near(chi_square_tail(3.940, 10), 0.95, 1e-3);
    assert_near(chi_square_tail(149.449, 100), 0.001, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cosine_directions_follow_their_pdf),
        cmocka_unit_test(sphere_directions_follow_their_pdf),
        cmocka_unit_test(triangle_places_are_even),
        cmocka_unit_test(results_are_whole_at_the_edges),
        cmocka_unit_test(square_to_disk_is_even_in_area),
        cmocka_unit_test(every_width_gives_the_same_places),
        cmocka_unit_test(chi_square_tails_are_those_of_the_tables),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
