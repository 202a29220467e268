/* tests/unit/test_portal.c -- directions drawn through openings. */
#include "sky/portal.h"

#include "core/sampler.h"
#include "tests/drawn_sky.h"
#include "tests/one_lane_sky.h"
#include "tests/test.h"

enum { COLUMNS = 64, ROWS = 32 };
static float sun[ROWS * COLUMNS]; /* pixels of 1, and one of 1e9 to the south, 40 degrees up */

enum { SKIES = 5 };
static sky_twin skies[SKIES];

static int make_skies(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS * COLUMNS; i++)
        sun[i] = 1.0f;
    sun[9 * COLUMNS + 63] = 1e9f;
    skies[0]              = sky_twin_of(TWIN_BLACK, NULL, 0, 0);
    skies[1]              = sky_twin_of(TWIN_EVEN, NULL, 0, 0);
    skies[2]              = sky_twin_of(TWIN_SMOOTH, NULL, 0, 0);
    skies[3]              = sky_twin_of(TWIN_SUNNY, NULL, 0, 0);
    skies[4]              = sky_twin_of(TWIN_PIXELS, sun, COLUMNS, ROWS);
    return 0;
}

/* A window to the south, one to the north-east that leans, and a rooflight. */
static const portal windows[] = {
    { { 0, -3, 1.5f }, { 1.5f, 0, 0 }, { 0, 0, 0.8f }, { 0, -1, 0 } },
    { { 3, 2, 1.2f }, { 0.48f, -0.64f, 0 }, { 0.48f, 0.36f, 0.8f }, { 0.64f, 0.48f, -0.6f } },
    { { -1, 1, 3 }, { 0, 0.5f, 0 }, { 0.4f, 0, 0 }, { 0, 0, 1 } },
};
enum { WINDOWS = 3 };

static const portals *portals_of(arena *a, const portal *list, int count, const sky_twin *s)
{
    const sky *one   = &s->base;
    const portals *p = portals_new(a, list, count, &one, 1, NULL);
    assert_non_null(p);
    return p;
}

static double pdf_at(const portals *all, vec3 p, vec3 n, vec3 w)
{
    vvec3 place = vspread(p), normal = vspread(n), wi = vspread(w);
    return (double)lane(portals_pdf(all, &place, &normal, &wi, ALL_LANES), 0);
}

static bool cross(const portals *all, vec3 p, vec3 w)
{
    vvec3 place = vspread(p), wi = vspread(w);
    return lane(portals_cross(all, &place, &wi, ALL_LANES), 0) & 1;
}

typedef struct drawn {
    bool any;
    vec3 wi;
    float pdf;
} drawn;

static drawn draw(const portals *all, vec3 p, vec3 n, const float u[3])
{
    vvec3 place = vspread(p), normal = vspread(n), wi;
    vfloat pdf;
    vmask any = portals_sample(all, &place, &normal, vsplat(u[0]), vsplat(u[1]), vsplat(u[2]),
                               ALL_LANES, &wi, &pdf);
    return (
        drawn){ lane(any, 0) & 1, { lane(wi.x, 0), lane(wi.y, 0), lane(wi.z, 0) }, lane(pdf, 0) };
}

static drawn draw_number(const portals *all, vec3 p, vec3 n, uint32_t number)
{
    vsample4 q = vsobol4(vsplat_uint(number), vsplat_uint(5));
    return draw(all, p, n, (const float[]){ lane(q.x, 0), lane(q.y, 0), lane(q.z, 0) });
}

/* Toward (s, t) in [0,1]^2 of a portal; *angle: sr of a share of 1 there, if evenly spread. */
static vec3 toward(const portal *d, vec3 p, double s, double t, double *angle)
{
    double a = 2.0 * s - 1.0, b = 2.0 * t - 1.0;
    double x    = (double)d->centre.x + a * (double)d->u.x + b * (double)d->v.x - (double)p.x;
    double y    = (double)d->centre.y + a * (double)d->u.y + b * (double)d->v.y - (double)p.y;
    double z    = (double)d->centre.z + a * (double)d->u.z + b * (double)d->v.z - (double)p.z;
    double r    = sqrt(x * x + y * y + z * z);
    vec3 w      = { (float)(x / r), (float)(y / r), (float)(z / r) };
    double area = 4.0 * (double)v3_length(d->u) * (double)v3_length(d->v);
    *angle      = area * (double)v3_dot(w, d->outward) / (r * r);
    return w;
}

