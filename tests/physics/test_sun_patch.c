/* tests/physics/test_sun_patch.c -- the sun through a window: where its patch ends, how bright it
 * is, how wide its edges are.
 *
 * The window is a rectangle c_k in the wall y = 0; a corner of its patch on the floor is at
 * c_k - s c_k.z / s.z, with s toward the sun. There E = E_n s.z, behind a pane times what a slab of
 * that glass passes at the angle of s. Of a disk of angular radius a, of which an edge hides all
 * beyond a plane that passes its centre at the angle d (positive: the centre is seen), t = d / a,
 *
 *     E / E_0 = 1 - (acos(t) - t sqrt(1 - t^2)) / pi
 *
 * is seen (a segment of the circle: flat to a^2, 1e-5).
 */
#include "tests/gltf_text.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <stdlib.h>

static const double sun_lx      = 100000.0;
static const double azimuth_deg = 191.0, elevation_deg = 38.0;

/* The window, corners in their order around it: sill first. Its sky gives as good as nothing. */
static const dvec3 window[4] = { { 1, 0, 0.9 }, { 3, 0, 0.9 }, { 3, 0, 2.3 }, { 1, 0, 2.3 } };

static dvec3 to_sun(void)
{
    double a = azimuth_deg * M_PI / 180.0, h = elevation_deg * M_PI / 180.0;
    return (dvec3){ sin(a) * cos(h), cos(a) * cos(h), sin(h) };
}

static char *study_of(lab *l, const char *sun, double transmittance)
{
    return text_of(&l->a,
                   "room: {size: [4, 5, 3], reflectance: 0, windows: [{wall: south, at: [1, 0.9], "
                   "size: [2, 1.4], transmittance: %.9g}]}\n"
                   "sky: {model: clear, sun: %s, sun_at: {azimuth: %g, elevation: %g}, ground: 0,\n"
                   "      horizontal: 1e-6, sun_illuminance: %g}",
                   transmittance, sun, azimuth_deg, elevation_deg, sun_lx);
}

static dvec3 shadow_of(dvec3 corner)
{
    return d3_sub(corner, d3_scale(to_sun(), corner.z / to_sun().z));
}

static dvec3 between(dvec3 a, dvec3 b, double t)
{
    return d3_add(d3_scale(a, 1.0 - t), d3_scale(b, t));
}

/* ---- a point --------------------------------------------------------------------------------- */

enum { SEARCHES = 8, CUTS = 32, ROUNDS = 3 };

/* Between a lit and a dark place each, where the light ends: to 1 / CUTS^ROUNDS of their distance.
 */
static void find_ends(dvec3 lit[SEARCHES], dvec3 dark[SEARCHES])
{
    for (int round = 0; round < ROUNDS; round++) {
        lab l;
        lab_open(&l);
        lab_probe p[SEARCHES * CUTS];
        grid_result r;
        for (int i = 0; i < SEARCHES * CUTS; i++)
            p[i] = (lab_probe){ between(lit[i / CUTS], dark[i / CUTS], (i % CUTS + 0.5) / CUTS),
                                { 0, 0, 1 } };
        lab_measure(&l, study_of(&l, "point", 1.0), NULL, p, SEARCHES * CUTS, &(run_options){ 0 },
                    &r);
        for (int i = 0; i < SEARCHES; i++) {
            const double *e = r.illuminance + (ptrdiff_t)i * CUTS;
            int bright      = 0;
            while (bright < CUTS && e[bright] > 0.5 * sun_lx * to_sun().z)
                bright++;
            for (int k = bright; k < CUTS; k++)
                assert_true(e[k] < 1.0); /* once it is dark, it stays so */
            dvec3 from = lit[i], to = dark[i];
            lit[i]  = bright > 0 ? between(from, to, (bright - 0.5) / CUTS) : from;
            dark[i] = bright < CUTS ? between(from, to, (bright + 0.5) / CUTS) : to;
        }
        lab_close(&l);
    }
}

