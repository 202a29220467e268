/* tests/unit/test_sampler.c -- Sobol points: right, even, independent, and honest about errors. */
#include "core/sampler.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

/* Sample n of the set, by number: Sobol dimensions 1 to 6 in their order. */
enum { DIMENSIONS = 6 };
typedef struct point {
    float u[DIMENSIONS];
} point;

static void points(uint32_t first, int count, uint32_t seed, point *out)
{
    for (int n = 0; n < count; n += LANES) {
        vuint index = vunsigned(vlane_index()) + first + (uint32_t)n;
        vsample4 s  = vsobol4(index, vsplat_uint(seed));
        vsample4 m  = vsobol4_more(index, vsplat_uint(seed));
        for (int i = 0; i < LANES && n + i < count; i++)
            out[n + i] = (point){ { lane(s.x, i), lane(s.y, i), lane(m.z, i), lane(m.x, i),
                                    lane(m.w, i), lane(m.y, i) } };
    }
}

/* ---- a twin that follows the publications step by step ---- */

static uint32_t reverse(uint32_t a)
{
    uint32_t r = 0;
    for (int i = 0; i < 32; i++)
        r |= (a >> i & 1) << (31 - i);
    return r;
}

/* Joe & Kuo's recurrence, and the lines of new-joe-kuo-6.21201 for dimensions 2 to 6. */
static uint32_t sobol_twin(uint32_t index, int dimension)
{
    static const struct {
        uint32_t s, a, m[4];
    } line[DIMENSIONS] = { { 0, 0, { 0 } },       { 1, 0, { 1 } },       { 2, 1, { 1, 3 } },
                           { 3, 1, { 1, 3, 1 } }, { 3, 2, { 1, 1, 1 } }, { 4, 1, { 1, 1, 3, 3 } } };

    uint32_t v[32], x = 0, s = line[dimension].s;
    for (uint32_t k = 0; k < 32; k++) {
        if (s == 0)
            v[k] = 1u << (31 - k);
        else if (k < s)
            v[k] = line[dimension].m[k] << (31 - k);
        else {
            v[k] = v[k - s] ^ (v[k - s] >> s);
            for (uint32_t i = 1; i < s; i++)
                v[k] ^= line[dimension].a >> (s - 1 - i) & 1 ? v[k - i] : 0;
        }
        x ^= index >> k & 1 ? v[k] : 0;
    }
    return x;
}

static uint32_t nested_scramble_twin(uint32_t x, uint32_t seed)
{
    x = reverse(x);
    x ^= x * 0x3d20adea;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56;
    x ^= x * 0x53a22864;
    return reverse(x);
}

TEST(the_twin_starts_as_published)
{
    /* The output of Joe & Kuo's own program, which goes in the order of Gray's code: number n there
     * is number n ^ n / 2. */
    static const double published[5][DIMENSIONS] = {
        { 0, 0, 0, 0, 0, 0 },
        { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 },
        { 0.75, 0.25, 0.25, 0.25, 0.75, 0.75 },
        { 0.25, 0.75, 0.75, 0.75, 0.25, 0.25 },
        { 0.375, 0.375, 0.625, 0.875, 0.375, 0.125 },
    };
    for (uint32_t n = 0; n < 5; n++)
        for (int d = 0; d < DIMENSIONS; d++)
            assert_near(sobol_twin(n ^ n >> 1, d) * 0x1p-32, published[n][d], 0.0);
}

TEST(points_are_those_of_the_twin)
{
    for (uint32_t k = 0; k < 20000; k++) {
        uint32_t seed  = k < 100 ? k : hash_u32(2 * k);
        uint32_t index = k < 100 ? k : hash_u32(2 * k + 1) >> k % 32;
        point p;
        points(index, 1, seed, &p);
        uint32_t h = hash_u32(seed), n = nested_scramble_twin(index, hash_u32(h));
        for (int d = 0; d < DIMENSIONS; d++) {
            uint32_t x = nested_scramble_twin(sobol_twin(n, d), hash_u32(h + 1 + (uint32_t)d));
            assert_true(p.u[d] == (float)(x >> 8) * 0x1p-24f);
            assert_true(p.u[d] >= 0.0f && p.u[d] < 1.0f);
        }
    }
}