/* sr, in closed form: of the corner over (x, y) at the height z, atan(x y / (z r)). */
static double corner(double x, double y, double z)
{
    return atan2(x * y, z * sqrt(x * x + y * y + z * z));
}
static double solid_angle(const portal *d, vec3 p)
{
    vec3 to  = { d->centre.x - p.x, d->centre.y - p.y, d->centre.z - p.z };
    double a = (double)v3_length(d->u), b = (double)v3_length(d->v);
    double x = (double)v3_dot(to, d->u) / a, y = (double)v3_dot(to, d->v) / b;
    double z = (double)v3_dot(to, d->outward);
    return corner(x + a, y + b, z) - corner(x - a, y + b, z) - corner(x + a, y - b, z) +
           corner(x - a, y - b, z);
}

static const vec3 nowhere = { 0, 0, 0 }, up = { 0, 0, 1 };

/* ---- densities ------------------------------------------------------------------------------ */

/* What the density comes to in each of 8 x 8 parts of each window, and all together. */
enum { SIDE = 8, PARTS = 48 };
static double integrate(const portals *all, vec3 p, vec3 n, double out[WINDOWS * SIDE * SIDE])
{
    double sum = 0.0;
    for (int k = 0; k < WINDOWS * SIDE * SIDE; k++)
        out[k] = 0.0;
    for (int k = 0; k < WINDOWS; k++)
        for (int j = 0; j < SIDE * PARTS; j++)
            for (int i = 0; i < SIDE * PARTS; i++) {
                const double step = 1.0 / (SIDE * PARTS);
                double angle;
                vec3 w   = toward(&windows[k], p, step * (i + 0.5), step * (j + 0.5), &angle);
                double e = pdf_at(all, p, n, w) * angle * step * step;
                out[(k * SIDE + j / PARTS) * SIDE + i / PARTS] += e;
                sum += e;
            }
    return sum;
}

static int part_of(vec3 p, vec3 w)
{
    for (int k = 0; k < WINDOWS; k++) {
        const portal *d = &windows[k];
        vec3 to         = { d->centre.x - p.x, d->centre.y - p.y, d->centre.z - p.z };
        float t         = v3_dot(to, d->outward) / v3_dot(w, d->outward);
        vec3 at         = { w.x * t - to.x, w.y * t - to.y, w.z * t - to.z };
        float s         = 0.5f + 0.5f * v3_dot(at, d->u) / v3_dot(d->u, d->u);
        float q         = 0.5f + 0.5f * v3_dot(at, d->v) / v3_dot(d->v, d->v);
        if (t > 0.0f && s > -1e-5f && s < 1.00001f && q > -1e-5f && q < 1.00001f) {
            int i = (int)(s * SIDE), j = (int)(q * SIDE);
            return (k * SIDE + (j < SIDE ? j : SIDE - 1)) * SIDE + (i < SIDE ? i : SIDE - 1);
        }
    }
    fail_msg("a direction through no window");
    return 0;
}

/* Cells are larger than the parts of the quadrature by 10 or so; it is off by what lies across
 * borders. */
TEST(the_density_comes_to_one_and_draws_follow_it)
{
    enum { DRAWS = 20000, BINS = WINDOWS * SIDE * SIDE };
    static double expected[BINS];
    static int count[BINS];
    const vec3 p[] = { { 0, 0, 0.8f }, { 1.2f, -2.5f, 2.6f }, { 0.5f, 1, 0 } };
    for (int k = 0; k < SKIES; k++)
        for (int m = 0; m < 3; m++) {
            vec3 n             = m == 0 ? nowhere : m == 1 ? (vec3){ 0.6f, 0, 0.8f } : up;
            arena a            = { 0 };
            const portals *all = portals_of(&a, windows, WINDOWS, &skies[k]);
            double sum         = integrate(all, p[m], n, expected);
            assert_near(sum, 1.0, k == 4 ? 0.02 : 0.003);
            for (int i = 0; i < BINS; i++) {
                count[i] = 0;
                expected[i] *= DRAWS / sum;
            }
            uint32_t at = 77;
            for (int i = 0; i < DRAWS; i++) {
                float u[3];
                for (int c = 0; c < 3; c++)
                    u[c] = (float)twin_even(&at);
                drawn d = draw(all, p[m], n, u);
                assert_true(d.any);
                count[part_of(p[m], d.wi)]++;
            }
            double by_chance = chi_square_test(expected, count, BINS);
            if (!(by_chance > 0.01))
                fail_msg("sky %d from place %d: p = %g", k, m, by_chance);
            arena_clear(&a);
        }
}

