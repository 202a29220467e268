/* tests/unit/test_luminaire_area.c -- places of luminous openings: densities, hits, edges of use.
 */
#include "core/sampler.h"
#include "core/warp.h"
#include "tests/test.h"
#include "tests/webs.h"

#include <string.h>

static const struct {
    const char *name;
    opening_shape shape;
    vec3 size;
} shapes[] = {
    { "rectangle", OPENING_RECTANGLE, { 1.2f, 0.3f, 0 } },
    { "disc", OPENING_DISC, { 0.5f, 0.8f, 0 } },
    { "box", OPENING_BOX, { 1.2f, 0.3f, 0.1f } },
    { "vertical cylinder", OPENING_VERTICAL_CYLINDER, { 0.4f, 0.6f, 0.5f } },
    { "ellipsoid", OPENING_SPHERE, { 0.5f, 0.7f, 0.3f } },
    { "cylinder along", OPENING_CYLINDER_ALONG, { 1.2f, 0.2f, 0.1f } },
    { "vertical disc", OPENING_VERTICAL_DISC, { 0.6f, 0, 0.4f } },
    { "upright rectangle", OPENING_BOX, { 0, 0.3f, 0.4f } },
    { "line", OPENING_LINE, { 1.2f, 0, 0 } },
};
enum { SHAPES = sizeof shapes / sizeof *shapes, FOUND = SHAPES - 1 }; /* rays find no line */

/* From all sides, none so flat that the sums over fine cells of the test below see too little. */
static const vec3 places[] = { { 1.5f, 1, -2 },          { 0.1f, 0.05f, -0.4f },
                               { 0.1f, 0.6f, -0.25f },   { -0.7f, 0.2f, 0.4f },
                               { 0.55f, 0.12f, -0.35f }, { 0.5f, 0.1f, -0.25f },
                               { 0, 0.02f, -0.3f },      { 0.02f, 0.45f, 0.15f } };
enum { PLACES = sizeof places / sizeof *places };

/* Turned in space, so that no axis is the world's. */
static const light *make(arena *a, photometry *web, int shape)
{
    web->opening           = shapes[shape].shape;
    web->length            = shapes[shape].size.x;
    web->width             = shapes[shape].size.y;
    web->height            = shapes[shape].size.z;
    const luminaire_desc d = {
        .aim = { 0, 0, -1 }, .rotate = 0.4f, .scale = { 1, 1, 1 }, .web = web
    };
    const light *l = light_luminaire(a, &d, NULL);
    assert_non_null(l);
    return l;
}

/* Directions drawn, in 12 x 24 cells of a cone, against the densities that rays find there. The
 * cone is the one around the ball that holds the opening; from within, the whole sphere. */
enum { ROWS = 12, COLUMNS = 24, FINE = 32, DRAWN = 1 << 11, CELLS = ROWS * COLUMNS };

typedef struct cone {
    vvec3 x, y, z;
    float height; /* 1 - the cosine of its half angle */
} cone;

static cone cone_of(vec3 place, vec3 size)
{
    vec3 h      = v3_scale(size, 0.5f);
    float share = v3_dot(h, h) / v3_dot(place, place);
    cone c      = { .z      = vnormalize(vneg(vspread(place))),
                    .height = share < 1.0f ? 1.0f - sqrtf(1.0f - share) : 2.0f };
    vframe(c.z, &c.x, &c.y);
    return c;
}

/* How many are to be expected; the sum over all cells is returned. */
static double expect(const light *l, const cone *c, vvec3 p, double expected[CELLS])
{
    double all = 0.0;
    memset(expected, 0, CELLS * sizeof *expected);
    for (int i = 0; i < CELLS * FINE * FINE; i += LANES) {
        vint at   = vlane_index() + i;
        vint cell = at / (FINE * FINE), fine = at % (FINE * FINE);
        vfloat s = (vto_float(cell / COLUMNS) + (vto_float(fine / FINE) + 0.5f) / FINE) / ROWS;
        vfloat t = (vto_float(cell % COLUMNS) + (vto_float(fine % FINE) + 0.5f) / FINE) / COLUMNS;
        vfloat less   = s * c->height;
        vfloat across = vsqrt(less * (2.0f - less));
        vfloat phi    = (2.0f * WARP_PI) * t;
        vvec3 round   = vadd(vscale(c->x, vcos(phi)), vscale(c->y, vsin(phi)));
        vvec3 w       = vadd(vscale(c->z, 1.0f - less), vscale(round, across));
        vlight_hit hit;
        l->type->hit(l, &p, &w, ALL_LANES, &hit);
        for (int k = 0; k < LANES; k++) {
            double part =
                (double)(lane(hit.pdf, k) * c->height) * 2.0 * M_PI * DRAWN / (CELLS * FINE * FINE);
            expected[lane(cell, k)] += part;
            all += part;
        }
    }
    return all;
}