TEST(numbers_of_a_second_vertex_are_of_the_same_set)
{
    for (uint32_t k = 0; k < 1000; k += LANES) {
        vuint index = vunsigned(vlane_index()) + k, seed = vhash(index);
        vsample4 s = vsobol4(index, seed), m = vsobol4_more(index, seed);
        assert_false(vany((m.z != s.z) | (m.x != s.w)));
    }
}

TEST(every_width_gives_the_same_points)
{
    for (uint32_t k = 0; k < 20000; k += LANES) {
        vuint index = vunsigned(vlane_index()) + k;
        vuint seed = vhash(index), both = vhash_combine(index, seed);
        vsample4 s = vsobol4(index, both), m = vsobol4_more(index, both);
        for (int i = 0; i < LANES; i++) {
            float one[4];
            assert_int_equal(lane(seed, i), hash_u32(k + (uint32_t)i));
            assert_int_equal(lane(seed, i), one_lane_hash(k + (uint32_t)i));
            assert_int_equal(lane(both, i), hash_combine_u32(k + (uint32_t)i, lane(seed, i)));
            assert_int_equal(lane(both, i), one_lane_hash_combine(k + (uint32_t)i, lane(seed, i)));
            one_lane_sobol4(k + (uint32_t)i, lane(both, i), one);
            assert_true(lane(s.x, i) == one[0] && lane(s.y, i) == one[1]);
            assert_true(lane(s.z, i) == one[2] && lane(s.w, i) == one[3]);
            one_lane_sobol4_more(k + (uint32_t)i, lane(both, i), one);
            assert_true(lane(m.x, i) == one[0] && lane(m.y, i) == one[1]);
            assert_true(lane(m.z, i) == one[2] && lane(m.w, i) == one[3]);
        }
    }
}

/* ---- evenness ---- */

/* Of 2^m points, one in each of 2^a columns by 2^(m-a) rows. */
static bool one_in_each(const point *p, int m, int a, int column_of, int row_of)
{
    static bool taken[4096];
    memset(taken, 0, sizeof taken);
    for (int n = 0; n < 1 << m; n++) {
        int column = (int)(p[n].u[column_of] * (float)(1 << a));
        int row    = (int)(p[n].u[row_of] * (float)(1 << (m - a)));
        bool *cell = &taken[(row << a) + column];
        if (*cell)
            return false;
        *cell = true;
    }
    return true;
}

TEST(powers_of_two_samples_are_a_net)
{
    static point p[4096];
    for (int m = 0; m <= 12; m++)
        for (uint32_t block = 0; block < 3; block++) {
            points(block << m, 1 << m, 77 * block + (uint32_t)m, p);
            for (int d = 0; d < DIMENSIONS; d++)
                assert_true(one_in_each(p, m, m, d, d));
            for (int a = 0; a <= m; a++)
                assert_true(one_in_each(p, m, a, 0, 1));
        }
}

/* The most that a cell of 2^a columns by 2^(m-a) rows holds of 2^m points. */
static int most_in_one(const point *p, int m, int a, int column_of, int row_of)
{
    static int held[4096];
    int most = 0;
    memset(held, 0, sizeof held);
    for (int n = 0; n < 1 << m; n++) {
        int column = (int)(p[n].u[column_of] * (float)(1 << a));
        int row    = (int)(p[n].u[row_of] * (float)(1 << (m - a)));
        int *cell  = &held[(row << a) + column];
        most       = ++*cell > most ? *cell : most;
    }
    return most;
}

/* In the plane of two coordinates whose polynomials are of degrees s and s' (of the first: 1) no
 * cell of area 2^-m holds more than 2^t points, t = s - 1 + s' - 1 (Sobol 1967; Niederreiter,
 * "Random number generation and quasi-Monte Carlo methods", 1992, section 4.5). */
