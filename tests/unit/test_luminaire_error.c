/* tests/unit/test_luminaire_error.c -- the bound on what a luminaire as a point is off.
 *
 * The truth is a sum over the opening in double precision: of flat shapes over a grid of 24 x 24
 * places; of solids by many samples. It is a vector, so that the bound is proven for all surfaces.
 */
#include "core/sampler.h"
#include "core/transform.h"
#include "tests/test.h"
#include "tests/webs.h"

static const light *make(arena *a, photometry *web, opening_shape shape, vec3 size)
{
    web->opening           = shape;
    web->length            = size.x;
    web->width             = size.y;
    web->height            = size.z;
    const luminaire_desc d = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = web };
    const light *l         = light_luminaire(a, &d, NULL);
    assert_non_null(l);
    return l;
}

/* W/m^2 as a vector at p, of a flat opening across the z axis. */
static dvec3 flat_truth(const photometry *w, dvec3 p)
{
    enum { GRID = 24 };
    bool line = w->width == 0.0f, disc = w->opening == OPENING_DISC;
    double n  = 0.0;
    dvec3 sum = { 0, 0, 0 };
    for (int i = 0; i < GRID; i++)
        for (int k = 0; k < (line ? 1 : GRID); k++) {
            double u = (2.0 * i + 1.0) / GRID - 1.0, v = line ? 0.0 : (2.0 * k + 1.0) / GRID - 1.0;
            double part = 1.0;
            if (disc) { /* rings of the same width, their areas as parts */
                double r = 0.5 * (u + 1.0), f = M_PI * v;
                part = r;
                u    = r * cos(f);
                v    = r * sin(f);
            }
            dvec3 y  = { 0.5 * u * (double)w->length, 0.5 * v * (double)w->width, 0.0 };
            dvec3 to = d3_sub(y, p);
            double d = d3_length(to);
            double c = atan2(-to.y, -to.x);
            double g = atan2(hypot(to.x, to.y), to.z);
            double cd =
                photometry_candela(w, (c < 0 ? c + 2 * M_PI : c) * 180.0 / M_PI, g * 180.0 / M_PI);
            sum = d3_add(sum, d3_scale(to, part * cd / (d * d * d)));
            n += part;
        }
    return d3_scale(sum, 1.0 / n);
}

static dvec3 solid_truth(const light *l, vec3 p)
{
    enum { COUNT = 1 << 11 };
    dvec3 sum = { 0, 0, 0 };
    vvec3 at  = vspread(p);
    for (int i = 0; i < COUNT; i += LANES) {
        vsample4 u = vsobol4(vunsigned(vlane_index() + i), vunsigned(vsplat_int(3)));
        vlight_sample s;
        light_sample(l, &at, u.x, u.y, ALL_LANES, &s);
        vvec3 e = vscale(s.wi, s.e.y);
        sum     = d3_add(sum, (dvec3){ (double)vsum(e.x), (double)vsum(e.y), (double)vsum(e.z) });
    }
    return d3_scale(sum, 1.0 / COUNT);
}

/* The largest error / bound over random places from 1.5 to 50 times `size` away. slack: of the
 * value, what the truth is itself off. */
static double worst_ratio(const light *l, const photometry *w, bool flat, double size, double slack)
{
    enum { PLACES = 600 };
    double worst = 0.0;
    int passed   = 0;
    for (int i = 0; i < (flat ? PLACES : PLACES / 6); i++) {
        vsample4 u = vsobol4(vunsigned(vsplat_int(i)), vunsigned(vsplat_int(11)));
        double z = 2.0 * (double)lane(u.x, 0) - 1.0, turn = 2.0 * M_PI * (double)lane(u.y, 0);
        double dist  = size * 1.5 * pow(50.0 / 1.5, (double)lane(u.z, 0));
        double s     = sqrt(1.0 - z * z);
        vec3 p       = { (float)(dist * s * cos(turn)), (float)(dist * s * sin(turn)),
                         (float)(dist * z) };
        vvec3 at     = vspread(p);
        vfloat error = { 0 };
        vlight_sample out;
        l->type->as_point(l, &at, ALL_LANES, &out, &error);
        double e     = (double)lane(out.e.y, 0);
        dvec3 point  = { (double)lane(out.wi.x, 0) * e, (double)lane(out.wi.y, 0) * e,
                         (double)lane(out.wi.z, 0) * e };
        dvec3 truth  = flat ? flat_truth(w, d3_from(p)) : solid_truth(l, p);
        double off   = d3_length(d3_sub(point, truth)) - slack * d3_length(truth) - 1e-37;
        double bound = (double)lane(error, 0);
        assert_true(bound >= 0.0);
        if (off > bound)
            fail_msg("off by %g, bound %g, of %g, at %g %g %g", off, bound, d3_length(truth),
                     (double)p.x, (double)p.y, (double)p.z);
        if (isfinite(bound) && bound > 0.0) {
            worst = fmax(worst, off / bound);
            passed++;
        }
    }
    assert_true(passed > 0);
    return worst;
}

static const struct {
    const char *name;
    web_form *form;
    int planes;
    double step_deg;
} forms[] = { { "isotropic", web_isotropic, 1, 5 },      { "lambertian", web_lambertian, 1, 2.5 },
              { "both sides", web_both_sides, 1, 2.5 },  { "spot", web_spot, 1, 1 },
              { "batwing", web_batwing, 1, 5 },          { "asymmetric", web_asymmetric, 24, 5 },
              { "asymmetric", web_asymmetric, 72, 2.5 }, { "sine", web_sine, 36, 5 } };
