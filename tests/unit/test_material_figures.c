/* tests/unit/test_material_figures.c -- what reports tell of materials, against closed forms. */
#include "materials/material_figures.h"
#include "tests/test.h"

static vec3 from(double theta_deg, double side)
{
    double t = theta_deg * (M_PI / 180.0);
    return (vec3){ (float)sin(t), 0.0f, (float)(side * cos(t)) };
}

TEST(a_matt_surface_gives_back_its_reflectance_from_everywhere)
{
    arena a           = { 0 };
    diffuse_desc d    = { .reflectance = { 0.5f, 0.25f, 0.125f } };
    const material *m = material_diffuse(&a, &d, NULL);
    for (int side = -1; side <= 1; side += 2)
        for (int t = 0; t < 90; t += 10) {
            material_share s = material_share_of(m, from(t, side));
            assert_near(s.reflected.x, 0.5, 1e-6);
            assert_near(s.reflected.y, 0.25, 1e-6);
            assert_near(s.reflected.z, 0.125, 1e-6);
            assert_near(s.through.x, 0.0, 0.0);
        }
    arena_clear(&a);
}

/* rho cos / pi, rho as luminance: of grey itself. */
TEST(the_lobe_of_a_matt_surface_is_lamberts)
{
    arena a = { 0 };
    const material *m =
        material_diffuse(&a, &(diffuse_desc){ .reflectance = { 0.6f, 0.6f, 0.6f } }, NULL);
    for (int t = 0; t < 90; t += 15) {
        double cosine = cos(t * (M_PI / 180.0));
        assert_near(material_lobe(m, from(40.0, 1.0), from(t, 1.0)), 0.6 * cosine / M_PI, 1e-6);
        assert_near(material_lobe(m, from(40.0, 1.0), from(t, -1.0)), 0.0, 0.0);
    }
    arena_clear(&a);
}

/* A pane without absorption, (1 - R) / (1 + R) at normal incidence, lets through what it does not
 * reflect; at normal incidence R = ((n - 1) / (n + 1))^2. 1e-3 is what the header promises. */
TEST(clear_glass_lets_through_what_it_does_not_reflect)
{
    arena a  = { 0 };
    double n = 1.5, r = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
    float t           = (float)((1.0 - r) / (1.0 + r) - 1e-7);
    pane_desc d       = { .transmittance = { t, t, t }, .ior = (float)n };
    lux_error e       = { 0 };
    const material *m = material_pane(&a, &d, &e);
    assert_non_null(m);
    material_share s = material_share_of(m, from(0.0, 1.0));
    assert_near(s.through.x, t, 1e-3);
    for (int deg = 0; deg < 90; deg += 10) {
        s = material_share_of(m, from(deg, 1.0));
        assert_near(s.reflected.y + s.through.y, 1.0, 2e-3); /* both ways of finding it */
    }
    assert_near(material_lobe(m, from(30.0, 1.0), from(30.0, -1.0)), 0.0, 0.0); /* no density */
    arena_clear(&a);
}

TEST(holes_are_left_out)
{
    arena a           = { 0 };
    diffuse_desc d    = { .reflectance = { 0.5f, 0.5f, 0.5f }, .extra = { .openness = 0.5f } };
    const material *m = material_diffuse(&a, &d, NULL);
    material_share s  = material_share_of(m, from(20.0, 1.0));
    assert_near(s.reflected.x, 0.5, 1e-6);
    assert_near(s.through.x, 0.0, 0.0);
    arena_clear(&a);
}

/* 1e-4: rounding of floats in lobes of exponent 50, fifty times that of a cosine and more. */
TEST(what_is_reciprocal_is_found_so)
{
    arena a                = { 0 };
    phong_desc p           = { .reflectance = { 0.3f, 0.3f, 0.3f },
                               .specular    = { 0.3f, 0.3f, 0.3f },
                               .exponent    = 50.0f };
    const material *m      = material_phong(&a, &p, NULL);
    material_reciprocity r = material_reciprocity_of(m);
    assert_true(r.mean >= 0.0 && r.mean < 1e-5);
    assert_true(r.worst >= r.mean && r.worst < 1e-4);
    m = material_mirror(&a, &(mirror_desc){ .reflectance = { 0.9f, 0.9f, 0.9f } }, NULL);
    r = material_reciprocity_of(m); /* no density: nothing to compare */
    assert_near(r.mean, 0.0, 0.0);
    assert_near(r.worst, 0.0, 0.0);
    arena_clear(&a);
}

/* A kind for this test alone, reciprocal nowhere but at equal angles: f = cos(wo) / 10. */
static vrgb lopsided(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                     vfloat *pdf)
{
    (void)self;
    vfloat cos_o = vdot(s->wo, s->n), cos_i = vdot(*wi, s->n);
    vfloat f = vkeep(active & (cos_i > 0.0f), 0.1f * cos_o * cos_i);
    if (pdf)
        *pdf = vsplat(1.0f);
    return (vrgb){ f, f, f };
}

/* The thetas that pairs are made of end at 0.06 and 1.49 rad: 1 - cos(1.49) / cos(0.06) is the
 * worst that they can find, and more than half of it any fair choice of pairs. */
TEST(what_is_not_reciprocal_is_told)
{
    static const material_type type = { .name = "lopsided", .reflect = lopsided };
    const material m                = { .type = &type };
    material_reciprocity r          = material_reciprocity_of(&m);
    assert_true(r.worst > 0.5 && r.worst <= 1.0);
    assert_true(r.mean > 0.1 && r.mean < r.worst);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matt_surface_gives_back_its_reflectance_from_everywhere),
        cmocka_unit_test(the_lobe_of_a_matt_surface_is_lamberts),
        cmocka_unit_test(clear_glass_lets_through_what_it_does_not_reflect),
        cmocka_unit_test(holes_are_left_out),
        cmocka_unit_test(what_is_reciprocal_is_found_so),
        cmocka_unit_test(what_is_not_reciprocal_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
