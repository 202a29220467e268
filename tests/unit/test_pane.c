/* tests/unit/test_pane.c -- panes of glass, single, double and as closed boxes. */
#include "core/sampler.h"
#include "tests/material_checks.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const material *make(arena *a, vec3 transmittance, float ior, bool box)
{
    pane_desc d       = { .transmittance = transmittance, .ior = ior, .box = box };
    const material *m = material_pane(a, &d, NULL);
    assert_non_null(m);
    return m;
}

static const vec3 tinted = { 0.9f, 0.5f, 0 };

TEST(panes_hold_to_what_all_materials_do)
{
    arena a           = { 0 };
    const material *m = make(&a, tinted, 1.52f, false);
    material_check_furnace(m);
    material_check_packets(m);
    m = make(&a, tinted, 1.52f, true);
    material_check_furnace(m);
    material_check_packets(m);
    m = make(&a, (vec3){ 0, 0, 0 }, 4, false);
    material_check_furnace(m);
    material_check_packets(m);
    m = make(&a, (vec3){ 1, 1, 1 }, 1.0000001f, false); /* hardly there */
    material_check_furnace(m);
    material_check_packets(m);
    arena_clear(&a);
}

typedef struct shares {
    double passed, reflected;
} shares;

static shares at(const material *m, double theta, bool front)
{
    vshading s  = material_seen_from(m, theta, 33, front);
    vrgb passed = m->type->through(m, &s, ALL_LANES);
    vrgb back   = m->type->albedo(m, &s, ALL_LANES);
    return (shares){ (double)lane(passed.x, 0), (double)lane(back.x, 0) };
}

/* n = 1.52 without absorption, and n = 1.53 whose inside lets 0.964 through (CIE 171:2006, 5.10):
 * published to four digits. Both are given by what the whole pane lets through at normal
 * incidence. */
TEST(the_whole_pane_follows_the_tables)
{
    static const double angles[] = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 85 };
    static const double clear[]  = { .9183, .9183, .9179, .9160, .9095,
                                     .8912, .8435, .7247, .4560, .2456 };
    static const double cie[]    = { .8828, .8826, .8816, .8786, .8709,
                                     .8515, .8036, .6876, .4268, .2217 };
    const double r               = pow(0.53 / 2.53, 2);
    const double whole           = (1 - r) * (1 - r) * 0.964 / (1 - pow(r * 0.964, 2));
    const float given[]          = { (float)pane_most(1.52), (float)whole };
    const double half_a_digit    = 0.5e-4 + 1e-6;
    arena a                      = { 0 };
    const material *m_clear      = make(&a, (vec3){ given[0], given[0], given[0] }, 1.52f, false);
    const material *m_cie        = make(&a, (vec3){ given[1], given[1], given[1] }, 1.53f, false);
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
        for (int front = 0; front < 2; front++) {
            assert_true(fabs(at(m_clear, angles[i], front).passed - clear[i]) <= half_a_digit);
            assert_true(fabs(at(m_cie, angles[i], front).passed - cie[i]) <= half_a_digit);
        }
    arena_clear(&a);
}

TEST(at_normal_incidence_it_lets_through_what_it_was_told)
{
    arena a = { 0 };
    for (float ior = 1.01f; ior < 4; ior += 0.37f)
        for (double share = 0; share <= 1; share += 0.1) {
            float t           = (float)(share * pane_most((double)ior));
            const material *m = make(&a, (vec3){ t, t, t }, ior, false);
            assert_true(fabs(at(m, 0, true).passed - (double)t) <= 1e-6);
        }
    arena_clear(&a);
}

/* What passes, comes back and stays inside is all there was: at the most that a pane can let
 * through nothing stays, and less of it the darker it is. */
TEST(nothing_is_lost_but_what_is_absorbed)
{
    arena a           = { 0 };
    float most        = (float)pane_most(1.52);
    const material *m = make(&a, (vec3){ most, most, most }, 1.52f, false);
    const material *d = make(&a, (vec3){ 0.5f, 0.5f, 0.5f }, 1.52f, false);
    for (double theta = 0; theta < 90; theta += 2.3) {
        shares clear = at(m, theta, true), dark = at(d, theta, true);
        assert_near(clear.passed + clear.reflected, 1.0, 1e-6);
        assert_true(dark.passed + dark.reflected < 1.0);
    }
    arena_clear(&a);
}

/* Paths between two panes, drawn as the program does: at each the path goes on straight or comes
 * back. What gets through is T1 T2 / (1 - R1 R2), what comes back R1 + T1^2 R2 / (1 - R1 R2). */
static shares follow(const material *const panes[2], double theta, int paths)
{
    shares sum     = { 0 };
    uint32_t state = 5;
    for (int i = 0; i < paths; i++) {
        double worth = 1;
        bool ahead   = true;
        int place    = 0; /* the pane that is met; before the first and after the last it ends */
        while (place >= 0 && place < 2) {
            const material *m = panes[place];
            vscatter out;
            vshading s  = material_seen_from(m, theta, 33, ahead);
            vfloat pick = vsplat((float)(hash_u32(state++) >> 8) * 0x1p-24f);
            assert_true(vall(m->type->scatter(m, &s, pick, pick, pick, ALL_LANES, &out)));
            worth *= (double)lane(out.weight.x, 0);
            ahead = (lane(out.straight, 0) & 1) ? ahead : !ahead;
            place += ahead ? 1 : -1;
        }
        *(place < 0 ? &sum.reflected : &sum.passed) += worth / paths;
    }
    return sum;
}

