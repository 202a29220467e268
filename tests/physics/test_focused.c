/* tests/physics/test_focused.c -- what balls of glass and round mirrors focus, and where.
 *
 * Around an axis of symmetry light that comes to a disk of radius r, W(r), is all that is needed:
 * of a square of side 2 a around the same axis a circle of radius r lies within it in part, 1 - 8 /
 * (2 pi) acos(a / r) if a < r < sqrt(2) a, so that the square has the sum of dW times that.
 */
#include "core/color.h"
#include "sim/illumination_map.h"
#include "tests/folder.h"
#include "tests/glass_sphere.h"
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/test.h"
#include "tests/transports.h"

static const char glass[] =
    "\"name\":\"Ball\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
    "\"KHR_materials_ior\":{\"ior\":1.5},\"KHR_materials_volume\":{\"thicknessFactor\":1}}";

typedef double disk_watts(const void *context, double radius);

static double in_square(disk_watts *w, const void *context, double side)
{
    enum { RINGS = 50 };
    double a = 0.5 * side, sum = w(context, a), before = sum;
    for (int i = 1; i <= RINGS; i++) {
        double r   = a * (1.0 + (sqrt(2.0) - 1.0) * i / RINGS);
        double mid = a * (1.0 + (sqrt(2.0) - 1.0) * (i - 0.5) / RINGS), now = w(context, r);
        sum += (now - before) * (1.0 - 4.0 / M_PI * acos(a / mid));
        before = now;
    }
    return sum;
}

/* Lux times m^2 of focused light in squares, as a map of it has them; on average of all sets. */
static void lumens_in_squares(lab *l, const scene *s, const lab_probe *p, int count, double side,
                              study_quantity quantity, double *lm)
{
    enum { MOST = 4 };
    vec3 at[MOST], normal[MOST];
    lux_error err = { 0 };
    for (int i = 0; i < count; i++) {
        at[i]     = scene_place(s, p[i].at);
        normal[i] = d3_to_float(p[i].normal);
    }
    map_sensors squares       = { count, at, normal, (float)side, quantity };
    map_options o             = { .light     = MAP_FOCUSED,
                                  .seed      = 1,
                                  .threads   = 2,
                                  .particles = 1 << 18,
                                  .accuracy  = 0.01,
                                  .deadline  = HUGE_VAL,
                                  .sensors   = &squares };
    const illumination_map *m = illumination_map_new(&l->a, s, &o, &err);
    if (!m)
        fail_msg("%s", err.text);
    for (int i = 0; i < count; i++) {
        lm[i] = 0.0;
        for (int set = 0; set < SCRAMBLES; set++) {
            vec3 coarse, fine = illumination_map_at_sensor(m, i, set, -1, &coarse);
            lm[i] += side * side * LUMENS_PER_WATT * (double)rgb_luminance(fine) / SCRAMBLES;
        }
    }
}

/* ---- a ball of glass in a beam --------------------------------------------------------------- */

/* Of radius 0.5 m, centre 2 m above a floor, under a beam of 1000 lx as wide as that: what passes
 * is known (glass_sphere.h). */
#define BEAM                                                                                       \
    "scene: [ball.gltf, floor.gltf]\n"                                                             \
    "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000, at: [0, 0, 4], radius: 0.5}]\n"
static const double radius = 0.5;

static double ball_on_disk(const void *distance, double r)
{
    enum { ORDERS = 5 }; /* light that turns within goes down, too: that of order 2, 0.3 % */
    const double *d = distance;
    double share    = 0.0;
    for (int k = 0; k < ORDERS; k++)
        share += glass_sphere_on_disk(1.5, 1.0, k, *d / radius, r / radius);
    return 1000.0 * M_PI * radius * radius * share;
}

static void write_beam(lab *l)
{
    quad floor = { { { -8, -8, 0 }, { 8, -8, 0 }, { 8, 8, 0 }, { -8, 8, 0 } } };
    lab_quads(l, "floor.gltf", &floor, 1, "\"name\":\"Floor\"");
    lab_sphere(l, "ball.gltf", (dvec3){ 0, 0, 2 }, radius, 180, glass);
}