/* Where two lines in the floor meet, each through two points. */
static dvec3 crossing(const dvec3 a[2], const dvec3 b[2])
{
    dvec3 u = d3_sub(a[1], a[0]), v = d3_sub(b[1], b[0]), w = d3_sub(b[0], a[0]);
    return d3_add(a[0], d3_scale(u, (w.x * v.y - w.y * v.x) / (u.x * v.y - u.y * v.x)));
}

/* Two points of each side are searched for, a line is laid through them; lines meet in corners. */
TEST(the_corners_of_the_patch_are_where_geometry_says)
{
    dvec3 corner[4], lit[SEARCHES], dark[SEARCHES], middle = { 0 };
    for (int k = 0; k < 4; k++) {
        corner[k] = shadow_of(window[k]);
        middle    = d3_add(middle, d3_scale(corner[k], 0.25));
    }
    for (int i = 0; i < SEARCHES; i++) {
        dvec3 on = between(corner[i / 2], corner[(i / 2 + 1) % 4], i % 2 ? 0.8 : 0.3);
        lit[i]   = between(middle, on, 0.7);
        dark[i]  = between(middle, on, 1.4);
    }
    find_ends(lit, dark);
    for (int k = 0; k < 4; k++) {
        dvec3 found = crossing(lit + 2 * k, lit + 2 * ((k + 1) % 4));
        double off  = d3_length(d3_sub(found, corner[(k + 1) % 4]));
        if (!(off < 1e-3))
            fail_msg("corner %d: (%.5f, %.5f), not (%.5f, %.5f)", k, found.x, found.y,
                     corner[(k + 1) % 4].x, corner[(k + 1) % 4].y);
    }
}

/* Points are exact; of a disk it is samples that say that all of it is seen. */
static void brightness_of_patch(const char *sun, double transmittance, double passes)
{
    const double exact = sun[0] == 'p' ? 1e-6 : 5e-5;
    lab l;
    lab_open(&l);
    lab_probe p[5];
    grid_result r;
    for (int k = 0; k < 4; k++)
        p[k].at = between(shadow_of(window[k]), shadow_of(window[(k + 2) % 4]), 0.1 + 0.1 * k);
    p[4].at = between(shadow_of(window[0]), shadow_of(window[2]), 1.1);
    for (int k = 0; k < 5; k++)
        p[k].normal = (dvec3){ 0, 0, 1 };
    p[3].normal = (dvec3){ 0.6, 0, 0.8 };
    lab_measure(&l, study_of(&l, sun, transmittance), NULL, p, 5, &(run_options){ 0 }, &r);
    for (int k = 0; k < 5; k++) {
        double want = k == 4 ? 0.0 : passes * sun_lx * d3_dot(to_sun(), p[k].normal);
        assert_near(r.direct[k], want, exact);
        assert_near(r.illuminance[k], want, exact);
    }
    lab_close(&l);
}

TEST(the_patch_is_as_bright_as_the_sun_at_that_angle)
{
    brightness_of_patch("point", 1.0, 1.0);
    brightness_of_patch("disk", 1.0, 1.0);
}

TEST(behind_a_pane_it_has_what_the_pane_passes_at_that_angle)
{
    static const double transmittance[] = { 0.9, 0.8, 0.3 };
    for (int i = 0; i < 3; i++) {
        double inner  = slab_inner(1.52, transmittance[i]);
        double passes = slab_of(1.52, inner, fabs(to_sun().y)).passed;
        assert_true(fabs(passes / transmittance[i] - 1.0) > 0.01); /* else it shows nothing */
        brightness_of_patch("point", transmittance[i], passes);
        brightness_of_patch("disk", transmittance[i], passes);
    }
}

/* ---- a disk ---------------------------------------------------------------------------------- */

/* 2 asin(695,700 km / 1 au) */
static const double sun_radius = 4.65048e-3;