/* Near and far, close to the plane and in line with a side; an even sky and one that varies. */
TEST(their_solid_angle_is_that_of_a_rectangle)
{
    const vec3 p[] = { { 0, 0, 1 },        { 0.7f, -2.9f, 1.9f }, { 0.1f, -2.9999f, 1.5f },
                       { 3, -2.9f, 1.5f }, { 40, 30, 2 },         { 300, 900, 70 },
                       { 1.5f, -2, 2.3f }, { 4, -2.99f, 4 },      { 1.4999f, -2.9999f, 2.2999f } };
    for (int k = 0; k < SKIES; k++) {
        arena a            = { 0 };
        const portals *all = portals_of(&a, windows, 1, &skies[k]);
        for (int i = 0; i < 9 && k < 4; i++) {
            double want = solid_angle(&windows[0], p[i]), got = 0.0;
            enum { DRAWS = 1 << 15 };
            for (uint32_t m = 0; m < DRAWS; m++) {
                drawn d = draw_number(all, p[i], nowhere, m);
                got += d.any ? 1.0 / (double)d.pdf / DRAWS : 0.0;
            }
            assert_near(got, want, k == 3 ? 0.05 : 0.004);
        }
        arena_clear(&a);
    }
}

/* ---- hard places ---------------------------------------------------------------------------- */

static void check_draw(const portals *all, vec3 p, vec3 n, const float u[3])
{
    drawn d = draw(all, p, n, u);
    if (!d.any) {
        assert_true(d.pdf == 0.0f && d.wi.x == 0.0f && d.wi.y == 0.0f && d.wi.z == 0.0f);
        return;
    }
    assert_true(d.pdf > 0.0f && d.pdf < INFINITY);
    assert_true(pdf_at(all, p, n, d.wi) == (double)d.pdf);
    assert_true(cross(all, p, d.wi));
    assert_near(v3_length(d.wi), 1.0, 3e-7);
}

TEST(the_density_told_is_that_of_the_direction_wherever_one_stands)
{
    const float edge[] = { 0.0f, 0x1p-24f, 0.5f, 0x1.fffffep-1f };
    const vec3 p[]     = { { 0, -3, 1.5f },       { 0, -2.9999998f, 1.5f },
                           { 5, -2.9999998f, 1 }, { 1.5f, -2.9999998f, 2.3f },
                           { 1e-6f, -2.999f, 2 }, { 0, 1e5f, 0 },
                           { 1e6f, 1e6f, -1e6f }, { 0, -8, 0 },
                           { -1, 1, 2.9999998f }, { 1e15f, 1e15f, 1e15f } };
    for (int k = 0; k < SKIES; k++) {
        arena a            = { 0 };
        const portals *all = portals_of(&a, windows, WINDOWS, &skies[k]);
        uint32_t at        = 9;
        for (int i = 0; i < 10; i++)
            for (int m = 0; m < 64; m++)
                check_draw(all, p[i], m & 1 ? nowhere : up,
                           (const float[]){ edge[m & 3], edge[m >> 2 & 3], edge[m >> 4] });
        for (int i = 0; i < 10000; i++) {
            float u[3], q[3];
            for (int c = 0; c < 3; c++) {
                u[c] = (float)twin_even(&at);
                q[c] = (float)(10.0 * twin_even(&at) - 5.0);
            }
            check_draw(all, p[i % 10], up, u);
            check_draw(all, (vec3){ q[0], q[1], q[2] }, nowhere, u);
        }
        arena_clear(&a);
    }
}