/* 0.8 %: within solids light is taken as unpolarised at each border, which makes 0.3 % here, at 1
 * and at half a degree a piece; the rest are three sigmas. Squares are before and behind the focus,
 * 0.75 m below the centre, and just above the floor. */
TEST(a_ball_of_glass_focuses_a_beam_onto_squares_below)
{
    lab l;
    lab_open(&l);
    write_beam(&l);
    const scene *s      = lab_scene(&l, "lux4: 1\n" BEAM);
    const lab_probe p[] = { { { 0, 0, 1.3 }, { 0, 0, 1 } },
                            { { 0, 0, 0.6 }, { 0, 0, 1 } },
                            { { 0, 0, 0.01 }, { 0, 0, 1 } } };
    double lm[3];
    lumens_in_squares(&l, s, p, 3, 0.6, QUANTITY_PLANAR, lm);
    for (int i = 0; i < 3; i++) {
        double d = 2.0 - p[i].at.z;
        assert_near(lm[i], in_square(ball_on_disk, &d, 0.6), 0.008);
    }
    lab_close(&l);
}

/* lx: of sensors below the ball, each as a ring as wide as its square. */
static double mean_below(const grid_result *r, double distance)
{
    const double half = 0.0125;
    double sum        = 0.0;
    for (int k = 0; k < r->sensor_count; k++) {
        double away = hypot(r->sensors[k].at.x, r->sensors[k].at.y);
        double lm   = ball_on_disk(&distance, away + half) - ball_on_disk(&distance, away - half);
        sum += lm / (4.0 * M_PI * away * half);
    }
    return sum / r->sensor_count;
}

/* In the ball's shadow there is focused light alone, of its class, and with its interval. So rough
 * results go by squares that are wider than what facets of glass send through them: 1 % of its
 * sum. */
TEST(a_grid_below_a_ball_of_glass_tells_focused_light)
{
    lab l;
    lab_open(&l);
    write_beam(&l);
    const scene *s =
        lab_scene(&l, "lux4: 1\n" BEAM "materials: [{match: Floor, reflectance: 0}]\n"
                      "grids: [{name: g, origin: [-0.3, -0.3, 0.3], u: [0.6, 0, 0], v: [0, 0.6, "
                      "0], spacing: 0.1}]\n");
    double d = 1.7, want = in_square(ball_on_disk, &d, 0.6) / 0.36;
    for (int t = 0; t < TRANSPORTS; t++) {
        grid_result r;
        grid_of_scene(&l.a, s, 0,
                      &(run_options){ .accuracy = 0.3, .seed = 1, .transport = transports[t] }, &r);
        for (int k = 0; k < r.sensor_count; k++)
            assert_true(r.direct[k] == 0.0);
        assert_near(r.classes[CLASS_FOCUSED].average, r.average, 1e-5);
        double half = r.classes[CLASS_FOCUSED].half_width;
        assert_true(half > 0.0 && half < 0.1 * want);
        assert_true(fabs(r.average - mean_below(&r, d)) <= 2.0 * half + 0.01 * want);
        assert_null(r.left_to_chance);
    }
    lab_close(&l);
}

/* ---- cylinders ------------------------------------------------------------------------------- */

/* Through a block of glass light at 45 degrees goes on as it came: on a cylinder it is sin e / pi
 * of what it is on a plane square to it, as cos e is on level ground, on a semicylinder that faces
 * it twice that, on one that turns its back nothing. */
