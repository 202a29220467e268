/* tests/physics/test_area_lights.c -- lights with extent through the whole program, against closed
 * forms: where nothing can stand between, and among things; half hidden behind an edge.
 *
 * Closed forms are exact to float: 5e-5. Sampled values must lie within their interval.
 */
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const dvec3 up = { 0, 0, 1 };

/* Accuracy asked for where light is sampled */
static const double asked = 0.01;

static double sq(double x) { return x * x; }

static dvec3 unit(double x, double y, double z)
{
    dvec3 v = { x, y, z };
    return d3_scale(v, 1.0 / d3_length(v));
}

/* The same light alone, and among things; the values wanted of both. */
static void check_both(const char *what, const char *lamp, const lab_probe *p, int count,
                       const double *want, double exact)
{
    char text[1024];
    for (int shaded = 0; shaded < 2; shaded++) {
        lab l;
        lab_open(&l);
        lab_speck(&l, "speck.gltf");
        snprintf(text, sizeof text, "%slights: [%s]", shaded ? "scene: speck.gltf\n" : "", lamp);
        grid_result r;
        lab_measure(&l, text, NULL, p, count, &(run_options){ .accuracy = asked }, &r);
        lab_check(what, &r, want, exact, asked);
        bool sampled = false;
        for (int k = 0; k < count; k++)
            sampled |= r.half_width[k] > 0.0;
        assert_true(sampled == (shaded == 1));
        lab_close(&l);
    }
}

/* I cos gamma in rings of 0.5 deg, with an opening of this size (width, length, height). */
static void write_matt_web(lab *l, const char *name, const char *size, double intensity)
{
    enum { RINGS = 361 };
    char angles[RINGS * 8], candelas[RINGS * 14];
    size_t a = 0, c = 0;
    for (int i = 0; i < RINGS; i++) {
        double cosine = i < 180 ? cos(i * M_PI / 360.0) : 0.0;
        char end      = i % 10 == 9 ? '\n' : ' ';
        a += (size_t)snprintf(angles + a, sizeof angles - a, "%g%c", 0.5 * i, end);
        c += (size_t)snprintf(candelas + c, sizeof candelas - c, "%.7g%c", intensity * cosine, end);
    }
    lab_write(l, name, "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 %d 1 1 2 %s\n1 1 0\n%s\n0\n%s\n", RINGS,
              size, angles, candelas);
}

/* ---- a rectangle ----------------------------------------------------------------------------- */

/* E of 1 cd/m^2 at a corner's foot: parallel, a x b at c; and at right angles, a wide, b high. */
static double corner_parallel(double a, double b, double c)
{
    double x = hypot(a, c), y = hypot(b, c);
    return 0.5 * (a / x * atan(b / x) + b / y * atan(a / y));
}

static double corner_perpendicular(double a, double b, double c)
{
    double y = hypot(b, c);
    return 0.5 * (atan(a / c) - c / y * atan(a / y));
}

TEST(a_rectangle_gives_what_lambert_says)
{
    static const dvec3 corner[4] = {
        { -0.5, -0.4, 1.5 }, { 0.5, -0.4, 1.5 }, { 0.5, 0.4, 1.5 }, { -0.5, 0.4, 1.5 }
    };
    const lab_probe p[] = {
        { { 0.5, 0.4, 0 }, up },
        { { 0.5, 0.4, 0 }, { 0, -1, 0 } },
        { { 0, 0, 0 }, up },
        { { 0, 0, 0 }, unit(1, 1, 1) },
        { { 0, 0, 1 }, unit(3, 0, 1) }, /* part of it behind the sensor */
        { { 2, 1, 1.4 }, unit(-2, -1, 0) },
        { { 0.2, 0.1, 1.4 }, unit(1, 2, 0.5) },
        { { 3, -2, -4 }, unit(-1, 1, 3) },
    };
    enum { N = sizeof p / sizeof *p };
    double want[N];
    for (int i = 0; i < N; i++)
        want[i] = 2000.0 * polygon_lux(corner, 4, p[i].at, p[i].normal);

    /* The polygon's formula against those for rectangles */
    assert_near(want[0], 2000.0 * corner_parallel(1.0, 0.8, 1.5), 1e-9);
    assert_near(want[0], 2000.0 * M_PI * 0.0766960, 1e-6);
    check_both("rect", "{type: rect, at: [0, 0, 1.5], size: [1, 0.8], luminance: 2000}", p, N, want,
               5e-5);
}

