/* tests/unit/test_dielectric.c -- solids of glass: what their border does, and what fades inside.
 */
#include "tests/material_checks.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const material *make(arena *a, float ior, vec3 absorption, vec3 tint)
{
    dielectric_desc d = { .ior = ior, .absorption = absorption, .tint = tint };
    const material *m = material_dielectric(a, &d, NULL);
    assert_non_null(m);
    return m;
}

static const vec3 white = { 1, 1, 1 }, none = { 0, 0, 0 };

TEST(solids_hold_to_what_all_materials_do)
{
    arena a           = { 0 };
    const material *m = make(&a, 1.52f, none, white);
    material_check_furnace(m);
    material_check_packets(m);
    m = make(&a, 4, (vec3){ 0.1f, 1, 30 }, (vec3){ 1, 0.5f, 0 });
    material_check_furnace(m);
    material_check_packets(m);
    arena_clear(&a);
}

/* One draw, the same in all lanes */
static vscatter draw(const material *m, const vshading *s, float pick)
{
    vscatter out;
    vfloat any = vsplat(0.5f);
    assert_true(vall(m->type->scatter(m, s, any, any, vsplat(pick), ALL_LANES, &out)));
    assert_true(vall(out.pdf == INFINITY) && !vany(out.straight));
    return out;
}

/* n sin t is kept, in double; beyond the critical angle everything comes back. */
TEST(light_is_bent_as_snell_says)
{
    const double n    = (double)1.52f;
    arena a           = { 0 };
    const material *m = make(&a, 1.52f, none, white);
    for (double theta = 0; theta < 89.5; theta += 0.5)
        for (int front = 0; front < 2; front++) {
            vshading s   = material_seen_from(m, theta, 0, front);
            vscatter out = draw(m, &s, 0x1.fffffep-1f);
            double sin_t = sin(theta * pi / 180) * (front ? 1 / n : n);
            if (sin_t > 1) {
                assert_true(!vany(out.bent) && vall(out.wi.z == s.wo.z));
                continue;
            }
            assert_true(vall(out.bent));
            assert_true(fabs((double)lane(out.wi.x, 0) + sin_t) <= 1e-6);
            double z = (front ? -1 : 1) * sqrt(1 - sin_t * sin_t);
            assert_near(lane(out.wi.z, 0), z, 1e-5);
        }
    arena_clear(&a);
}

/* A ray that is bent into the solid and turned round is bent back to where it came from, and
 * passes as often. */
TEST(ways_can_be_gone_backward)
{
    arena a           = { 0 };
    const material *m = make(&a, 1.5f, none, white);
    for (double theta = 1; theta < 89; theta += 2.2) {
        vshading s    = material_seen_from(m, theta, 0, true);
        vscatter into = draw(m, &s, 0x1.fffffep-1f);
        vrgb ahead    = m->type->albedo(m, &s, ALL_LANES);

        vshading inside = s;
        inside.wo       = into.wi;
        inside.n = inside.flat = vneg(s.n);
        inside.front           = ~ALL_LANES;
        vscatter out           = draw(m, &inside, 0x1.fffffep-1f);
        vrgb back              = m->type->albedo(m, &inside, ALL_LANES);
        assert_true(fabs((double)lane(out.wi.x, 0) - (double)lane(s.wo.x, 0)) <= 1e-6);
        assert_true(fabs((double)lane(out.wi.z, 0) - (double)lane(s.wo.z, 0)) <=
                    1e-6 / (double)lane(s.wo.z, 0)); /* a root: its square is to 1e-6 */
        assert_true(fabs((double)lane(ahead.x, 0) - (double)lane(back.x, 0)) <=
                    1e-6 / (double)lane(s.wo.z, 0));
    }
    arena_clear(&a);
}

/* exp(-sigma d) of what comes along wo, from inside alone */
TEST(light_fades_inside)
{
    arena a           = { 0 };
    const material *m = make(&a, 1.5f, (vec3){ 0, 2, 50 }, (vec3){ 1, 0.5f, 1 });
    for (int k = 0; k < 2; k++)
        for (float d = 0.001f; d < 1.5f; d *= 1.7f) {
            vshading s   = material_seen_from(m, 20, 0, false);
            s.distance   = vsplat(d);
            vscatter out = draw(m, &s, k ? 0x1.fffffep-1f : 0);
            double tint  = k ? 0.5 : 1;
            assert_true(vall(out.bent) == (k == 1));
            assert_near(lane(out.weight.x, 0), 1.0, 1e-6);
            assert_near(lane(out.weight.y, 0), tint * exp(-2 * (double)d), 5e-6);
            assert_near(lane(out.weight.z, 0), exp(-50 * (double)d), 5e-7 * (1 + 50 * (double)d));
            s          = material_seen_from(m, 20, 0, true);
            s.distance = vsplat(d);
            out        = draw(m, &s, k ? 0x1.fffffep-1f : 0);
            assert_near(lane(out.weight.y, 0), tint, 1e-6);
            assert_near(lane(out.weight.z, 0), 1.0, 1e-6);
        }
    vshading s   = material_seen_from(m, 20, 0, false);
    s.distance   = vsplat(INFINITY);
    vscatter out = draw(m, &s, 0);
    assert_true(vall((out.weight.x == 1.0f) & (out.weight.y == 0.0f)));
    arena_clear(&a);
}