TEST(nothing_comes_from_where_a_portal_is_not_seen)
{
    arena a            = { 0 };
    const float u[]    = { 0.3f, 0.4f, 0.5f };
    const portals *all = portals_of(&a, windows, 1, &skies[1]);
    assert_true(draw(all, (vec3){ 0, 0, 1 }, nowhere, u).any);
    assert_false(draw(all, (vec3){ 0, -3, 1 }, nowhere, u).any); /* in its plane */
    assert_false(draw(all, (vec3){ 0, -5, 1 }, nowhere, u).any); /* outside */
    assert_false(draw(all, (vec3){ 0, 0, 1 }, (vec3){ 0, 1, 0 }, u).any);
    assert_false(draw(all, (vec3){ 0, 0, 3 }, up, u).any);
    assert_true(cross(all, (vec3){ 0, 0, 1 }, (vec3){ 0, -1, 0 }));
    assert_false(cross(all, (vec3){ 0, -5, 1 }, (vec3){ 0, -1, 0 }));
    assert_false(cross(all, (vec3){ 0, 0, 1 }, (vec3){ 0, 1, 0 }));
    assert_true(pdf_at(all, (vec3){ 0, 0, 3 }, up, (vec3){ 0, -0.8f, -0.6f }) == 0.0);
    arena_clear(&a);
}

TEST(rays_cross_where_geometry_says)
{
    arena a            = { 0 };
    const portals *all = portals_of(&a, windows, WINDOWS, &skies[3]);
    vec3 p             = { 0.2f, 0.1f, 0.9f };
    for (int k = 0; k < WINDOWS; k++)
        for (int i = -3; i < 24; i++)
            for (int j = -3; j < 24; j++) {
                double angle, s = (i + 0.5) / 20.0, t = (j + 0.5) / 20.0;
                vec3 w      = toward(&windows[k], p, s, t, &angle);
                bool inside = i >= 0 && i < 20 && j >= 0 && j < 20;
                assert_true(cross(all, p, w) == inside);
                assert_true((pdf_at(all, p, nowhere, w) > 0.0) == inside);
            }
    arena_clear(&a);
}

TEST(through_a_portal_to_the_dark_some_are_drawn)
{
    const portal floor_[] = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, -1 } } };
    arena a               = { 0 };
    const portals *all    = portals_of(&a, floor_, 1, &skies[3]);
    for (uint32_t i = 0; i < 100; i++)
        assert_true(draw_number(all, (vec3){ 0.3f, 0.2f, 2 }, nowhere, i).any);
    arena_clear(&a);
}

/* One behind the other: what goes through both has the densities of both. */
TEST(of_portals_behind_each_other_all_count)
{
    const portal two[] = { windows[0],
                           { { 0, -4, 1.5f }, { 1.0f, 0, 0 }, { 0, 0, 0.4f }, { 0, -1, 0 } },
                           { { 0, -2, 1.4f }, { 0.3f, 0, 0 }, { 0, 0, 0.3f }, { 0, -1, 0 } } };
    arena a            = { 0 };
    const portals *all = portals_of(&a, two, 3, &skies[2]);
    vec3 p             = { 0, 0, 1.2f };
    double want = solid_angle(&windows[0], p), got = 0.0;
    for (uint32_t i = 0; i < 1 << 15; i++)
        got += 0x1p-15 / (double)draw_number(all, p, nowhere, i).pdf;
    assert_near(got, want, 0.004);
    arena_clear(&a);
}

/* ---- what it is worth ----------------------------------------------------------------------- */

static double light_from(const sky_twin *s, vec3 w)
{
    return sky_twin_luminance(s, (double[]){ (double)w.x, (double)w.y, (double)w.z });
}

/* Seen 45 degrees wide, the glow of 11 degrees inside of it or at its rim. */
TEST(a_sunny_sky_varies_much_less_than_when_drawn_evenly)
{
    enum { DRAWS = 20000 };
    const portal east[] = {
        { { 0.6f, 0.64f, 0.48f }, { -0.4f, 0.375f, 0 }, { 0, 0, 0.4f }, { 0.6839f, 0.7295f, 0 } }
    };
    arena a            = { 0 };
    const portals *all = portals_of(&a, east, 1, &skies[3]);
    uint32_t at        = 4;
    double mean = 0.0, square = 0.0, even = 0.0, even_square = 0.0;
    for (int i = 0; i < DRAWS; i++) {
        float u[3];
        double angle;
        for (int c = 0; c < 3; c++)
            u[c] = (float)twin_even(&at);
        drawn d  = draw(all, nowhere, nowhere, u);
        double e = light_from(&skies[3], d.wi) / (double)d.pdf;
        mean += e / DRAWS;
        square += e * e / DRAWS;
        vec3 w = toward(&east[0], nowhere, twin_even(&at), twin_even(&at), &angle);
        e      = light_from(&skies[3], w) * angle;
        even += e / DRAWS;
        even_square += e * e / DRAWS;
    }
    assert_near(mean, even, 0.03);
    double ratio = (even_square - even * even) / (square - mean * mean);
    if (!(ratio > 100.0))
        fail_msg("varies %g times less", ratio);
    arena_clear(&a);
}

