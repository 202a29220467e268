/* tests/physics/test_near_field.c -- luminaires that shine from their openings, against closed
 * forms.
 *
 * A web of I0 cos gamma makes a flat opening of the area A a Lambertian one of radiance I0 / A;
 * that of this file is linear between rings 0.5 deg apart, less than 1e-5 of I0 below the cosine.
 * Every luminaire hangs at (0, 0, 0), aimed down with C0 along +x.
 */
#include "core/sampler.h"
#include "tests/test.h"
#include "tests/webs.h"

static const vec3 UP = { 0, 0, 1 };

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

/* E of the rectangle (0..a) x (0..b) at its corner, c below, on a surface that faces it; pi L F. */
static double corner(double a, double b, double c)
{
    double x = hypot(a, c), y = hypot(b, c);
    return 0.5 * (a / x * atan(b / x) + b / y * atan(a / y));
}

/* The same under (x, y) of a rectangle a x b about the middle: four corners. */
static double rectangle_below(double a, double b, double x, double y, double c)
{
    double e = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int k = -1; k <= 1; k += 2) {
            double u = 0.5 * a + i * x, v = 0.5 * b + k * y;
            e += copysign(corner(fabs(u), fabs(v), c), u * v);
        }
    return e;
}

/* A mean of 2^14 net samples; the worst of these cases, right under an edge, is off by 7e-4. */
TEST(a_matt_rectangle_gives_what_lambert_says)
{
    arena a = { 0 };
    const light *l =
        make(&a, web_make(&a, web_lambertian, 1, 0.5), OPENING_RECTANGLE, (vec3){ 1.2f, 0.6f, 0 });
    const float z[] = { 5, 1, 0.3f, 0.1f, 0.01f, 1e-3f, 1e-6f };
    for (size_t i = 0; i < sizeof z / sizeof *z; i++)
        for (int k = 0; k < 4; k++) {
            vec3 p      = { 0.25f * (float)k, 0.1f * (float)k, -z[i] };
            double want = rectangle_below(1.2, 0.6, (double)p.x, (double)p.y, (double)z[i]) / 0.72;
            if (want < 1e-4) /* beside it, almost in its plane */
                continue;
            assert_near(mean_irradiance(l, p, UP, 14, NULL), want, 2e-3);
        }
    arena_clear(&a);
}

TEST(a_matt_rectangle_seen_from_the_side_gives_what_lambert_says)
{
    arena a        = { 0 };
    photometry *w  = web_make(&a, web_lambertian, 1, 0.5);
    const light *l = make(&a, w, OPENING_RECTANGLE, (vec3){ 2, 0.8f, 0 });

    /* The corner of 1 x 0.8 lies in the receiver's plane, 1.5 below it: both halves alike */
    double want =
        2.0 * 0.5 * (atan(1.0 / 1.5) - 1.5 / hypot(0.8, 1.5) * atan(1.0 / hypot(0.8, 1.5)));
    vec3 n = { 0, 1, 0 };
    assert_near(mean_irradiance(l, (vec3){ 0, -0.4f, -1.5f }, n, 14, NULL), want / 1.6, 1e-3);
    arena_clear(&a);
}

TEST(the_length_lies_along_the_plane_that_the_file_names)
{
    arena a             = { 0 };
    photometry *w       = web_make(&a, web_lambertian, 1, 0.5);
    w->length_along_deg = 90.0f;
    const light *l      = make(&a, w, OPENING_RECTANGLE, (vec3){ 1.2f, 0.6f, 0 });
    vec3 p              = { 0.1f, 0.3f, -0.3f };
    double want         = rectangle_below(0.6, 1.2, 0.1, 0.3, 0.3) / 0.72;
    assert_near(mean_irradiance(l, p, UP, 14, NULL), want, 1e-3);

    const luminaire_desc d = {
        .aim = { 0, 0, -1 }, .c0 = { 0, 2, 1 }, .scale = { 1, 1, 1 }, .web = w
    };
    l    = light_luminaire(&a, &d, NULL); /* C0 along +y, C90 and the length along -x */
    want = rectangle_below(1.2, 0.6, 0.1, 0.3, 0.3) / 0.72;
    assert_near(mean_irradiance(l, p, UP, 14, NULL), want, 1e-3);
    arena_clear(&a);
}