/* At normal incidence 1 - ((n - 1) / (n + 1))^2; the same from both sides at every angle, without
 * total reflection. */
TEST(shadow_rays_pass_faces_as_from_outside)
{
    arena a           = { 0 };
    const material *m = make(&a, 1.5f, (vec3){ 1, 1, 1 }, (vec3){ 1, 0.5f, 0 });
    for (double theta = 0; theta < 90; theta += 9) {
        vshading out = material_seen_from(m, theta, 0, true);
        vshading in  = material_seen_from(m, theta, 0, false);
        vrgb front   = m->type->through(m, &out, ALL_LANES);
        vrgb back    = m->type->through(m, &in, ALL_LANES);
        vrgb lost    = m->type->albedo(m, &out, ALL_LANES);
        assert_true(vall((front.x == back.x) & (front.y == back.y) & (front.z == 0.0f)));
        assert_near(lane(front.x, 0), 1 - (double)lane(lost.x, 0), 1e-6);
        assert_near(lane(front.y, 0), 0.5 * (double)lane(front.x, 0), 1e-6);
    }
    vshading s = material_seen_from(m, 0, 0, true);
    assert_near(lane(m->type->through(m, &s, ALL_LANES).x, 0), 0.96, 1e-6);
    arena_clear(&a);
}

/* The mean of Fresnel's formula over the half space, in closed form (Walsh 1926, as in Judd 1942):
 * 0.0918 for n = 1.5. */
TEST(reflectance_is_that_of_diffuse_light)
{
    arena a           = { 0 };
    const material *m = make(&a, 1.5f, (vec3){ 1, 2, 3 }, (vec3){ 1, 0.5f, 0 });
    const double n = 1.5, n2 = n * n, n4 = n2 * n2;
    double want = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                  n2 * (n2 - 1) * (n2 - 1) / pow(n2 + 1, 3) * log((n - 1) / (n + 1)) -
                  2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
                  8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * log(n);
    assert_near(want, 0.0918, 1e-3);
    assert_near(m->reflectance.x, want, 1e-5);
    assert_near(m->transmittance.x, 1 - want, 1e-5);
    assert_near(m->transmittance.y, 0.5 * (1 - want), 1e-5);
    assert_true(m->transmittance.z == 0 && m->absorption.y == 2);
    assert_true(m->solid && !m->matt && !m->two_sided && !m->type->reflect);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a                    = { 0 };
    lux_error err              = { 0 };
    const dielectric_desc good = { .ior = 4, .tint = { 1, 1, 1 } };
    assert_non_null(material_dielectric(&a, &good, &err));
    dielectric_desc d = good;
    d.ior             = 1;
    assert_null(material_dielectric(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.ior = NAN;
    assert_null(material_dielectric(&a, &d, &err));
    d.ior = 4.1f;
    assert_null(material_dielectric(&a, &d, &err));
    d              = good;
    d.absorption.z = INFINITY;
    assert_null(material_dielectric(&a, &d, &err));
    d.absorption.z = -1;
    assert_null(material_dielectric(&a, &d, &err));
    d        = good;
    d.tint.x = 1.1f;
    assert_null(material_dielectric(&a, &d, &err));
    d                = good;
    d.extra.openness = -1;
    assert_null(material_dielectric(&a, &d, &err));
    memory_is_out = true;
    arena full    = { 0 };
    assert_null(material_dielectric(&full, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_hold_to_what_all_materials_do),
        cmocka_unit_test(light_is_bent_as_snell_says),
        cmocka_unit_test(ways_can_be_gone_backward),
        cmocka_unit_test(light_fades_inside),
        cmocka_unit_test(shadow_rays_pass_faces_as_from_outside),
        cmocka_unit_test(reflectance_is_that_of_diffuse_light),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
