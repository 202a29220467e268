/* tests/unit/test_light_tree.c -- that the light tree leaves no light out and states its odds.
 *
 * What lights give is worked out here, in double, from their bounds: a glowing ball of small
 * lamps each of which shines into the cone that the bounds say.
 */
#include "lights/light_tree.h"
#include "tests/test.h"

#include <stdlib.h>

static const float PI = 3.14159265f;

/* A lamp that is nothing but bounds. */
typedef struct lamp {
    light base;
    light_bounds b;
} lamp;

static light_bounds lamp_bounds(const light *self) { return ((const lamp *)self)->b; }
static const light_type lamp_type = { .name = "lamp", .bounds = lamp_bounds };

static float random_unit(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

static float random_from(uint32_t *seed, float low, float high)
{
    return low + (high - low) * random_unit(seed);
}

static vec3 random_place(uint32_t *seed, float size)
{
    float x = random_from(seed, -size, size), y = random_from(seed, -size, size);
    return (vec3){ x, y, random_from(seed, -size, size) };
}

static vec3 random_direction(uint32_t *seed)
{
    for (;;) {
        vec3 d  = random_place(seed, 1.0f);
        float l = v3_length(d);
        if (l > 0.1f && l <= 1.0f)
            return v3_scale(d, 1.0f / l);
    }
}

/* The hall of lights of one test. */
enum { MOST = 1000 };
typedef struct hall {
    arena a;
    lamp lamps[MOST];
    const light *lights[MOST];
    int count;
    const light_tree *tree;
} hall;

static void hall_tree(hall *h)
{
    for (int i = 0; i < h->count; i++) {
        h->lamps[i].base.type = &lamp_type;
        h->lights[i]          = &h->lamps[i].base;
    }
    h->tree = light_tree_new(&h->a, h->lights, h->count, NULL);
    assert_non_null(h->tree);
}

static light_bounds point_at(vec3 at, float peak)
{
    return (light_bounds){ at, at, { 0, 0, 1 }, -1.0f, -1.0f, peak, false };
}

static light_bounds random_lamp(uint32_t *seed)
{
    vec3 at        = random_place(seed, 5.0f);
    vec3 size      = v3_scale(random_place(seed, 0.5f), random_unit(seed) < 0.5f ? 0.0f : 1.0f);
    light_bounds b = { .low  = at,
                       .high = { at.x + fabsf(size.x), at.y + fabsf(size.y), at.z + fabsf(size.z) },
                       .axis = random_direction(seed),
                       .cos_spread = random_from(seed, -1.0f, 1.0f),
                       .cos_reach  = random_from(seed, -1.0f, 1.0f),
                       .peak       = random_from(seed, 0.0f, 10.0f) };
    float kind     = random_unit(seed);
    if (kind < 0.4f)
        b.cos_spread = 1.0f;
    if (kind < 0.05f)
        b.far = true;
    if (kind > 0.9f)
        b.peak = 0.0f;
    return b;
}

static hall *random_hall(int count, uint32_t *seed)
{
    hall *h = calloc(1, sizeof *h);
    assert_non_null(h);
    h->count = count;
    for (int i = 0; i < count; i++)
        h->lamps[i].b = random_lamp(seed);
    hall_tree(h);
    return h;
}

static void hall_end(hall *h)
{
    arena_clear(&h->a);
    free(h);
}

static double probability_of(const hall *h, vec3 p, vec3 n, int i)
{
    vvec3 at = vspread(p), normal = vspread(n);
    vfloat q = vlight_tree_probability(h->tree, &at, &normal, vsplat_int(i), ALL_LANES);
    return (double)lane(q, LANES - 1);
}

/* ---- probabilities --------------------------------------------------------------------------- */

/* Draws at one point with even u; counts per light, and checks each draw. The share of u that had
 * no light. */
static double draw(const hall *h, vec3 p, vec3 n, int draws, int *counts)
{
    vvec3 at = vspread(p), normal = vspread(n);
    int none = 0;
    for (int i = 0; i < draws; i += LANES) {
        vlight_choice c;
        vfloat u     = (vto_float(i + vlane_index()) + 0.5f) / (float)draws;
        vmask chosen = vlight_tree_choose(h->tree, &at, &normal, u, ALL_LANES, &c);
        vfloat again = vlight_tree_probability(h->tree, &at, &normal,
                                               vselect_int(chosen, c.index, vsplat_int(0)), chosen);
        assert_true(vall(~chosen | ((c.probability > 0.0f) & (again == c.probability))));
        assert_true(vall((c.rest >= 0.0f) & (c.rest < 1.0f)));
        assert_true(vall(chosen | ((c.index == -1) & (c.probability == 0.0f))));
        for (int k = 0; k < LANES; k++) {
            if (lane(c.index, k) >= 0)
                counts[lane(c.index, k)]++;
            else
                none++;
        }
    }
    return (double)none / draws;
}

TEST(probabilities_sum_to_the_share_that_is_chosen_and_counts_follow_them)
{
    enum { DRAWS = 1 << 14, HALLS = 60 };
    uint32_t seed = 1;
    for (int k = 0; k < HALLS; k++) {
        hall *h = random_hall(1 + k * 5, &seed);
        vec3 p  = random_place(&seed, k % 2 ? 5.0f : 12.0f);
        vec3 n  = k % 5 ? random_direction(&seed) : (vec3){ 0, 0, 0 };

        static int counts[MOST];
        memset(counts, 0, sizeof counts);
        double none = draw(h, p, n, DRAWS, counts), sum = 0.0;

        /* Each light has one interval of u: even u count it to within one, plus what 24 bits and
         * the rounding of a dozen divisions shift */
        for (int i = 0; i < h->count; i++) {
            double q = probability_of(h, p, n, i);
            sum += q;
            assert_true(fabs(q * DRAWS - counts[i]) <= 1.2);
        }
        /* The intervals of none lie between those of lights: one draw each at most */
        assert_true(sum <= 1.0 + 1e-5);
        assert_true(fabs(1.0 - sum - none) <= 1e-5 + 2.0 * h->count / DRAWS);
        hall_end(h);
    }
}

TEST(random_draws_pass_a_chi_square_test)
{
    enum { DRAWS = 1 << 16 };
    uint32_t seed = 7;
    for (int k = 0; k < 10; k++) {
        hall *h = random_hall(80, &seed);
        vec3 p = random_place(&seed, 6.0f), n = random_direction(&seed);
        vvec3 at = vspread(p), normal = vspread(n);
        int counts[MOST + 1]      = { 0 };
        double expected[MOST + 1] = { 0 }, sum = 0.0;
        for (int i = 0; i < DRAWS; i += LANES) {
            float u[LANES];
            for (int j = 0; j < LANES; j++)
                u[j] = random_unit(&seed);
            vlight_choice c;
            (void)vlight_tree_choose(h->tree, &at, &normal, vload(u), ALL_LANES, &c);
            for (int j = 0; j < LANES; j++)
                counts[lane(c.index, j) < 0 ? h->count : lane(c.index, j)]++;
        }
        for (int i = 0; i < h->count; i++) {
            expected[i] = DRAWS * probability_of(h, p, n, i);
            sum += expected[i];
        }
        expected[h->count] = fmax(DRAWS - sum, 0.0);
        assert_true(chi_square_test(expected, counts, h->count + 1) > 0.001);
        hall_end(h);
    }
}

/* Where no light can be below the horizon nor point away, no draw is lost. */
TEST(lights_all_around_without_a_horizon_sum_to_one)
{
    uint32_t seed = 3;
    hall *h       = random_hall(300, &seed);
    for (int i = 0; i < h->count; i++)
        h->lamps[i].b.cos_reach = -1.0f, h->lamps[i].b.peak += 0.1f;
    hall_tree(h);
    for (int k = 0; k < 20; k++) {
        vec3 p     = random_place(&seed, 10.0f);
        double sum = 0.0;
        for (int i = 0; i < h->count; i++)
            sum += probability_of(h, p, (vec3){ 0, 0, 0 }, i);
        assert_near(sum, 1.0, 1e-5); /* 10 levels of float roundings */
    }
    hall_end(h);
}

/* ---- no light is left out -------------------------------------------------------------------- */

static double dot64(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A direction at so many radians from unit d. */
static vec3 turned(vec3 d, double angle, uint32_t *seed)
{
    vec3 u, v;
    v3_frame(d, &u, &v);
    double phi = (double)random_from(seed, 0.0f, 2.0f * PI);
    double c = cos(angle), s = sin(angle), x = s * cos(phi), y = s * sin(phi);
    return (vec3){ (float)(c * (double)d.x + x * (double)u.x + y * (double)v.x),
                   (float)(c * (double)d.y + x * (double)u.y + y * (double)v.y),
                   (float)(c * (double)d.z + x * (double)u.z + y * (double)v.z) };
}

/* From low to high, the ends more often than not. */
static float between(uint32_t *seed, float low, float high)
{
    float t = random_unit(seed);
    return t < 0.3f ? low : t < 0.6f ? high : random_from(seed, low, high);
}

/* Light of lamp b leaves one of its places within its cone and meets a surface at p from above by a
 * cosine of `above`: p and n that are lit so. */
static void lit_by(const light_bounds *b, double above, bool rim, uint32_t *seed, vec3 *p, vec3 *n)
{
    double spread = acos((double)b->cos_spread), reach = acos((double)b->cos_reach);
    double k  = rim ? 1.0 : (double)random_unit(seed);
    vec3 beam = turned(b->axis, fmin(k * (spread + reach), (double)PI) * (1.0 - 1e-6), seed);
    float d   = expf(random_from(seed, -5.0f, 3.0f));
    float x = between(seed, b->low.x, b->high.x), y = between(seed, b->low.y, b->high.y);
    vec3 from = { x, y, between(seed, b->low.z, b->high.z) };
    *p        = b->far ? random_place(seed, 5.0f)
                       : (vec3){ from.x + d * beam.x, from.y + d * beam.y, from.z + d * beam.z };
    *n        = turned(v3_scale(beam, -1.0f), acos(above), seed);
}

TEST(every_light_that_contributes_may_be_chosen)
{
    enum { HALLS = 100, POINTS = 1000 };
    uint32_t seed = 11;
    for (int k = 0; k < HALLS; k++) {
        hall *h = random_hall(1 + k, &seed);
        for (int i = 0; i < POINTS; i++) {
            int which             = (int)(random_unit(&seed) * (float)h->count);
            const light_bounds *b = &h->lamps[which].b;
            /* To the rounding of the unit vectors made here: a few 2^-24 */
            double above = i % 2 ? 1e-6 : (double)random_unit(&seed);
            vec3 p, n;
            lit_by(b, above, i % 3 == 0, &seed, &p, &n);
            assert_true((probability_of(h, p, n, which) > 0.0) == (b->peak > 0.0f));
        }
        hall_end(h);
    }
}

/* ---- estimates ------------------------------------------------------------------------------- */

/* W/m^2 that a lamp gives at p, as it were at its middle, of full strength within its reach. */
static double given(const light_bounds *b, vec3 p, vec3 n)
{
    double to[3]   = { (double)b->low.x - (double)p.x, (double)b->low.y - (double)p.y,
                       (double)b->low.z - (double)p.z };
    double nn[3]   = { (double)n.x, (double)n.y, (double)n.z };
    double axis[3] = { (double)b->axis.x, (double)b->axis.y, (double)b->axis.z };
    if (b->far)
        return (double)b->peak * fmax(-dot64(nn, axis), 0.0);
    double d2 = dot64(to, to), d = sqrt(d2);
    double out = acos(fmax(fmin(-dot64(axis, to) / d, 1.0), -1.0));
    if (out > acos((double)b->cos_spread) + acos((double)b->cos_reach))
        return 0.0;
    return (double)b->peak * fmax(dot64(nn, to) / d, 0.0) / d2;
}

/* The sum over all lamps, and the relative variance of the estimate given / probability when the
 * tree chooses, and when peaks alone do; the mean of the estimate over even u in *mean. */
typedef struct estimate {
    double sum, mean, tree_variance, power_variance;
} estimate;

static estimate estimate_at(const hall *h, vec3 p, vec3 n, int draws)
{
    vvec3 at = vspread(p), normal = vspread(n);
    estimate e  = { 0 };
    double tree = 0.0, power = 0.0, peaks = 0.0;
    for (int i = 0; i < h->count; i++)
        peaks += (double)h->lamps[i].b.peak;
    for (int i = 0; i < h->count; i++) {
        double gave = given(&h->lamps[i].b, p, n);
        e.sum += gave;
        if (gave > 0.0) {
            tree += gave * gave / probability_of(h, p, n, i);
            power += gave * gave * peaks / (double)h->lamps[i].b.peak;
        }
    }
    for (int i = 0; i < draws; i += LANES) {
        vlight_choice c;
        vfloat u = (vto_float(i + vlane_index()) + 0.5f) / (float)draws;
        (void)vlight_tree_choose(h->tree, &at, &normal, u, ALL_LANES, &c);
        for (int j = 0; j < LANES; j++)
            if (lane(c.index, j) >= 0)
                e.mean += given(&h->lamps[lane(c.index, j)].b, p, n) /
                          (double)lane(c.probability, j) / draws;
    }
    if (e.sum > 0.0) {
        e.tree_variance  = tree / (e.sum * e.sum) - 1.0;
        e.power_variance = power / (e.sum * e.sum) - 1.0;
    }
    return e;
}

TEST(the_estimate_of_the_sum_is_unbiased)
{
    enum { DRAWS = 1 << 15 };
    uint32_t seed = 5;
    for (int k = 0; k < 40; k++) {
        hall *h    = random_hall(2 + 3 * k, &seed);
        estimate e = estimate_at(h, random_place(&seed, 8.0f), random_direction(&seed), DRAWS);
        /* Even u are better than random ones, of which four standard errors are allowed */
        double error = e.sum * sqrt(fmax(e.tree_variance, 0.0) / DRAWS);
        assert_true(fabs(e.mean - e.sum) <= 4.0 * error + 1e-4 * e.sum);
        hall_end(h);
    }
}

/* 40 x 25 lamps of equal strength over a hall of 40 x 60 m, 3 m above the work plane. */
static void grid_hall(hall *h, float cos_reach)
{
    h->count = 1000;
    for (int i = 0; i < h->count; i++) {
        float x                  = (0.5f + (float)(i % 25)) * 40.0f / 25.0f;
        float y                  = (0.5f + (float)(i / 25)) * 60.0f / 40.0f;
        h->lamps[i].b            = point_at((vec3){ x, y, 3.0f }, 100.0f);
        h->lamps[i].b.axis       = (vec3){ 0, 0, -1 };
        h->lamps[i].b.cos_spread = cos_reach == -1.0f ? -1.0f : 1.0f;
        h->lamps[i].b.cos_reach  = cos_reach;
    }
    hall_tree(h);
}

static void compare_in_hall(float cos_reach, double *tree, double *power)
{
    enum { POINTS = 50 };
    hall *h       = calloc(1, sizeof *h);
    uint32_t seed = 9;
    assert_non_null(h);
    grid_hall(h, cos_reach);
    *tree = *power = 0.0;
    for (int k = 0; k < POINTS; k++) {
        vec3 p     = { random_from(&seed, 0.0f, 40.0f), random_from(&seed, 0.0f, 60.0f), 0.0f };
        estimate e = estimate_at(h, p, (vec3){ 0, 0, 1 }, LANES);
        *tree += e.tree_variance / POINTS;
        *power += e.power_variance / POINTS;
    }
    hall_end(h);
    if (getenv("LIGHT_TREE_FIGURES"))
        print_message("reach %g: relative variance %.3g, by power %.3g\n", (double)cos_reach, *tree,
                      *power);
}

/* Of 1,000 equal lamps a few are near: by power alone most draws give next to nothing. */
TEST(in_a_hall_of_equal_lamps_it_varies_far_less_than_choice_by_power)
{
    double tree, power;
    compare_in_hall(-1.0f, &tree, &power);
    assert_true(tree < power / 20.0);
    compare_in_hall(0.5f, &tree, &power);
    assert_true(tree < power / 20.0);
}

/* ---- what there is of odd input -------------------------------------------------------------- */

static void nothing_odd_at(const hall *h, vec3 p, vec3 n)
{
    static int counts[MOST];
    double sum = 0.0;
    for (int i = 0; i < h->count; i++)
        sum += probability_of(h, p, n, i);
    assert_true(sum >= 0.0 && sum <= 1.0 + 1e-4); /* NaN: no */
    double none = draw(h, p, n, 1 << 12, counts);
    assert_true(fabs(sum + none - 1.0) < 1e-3);
}

TEST(no_lights_and_dark_lights_are_never_chosen)
{
    hall *h = calloc(1, sizeof *h);
    assert_non_null(h);
    for (h->count = 0; h->count < 4; h->count++) {
        for (int i = 0; i < h->count; i++)
            h->lamps[i].b = point_at((vec3){ (float)i, 0, 0 }, 0.0f);
        hall_tree(h);
        vvec3 p = vspread((vec3){ 0, 0, 0 });
        vlight_choice c;
        assert_false(vany(vlight_tree_choose(h->tree, &p, &p, vsplat(0.5f), ALL_LANES, &c)));
        assert_true(vall((c.index == -1) & (c.probability == 0.0f)));
        vfloat q = vlight_tree_probability(h->tree, &p, &p, vsplat_int(0), ALL_LANES);
        assert_true(vall(q == 0.0f));
    }
    hall_end(h);
}

TEST(one_light_is_always_chosen_and_u_kept)
{
    hall *h = calloc(1, sizeof *h);
    assert_non_null(h);
    h->count      = 1;
    h->lamps[0].b = point_at((vec3){ 1, 2, 3 }, 1e-30f);
    hall_tree(h);
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread((vec3){ 0, 0, 1 });
    vlight_choice c;
    assert_true(vall(vlight_tree_choose(h->tree, &p, &n, vsplat(0.625f), ALL_LANES, &c)));
    assert_true(vall((c.index == 0) & (c.probability == 1.0f) & (c.rest == 0.625f)));
    n = vspread((vec3){ 0, 0, -1 });
    assert_false(vany(vlight_tree_choose(h->tree, &p, &n, vsplat(0.625f), ALL_LANES, &c)));
    hall_end(h);
}

TEST(lights_in_one_place_and_points_on_or_in_lights_are_numbers)
{
    vec3 away[] = { { 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 } };
    for (int kind = 0; kind < 3; kind++) {
        hall *h = calloc(1, sizeof *h);
        assert_non_null(h);
        h->count = 300;
        for (int i = 0; i < h->count; i++) {
            vec3 at       = { kind == 1 ? (float)i : 0.0f, 0, 0 };
            h->lamps[i].b = point_at(at, 1.0f);
            h->lamps[i].b.high.z += kind == 2 ? 1.0f : 0.0f;
            h->lamps[i].b.cos_spread = 1.0f;
            h->lamps[i].b.cos_reach  = 0.0f;
        }
        hall_tree(h);
        for (size_t i = 0; i < sizeof away / sizeof *away; i++) {
            nothing_odd_at(h, (vec3){ 0, 0, 0 }, away[i]);
            nothing_odd_at(h, (vec3){ 0, 0, 0.5f }, away[i]);
            nothing_odd_at(h, (vec3){ 1e6f, 0, -1e6f }, away[i]);
        }
        hall_end(h);
    }
}

/* Each next lamp half as far: bins cut one off at a time, until sets are halved. */
TEST(a_very_deep_tree_still_knows_its_leaves)
{
    hall *h = calloc(1, sizeof *h);
    assert_non_null(h);
    h->count = 400;
    for (int i = 0; i < h->count; i++)
        h->lamps[i].b = point_at((vec3){ ldexpf(1.0f, 10 - i / 4), (float)(i % 4), 0 }, 1.0f);
    hall_tree(h);
    for (int i = 0; i < h->count; i++)
        assert_true(probability_of(h, h->lamps[i].b.low, (vec3){ 0, 0, 0 }, i) > 1e-3);
    nothing_odd_at(h, (vec3){ 3, 2, 1 }, (vec3){ 0, 0, 0 });
    hall_end(h);
}

TEST(lights_that_exist_are_chosen_near_and_far)
{
    arena a                = { 0 };
    const light *lights[3] = {
        light_point(&a, &(point_desc){ { 0, 0, 2 }, { 4, 4, 4 } }, NULL),
        light_parallel(&a, &(parallel_desc){ .aim = { 0, 0, -1 }, .irradiance = { 3, 3, 3 } },
                       NULL),
        light_cone(&a,
                   &(cone_desc){ .position  = { 0, 0, 1 },
                                 .aim       = { 0, 0, 1 },
                                 .intensity = { 9, 9, 9 },
                                 .inner     = 0.5f,
                                 .outer     = 1.0f },
                   NULL),
    };
    const light_tree *t = light_tree_new(&a, lights, 3, NULL);
    assert_non_null(t);
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread((vec3){ 0, 0, 1 });
    /* 4 / 2^2 = 1 of the point, 3 of the parallel light; the cone looks away. The tree's root sees
     * the cone and the point as one of 13 at 1.5 m, in a ball of 0.5 m */
    double near_ = 13.0 / (2.25 + 0.25 / 8.0), share[3];
    for (int i = 0; i < 3; i++)
        share[i] = (double)lane(vlight_tree_probability(t, &p, &n, vsplat_int(i), ALL_LANES), 0);
    assert_near(share[0], near_ / (near_ + 3.0), 1e-5);
    assert_near(share[1], 3.0 / (near_ + 3.0), 1e-5);
    assert_true(share[2] == 0.0);
    arena_clear(&a);
}

/* Each lane on a way of its own gets what it gets in a packet of its like. */
TEST(lanes_do_not_mind_each_other)
{
    uint32_t seed = 21;
    hall *h       = random_hall(200, &seed);
    for (int k = 0; k < 300; k++) {
        float x[LANES], y[LANES], z[LANES], u[LANES];
        int32_t index[LANES];
        for (int j = 0; j < LANES; j++) {
            x[j] = random_from(&seed, -6.0f, 6.0f), y[j] = random_from(&seed, -6.0f, 6.0f);
            z[j] = random_from(&seed, -6.0f, 6.0f), u[j] = random_unit(&seed);
            index[j] = (int32_t)(random_unit(&seed) * 200.0f);
        }
        vvec3 p = { vload(x), vload(y), vload(z) }, n = vspread(random_direction(&seed));
        vlight_choice c, one;
        vmask some = ALL_LANES & (vload(u) < 0.9f);
        vfloat q   = vlight_tree_probability(h->tree, &p, &n, vload_int(index), some);
        (void)vlight_tree_choose(h->tree, &p, &n, vload(u), some, &c);
        for (int j = 0; j < LANES; j++) {
            vvec3 at   = vspread((vec3){ x[j], y[j], z[j] });
            vmask same = ALL_LANES & (vsplat(u[j]) < 0.9f);
            vfloat odd = vlight_tree_probability(h->tree, &at, &n, vsplat_int(index[j]), same);
            (void)vlight_tree_choose(h->tree, &at, &n, vsplat(u[j]), same, &one);
            assert_true(lane(q, j) == lane(odd, 0));
            assert_int_equal(lane(c.index, j), lane(one.index, 0));
            assert_true(lane(c.probability, j) == lane(one.probability, 0));
            assert_true(lane(c.rest, j) == lane(one.rest, 0));
        }
    }
    hall_end(h);
}

TEST(dead_lanes_are_zero)
{
    uint32_t seed = 2;
    hall *h       = random_hall(50, &seed);
    vvec3 p       = vspread((vec3){ NAN, NAN, NAN });
    vlight_choice c;
    vmask none = ~ALL_LANES;
    assert_false(vany(vlight_tree_choose(h->tree, &p, &p, vsplat(0.5f), none, &c)));
    assert_true(vall((c.index == -1) & (c.probability == 0.0f) & (c.rest == 0.0f)));
    vfloat q = vlight_tree_probability(h->tree, &p, &p, vsplat_int(1 << 30), none);
    assert_true(vall(q == 0.0f));
    hall_end(h);
}

TEST(bounds_that_are_no_numbers_are_refused)
{
    light_bounds good  = point_at((vec3){ 0, 0, 0 }, 1.0f);
    light_bounds bad[] = { good, good, good, good, good };
    bad[0].peak        = NAN;
    bad[1].low.x       = NAN;
    bad[2].high.y      = -1.0f;
    bad[3].axis        = (vec3){ 0, 0, 0 };
    bad[4].cos_reach   = 1.5f;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        arena a        = { 0 };
        lux_error err  = { 0 };
        lamp l         = { { &lamp_type }, bad[i] };
        const light *p = &l.base;
        assert_null(light_tree_new(&a, &p, 1, &err));
        assert_int_equal(err.code, ERR_ARGUMENT);
        arena_clear(&a);
    }
}

TEST(no_memory_is_an_error)
{
    lamp l         = { { &lamp_type }, point_at((vec3){ 0, 0, 0 }, 1.0f) };
    const light *p = &l.base;
    arena a        = { 0 };
    lux_error err  = { 0 };
    memory_is_out  = true;
    assert_null(light_tree_new(&a, &p, 1, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probabilities_sum_to_the_share_that_is_chosen_and_counts_follow_them),
        cmocka_unit_test(random_draws_pass_a_chi_square_test),
        cmocka_unit_test(lights_all_around_without_a_horizon_sum_to_one),
        cmocka_unit_test(every_light_that_contributes_may_be_chosen),
        cmocka_unit_test(the_estimate_of_the_sum_is_unbiased),
        cmocka_unit_test(in_a_hall_of_equal_lamps_it_varies_far_less_than_choice_by_power),
        cmocka_unit_test(no_lights_and_dark_lights_are_never_chosen),
        cmocka_unit_test(one_light_is_always_chosen_and_u_kept),
        cmocka_unit_test(lights_in_one_place_and_points_on_or_in_lights_are_numbers),
        cmocka_unit_test(a_very_deep_tree_still_knows_its_leaves),
        cmocka_unit_test(lights_that_exist_are_chosen_near_and_far),
        cmocka_unit_test(lanes_do_not_mind_each_other),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(bounds_that_are_no_numbers_are_refused),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