TEST(cylinders_in_focused_light_have_what_its_direction_says)
{
    static const struct {
        study_quantity quantity;
        dvec3 normal;
        double share;
    } probe[] = { { QUANTITY_PLANAR, { 0, 0, 1 }, 1.0 },
                  { QUANTITY_VERTICAL, { -1, 0, 0 }, 1.0 },
                  { QUANTITY_CYLINDRICAL, { 0, 0, 1 }, 1.0 / M_PI },
                  { QUANTITY_SEMICYLINDRICAL, { -1, 0, 0 }, 2.0 / M_PI },
                  { QUANTITY_SEMICYLINDRICAL, { 1, 0, 0 }, 0.0 } };
    lab l;
    lab_open(&l);
    quad block[6], floor = { { { -8, -8, 0 }, { 8, -8, 0 }, { 8, 8, 0 }, { -8, 8, 0 } } };
    quads_of_box((dvec3){ -3, -2, 1 }, (dvec3){ 1, 2, 2 }, block);
    lab_quads(&l, "block.gltf", block, 6, glass);
    lab_quads(&l, "floor.gltf", &floor, 1, "\"name\":\"Floor\"");
    const scene *s = lab_scene(
        &l, "lux4: 1\nscene: [block.gltf, floor.gltf]\n"
            "lights: [{type: parallel, aim: [1, 0, -1], illuminance: 1000, at: [-2, 0, 3], "
            "radius: 1}]\n");
    double level = 0.0;
    for (size_t i = 0; i < sizeof probe / sizeof *probe; i++) {
        const lab_probe p = { { 0.4, 0, 0.6 }, probe[i].normal };
        double lm;
        lumens_in_squares(&l, s, &p, 1, 0.4, probe[i].quantity, &lm);
        level = i == 0 ? lm : level;
        assert_true(level > 500.0 * 0.16 && level < 707.2 * 0.16);
        assert_true(fabs(lm - probe[i].share * level) <= 0.02 * level);
    }
    lab_close(&l);
}

/* ---- round mirrors before a lamp ------------------------------------------------------------- */

/* A point of 100 cd on the axis at z = lamp (m, of the sphere's centre), a mirror that is the
 * sphere z > cos(cap) for the lamp above it (a ball), or its inside below the lamp: light that is
 * reflected once comes to the plane z = at. */
typedef struct round_mirror {
    double lamp, at; /* m */
    double from, to; /* rad, of the sphere, from the z axis: the cap */
} round_mirror;

/* By the midpoint rule over the angle v of the place on the sphere of radius 1, seen from the lamp
 * at the angle w: lm of a ring 2 pi I d(cos w), as far as it is seen. */
static double mirror_on_disk(const void *context, double r)
{
    enum { STEPS = 20000 };
    const round_mirror *m = context;
    double sum            = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double v0 = m->from + (m->to - m->from) * i / STEPS;
        double v1 = m->from + (m->to - m->from) * (i + 1) / STEPS, v = 0.5 * (v0 + v1);
        double x = sin(v), z = cos(v), dx = x, dz = z - m->lamp, d = hypot(dx, dz);
        double n = dx / d * x + dz / d * z; /* along the normal (x, z) */
        if (m->lamp > 1.0 && n >= 0.0)
            continue; /* the far side of a ball */
        double bx = dx / d - 2.0 * n * x, bz = dz / d - 2.0 * n * z;
        double to = (m->at - z) / bz;
        if (!(to > 0.0) || fabs(x + to * bx) > r)
            continue;
        double c0 = (cos(v0) - m->lamp) / hypot(sin(v0), cos(v0) - m->lamp);
        double c1 = (cos(v1) - m->lamp) / hypot(sin(v1), cos(v1) - m->lamp);
        sum += 2.0 * M_PI * 100.0 * fabs(c1 - c0);
    }
    return sum;
}

/* Rings of a sphere of radius 1 about the origin. */
static void write_cap(lab *l, double from, double to)
{
    enum { ROUND = 480, RINGS = 240 }; /* of half as many, 1.1 % too much comes to the square */
    quad *q = arena_array(&l->a, quad, ROUND * RINGS, NULL);
    assert_non_null(q);
    for (int i = 0; i < ROUND * RINGS; i++) {
        static const int dv[4] = { 0, 1, 1, 0 }, dt[4] = { 0, 0, 1, 1 };
        for (int c = 0; c < 4; c++) {
            double v       = from + (to - from) * (i / ROUND + dv[c]) / RINGS;
            double t       = 2.0 * M_PI * ((i % ROUND + dt[c]) % ROUND) / ROUND;
            q[i].corner[c] = (dvec3){ sin(v) * cos(t), sin(v) * sin(t), cos(v) };
        }
    }
    lab_quads(l, "cap.gltf", q, ROUND * RINGS, "\"name\":\"Cap\"");
}