/* On the wall beside it: the bottom edge lies in the receiver's plane. */
TEST(a_rectangle_at_right_angles_gives_its_closed_form)
{
    const lab_probe p   = { { 0.5, 0, 0 }, { 0, 0, 1 } };
    const double want[] = { 2000.0 * corner_perpendicular(1.0, 0.8, 1.5) };
    assert_near(want[0], 2000.0 * M_PI * 0.0189131, 1e-5);
    check_both("rect at right angles",
               "{type: rect, at: [0, 1.5, 0.4], aim: [0, -1, 0], up: [0, 0, 1], size: [1, 0.8], "
               "luminance: 2000}",
               &p, 1, want, 5e-5);
}

/* ---- a disk ---------------------------------------------------------------------------------- */

/* The light vector of a disk of 1 cd/m^2 and radius a, at height h and offset d: its part toward
 * the disk's plane, and that toward its axis. */
static double disk_up(double a, double h, double d)
{
    double s = sqrt(sq(h * h + d * d + a * a) - 4.0 * sq(a * d));
    return 0.5 * M_PI * (1.0 - (h * h + d * d - a * a) / s);
}

static double disk_across(double a, double h, double d)
{
    double s = sqrt(sq(h * h + d * d + a * a) - 4.0 * sq(a * d));
    return d > 0.0 ? 0.5 * M_PI * h / d * ((h * h + d * d + a * a) / s - 1.0) : 0.0;
}

TEST(a_disk_gives_its_closed_form)
{
    static const double place[][4] = {
        /* height, offset, normal up and toward the axis */
        { 2, 0, 1, 0 },     { 2, 0.5, 1, 0 },   { 2, 1, 1, 0 },       { 2, 2, 1, 0 },
        { 2, 3, 1, 0 },     { 2, 1, 0, 1 },     { 2, 2, 0, 1 },       { 2, 3, 0, 1 },
        { 2, 2, 0.8, 0.6 }, { 3, 4, 0.6, 0.8 }, { 2, 0, 0.96, 0.28 }, { 0.1, 0.3, 1, 0 },
    };
    enum { N = sizeof place / sizeof *place };
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        const double *k = place[i];
        p[i]            = (lab_probe){ { k[1], 0, -k[0] }, { -k[3], 0, k[2] } };
        want[i] = 1000.0 * (k[2] * disk_up(1, k[0], k[1]) + k[3] * disk_across(1, k[0], k[1]));
    }
    assert_near(want[0], 628.319, 1e-5);
    assert_near(want[4], 80.6081, 1e-5);
    assert_near(want[6], 182.703, 1e-5);
    check_both("disk", "{type: disk, at: [0, 0, 0], radius: 1, luminance: 1000}", p, N, want, 5e-5);
}

/* ---- a line ---------------------------------------------------------------------------------- */

/* Per candela of the whole line, under one end, on a plane parallel to it; and, of the unit vector
 * along the line, the part of the light vector that way. */
TEST(a_line_gives_its_closed_form)
{
    const double length = 1.2, h = 2.0, alpha = atan(length / h), i0 = 1000.0 / length;
    const double upward = i0 / (2.0 * h) * (alpha + sin(alpha) * cos(alpha));
    const double along  = i0 / (2.0 * h) * sq(sin(alpha)); /* integral of sin a cos a */
    const lab_probe p[] = {
        { { 0, 0, 0 }, up },
        { { 0, 0, 0 }, { 1, 0, 0 } },
        { { 0, 0, 0 }, { 0.6, 0, 0.8 } },
        { { 1.2, 0, 0 }, unit(0, 1, 1) },
    };
    const double want[] = { upward, along, 0.6 * along + 0.8 * upward, upward * sqrt(0.5) };
    assert_near(upward / i0, 0.245399, 1e-5);
    check_both("line", "{type: linear, from: [0, 0, 2], to: [1.2, 0, 2], intensity: 1000}", p, 4,
               want, 5e-5);
}

/* ---- close by, and in a beam ----------------------------------------------------------------- */