TEST(planes_of_all_six_dimensions_are_nets)
{
    static const int degree[DIMENSIONS] = { 1, 1, 2, 3, 3, 4 };
    enum { M = 12 };
    static point p[1 << M];
    for (uint32_t block = 0; block < 2; block++) {
        points(block << M, 1 << M, 31 + block, p);
        for (int d = 0; d < DIMENSIONS; d++)
            for (int e = 0; e < d; e++)
                for (int a = 0; a <= M; a++) {
                    int t = degree[d] + degree[e] - 2;
                    assert_true(most_in_one(p, M, a, d, e) <= 1 << t);
                }
    }
}

/* The share of points in a grid of 16 x 16 over any two coordinates, over many seeds. */
TEST(each_sample_is_even_over_the_seeds)
{
    enum { SEEDS = 1 << 16, CELLS = 256, PAIRS = DIMENSIONS * (DIMENSIONS - 1) / 2 };
    double expected[CELLS];
    for (int c = 0; c < CELLS; c++)
        expected[c] = (double)SEEDS / CELLS;
    for (uint32_t index = 0; index < 2; index++) {
        static int count[PAIRS][CELLS];
        memset(count, 0, sizeof count);
        for (uint32_t seed = 0; seed < SEEDS; seed++) {
            point p;
            points(index, 1, seed, &p);
            for (int a = 0, pair = 0; a < DIMENSIONS; a++)
                for (int b = a + 1; b < DIMENSIONS; b++, pair++)
                    count[pair][(int)(p.u[a] * 16.0f) * 16 + (int)(p.u[b] * 16.0f)]++;
        }
        for (int pair = 0; pair < PAIRS; pair++)
            assert_true(chi_square_test(expected, count[pair], CELLS) > 1e-4);
    }
}

/* ---- integrals ---- */

/* The mean of exp(x + y + z + w) is (e - 1)^4; its standard deviation follows likewise. */
static const double exact = 8.71721164; /* 1.71828183^4 */
static double deviation(void) { return sqrt(pow(expm1(2.0) / 2.0, 4.0) - exact * exact); }

static double estimate(int count, uint32_t seed)
{
    static point p[4096];
    double sum = 0.0;
    points(0, count, seed, p);
    for (int n = 0; n < count; n++) {
        const float *u = p[n].u;
        sum += exp((double)u[0] + (double)u[1] + (double)u[2] + (double)u[3]);
    }
    return sum / count;
}

TEST(smooth_integrals_converge_far_faster_than_at_random)
{
    enum { N = 1024, SEEDS = 64 };
    double squares = 0.0;
    for (uint32_t seed = 0; seed < SEEDS; seed++)
        squares += pow(estimate(N, seed) - exact, 2.0);
    assert_true(sqrt(squares / SEEDS) < deviation() / sqrt(N) / 30.0);
}

TEST(the_mean_over_seeds_is_unbiased)
{
    enum { SEEDS = 4096 };
    double sum = 0.0, squares = 0.0, neighbours = 0.0, last = 0.0;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        double off = estimate(16, seed) - exact;
        sum += off;
        squares += off * off;
        neighbours += off * last;
        last = off;
    }
    double variance = squares / SEEDS;
    assert_true(fabs(sum / SEEDS) < 4.0 * sqrt(variance / SEEDS));
    assert_true(fabs(neighbours / SEEDS / variance) < 4.0 / sqrt(SEEDS)); /* errors of s, s + 1 */
}