/* How many are drawn; count[CELLS]: those that meet nothing. */
static void draw(const light *l, const cone *c, vvec3 p, int count[CELLS + 1])
{
    memset(count, 0, (CELLS + 1) * sizeof *count);
    for (int i = 0; i < DRAWN; i += LANES) {
        vuint n  = vunsigned(vlane_index() + i);
        vfloat s = vto_float(vsigned(vhash(n) >> 8)) * 0x1p-24f;
        vfloat t = vto_float(vsigned(vhash(vhash(n) + 77) >> 8)) * 0x1p-24f;
        vlight_sample out;
        vmask lit  = light_sample(l, &p, s, t, ALL_LANES, &out);
        vfloat row = vmin((1.0f - vdot(out.wi, c->z)) / c->height, vsplat(0.9999999f));
        vfloat phi = vatan2(vdot(out.wi, c->y), vdot(out.wi, c->x)) * (0.5f / WARP_PI);
        phi        = vmin(vselect(phi < 0.0f, phi + 1.0f, phi), vsplat(0.9999999f));
        row        = vmax(row, vsplat(0.0f));
        vint cell  = vto_int(row * (float)ROWS) * COLUMNS + vto_int(phi * (float)COLUMNS);
        cell       = vselect_int(lit, cell, vsplat_int(CELLS));
        for (int k = 0; k < LANES; k++)
            count[lane(cell, k)]++;
    }
}

/* Fine cells at outlines are in or out as a whole, and there the densities of places on round sides
 * have no bound: the sum is off by up to 4 %. */
static double chi_square_of(const light *l, int shape, vec3 place)
{
    double expected[CELLS];
    int count[CELLS + 1];
    cone c     = cone_of(place, shapes[shape].size);
    double all = expect(l, &c, vspread(place), expected);
    draw(l, &c, vspread(place), count);
    assert_true(fabs(DRAWN - all - count[CELLS]) < 0.06 * DRAWN);
    for (int i = 0; i < CELLS; i++)
        expected[i] *= (DRAWN - count[CELLS]) / all;
    return chi_square_test(expected, count, CELLS);
}

TEST(places_are_drawn_with_the_density_that_rays_find)
{
    arena a       = { 0 };
    photometry *w = web_make(&a, web_isotropic, 1, 90);
    for (int i = 0; i < FOUND; i++)
        for (int k = 1; k < PLACES; k++) {
            if (shapes[i].shape == OPENING_VERTICAL_DISC && (k == 1 || k == 6))
                continue; /* edge on: narrower than the fine cells */
            double p = chi_square_of(make(&a, w, i), i, places[k]);
            if (!(p > 0.01 / (FOUND * PLACES))) /* one in a hundred of all cases together */
                fail_msg("%s from place %d: p = %g", shapes[i].name, k, p);
        }
    arena_clear(&a);
}

/* A ray along a sample meets the same place, with its pdf, and radiance / pdf is e. Near the rim of
 * a round side, 1e-3 of the cosine is what floats know of it: of a few, pdf and e may be off more.
 */
TEST(a_ray_toward_a_sample_meets_what_was_drawn)
{
    arena a       = { 0 };
    photometry *w = web_make(&a, web_both_sides, 1, 2.5);
    int met = 0, drawn = 0, same_pdf = 0, same_e = 0;
    for (int i = 0; i < FOUND; i++) {
        const light *l = make(&a, w, i);
        for (int n = 0; n < 256 * PLACES; n += LANES) {
            vvec3 p    = vspread(places[n / 256]);
            vsample4 u = vsobol4(vunsigned(vlane_index() + n), vunsigned(vsplat_int(5)));
            vlight_sample s;
            vlight_hit h;
            vmask lit = light_sample(l, &p, u.x, u.y, ALL_LANES, &s);
            vmask hit = l->type->hit(l, &p, &s.wi, lit, &h);
            vfloat e  = h.radiance.x / h.pdf;
            drawn += __builtin_popcount((unsigned)vbits(lit));
            met += __builtin_popcount((unsigned)vbits(hit));
            same_pdf +=
                __builtin_popcount((unsigned)vbits(hit & (vabs(h.pdf - s.pdf) < 1e-3f * s.pdf)));
            same_e += __builtin_popcount((unsigned)vbits(hit & (vabs(e - s.e.x) < 1e-3f * s.e.x)));
            assert_false(vany(hit & (vabs(h.dist - s.dist) > 1e-3f * s.dist)));
        }
    }
    assert_true(drawn > 10000 && met > drawn * 0.998); /* the rest: at edges */
    assert_true(same_pdf > met * 0.995 && same_e > met * 0.995);
    arena_clear(&a);
}

