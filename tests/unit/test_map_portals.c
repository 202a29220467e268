/* tests/unit/test_map_portals.c -- particles that are aimed at portals carry what others would:
 * against the light that a matt surface gives on, and what of it goes through, by the midpoint
 * rule.
 */
#include "core/sampler.h"
#include "sim/map_parts.h"
#include "tests/test.h"

#include <string.h>

static const portal windows[] = {
    { { 0, 3, 1.5f }, { 1, 0, 0 }, { 0, 0, 0.75f }, { 0, -1, 0 } },
    { { 2.5f, 3, 1.5f }, { 0.5f, 0, 0 }, { 0, 0, 0.75f }, { 0, -1, 0 } },
    { { 0, -4, 1.5f }, { 1, 0, 0 }, { 0, 0, 0.75f }, { 0, -1, 0 } }, /* seen from within */
};
enum { WINDOWS = 2, ALL_WINDOWS = 3, DRAWN = 1 << 14 };

/* On the ground, on a sill, on a wall across. */
static const struct place {
    vec3 p, n;
} places[] = {
    { { 0.5f, 0, 0 }, { 0, 0, 1 } },
    { { -0.3f, 2.9f, 0.74f }, { 0, 0, 1 } },
    { { 3, -3, 2 }, { 0, 1, 0 } },
};
enum { PLACES = 3 };

typedef struct yard {
    arena a;
    scene s;
    const material *of[1];
} yard;

static void open_yard(yard *y)
{
    lux_error err = { 0 };
    memset(y, 0, sizeof *y);
    y->of[0] =
        material_diffuse(&y->a, &(diffuse_desc){ .reflectance = { 0.4f, 0.5f, 0.6f } }, &err);
    assert_non_null(y->of[0]);
    y->s = (scene){ .materials = y->of, .portal_list = windows, .portal_count = ALL_WINDOWS };
}

static vshading shading_of(const struct place *at)
{
    vvec3 n = vspread(at->n);
    return (vshading){ .wo       = n,
                       .n        = n,
                       .flat     = n,
                       .front    = ALL_LANES,
                       .distance = vsplat(1.0f),
                       .look     = { .color = vspread((vec3){ 0.4f, 0.5f, 0.6f }) } };
}

static vmask goes_through(const portal *q, vec3 p, const vvec3 *wi)
{
    vvec3 to    = vsub(vspread(p), vspread(q->centre));
    vfloat out  = -vdot(*wi, vspread(q->outward));
    vvec3 place = valong(to, *wi, vdot(to, vspread(q->outward)) / out);
    return (out > 0.0f) & (vabs(vdot(place, vspread(q->u))) <= v3_dot(q->u, q->u)) &
           (vabs(vdot(place, vspread(q->v))) <= v3_dot(q->v, q->v));
}

/* What of all that the place gives on goes through the windows before it. */
static double seen_from(const struct place *at)
{
    enum { SIDE = 1000 };
    double sum = 0.0;
    for (int w = 0; w < WINDOWS; w++) {
        const portal *q = &windows[w];
        double area     = 4.0 * (double)(v3_length(q->u) * v3_length(q->v)) / (SIDE * (double)SIDE);
        for (int i = 0; i < SIDE * SIDE; i++) {
            double s = 2.0 * (i % SIDE + 0.5) / SIDE - 1.0, t = 2.0 * (i / SIDE + 0.5) / SIDE - 1.0;
            dvec3 to   = d3_sub(d3_add(d3_from(q->centre), d3_add(d3_scale(d3_from(q->u), s),
                                                                  d3_scale(d3_from(q->v), t))),
                                d3_from(at->p));
            double r2  = d3_dot(to, to);
            double cos = fmax(d3_dot(to, d3_from(at->n)), 0.0) * -d3_dot(to, d3_from(q->outward));
            sum += area * cos / (M_PI * r2 * r2);
        }
    }
    return sum;
}

static vmask draw(const yard *y, const struct place *at, int first, vscatter *next, vfloat *rarer)
{
    vshading h  = shading_of(at);
    vsurface on = { .position = vspread(at->p), .normal = h.n };
    vuint index = vunsigned(vlane_index() + first);
    vsample4 u = vsobol4(index, vsplat_uint(11)), v = vsobol4(index, vsplat_uint(12));
    vmask goes =
        materials_scatter(y->s.materials, vsplat_int(0), &h, u.x, u.y, u.z, ALL_LANES, next);
    return map_toward_portals(&y->s, &on, &h, &v, ALL_LANES, goes, next, rarer);
}