/* pi L is reached, and never exceeded. Within a millimetre of the edge, half of it. */
TEST(close_to_a_light_there_is_pi_l_and_no_more)
{
    static const double height[] = { 1, 1e-3, 1e-6 };
    lab_probe p[6];
    double want_disk[6], want_rect[6];
    const dvec3 corner[4] = { { -2, -1, 0 }, { 2, -1, 0 }, { 2, 1, 0 }, { -2, 1, 0 } };
    for (int i = 0; i < 6; i++) {
        double h     = height[i % 3];
        p[i]         = (lab_probe){ { i < 3 ? 0.5 : 0.0, i < 3 ? 0.0 : -1.0, -h }, up };
        want_disk[i] = 100.0 * disk_up(1, h, i < 3 ? 0.5 : 1.0);
        want_rect[i] = 100.0 * polygon_lux(corner, 4, p[i].at, up);
    }
    assert_near(want_disk[2], 100.0 * M_PI, 1e-5);
    assert_near(want_rect[5], 50.0 * M_PI, 1e-5);
    for (int shaded = 0; shaded < 2; shaded++)
        for (int rect = 0; rect < 2; rect++) {
            char text[512];
            lab l;
            lab_open(&l);
            lab_speck(&l, "speck.gltf");
            snprintf(text, sizeof text, "%slights: [{%s, at: [0, 0, 0], luminance: 100}]",
                     shaded ? "scene: speck.gltf\n" : "",
                     rect ? "type: rect, size: [4, 2]" : "type: disk, radius: 1");
            grid_result r;
            lab_measure(&l, text, NULL, p, 6, &(run_options){ .accuracy = asked }, &r);
            lab_check(text, &r, rect ? want_rect : want_disk, 1e-4, asked);
            for (int i = 0; i < 6; i++)
                if (!(r.illuminance[i] <= 100.0 * M_PI * (1.0 + 1e-5) + 2.0 * r.half_width[i]))
                    fail_msg("%s, sensor %d: %.9g lx +- %g", text, i, r.illuminance[i],
                             r.half_width[i]);
            lab_close(&l);
        }
}

/* E cos i within the beam, from its beginning on; nothing beside, behind and in shadow. */
TEST(a_beam_lights_what_is_in_it)
{
    const dvec3 along = unit(1, 0, -1), a = { 1, 0, 2 };
    const lab_probe p[] = {
        { d3_add(a, d3_scale(along, 1.0)), up },
        { d3_add(a, d3_scale(along, 1.0)), d3_scale(along, -1.0) },
        { d3_add(d3_add(a, d3_scale(along, 1.0)), (dvec3){ 0, 0.09, 0 }), up },
        { d3_add(d3_add(a, d3_scale(along, 1.0)), (dvec3){ 0, 0.11, 0 }), up },
        { d3_add(a, d3_scale(along, -0.1)), up },
        { d3_add(a, d3_scale(along, 3.5)), up },
    };
    const double want[] = { 5000.0 * sqrt(0.5), 5000, 5000.0 * sqrt(0.5), 0, 0, 0 };
    lab l;
    lab_open(&l);
    quad screen = { { { 0, -3, 0 }, { 5, -3, 0 }, { 5, 3, 0 }, { 0, 3, 0 } } };
    lab_quads(&l, "screen.gltf", &screen, 1, "\"name\":\"Black\"");
    grid_result r;
    lab_measure(&l,
                "scene: screen.gltf\nmaterials: [{match: '*', reflectance: 0}]\n"
                "lights: [{type: parallel, at: [1, 0, 2], aim: [1, 0, -1], radius: 0.1, "
                "illuminance: 5000}]",
                NULL, p, 6, &(run_options){ 0 }, &r);
    for (int i = 0; i < 6; i++)
        assert_near(r.illuminance[i], want[i], 1e-5);
    lab_close(&l);
}

/* ---- luminaires ------------------------------------------------------------------------------ */

/* A web of I cos gamma makes a flat opening of the area A shine evenly, L = I / A: a rectangle of
 * 1.2 x 0.6 m, near, where it is no point, and far, where it may be taken as one. The web is linear
 * between rings 0.5 deg apart: 1e-5. */