/* What faces p in the mean over 2^14 draws and by 2^18 rays, even in the half space before p:
 * within 1.5 % of it, the noise of the rays, of which few meet a small opening. */
TEST(rays_all_around_meet_as_much_light_as_samples_bring)
{
    arena a       = { 0 };
    photometry *w = web_make(&a, web_isotropic, 1, 90);
    for (int i = 0; i < FOUND; i++)
        for (int k = 1; k < PLACES; k++) {
            const light *l = make(&a, w, i);
            vvec3 p = vspread(places[k]), n = vnormalize(vneg(p));
            double sum = 0.0;
            for (int at = 0; at < 1 << 18; at += LANES) {
                vsample4 u = vsobol4(vunsigned(vlane_index() + at), vunsigned(vsplat_int(9)));
                vvec3 wi   = vwarp_cosine_about(n, u.x, u.y);
                vlight_hit h;
                l->type->hit(l, &p, &wi, ALL_LANES, &h);
                sum += (double)vsum(h.radiance.x);
            }
            vec3 facing = { lane(n.x, 0), lane(n.y, 0), lane(n.z, 0) };
            double mean = mean_irradiance(l, places[k], facing, 14, NULL);
            double rays = sum * M_PI / (1 << 18);
            if (!(fabs(mean - rays) < 0.03 * rays))
                fail_msg("%s from place %d: samples %g, rays %g", shapes[i].name, k, mean, rays);
        }
    arena_clear(&a);
}

/* 1 m, 1 mm, 1 um below a matt panel E is at most pi L, and no sample is far above. */
TEST(close_to_a_panel_nothing_is_above_pi_times_its_radiance)
{
    arena a                = { 0 };
    photometry *w          = web_make(&a, web_lambertian, 1, 1);
    w->opening             = OPENING_RECTANGLE;
    w->length              = 0.6f;
    w->width               = 0.6f;
    double pi_l            = M_PI / 0.36;
    const float z[]        = { 1, 0.3f, 0.1f, 1e-2f, 1e-3f, 1e-6f };
    const luminaire_desc d = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = w };
    const light *l         = light_luminaire(&a, &d, NULL);
    for (int i = 0; i < 6; i++) {
        double deviation = 0.0;
        vec3 p           = { 0.1f, 0.05f, -z[i] };
        double e         = mean_irradiance(l, p, (vec3){ 0, 0, 1 }, 12, &deviation);
        assert_true(e < pi_l * 1.002);
        assert_true(deviation < 1.5 * e);
        print_message("%8g m: %.4f pi L, deviation of one sample %.3f of it\n", (double)z[i],
                      e / pi_l, deviation / e);
    }

    /* Edge on an isotropic web is bright without bound: 2 / 0.36 log(0.6 / z) or so, facing along
     */
    w->candela = web_make(&a, web_isotropic, 1, 1)->candela;
    l          = light_luminaire(&a, &d, NULL);
    for (int i = 0; i < 5; i++) {
        double deviation = 0.0;
        vec3 p           = { 0.1f, 0.05f, -z[i] };
        double e         = mean_irradiance(l, p, (vec3){ 1, 0, 0 }, 12, &deviation);
        assert_true(deviation < 8.0 * e);
        print_message("%8g m, isotropic, facing along: %.3f, deviation %.3f of it\n", (double)z[i],
                      e, deviation / e);
    }
    arena_clear(&a);
}