TEST(a_matt_disc_gives_its_closed_form)
{
    arena a = { 0 };
    const light *l =
        make(&a, web_make(&a, web_lambertian, 1, 0.5), OPENING_DISC, (vec3){ 2, 2, 0 });
    const float d[] = { 0, 0.5f, 1, 2 }, h[] = { 2, 0.5f, 0.1f, 1e-3f };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            double dd = (double)d[i], hh = (double)h[k], sum = hh * hh + dd * dd;
            double s    = sqrt((sum + 1) * (sum + 1) - 4 * dd * dd);
            double want = 0.5 * (1.0 - (sum - 1) / s); /* pi L F, L = 1 / pi */
            if (want < 1e-4)
                continue;
            assert_near(mean_irradiance(l, (vec3){ 0, d[i], -h[k] }, UP, 14, NULL), want, 3e-3);
        }
    arena_clear(&a);
}

TEST(a_line_gives_its_closed_forms)
{
    arena a      = { 0 };
    double alpha = atan(1.2 / 2.0);
    vec3 p       = { 0.6f, 0, -2 }; /* under one end */

    const light *l =
        make(&a, web_make(&a, web_isotropic, 1, 5), OPENING_LINE, (vec3){ 1.2f, 0, 0 });
    assert_near(mean_irradiance(l, p, UP, 12, NULL), sin(alpha) / 2.0 / 1.2, 1e-5);
    p.z          = -1e-3f;
    double close = sin(atan(1200.0)) * 1e3 / 1.2;
    assert_near(mean_irradiance(l, p, UP, 12, NULL), close, 1e-4);

    p.z = -2;
    l   = make(&a, web_make(&a, web_sine, 360, 1), OPENING_LINE, (vec3){ 1.2f, 0, 0 });
    assert_near(mean_irradiance(l, p, UP, 12, NULL), (alpha + sin(alpha) * cos(alpha)) / 4.0 / 1.2,
                1e-4);

    /* On the axis beyond an end: 1 / (near far), facing along it */
    vec3 on_axis = { 1.6f, 0, 0 }, along = { -1, 0, 0 };
    l = make(&a, web_make(&a, web_isotropic, 1, 5), OPENING_LINE, (vec3){ 1.2f, 0, 0 });
    assert_near(mean_irradiance(l, on_axis, along, 12, NULL), 1.0 / (1.0 * 2.2), 1e-3);
    arena_clear(&a);
}

TEST(a_matt_sphere_gives_its_closed_form)
{
    arena a        = { 0 };
    const light *l = make(&a, web_make(&a, web_isotropic, 1, 5), OPENING_SPHERE, (vec3){ 1, 1, 1 });
    vec3 n         = { 0, 0.6f, 0.8f };
    assert_near(mean_irradiance(l, (vec3){ 0, 0, -2 }, n, 12, NULL), 0.8 / 4.0, 1e-5);
    assert_near(mean_irradiance(l, (vec3){ 0, 0, -0.501f }, UP, 12, NULL), 1.0 / (0.501 * 0.501),
                1e-4);
    arena_clear(&a);
}

/* ---- all shapes -------------------------------------------------------------------------- */