TEST(a_matt_luminaire_gives_what_lambert_says)
{
    enum { N = 7 };
    static const dvec3 corner[4] = {
        { -0.6, -0.3, 0 }, { 0.6, -0.3, 0 }, { 0.6, 0.3, 0 }, { -0.6, 0.3, 0 }
    };
    const lab_probe p[N] = {
        { { 0, 0, -0.1 }, { 0, 0, 1 } },    { { 0.5, 0.2, -0.3 }, { 0, 0, 1 } },
        { { 1, 1, -1 }, { 0, 0, 1 } },      { { -0.5, 1, -0.5 }, unit(0, -1, 1) },
        { { 3, 2, -20 }, { 0, 0, 1 } },     { { 0, 0, -60 }, unit(1, 1, 2) },
        { { 0.3, 0, -2 }, unit(1, 0, 0.1) }
    };
    double want[N];
    for (int i = 0; i < N; i++)
        want[i] = 720.0 / 0.72 * polygon_lux(corner, 4, p[i].at, p[i].normal);
    for (int shaded = 0; shaded < 2; shaded++)
        for (int i = 0; i < N; i++) { /* each alone: the accuracy asked for is that of each */
            lab l;
            lab_open(&l);
            lab_speck(&l, "speck.gltf");
            write_matt_web(&l, "matt.ies", "0.6 1.2 0", 720.0);
            grid_result r;
            lab_measure(
                &l,
                shaded ? "scene: speck.gltf\nluminaires: [{photometry: matt.ies, at: [0, 0, 0]}]"
                       : "luminaires: [{photometry: matt.ies, at: [0, 0, 0]}]",
                NULL, &p[i], 1, &(run_options){ .accuracy = asked }, &r);
            lab_check("matt luminaire", &r, &want[i], 3e-5, asked);
            lab_close(&l);
        }
}

/* ---- half hidden ----------------------------------------------------------------------------- */

/* E on the horizontal at the origin, of what of the disk (1 cd/m^2, radius a, centre (cx, 0, h))
 * lies at x <= edge: strips along y, of which each is integrated exactly,
 *     integral of dy / (q^2 + y^2)^2 = y / (2 q^2 (q^2 + y^2)) + atan(y / q) / (2 q^3),
 * in x = cx - a cos t, so that the ends are smooth. */
static double disk_part(double a, double cx, double h, double edge)
{
    enum { STRIPS = 4000 };
    double end = acos(fmin(fmax((cx - edge) / a, -1.0), 1.0)), sum = 0.0;
    for (int i = 0; i < STRIPS; i++) {
        double t = end * (i + 0.5) / STRIPS, x = cx - a * cos(t), y = a * sin(t);
        double q = hypot(x, h);
        sum += sin(t) * (y / (q * q * (q * q + y * y)) + atan(y / q) / (q * q * q));
    }
    return sum * a * h * h * end / STRIPS;
}

/* A black half plane x > 0.2 at half the height of a disk at 2 m. Seen from (x, 0, 0) its edge
 * stands before the line at 0.4 - x of the disk's plane; at x = 0.2, before its middle. */
TEST(a_disk_behind_an_edge_gives_its_segment)
{
    enum { N = 9 };
    lab l;
    lab_open(&l);
    quad plane = { { { 0.2, -40, 1 }, { 60, -40, 1 }, { 60, 40, 1 }, { 0.2, 40, 1 } } };
    lab_quads(&l, "edge.gltf", &plane, 1, "\"name\":\"Black\"");
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        double x = 0.2 + 0.15 * (i - 4);
        p[i]     = (lab_probe){ { x, 0, 0 }, up };
        want[i]  = 5000.0 * disk_part(0.6, 0.2 - x, 2.0, 0.4 - 2.0 * x);
    }

    /* Where no edge is, the closed form; where it halves what is right above, half of it */
    assert_near(disk_part(0.6, 0.2, 2.0, 10.0), disk_up(0.6, 2.0, 0.2), 1e-6);
    assert_near(want[4], 5000.0 * 0.5 * disk_up(0.6, 2.0, 0.0), 1e-6);
    grid_result r;
    lab_measure(&l,
                "scene: edge.gltf\nmaterials: [{match: '*', reflectance: 0}]\n"
                "lights: [{type: disk, at: [0.2, 0, 2], radius: 0.6, luminance: 5000}]",
                NULL, p, N, &(run_options){ .accuracy = asked }, &r);
    lab_check("disk behind an edge", &r, want, 5e-5, asked);
    lab_close(&l);
}

/* What an edge leaves of a rectangle is a rectangle. */
TEST(a_rectangle_behind_an_edge_gives_what_is_left)
{
    enum { N = 8 };
    lab l;
    lab_open(&l);
    quad plane = { { { 0, -40, 1 }, { 60, -40, 1 }, { 60, 40, 1 }, { 0, 40, 1 } } };
    lab_quads(&l, "edge.gltf", &plane, 1, "\"name\":\"Black\"");
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        double x = 0.13 * (i - 3) - 0.05, edge = fmin(fmax(-x, -0.6), 0.6);
        p[i]         = (lab_probe){ { x, 0.3, 0 }, i % 2 ? up : unit(0.3, 0.5, 1) };
        dvec3 left[] = { { -0.6, -0.3, 2 }, { edge, -0.3, 2 }, { edge, 0.3, 2 }, { -0.6, 0.3, 2 } };
        want[i]      = 5000.0 * polygon_lux(left, 4, p[i].at, p[i].normal);
    }
    grid_result r;
    lab_measure(&l,
                "scene: edge.gltf\nmaterials: [{match: '*', reflectance: 0}]\n"
                "lights: [{type: rect, at: [0, 0, 2], size: [1.2, 0.6], luminance: 5000}]",
                NULL, p, N, &(run_options){ .accuracy = asked }, &r);
    lab_check("rect behind an edge", &r, want, 5e-5, asked);
    lab_close(&l);
}