/* Means of 16 scrambles: what their spread tells, against the error that they have. */
TEST(the_spread_of_16_scrambles_tells_the_error)
{
    enum { GROUPS = 512, SCRAMBLES = 16 };
    double told = 0.0, real = 0.0;
    int covered = 0;
    for (uint32_t g = 0; g < GROUPS; g++) {
        double sum = 0.0, squares = 0.0;
        for (uint32_t k = 0; k < SCRAMBLES; k++) {
            double off = estimate(64, hash_combine_u32(g, k)) - exact;
            sum += off;
            squares += off * off;
        }
        double mean     = sum / SCRAMBLES;
        double variance = (squares / SCRAMBLES - mean * mean) / (SCRAMBLES - 1); /* of the mean */
        told += variance;
        real += mean * mean;
        covered += fabs(mean) <= 2.131 * sqrt(variance); /* Student, 15 degrees, 95 % */
    }
    /* The deviation of real / told is about sqrt(2 / GROUPS) = 6 %, of covered 1 % */
    assert_near(real / told, 1.0, 0.25);
    assert_near((double)covered / GROUPS, 0.95, 0.04);
}

/* Coordinates of two sets, by sample number. The deviation of a correlation is 1.25/64: the first
 * digits make 3/4 of a coordinate's variance, and their products are the same in pairs of samples,
 * so that of the variance 1/64^2 of even pairings (3/4)^2 counts twice: 25/16 of it. */
static double worst_correlation(uint32_t seed, uint32_t other)
{
    enum { N = 4096 };
    static point p[N], q[N];
    points(0, N, seed, p);
    points(0, N, other, q);
    double worst = 0.0;
    for (int a = 0; a < DIMENSIONS; a++)
        for (int b = 0; b < DIMENSIONS; b++) {
            double sum = 0.0;
            for (int n = 0; n < N; n++)
                sum += ((double)p[n].u[a] - 0.5) * ((double)q[n].u[b] - 0.5);
            worst = fmax(worst, fabs(12.0 * sum / N));
        }
    return worst;
}

TEST(sets_of_different_seeds_are_uncorrelated)
{
    const double deviation_of_one = 1.25 / 64.0;
    for (uint32_t seed = 0; seed < 24; seed++) {
        uint32_t path = hash_u32(seed);
        assert_true(worst_correlation(seed, seed + 1) < 5.0 * deviation_of_one);
        assert_true(worst_correlation(seed, seed ^ 0x80000000) < 5.0 * deviation_of_one);
        assert_true(worst_correlation(hash_combine_u32(path, 0), hash_combine_u32(path, 1)) <
                    5.0 * deviation_of_one);
        assert_true(worst_correlation(hash_combine_u32(seed, 3), hash_combine_u32(seed + 1, 3)) <
                    5.0 * deviation_of_one);
    }
}

/* One bit of the argument changes each bit of the hash half of the times. */
TEST(hashes_avalanche)
{
    enum { N = 4096 };
    for (int in = 0; in < 32; in++) {
        int flips[32] = { 0 };
        for (uint32_t k = 0; k < N; k++) {
            uint32_t changed = hash_u32(k) ^ hash_u32(k ^ 1u << in);
            for (int out = 0; out < 32; out++)
                flips[out] += (int)(changed >> out & 1);
        }
        for (int out = 0; out < 32; out++)
            assert_true(abs(flips[out] - N / 2) < N / 8);
    }
    assert_true(hash_combine_u32(1, 2) != hash_combine_u32(2, 1));
    assert_true(hash_u32(0) != 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_twin_starts_as_published),
        cmocka_unit_test(points_are_those_of_the_twin),
        cmocka_unit_test(numbers_of_a_second_vertex_are_of_the_same_set),
        cmocka_unit_test(every_width_gives_the_same_points),
        cmocka_unit_test(powers_of_two_samples_are_a_net),
        cmocka_unit_test(planes_of_all_six_dimensions_are_nets),
        cmocka_unit_test(each_sample_is_even_over_the_seeds),
        cmocka_unit_test(smooth_integrals_converge_far_faster_than_at_random),
        cmocka_unit_test(the_mean_over_seeds_is_unbiased),
        cmocka_unit_test(the_spread_of_16_scrambles_tells_the_error),
        cmocka_unit_test(sets_of_different_seeds_are_uncorrelated),
        cmocka_unit_test(hashes_avalanche),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