static const struct {
    opening_shape shape;
    vec3 size;
} shapes[] = {
    { OPENING_LINE, { 1.2f, 0, 0 } },
    { OPENING_LINE, { 0, 0, 0.5f } },
    { OPENING_RECTANGLE, { 1.2f, 0.3f, 0 } },
    { OPENING_BOX, { 1.2f, 0.3f, 0.1f } },
    { OPENING_BOX, { 0, 0.3f, 0.4f } },
    { OPENING_DISC, { 0.5f, 0.8f, 0 } },
    { OPENING_VERTICAL_CYLINDER, { 0.4f, 0.6f, 0.5f } },
    { OPENING_SPHERE, { 0.5f, 0.7f, 0.3f } },
    { OPENING_CYLINDER_ALONG, { 1.2f, 0.2f, 0.1f } },
    { OPENING_CYLINDER_ACROSS, { 0.2f, 1.2f, 0.2f } },
    { OPENING_VERTICAL_DISC, { 0.6f, 0, 0.4f } },
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static const struct {
    web_form *form;
    int planes;
} forms[] = {
    { web_isotropic, 1 }, { web_both_sides, 1 }, { web_batwing, 1 }, { web_asymmetric, 72 }
};
enum { FORMS = sizeof forms / sizeof *forms };

/* W through the walls of a box x, y in +-1, z in +-0.8 m, by a net of places and of draws at once.
 */
static double flux_out(const light *l, int log2_count)
{
    const float half[] = { 1.0f, 1.0f, 0.8f };
    double sum         = 0.0;
    for (int wall = 0; wall < 6; wall++) {
        int i = wall / 2, j = (i + 1) % 3, k = (i + 2) % 3;
        float side = wall % 2 ? 1.0f : -1.0f, through = 0.0f;
        double part = 0.0;
        for (int at = 0; at < 1 << log2_count; at += LANES) {
            vsample4 u = vsobol4(vunsigned(vlane_index() + at), vunsigned(vsplat_int(wall)));
            vfloat c[3];
            c[i]    = vsplat(side * half[i]);
            c[j]    = (2.0f * u.x - 1.0f) * half[j];
            c[k]    = (2.0f * u.y - 1.0f) * half[k];
            vvec3 p = { c[0], c[1], c[2] };
            vlight_sample s;
            light_sample(l, &p, u.z, u.w, ALL_LANES, &s);
            vfloat cosine = (i == 0 ? s.wi.x : i == 1 ? s.wi.y : s.wi.z) * -side;
            through       = vsum(s.e.y * vmax(cosine, vsplat(0.0f)));
            part += (double)through;
        }
        sum += part * 4.0 * (double)(half[j] * half[k]) / (1 << log2_count);
    }
    return sum;
}

TEST(the_flux_through_a_box_around_it_is_the_lumens_of_the_file)
{
    arena a = { 0 };
    for (int f = 0; f < FORMS; f++) {
        photometry *w = web_make(&a, forms[f].form, forms[f].planes, 2.5);
        for (int i = 0; i < SHAPES; i++) {
            const light *l = make(&a, w, shapes[i].shape, shapes[i].size);
            assert_near((double)light_flux(l).y, w->luminaire_lumens, 1e-6);
            assert_near(flux_out(l, 15), w->luminaire_lumens, 2e-3);
        }
    }
    arena_clear(&a);
}

/* At 2000 m, the depth of the solids is within 1e-3, and the angle of any part within 4e-4. */
TEST(far_away_it_is_the_point)
{
    arena a                = { 0 };
    photometry *w          = web_make(&a, web_asymmetric, 72, 2.5);
    const luminaire_desc d = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = w, .point = true };
    const light *point     = light_luminaire(&a, &d, NULL);
    for (int i = 0; i < SHAPES; i++) {
        const light *l = make(&a, w, shapes[i].shape, shapes[i].size);
        for (int k = 0; k < 20; k++) {
            float turn = 0.7f * (float)k, down = 0.1f + 0.045f * (float)k;
            float across = sqrtf(1.0f - down * down);
            vec3 to      = { across * cosf(turn), across * sinf(turn), -down };
            vec3 p       = v3_scale(to, 2000.0f);
            vec3 n       = v3_scale(to, -1.0f);
            double want  = mean_irradiance(point, p, n, 2, NULL);
            assert_near(mean_irradiance(l, p, n, 12, NULL), want, 3e-3);
        }
    }
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matt_rectangle_gives_what_lambert_says),
        cmocka_unit_test(a_matt_rectangle_seen_from_the_side_gives_what_lambert_says),
        cmocka_unit_test(the_length_lies_along_the_plane_that_the_file_names),
        cmocka_unit_test(a_matt_disc_gives_its_closed_form),
        cmocka_unit_test(a_line_gives_its_closed_forms),
        cmocka_unit_test(a_matt_sphere_gives_its_closed_form),
        cmocka_unit_test(the_flux_through_a_box_around_it_is_the_lumens_of_the_file),
        cmocka_unit_test(far_away_it_is_the_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
