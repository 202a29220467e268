/* tests/physics/test_glass_sphere.c -- a sphere of glass: what falls on it leaves it or is
 * absorbed.
 *
 * In an even glow of 1 from all around, what the eye sees of the sphere is, averaged over its
 * outline, the share of a beam from the eye that is not absorbed (light goes the same ways back).
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/glass_sphere.h"
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/test.h"

/* ---- the reference itself -------------------------------------------------------------------- */

TEST(all_shares_of_the_beam_add_up)
{
    static const double n[] = { 1.33, 1.5, 1.8 }, inner[] = { 1.0, 0.7, 0.2 };
    for (int i = 0; i < 3; i++) {
        glass_sphere s = glass_sphere_of(n[i], inner[i]);
        double sum     = s.reflected + s.absorbed;
        for (int k = 0; k < SPHERE_ORDERS; k++)
            sum += s.leaves[k];
        assert_near(sum, 1.0, 1e-5); /* of the rim, orders beyond those */
    }
}

/* 0.0918 at index 1.5: what a surface reflects of even light (D. B. Judd, J. Res. NBS 29, 1942) */
TEST(a_sphere_reflects_as_a_surface_in_even_light)
{
    assert_true(fabs(glass_sphere_of(1.5, 1.0).reflected - 0.0918) < 6e-5);
}

/* The rainbow of water, index 4/3, stands 42.0 degrees about the point opposite to the sun: nothing
 * is turned by less than 138.0 degrees by one reflection. */
TEST(no_ray_is_turned_by_less_than_the_rainbow_s)
{
    const double degree = M_PI / 180.0;
    assert_near(glass_sphere_within(4.0 / 3.0, 1.0, 1, 137.9 * degree), 0.0, 0.0);
    assert_true(glass_sphere_within(4.0 / 3.0, 1.0, 1, 138.1 * degree) > 0.0);
    assert_near(glass_sphere_within(4.0 / 3.0, 1.0, 1, M_PI),
                glass_sphere_of(4.0 / 3.0, 1.0).leaves[1], 1e-9);
}

/* A ball lens has its focus n / (2 (n - 1)) radii behind its centre: rays near the axis, to b =
 * 0.1, meet it there within b^3 of a few, and are 0.96^2 of 1 % of the beam. */
TEST(rays_near_the_axis_meet_in_the_focus)
{
    double all   = glass_sphere_of(1.5, 1.0).leaves[0];
    double focus = glass_sphere_on_disk(1.5, 1.0, 0, 1.5, 0.005);
    assert_true(focus > 0.01 * 0.96 * 0.96 && focus < all);
    assert_near(glass_sphere_on_disk(1.5, 1.0, 0, 1.5, 1000.0), all, 1e-3); /* some go sideways */
}

/* ---- seen ------------------------------------------------------------------------------------ */

static void seen(double n, double inner)
{
    enum { SIDE = 16 };
    lab l;
    lab_open(&l);
    quad side[6];
    quads_of_box((dvec3){ -4, -4, -4 }, (dvec3){ 4, 4, 4 }, side);
    lab_quads(&l, "glow.gltf", side, 6, lab_glow(&l, 100.0));
    lab_sphere(&l, "ball.gltf", (dvec3){ 0 }, 0.5, 120,
               text_of(&l.a,
                       "\"name\":\"Ball\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                       "\"roughnessFactor\":0},\"extensions\":{\"KHR_materials_transmission\":{"
                       "\"transmissionFactor\":1},\"KHR_materials_ior\":{\"ior\":%.9g},"
                       "\"KHR_materials_volume\":{\"thicknessFactor\":1,\"attenuationDistance\":1,"
                       "\"attenuationColor\":[%.9g,%.9g,%.9g]}}",
                       n, inner, inner, inner));
    const scene *s =
        lab_scene(&l, "lux4: 1\nscene: [glow.gltf, ball.gltf]\n"
                      "views: [{name: v, projection: orthographic, eye: [2, 0.3, 0.2], "
                      "target: [0, 0, 0], width: 1, size: [16, 16]}]\n");
    run_options o = { .accuracy = 0.03, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    view_result r;
    assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, NULL));
    double mean = 0.0, outline = M_PI / 4.0;
    for (int i = 0; i < SIDE * SIDE; i++)
        mean += LUMENS_PER_WATT * (double)r.radiance[1][i] / 100.0 / (SIDE * SIDE);
    /* 1e-2: 256 pixels know 3 % each; pieces are 1.5 degrees wide; and within solids light is taken
     * as unpolarised at each border, which makes 0.15 % here */
    assert_near((mean - (1.0 - outline)) / outline, 1.0 - glass_sphere_of(n, inner).absorbed, 1e-2);
    lab_close(&l);
}

TEST(a_ball_of_clear_glass_cannot_be_seen) { seen(1.5, 1.0); }
TEST(a_ball_of_grey_glass_shows_what_it_leaves) { seen(1.5, 0.5); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_shares_of_the_beam_add_up),
        cmocka_unit_test(a_sphere_reflects_as_a_surface_in_even_light),
        cmocka_unit_test(no_ray_is_turned_by_less_than_the_rainbow_s),
        cmocka_unit_test(rays_near_the_axis_meet_in_the_focus),
        cmocka_unit_test(a_ball_of_clear_glass_cannot_be_seen),
        cmocka_unit_test(a_ball_of_grey_glass_shows_what_it_leaves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