TEST(double_glazing_is_the_sum_of_its_ways)
{
    enum { PATHS = 60000 };
    arena a                       = { 0 };
    const material *const panes[] = { make(&a, (vec3){ 0.8f, 0.8f, 0.8f }, 1.52f, false),
                                      make(&a, (vec3){ 0.6f, 0.6f, 0.6f }, 1.7f, false) };
    for (double theta = 0; theta < 90; theta += 40) {
        shares one = at(panes[0], theta, true), two = at(panes[1], theta, true);
        double ends   = 1 - one.reflected * two.reflected;
        double passed = one.passed * two.passed / ends;
        double back   = one.reflected + one.passed * one.passed * two.reflected / ends;
        shares got    = follow(panes, theta, PATHS);
        /* Each path is worth at most 1: its error is at most 0.5 / sqrt(paths), 5 of them */
        assert_true(fabs(got.passed - passed) <= 2.5 / sqrt(PATHS));
        assert_true(fabs(got.reflected - back) <= 2.5 / sqrt(PATHS));
    }
    arena_clear(&a);
}

TEST(back_sides_of_boxes_do_nothing)
{
    arena a           = { 0 };
    const material *m = make(&a, tinted, 1.52f, true);
    const material *p = make(&a, tinted, 1.52f, false);
    for (double theta = 0; theta < 90; theta += 8) {
        shares front = at(m, theta, true), back = at(m, theta, false), plain = at(p, theta, true);
        assert_true(back.passed == 1 && back.reflected == 0);
        assert_true(front.passed == plain.passed && front.reflected == plain.reflected);
        vscatter out;
        vshading s = material_seen_from(m, theta, 0, false);
        vfloat u   = vsplat(0x1.fffffep-1f);
        assert_true(vall(m->type->scatter(m, &s, u, u, u, ALL_LANES, &out)));
        assert_true(vall(out.straight & (out.weight.z == 1.0f) & (out.wi.x == -s.wo.x)));
    }
    arena_clear(&a);
}

/* Of diffuse light: 2 integral of T(c) c dc, here in degrees by Simpson's rule. */
TEST(transmittance_is_that_of_diffuse_light)
{
    enum { N = 9000 };
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 0.85f, 0.85f, 0.85f }, 1.52f, false);
    double passed = 0, reflected = 0;
    for (int i = 0; i <= N; i++) {
        double theta = 90.0 * i / N, w = (i % 2 ? 4 : i % N ? 2 : 1) * pi / 2 / N / 3;
        shares s = at(m, theta, true);
        passed += w * s.passed * sin(2 * theta * pi / 180);
        reflected += w * s.reflected * sin(2 * theta * pi / 180);
    }
    assert_near(m->transmittance.x, passed, 1e-5);
    assert_near(m->reflectance.x, reflected, 1e-5);
    assert_true(!m->matt && !m->solid && !m->two_sided && !m->type->reflect);
    arena_clear(&a);
}

TEST(the_most_that_a_pane_can_be_is_told)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    assert_near(pane_most(1.52), 0.9183, 5e-5);
    pane_desc d = { .transmittance = { 0.8f, 0.92f, 0.8f }, .ior = 1.52f };
    assert_null(material_pane(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    assert_non_null(strstr(err.text, "0.9183"));
    assert_non_null(strstr(err.text, "0.92"));
    d.transmittance.y = 0.9183f;
    assert_non_null(material_pane(&a, &d, &err));
    arena_clear(&a);
}

/* Of index 1 nothing is reflected: all goes on that is not absorbed, and of black glass nothing. */
TEST(without_a_border_nothing_comes_back)
{
    arena a                  = { 0 };
    static const float all[] = { 1.0f, 0.25f, 0.0f };
    for (int i = 0; i < 3; i++) {
        const material *m = make(&a, (vec3){ all[i], all[i], all[i] }, 1.0f, false);
        material_check_furnace(m);
        material_check_packets(m);
        assert_true(v3_dot(m->reflectance, m->reflectance) == 0.0f);
        for (double theta = 0; theta < 90; theta += 7) {
            shares of = at(m, theta, true);
            assert_near(of.passed, pow((double)all[i], 1.0 / cos(theta * pi / 180.0)), 1e-5);
            assert_true(of.reflected == 0.0);
        }
    }
    assert_near(pane_most(1.0), 1.0, 0.0);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a              = { 0 };
    lux_error err        = { 0 };
    const pane_desc good = { .transmittance = { 0.8f, 0.8f, 0.8f }, .ior = 1.52f };
    pane_desc d          = good;
    d.transmittance.z    = -0.1f;
    assert_null(material_pane(&a, &d, &err));
    d.transmittance.z = NAN;
    assert_null(material_pane(&a, &d, &err));
    d     = good;
    d.ior = 0.999f;
    assert_null(material_pane(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d                = good;
    d.extra.openness = NAN;
    assert_null(material_pane(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(material_pane(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_hold_to_what_all_materials_do),
        cmocka_unit_test(the_whole_pane_follows_the_tables),
        cmocka_unit_test(at_normal_incidence_it_lets_through_what_it_was_told),
        cmocka_unit_test(nothing_is_lost_but_what_is_absorbed),
        cmocka_unit_test(double_glazing_is_the_sum_of_its_ways),
        cmocka_unit_test(back_sides_of_boxes_do_nothing),
        cmocka_unit_test(transmittance_is_that_of_diffuse_light),
        cmocka_unit_test(the_most_that_a_pane_can_be_is_told),
        cmocka_unit_test(without_a_border_nothing_comes_back),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