enum { FORMS = sizeof forms / sizeof *forms };

/* What the grid of places is itself off: at 1.5 sizes 1e-4 of the value, falling with the distance
 * as the bound does; floats: 2e-6, and none below 1e-37. */
TEST(no_flat_luminaire_is_farther_off_its_point_than_the_bound)
{
    arena a = { 0 };
    for (int f = 0; f < FORMS; f++) {
        photometry *w  = web_make(&a, forms[f].form, forms[f].planes, forms[f].step_deg);
        const light *l = make(&a, w, OPENING_RECTANGLE, (vec3){ 0.6f, 0.6f, 0 });
        double square  = worst_ratio(l, w, true, 0.6, 2e-6);
        l              = make(&a, w, OPENING_RECTANGLE, (vec3){ 1.5f, 0.1f, 0 });
        double strip   = worst_ratio(l, w, true, 1.5, 2e-6);
        l              = make(&a, w, OPENING_DISC, (vec3){ 0.5f, 0.5f, 0 });
        double disc    = worst_ratio(l, w, true, 0.5, 2e-6);
        l              = make(&a, w, OPENING_LINE, (vec3){ 1.2f, 0, 0 });
        double line    = worst_ratio(l, w, true, 1.2, 2e-6);
        print_message("%12s: error / bound at most %.2f square, %.2f strip, %.2f disc, %.2f line\n",
                      forms[f].name, square, strip, disc, line);
    }
    arena_clear(&a);
}

/* 2048 samples: within 2e-3 of the value. */
TEST(no_solid_luminaire_is_farther_off_its_point_than_the_bound)
{
    arena a = { 0 };
    for (int f = 0; f < FORMS; f++) {
        photometry *w = web_make(&a, forms[f].form, forms[f].planes, forms[f].step_deg);
        worst_ratio(make(&a, w, OPENING_BOX, (vec3){ 1.2f, 0.3f, 0.1f }), w, false, 1.3, 2e-3);
        worst_ratio(make(&a, w, OPENING_SPHERE, (vec3){ 0.5f, 0.5f, 0.5f }), w, false, 0.9, 2e-3);
        worst_ratio(make(&a, w, OPENING_VERTICAL_CYLINDER, (vec3){ 0.5f, 0.5f, 0.8f }), w, false,
                    1.1, 2e-3);
    }
    arena_clear(&a);
}

/* m from a panel of 0.6 m, `down` the cosine of gamma, where the bound is a thousandth. */
static double reach_of(const light *l, double down)
{
    for (double dist = 1.0; dist < 1000.0; dist *= 1.02) {
        vvec3 p =
            vspread((vec3){ (float)(dist * sqrt(1.0 - down * down)), 0, (float)(-dist * down) });
        vfloat error = { 0 };
        vlight_sample out;
        l->type->as_point(l, &p, ALL_LANES, &out, &error);
        if (lane(error, 0) < 1e-3f * lane(out.e.y, 0))
            return dist;
    }
    return HUGE_VAL;
}

TEST(a_matt_panel_is_a_point_from_20_m_on)
{
    arena a = { 0 };
    for (int f = 0; f < FORMS; f++) {
        photometry *w  = web_make(&a, forms[f].form, forms[f].planes, forms[f].step_deg);
        const light *l = make(&a, w, OPENING_RECTANGLE, (vec3){ 0.6f, 0.6f, 0 });
        print_message("%12s: within 0.1 %% from %.1f m below, %.1f m at 45 deg, %.1f m at 70\n",
                      forms[f].name, reach_of(l, 1.0), reach_of(l, 0.7071), reach_of(l, 0.342));
        if (forms[f].form == web_lambertian)
            assert_true(reach_of(l, 1.0) < 20.0 && reach_of(l, 0.7071) < 20.0);
    }
    arena_clear(&a);
}

TEST(close_by_there_is_no_bound_and_dead_lanes_are_zero)
{
    arena a        = { 0 };
    photometry *w  = web_make(&a, web_lambertian, 1, 5);
    const light *l = make(&a, w, OPENING_RECTANGLE, (vec3){ 0.6f, 0.6f, 0 });
    vvec3 p        = vspread((vec3){ 0.1f, 0, -0.5f });
    vfloat error   = { 0 };
    vlight_sample out;
    vmask one = vlane_index() < 1;
    assert_int_equal(vbits(l->type->as_point(l, &p, one, &out, &error)), 1);
    assert_true(lane(error, 0) == INFINITY);
    for (int i = 1; i < LANES; i++)
        assert_true(lane(error, i) == 0.0f && lane(out.e.x, i) == 0.0f &&
                    lane(out.dist, i) == 0.0f);
    assert_true(light_has_extent(l));

    const luminaire_desc d = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = w, .point = true };
    assert_false(light_has_extent(light_luminaire(&a, &d, NULL)));
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_flat_luminaire_is_farther_off_its_point_than_the_bound),
        cmocka_unit_test(no_solid_luminaire_is_farther_off_its_point_than_the_bound),
        cmocka_unit_test(a_matt_panel_is_a_point_from_20_m_on),
        cmocka_unit_test(close_by_there_is_no_bound_and_dead_lanes_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