/* How far the sun's centre is from the plane of a side of the window and a place. */
static double past_edge(const dvec3 *edge, dvec3 inside, dvec3 at)
{
    dvec3 n  = d3_cross(d3_sub(edge[0], at), d3_sub(edge[1], at));
    double d = asin(d3_dot(n, to_sun()) / d3_length(n));
    return d3_dot(n, d3_sub(inside, at)) > 0.0 ? d : -d;
}

static double share_seen(double past)
{
    double t = fmin(fmax(past / sun_radius, -1.0), 1.0);
    return 1.0 - (acos(t) - t * sqrt(1.0 - t * t)) / M_PI;
}

enum { ACROSS = 41 };

/* Sensors across the middle of a side's shadow: over twice its width, which is distance times
 * diameter, slanted as the floor is. */
static void penumbra(int side, double transmittance)
{
    const dvec3 edge[2] = { window[side], window[(side + 1) % 4] };
    dvec3 inside        = between(window[0], window[2], 0.5);
    dvec3 on            = between(shadow_of(edge[0]), shadow_of(edge[1]), 0.45);
    dvec3 inward        = d3_sub(shadow_of(inside), on);
    inward              = d3_scale(inward, 1.0 / d3_length(inward));
    double step         = 0.01;
    double slope        = past_edge(edge, inside, d3_add(on, d3_scale(inward, step))) / step;
    double half_width   = sun_radius / slope; /* m, along the row of sensors */

    lab l;
    lab_open(&l);
    lab_probe p[ACROSS];
    double want[ACROSS];
    double passes = transmittance < 1.0
                        ? slab_of(1.52, slab_inner(1.52, transmittance), fabs(to_sun().y)).passed
                        : 1.0;
    for (int i = 0; i < ACROSS; i++) {
        double along = 2.0 * half_width * (i - ACROSS / 2) / (ACROSS / 2);
        p[i]         = (lab_probe){ d3_add(on, d3_scale(inward, along)), { 0, 0, 1 } };
        want[i]      = passes * sun_lx * to_sun().z * share_seen(past_edge(edge, inside, p[i].at));
    }
    assert_near(want[ACROSS / 2], 0.5 * passes * sun_lx * to_sun().z, 1e-6);
    grid_result r;
    lab_measure(&l, study_of(&l, "disk", transmittance), NULL, p, ACROSS,
                &(run_options){ .accuracy = 0.01 }, &r);
    double full = passes * sun_lx * to_sun().z;
    for (int i = 0; i < ACROSS; i++) {
        double off = fabs(r.illuminance[i] - want[i]);
        if (!(off <= fmax(1.91 * r.half_width[i], 0.01 * fmax(want[i], 0.05 * full)) + 1e-4 * full))
            fail_msg("side %d, sensor %d: %.6g lx +- %.2g, not %.6g", side, i, r.illuminance[i],
                     r.half_width[i], want[i]);
        double from_middle = abs(i - ACROSS / 2) / (0.5 * (ACROSS / 2));
        if (from_middle > 1.02) /* beyond the penumbra all or nothing is seen */
            assert_near(r.illuminance[i] / full, i > ACROSS / 2 ? 1.0 : 0.0, 5e-5);
        else if (from_middle < 0.92)
            assert_true(r.illuminance[i] > 1e-4 * full && r.illuminance[i] < 0.9999 * full);
    }
    lab_close(&l);
}

TEST(the_penumbra_is_as_wide_as_the_sun_and_half_lit_in_the_middle)
{
    for (int side = 0; side < 4; side++)
        penumbra(side, 1.0);
    penumbra(0, 0.8);
    penumbra(2, 0.8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_corners_of_the_patch_are_where_geometry_says),
        cmocka_unit_test(the_patch_is_as_bright_as_the_sun_at_that_angle),
        cmocka_unit_test(behind_a_pane_it_has_what_the_pane_passes_at_that_angle),
        cmocka_unit_test(the_penumbra_is_as_wide_as_the_sun_and_half_lit_in_the_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