TEST(where_all_is_edge_on_or_inside_there_is_no_nan)
{
    arena a              = { 0 };
    photometry *w        = web_make(&a, web_isotropic, 1, 90);
    const vec3 edge_on[] = {
        { 0, 0, 0 },     { 0.1f, 0, 0 },  { 2, 0, 0 },     { 0, 2, 0 },
        { 0, 0, 2 },     { 0, 0, 0.05f }, { 0.6f, 0, 0 },  { 0.6f, 0.15f, 0.05f },
        { 0, 0, 1e-9f }, { 1e9f, 0, 0 },  { 1e15f, 1, 1 }, { 0, 1e-20f, 0 }
    };
    for (int i = 0; i < SHAPES; i++) {
        const light *l = make(&a, w, i);
        for (size_t k = 0; k < sizeof edge_on / sizeof *edge_on; k++) {
            vec3 n = { 0, 0, -1 };
            mean_irradiance(l, edge_on[k], n, 8, NULL); /* checks each sample */
            vvec3 p = vspread(edge_on[k]), up = vspread(n);
            vfloat weight = l->type->weight(l, &p, &up, ALL_LANES), error = { 0 };
            assert_true(vall(weight >= 0.0f) && vall(weight < INFINITY));
            vlight_sample s;
            vlight_hit h;
            l->type->as_point(l, &p, ALL_LANES, &s, &error);
            assert_true(vall(error >= 0.0f));
            if (l->type->hit && vany(l->type->hit(l, &p, &up, ALL_LANES, &h)))
                assert_true(vall(h.dist > 0.0f) && vall(h.radiance.x > 0.0f) && vall(h.pdf > 0.0f));
        }
        assert_near(mean_irradiance(l, (vec3){ 5, 0, 0 }, (vec3){ -1, 0, 0 }, 8, NULL), 0.04, 0.4);
    }
    arena_clear(&a);
}

/* The weight against E at random places and tilts: within the factors below, and never 0 where
 * there is light. */
TEST(the_weight_is_about_the_irradiance)
{
    arena a       = { 0 };
    photometry *w = web_make(&a, web_lambertian, 1, 5);
    for (int i = 0; i < SHAPES; i++) {
        const light *l = make(&a, w, i);
        double low = 1.0, high = 1.0;
        for (int k = 0; k < 400; k++) {
            vsample4 u = vsobol4(vunsigned(vsplat_int(k)), vunsigned(vsplat_int(2)));
            float dist = 0.35f + 4.0f * lane(u.z, 0) * lane(u.z, 0);
            vvec3 to   = vwarp_sphere(0.5f + 0.5f * u.x, u.y); /* downward */
            vvec3 tilt = vwarp_sphere(u.w, vsplat(0.37f) + 0.1f * u.x);
            vvec3 p    = vscale(to, vsplat(dist));
            vec3 at    = { lane(p.x, 0), lane(p.y, 0), lane(p.z, 0) };
            vec3 n     = { lane(tilt.x, 0), lane(tilt.y, 0), lane(tilt.z, 0) };
            double e   = mean_irradiance(l, at, n, 8, NULL);
            double got = (double)lane(l->type->weight(l, &p, &tilt, ALL_LANES), 0);
            if (e > 0.0)
                assert_true(got > 0.0);
            if (e > 0.02) {
                low  = fmin(low, got / e);
                high = fmax(high, got / e);
            }
        }
        print_message("%s: weight / E from %.2f to %.2f\n", shapes[i].name, low, high);
    }
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a       = { 0 };
    photometry *w = web_make(&a, web_isotropic, 1, 90);
    vvec3 p = vspread((vec3){ 0.1f, 0.2f, -0.5f }), n = vspread((vec3){ 0, 0, 1 });
    vmask one = vlane_index() < 1;
    for (int i = 0; i < SHAPES; i++) {
        const light *l = make(&a, w, i);
        vlight_sample s;
        vlight_hit h  = { 0 };
        vfloat middle = vsplat(0.4f);
        assert_int_equal(vbits(light_sample(l, &p, middle, middle, one, &s)) & ~1, 0);
        vfloat weight = l->type->weight(l, &p, &n, one);
        if (l->type->hit)
            assert_int_equal(vbits(l->type->hit(l, &p, &n, one, &h)) & ~1, 0);
        else
            assert_true(lane(s.pdf, 0) == INFINITY);
        for (int k = 1; k < LANES; k++) {
            assert_true(lane(s.e.x, k) == 0.0f && lane(s.pdf, k) == 0.0f &&
                        lane(s.dist, k) == 0.0f);
            assert_true(lane(s.wi.z, k) == 0.0f && lane(weight, k) == 0.0f);
            assert_true(lane(h.dist, k) == 0.0f && lane(h.pdf, k) == 0.0f);
        }
    }
    arena_clear(&a);
}