/* A line, under one end, hidden from halfway on: E = i0 / 2h [a + sin a cos a], a = atan(x / h). */
TEST(a_line_behind_an_edge_gives_what_is_left)
{
    enum { N = 5 };
    lab l;
    lab_open(&l);
    quad plane = { { { 0.25, -40, 1 }, { 60, -40, 1 }, { 60, 40, 1 }, { 0.25, 40, 1 } } };
    lab_quads(&l, "edge.gltf", &plane, 1, "\"name\":\"Black\"");
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        double x = -0.1 * i, from = atan(-x / 2.0), to = atan((fmin(0.5 - x, 1.2) - x) / 2.0);
        p[i]    = (lab_probe){ { x, 0, 0 }, up };
        want[i] = 1000.0 / 4.0 * (to + sin(to) * cos(to) - from - sin(from) * cos(from));
    }
    grid_result r;
    lab_measure(&l,
                "scene: edge.gltf\nmaterials: [{match: '*', reflectance: 0}]\n"
                "lights: [{type: linear, from: [0, 0, 2], to: [1.2, 0, 2], intensity: 1200}]",
                NULL, p, N, &(run_options){ .accuracy = asked }, &r);
    lab_check("line behind an edge", &r, want, 5e-5, asked);
    lab_close(&l);
}

/* ---- a sphere -------------------------------------------------------------------------------- */

/* A luminaire of an even web of I cd and a spherical opening of radius R is of the luminance
 * I / (pi R^2): E = pi L (R / D)^2 cos i = I cos i / D^2, from outside and above the horizon. */
TEST(a_sphere_seen_from_outside_gives_its_closed_form)
{
    enum { N = 6 };
    lab_probe p[N];
    double want[N];
    const double radius = 0.5, intensity = 400.0, luminance = intensity / (M_PI * sq(radius));
    for (int i = 0; i < N; i++) {
        dvec3 from = unit(i - 2.0, 1, -1.0 - i);
        double d = 0.9 + 0.5 * i, cosine = i % 2 ? 1.0 : 0.8;
        dvec3 side = d3_cross(from, up);
        side       = d3_scale(side, sqrt(1.0 - sq(cosine)) / d3_length(side));
        p[i]       = (lab_probe){ d3_scale(from, d), d3_sub(side, d3_scale(from, cosine)) };
        want[i]    = M_PI * luminance * sq(radius / d) * cosine;
    }
    for (int shaded = 0; shaded < 2; shaded++) {
        lab l;
        lab_open(&l);
        lab_speck(&l, "speck.gltf");
        lab_write(&l, "globe.ies",
                  "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -1 -1 -1\n1 1 0\n0 90 180\n0\n"
                  "400 400 400\n");
        grid_result r;
        lab_measure(&l,
                    shaded
                        ? "scene: speck.gltf\nluminaires: [{photometry: globe.ies, at: [0, 0, 0]}]"
                        : "luminaires: [{photometry: globe.ies, at: [0, 0, 0]}]",
                    NULL, p, N, &(run_options){ .accuracy = asked }, &r);
        lab_check("sphere", &r, want, 1e-4, asked);
        lab_close(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rectangle_gives_what_lambert_says),
        cmocka_unit_test(a_rectangle_at_right_angles_gives_its_closed_form),
        cmocka_unit_test(a_disk_gives_its_closed_form),
        cmocka_unit_test(a_line_gives_its_closed_form),
        cmocka_unit_test(close_to_a_light_there_is_pi_l_and_no_more),
        cmocka_unit_test(a_beam_lights_what_is_in_it),
        cmocka_unit_test(a_matt_luminaire_gives_what_lambert_says),
        cmocka_unit_test(a_disk_behind_an_edge_gives_its_segment),
        cmocka_unit_test(a_rectangle_behind_an_edge_gives_what_is_left),
        cmocka_unit_test(a_line_behind_an_edge_gives_what_is_left),
        cmocka_unit_test(a_sphere_seen_from_outside_gives_its_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