static void by_round_mirror(const round_mirror *m, double side)
{
    lab l;
    lab_open(&l);
    write_cap(&l, m->from, m->to);
    const scene *s =
        lab_scene(&l, text_of(&l.a,
                              "lux4: 1\nscene: cap.gltf\nmaterials: [{match: Cap, mirror: 0.8}]\n"
                              "lights: [{type: point, at: [0, 0, %g], intensity: 100}]\n",
                              m->lamp));
    assert_null(s->mirror_images);
    const lab_probe p = { { 0, 0, m->at }, { 0, 0, -1 } };
    double lm;
    lumens_in_squares(&l, s, &p, 1, side, QUANTITY_PLANAR, &lm);
    assert_near(lm, 0.8 * in_square(mirror_on_disk, m, side), 0.005);
    lab_close(&l);
}

TEST(a_convex_mirror_spreads_a_lamp)
{
    by_round_mirror(&(round_mirror){ .lamp = 2.0, .at = 4.0, .from = 1e-3, .to = 1.2 }, 2.0);
}

/* The lamp is between the focus and the centre of curvature, its image above that. */
TEST(a_concave_mirror_gathers_a_lamp)
{
    by_round_mirror(
        &(round_mirror){ .lamp = -0.4, .at = 0.8, .from = M_PI - 0.7, .to = M_PI - 1e-3 }, 0.5);
}

/* ---- aimed by way of others ------------------------------------------------------------------ */

static double behind_block(lab *l, const char *lamp, bool mirror)
{
    quad block[6], wall = { { { 2, -3, 0 }, { 2, -3, 4 }, { 2, 3, 4 }, { 2, 3, 0 } } };
    quads_of_box((dvec3){ -0.5, -0.4, 0.5 }, (dvec3){ 0.5, 0.4, 1 }, block);
    lab_quads(l, "block.gltf", block, 6, glass);
    lab_quads(l, "wall.gltf", &wall, 1, "\"name\":\"Wall\"");
    const scene *s = lab_scene(
        l, text_of(&l->a,
                   "lux4: 1\nscene: [block.gltf%s\n"
                   "lights: [{type: cone, %s, intensity: 1000, inner: 20, outer: 25}]\n",
                   mirror ? ", wall.gltf]\nmaterials: [{match: Wall, mirror: 0.8}]" : "]", lamp));
    const lab_probe p = { { -1, 0, 0.2 }, { 0, 0, 1 } };
    double lm;
    lumens_in_squares(l, s, &p, 1, 2.0, QUANTITY_PLANAR, &lm);
    return lm;
}

/* Particles turn at the mirror first. 1 %: three sigmas. */
TEST(a_lamp_is_focused_from_its_mirror_image)
{
    lab l;
    lab_open(&l);
    double plain = behind_block(&l, "at: [4, 0, 3], aim: [-4, 0, -2.2]", false);
    assert_true(plain > 10.0);
    assert_near(behind_block(&l, "at: [0, 0, 3], aim: [4, 0, -2.2]", true), 0.8 * plain, 0.01);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_of_glass_focuses_a_beam_onto_squares_below),
        cmocka_unit_test(a_grid_below_a_ball_of_glass_tells_focused_light),
        cmocka_unit_test(cylinders_in_focused_light_have_what_its_direction_says),
        cmocka_unit_test(a_convex_mirror_spreads_a_lamp),
        cmocka_unit_test(a_concave_mirror_gathers_a_lamp),
        cmocka_unit_test(a_lamp_is_focused_from_its_mirror_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