TEST(the_bounds_hold_the_opening_and_its_light)
{
    arena a                = { 0 };
    photometry *w          = web_make(&a, web_lambertian, 1, 5);
    w->opening             = OPENING_BOX;
    w->length              = 1.2f;
    w->width               = 0.3f;
    w->height              = 0.1f;
    const luminaire_desc d = { .position = { 1, 2, 3 },
                               .aim      = { 0, 0, 1 },
                               .c0       = { 0, 1, 0 },
                               .scale    = { 1, 1, 1 },
                               .web      = w };
    light_bounds b         = light_bounds_of(light_luminaire(&a, &d, NULL));
    assert_near(b.low.x, 0.85, 1e-6);
    assert_near(b.high.y, 2.6, 1e-6);
    assert_near(b.low.z, 2.95, 1e-6);
    assert_near(b.axis.z, 1.0, 1e-6);
    assert_near(b.peak, 1.0, 1e-6);
    assert_true(b.cos_reach <= 0.0f && b.cos_reach > -1e-4f);

    /* An uplight, its web from 90 to 180 */
    const float gamma[] = { 90, 120, 180 }, candela[] = { 0, 0, 5 };
    const photometry up    = { .plane_count = 1,
                               .gamma_count = 3,
                               .plane_deg   = candela,
                               .gamma_deg   = gamma,
                               .candela     = candela };
    const luminaire_desc e = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = &up };
    b                      = light_bounds_of(light_luminaire(&a, &e, NULL));
    assert_near(b.axis.z, 1.0, 1e-6);
    assert_near(b.cos_reach, 0.5, 1e-4);
    arena_clear(&a);
}

/* A box x in +-0.6, y in +-0.15, z in +-0.05 m, seen from 1 m below beside its end. */
TEST(a_light_is_whole_unless_the_horizon_cuts_its_box)
{
    const light_bounds b = { .low = { -0.6f, -0.15f, -0.05f }, .high = { 0.6f, 0.15f, 0.05f } };
    const vvec3 p        = vspread((vec3){ 0.6f, 0, -1.05f });
    const struct {
        vec3 n;
        bool whole;
    } cases[] = { { { 0, 0, 1 }, true },         { { 0, 0, -1 }, true },
                  { { 1, 0, 0 }, true },         { { 0, 1, 0 }, false },
                  { { 0.99f, 0, 0.1f }, false }, { { 0.707f, 0, 0.707f }, false },
                  { { -0.6f, 0, 0.8f }, true },  { { 0.6f, 0, 0.8f }, true } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vvec3 n = vspread(cases[i].n);
        assert_true(vall(vlight_is_whole(&b, &p, &n, ALL_LANES)) == cases[i].whole);
        assert_false(vany(vlight_is_whole(&b, &p, &n, ~ALL_LANES)));
    }
}

TEST(sizes_that_make_no_sense_are_refused)
{
    arena a           = { 0 };
    lux_error err     = { 0 };
    photometry *w     = web_make(&a, web_isotropic, 1, 90);
    luminaire_desc d  = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = w };
    w->opening        = OPENING_RECTANGLE;
    w->width          = 1.0f;
    const float bad[] = { -1.0f, NAN, INFINITY, 1e9f };
    for (int i = 0; i < 4; i++) {
        w->length = bad[i];
        assert_null(light_luminaire(&a, &d, &err));
        assert_int_equal(err.code, ERR_ARGUMENT);
    }
    w->length = 1.0f;
    d.c0      = (vec3){ 0, 0, 3 };
    assert_null(light_luminaire(&a, &d, &err));
    d.c0          = (vec3){ 0 };
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_luminaire(&none, &d, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    w->length = 0.0f; /* what is left of a rectangle is a line, then a point */
    assert_true(light_luminaire(&a, &d, &err)->type->hit == NULL);
    w->width = 0.0f;
    assert_false(light_has_extent(light_luminaire(&a, &d, &err)));
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_drawn_with_the_density_that_rays_find),
        cmocka_unit_test(a_ray_toward_a_sample_meets_what_was_drawn),
        cmocka_unit_test(rays_all_around_meet_as_much_light_as_samples_bring),
        cmocka_unit_test(close_to_a_panel_nothing_is_above_pi_times_its_radiance),
        cmocka_unit_test(where_all_is_edge_on_or_inside_there_is_no_nan),
        cmocka_unit_test(the_weight_is_about_the_irradiance),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(the_bounds_hold_the_opening_and_its_light),
        cmocka_unit_test(a_light_is_whole_unless_the_horizon_cuts_its_box),
        cmocka_unit_test(sizes_that_make_no_sense_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