/* ---- packets -------------------------------------------------------------------------------- */

TEST(dead_lanes_are_zero)
{
    arena a            = { 0 };
    const portals *all = portals_of(&a, windows, WINDOWS, &skies[3]);
    vvec3 p = vspread((vec3){ NAN, INFINITY, NAN }), wi = p;
    vfloat pdf = vsplat(3.0f), u = vsplat(NAN);
    assert_true(vall(portals_pdf(all, &p, &p, &wi, ~ALL_LANES) == 0.0f));
    assert_false(vany(portals_cross(all, &p, &wi, ~ALL_LANES)));
    assert_false(vany(portals_sample(all, &p, &p, u, u, u, ~ALL_LANES, &wi, &pdf)));
    assert_true(vall((wi.x == 0.0f) & (wi.y == 0.0f) & (wi.z == 0.0f) & (pdf == 0.0f)));
    arena_clear(&a);
}

TEST(one_lane_draws_the_same_to_the_bit)
{
    arena a            = { 0 };
    const portals *all = portals_of(&a, windows, WINDOWS, &skies[3]);
    uint32_t at        = 8;
    for (int i = 0; i < 2000; i++) {
        float u[9][LANES];
        for (int c = 0; c < 9; c++)
            for (int l = 0; l < LANES; l++)
                u[c][l] = (float)twin_even(&at);
        vvec3 p = { vload(u[0]) * 6.0f - 3.0f, vload(u[1]) * 6.0f - 3.0f, vload(u[2]) * 3.0f };
        vvec3 n = vnormalize((vvec3){ vload(u[3]) - 0.5f, vload(u[4]) - 0.5f, vload(u[5]) }), wi;
        vfloat pdf;
        vmask alive = vlane_index() != i % 5;
        portals_sample(all, &p, &n, vload(u[6]), vload(u[7]), vload(u[8]), alive, &wi, &pdf);
        for (int l = 0; l < LANES; l++) {
            float place[]  = { lane(p.x, l), lane(p.y, l), lane(p.z, l) };
            float normal[] = { lane(n.x, l), lane(n.y, l), lane(n.z, l) };
            float one[4]   = { 0 };
            if (l != i % 5)
                one_lane_portals_sample(all, place, normal, (float[]){ u[6][l], u[7][l], u[8][l] },
                                        one);
            assert_true(one[0] == lane(wi.x, l) && one[1] == lane(wi.y, l));
            assert_true(one[2] == lane(wi.z, l) && one[3] == lane(pdf, l));
            assert_true(one_lane_portals_pdf(all, place, normal, one) == one[3]);
        }
    }
    arena_clear(&a);
}

TEST(without_memory_there_are_none)
{
    arena a            = { 0 };
    lux_error err      = { 0 };
    const sky *one     = &skies[3].base;
    memory_is_out      = true;
    const portals *all = portals_new(&a, windows, WINDOWS, &one, 1, &err);
    memory_is_out      = false;
    assert_null(all);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_density_comes_to_one_and_draws_follow_it),
        cmocka_unit_test(their_solid_angle_is_that_of_a_rectangle),
        cmocka_unit_test(the_density_told_is_that_of_the_direction_wherever_one_stands),
        cmocka_unit_test(nothing_comes_from_where_a_portal_is_not_seen),
        cmocka_unit_test(rays_cross_where_geometry_says),
        cmocka_unit_test(through_a_portal_to_the_dark_some_are_drawn),
        cmocka_unit_test(of_portals_behind_each_other_all_count),
        cmocka_unit_test(a_sunny_sky_varies_much_less_than_when_drawn_evenly),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(one_lane_draws_the_same_to_the_bit),
        cmocka_unit_test(without_memory_there_are_none),
    };
    return cmocka_run_group_tests(tests, make_skies, NULL);
}