typedef struct found {
    double all, through; /* what of light goes on, and by windows, second channel */
    double drawn;        /* share of cases that go on by windows */
    double most, most_through, least_rarer;
} found;

static found draw_many(const yard *y, const struct place *at)
{
    found f = { .least_rarer = 1.0 };
    for (int first = 0; first < DRAWN; first += LANES) {
        vscatter next;
        vfloat rarer;
        vmask goes    = draw(y, at, first, &next, &rarer);
        vmask through = goes & (goes_through(&windows[0], at->p, &next.wi) |
                                goes_through(&windows[1], at->p, &next.wi));
        for (int i = 0; i < LANES && first + i < DRAWN; i++) {
            double weight = vbits(goes) >> i & 1 ? (double)lane(next.weight.y, i) : 0.0;
            bool in       = vbits(through) >> i & 1;
            f.all += weight / DRAWN;
            f.through += in ? weight / DRAWN : 0.0;
            f.drawn += in ? 1.0 / DRAWN : 0.0;
            f.most         = fmax(f.most, weight);
            f.most_through = in ? fmax(f.most_through, weight) : f.most_through;
            f.least_rarer  = fmin(f.least_rarer, (double)lane(rarer, i));
        }
    }
    return f;
}

/* 16384 draws of one net: a percent is ten times what they are off by. */
TEST(aimed_or_not_the_same_light_goes_on)
{
    yard y;
    open_yard(&y);
    for (int i = 0; i < PLACES; i++) {
        found f = draw_many(&y, &places[i]);
        assert_near(f.all, 0.5, 0.01);
        assert_near(f.through, 0.5 * seen_from(&places[i]), 0.02);
    }
    arena_clear(&y.a);
}

/* From far away a window's particles are alike, and there are as many as are aimed; nowhere does
 * one carry more than it would, by the cases that are left. */
TEST(windows_get_many_particles_that_carry_little)
{
    yard y;
    open_yard(&y);
    for (int i = 0; i < PLACES; i++) {
        found f = draw_many(&y, &places[i]);
        assert_true(f.most <= 0.5 / 0.75 * (1.0 + 1e-5));
        assert_true(f.drawn >= 0.24);
        assert_true(f.least_rarer > 0.0 && f.least_rarer < 1.0);
    }
    found far = draw_many(&y, &places[2]);
    assert_true(far.most_through < 3.0 * far.through / far.drawn);
    arena_clear(&y.a);
}

/* What splits particles is about what one carries that is aimed. */
TEST(shares_are_those_of_view_factors)
{
    yard y;
    open_yard(&y);
    for (int i = 0; i < PLACES; i++) {
        vshading h   = shading_of(&places[i]);
        vsurface on  = { .position = vspread(places[i].p), .normal = h.n };
        double share = (double)lane(map_portal_share(&y.s, &on, &h, ALL_LANES), 0);
        double want  = 0.6 * seen_from(&places[i]) / 0.25;
        assert_true(share > 0.5 * want && share < 3.0 * want);
    }
    arena_clear(&y.a);
}

TEST(from_within_and_from_below_none_is_aimed)
{
    static const struct place blind[] = { { { 0, 4, 0 }, { 0, 0, 1 } },
                                          { { 0, 0, 5 }, { 0, 0, 1 } } };
    yard y;
    open_yard(&y);
    for (int i = 0; i < 2; i++)
        for (int first = 0; first < 64; first += LANES) {
            vscatter plain, next;
            vfloat rarer;
            vshading h  = shading_of(&blind[i]);
            vuint index = vunsigned(vlane_index() + first);
            vsample4 u  = vsobol4(index, vsplat_uint(11));
            materials_scatter(y.s.materials, vsplat_int(0), &h, u.x, u.y, u.z, ALL_LANES, &plain);
            draw(&y, &blind[i], first, &next, &rarer);
            assert_memory_equal(&plain, &next, sizeof next);
        }
    arena_clear(&y.a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aimed_or_not_the_same_light_goes_on),
        cmocka_unit_test(windows_get_many_particles_that_carry_little),
        cmocka_unit_test(shares_are_those_of_view_factors),
        cmocka_unit_test(from_within_and_from_below_none_is_aimed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
