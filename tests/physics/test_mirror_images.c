/* tests/physics/test_mirror_images.c -- plane mirrors and panes show each lamp again, behind them.
 *
 * A lamp in front of a mirror of reflectance rho lights as if its image behind it shone, too, rho
 * times as bright; between two mirrors, x = 0 and x = d, each image has images:
 *
 *     x' = 2 d m + x after 2 |m| reflections,    x' = 2 d m - x after |2 m - 1|
 *
 * Two mirrors at right angles show three images, the third by way of both. A pane is a mirror whose
 * rho is the slab's reflectance at the angle of incidence (tests/slab.h). Sums of images in double.
 */
#include "tests/gltf_text.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

/* Whether mirrors and panes are asked for the images of lamps without extent. */
enum { POINTS_HAVE_IMAGES = 1 };

/* Where a point of the scene is seen again: (x_sign x + x_at, y_sign y + y_at, z). */
typedef struct image {
    double x_sign, x_at, y_sign, y_at, worth;
} image;

enum { MOST_IMAGES = 256, N = 5 };
static const double width = 4.0; /* m, of the corridor */

static const image itself = { 1, 0, 1, 0, 1 };

static int images_of_wall(double rho, image out[])
{
    out[0] = itself;
    out[1] = (image){ -1, 0, 1, 0, rho };
    return 2;
}

static int images_of_corner(double rho, image out[])
{
    out[2] = (image){ 1, 0, -1, 0, rho };
    out[3] = (image){ -1, 0, -1, 0, rho * rho };
    return images_of_wall(rho, out) + 2;
}

/* To where they add less than 1e-6 of what was added. */
static int images_of_corridor(double rho, image out[])
{
    int count = 0;
    for (int m = -31; m <= 31; m++) {
        out[count++] = (image){ 1, 2 * width * m, 1, 0, pow(rho, abs(2 * m)) };
        out[count++] = (image){ -1, 2 * width * m, 1, 0, pow(rho, abs(2 * m - 1)) };
    }
    return count;
}

static dvec3 seen_at(const image *i, dvec3 p)
{
    return (dvec3){ i->x_sign * p.x + i->x_at, i->y_sign * p.y + i->y_at, p.z };
}

static const lab_probe probes[N] = { { { 1, 1, 0.01 }, { 0, 0, 1 } },
                                     { { 2.5, 2, 1 }, { 0, 0, -1 } },
                                     { { 0.5, 3, 1.2 }, { -0.6, 0, 0.8 } },
                                     { { 2, 2, 1 }, { -1, 0, 0 } },
                                     { { 1.5, 0.5, 1.5 }, { 0, 0.6, 0.8 } } };

static void write_mirror(lab *l, const char *name, double x)
{
    quad q = { { { x, -30, -30 }, { x, 30, -30 }, { x, 30, 30 }, { x, -30, 30 } } };
    lab_quads(l, name, &q, 1, "\"name\":\"Mirror\"");
}

static void write_side(lab *l, const char *name)
{
    quad q = { { { -30, 0, -30 }, { 30, 0, -30 }, { 30, 0, 30 }, { -30, 0, 30 } } };
    lab_quads(l, name, &q, 1, "\"name\":\"Mirror\"");
}

/* ---- a lamp with extent in a corridor, above a floor ----------------------------------------- */

static const dvec3 panel[4] = { { 1, 1, 2.5 }, { 3, 1, 2.5 }, { 3, 3, 2.5 }, { 1, 3, 2.5 } };

/* Lux of the panel, 1 cd/m^2, which shines downward only. */
static double by_panel(const image *all, int count, dvec3 at, dvec3 normal)
{
    double lux = 0.0;
    for (int i = 0; i < count; i++) {
        dvec3 corner[4];
        for (int k = 0; k < 4; k++)
            corner[k] = seen_at(&all[i], panel[k]);
        lux += all[i].worth * polygon_lux(corner, 4, at, normal);
    }
    return lux;
}

/* Lux of the floor z = 0, x in 0 ... 4, y in -2 ... 6, which reflects rho of what the panel and its
 * images give it, seen straight and by its own images. A level floor does not light itself. Cells
 * of 0.1 m, seen from 1 m and more: the midpoint rule is within (0.1 / 1)^2 / 24. */
static void by_floor(const image *all, int count, double rho, double lux[N])
{
    const double cell = 0.1;
    memset(lux, 0, N * sizeof *lux);
    for (int c = 0; c < 40 * 80; c++) {
        dvec3 at    = { cell * (c % 40 + 0.5), -2.0 + cell * (c / 40 + 0.5), 0.0 };
        double glow = rho / M_PI * by_panel(all, count, at, (dvec3){ 0, 0, 1 });
        for (int i = 0; i < count; i++)
            for (int k = 0; k < N; k++) {
                dvec3 to = d3_sub(seen_at(&all[i], at), probes[k].at);
                double d = d3_length(to), cosine = d3_dot(to, probes[k].normal) / d;
                lux[k] += all[i].worth * glow * cell * cell * fmax(cosine, 0.0) *
                          fmax(-to.z / d, 0.0) / (d * d);
            }
    }
}

static void corridor_with_floor(double rho_floor)
{
    const double rho = 0.8;
    lab l;
    lab_open(&l);
    image all[MOST_IMAGES];
    int count = images_of_corridor(rho, all);
    double want[N];
    by_floor(all, count, rho_floor, want);
    for (int i = 0; i < N; i++)
        want[i] = 1000.0 * (want[i] + by_panel(all, count, probes[i].at, probes[i].normal));
    write_mirror(&l, "one.gltf", 0.0);
    write_mirror(&l, "other.gltf", width);
    quad floor = { { { 0, -2, 0 }, { 4, -2, 0 }, { 4, 6, 0 }, { 0, 6, 0 } } };
    lab_quads(&l, "floor.gltf", &floor, 1, "\"name\":\"Floor\"");
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "scene: [one.gltf, other.gltf, floor.gltf]\n"
                        "materials: [{match: Mirror, mirror: 0.8}, {match: Floor, reflectance: "
                        "%g}]\nlights: [{type: rect, at: [2, 2, 2.5], aim: [0, 0, -1], size: [2, "
                        "2], luminance: 1000}]",
                        rho_floor),
                NULL, probes, N, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("corridor", &r, want, 1e-3, 0.02);
    lab_close(&l);
}

TEST(a_mirrored_corridor_with_a_black_floor_shows_rows_of_panels) { corridor_with_floor(0.0); }
TEST(a_mirrored_corridor_with_a_matt_floor_shows_rows_of_floors) { corridor_with_floor(0.6); }

/* ---- lamps without extent -------------------------------------------------------------------- */

static double by_point(const image *all, int count, dvec3 lamp, const lab_probe *p)
{
    double lux = 0.0;
    for (int i = 0; i < count; i++) {
        dvec3 to = d3_sub(seen_at(&all[i], lamp), p->at);
        double d = d3_length(to);
        lux += all[i].worth * 500.0 * fmax(d3_dot(to, p->normal), 0.0) / (d * d * d);
    }
    return lux;
}

/* Images are found exactly, or sampled: as accurate as asked for. */
static void point_before(const char *what, const char *scene_files, const image *all, int count)
{
    const dvec3 lamp = { 1.2, 2.1, 2.5 };
    lab l;
    lab_open(&l);
    double want[N], mirrored = 0.0;
    for (int i = 0; i < N; i++)
        want[i] = by_point(all, count, lamp, &probes[i]);
    write_mirror(&l, "one.gltf", 0.0);
    write_mirror(&l, "other.gltf", width);
    write_side(&l, "side.gltf");
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "scene: [%s]\nmaterials: [{match: Mirror, mirror: 0.8}]\n"
                        "lights: [{type: point, at: [1.2, 2.1, 2.5], intensity: 500}]",
                        scene_files),
                NULL, probes, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check(what, &r, want, 1e-5, 0.01);
    for (int i = 0; i < N; i++) {
        double straight = by_point(&itself, 1, lamp, &probes[i]);
        assert_near(r.direct[i], straight, 1e-5);
        mirrored += (want[i] - straight) / N;
    }
    assert_near(r.classes[CLASS_MIRRORED].average, mirrored, 0.01);
    lab_close(&l);
}

TEST(a_mirror_shows_a_point_lamp_again)
{
    image all[MOST_IMAGES];
    if (!POINTS_HAVE_IMAGES)
        skip();
    point_before("wall", "one.gltf", all, images_of_wall(0.8, all));
}

TEST(a_corner_of_mirrors_shows_a_point_lamp_three_times_more)
{
    image all[MOST_IMAGES];
    if (!POINTS_HAVE_IMAGES)
        skip();
    point_before("corner", "one.gltf, side.gltf", all, images_of_corner(0.8, all));
}

TEST(a_mirrored_corridor_shows_rows_of_point_lamps)
{
    image all[MOST_IMAGES];
    if (!POINTS_HAVE_IMAGES)
        skip();
    point_before("corridor", "one.gltf, other.gltf", all, images_of_corridor(0.8, all));
}

/* ---- panes ----------------------------------------------------------------------------------- */

static const double pane_index = 1.53, pane_inner = 0.964;

static char *pane_study(lab *l, const char *lights)
{
    return text_of(
        &l->a, "scene: one.gltf\nmaterials: [{match: Mirror, transmittance: %.9g, ior: %g}]\n%s",
        slab_of(pane_index, pane_inner, 1.0).passed, pane_index, lights);
}

/* Before the pane x = 0 the lamp and what is reflected, behind it what is passed. */
TEST(a_pane_shows_a_point_lamp_again_by_angle)
{
    if (!POINTS_HAVE_IMAGES)
        skip();
    const lab_probe p[] = { { { 0.3, 1, 0 }, { 0, 0, 1 } },
                            { { 2, -2, 0.5 }, { -1, 0, 0 } },
                            { { 0.2, 6, 2.5 }, { -0.6, -0.8, 0 } },
                            { { -1, 0, 0.5 }, { 1, 0, 0 } } };
    const dvec3 lamp    = { 1.2, 2.1, 2.5 };
    lab l;
    lab_open(&l);
    double want[4];
    write_mirror(&l, "one.gltf", 0.0);
    for (int i = 0; i < 4; i++) {
        bool before = p[i].at.x > 0.0;
        image again = { -1, 0, 1, 0, 1 };
        dvec3 to    = d3_sub(before ? seen_at(&again, lamp) : lamp, p[i].at);
        slab s      = slab_of(pane_index, pane_inner, fabs(to.x) / d3_length(to));
        want[i]     = before ? by_point(&itself, 1, lamp, &p[i]) +
                               s.reflected * by_point(&again, 1, lamp, &p[i])
                             : s.passed * by_point(&itself, 1, lamp, &p[i]);
    }
    grid_result r;
    lab_measure(&l, pane_study(&l, "lights: [{type: point, at: [1.2, 2.1, 2.5], intensity: 500}]"),
                NULL, p, 4, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("pane", &r, want, 2e-5, 0.01);
    lab_close(&l);
}

/* Parallel light from +x, so many degrees above the horizon, onto the pane x = 0: it comes back
 * from -x, as high. */
static void pane_in_the_sun(double deg, const char *lights, double exact)
{
    const lab_probe p[] = { { { 1, 0, 0 }, { 0, 0, 1 } },
                            { { 1.5, 1, 0 }, { -1, 0, 0 } },
                            { { 0.5, 2, 0.5 }, { -0.6, 0.8, 0 } },
                            { { -1, 0, 0 }, { 1, 0, 0 } } };
    double c = cos(deg * M_PI / 180.0), up = sin(deg * M_PI / 180.0);
    slab s              = slab_of(pane_index, pane_inner, c);
    const double want[] = { 10000.0 * up * (1.0 + s.reflected), 10000.0 * c * s.reflected,
                            10000.0 * 0.6 * c * s.reflected, 10000.0 * c * s.passed };
    lab l;
    lab_open(&l);
    write_mirror(&l, "one.gltf", 0.0);
    grid_result r;
    lab_measure(&l, pane_study(&l, lights), NULL, p, 4, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check(lights, &r, want, exact, 0.01);
    lab_close(&l);
}

TEST(a_pane_reflects_parallel_light_by_angle)
{
    if (!POINTS_HAVE_IMAGES)
        skip();
    pane_in_the_sun(30.0,
                    "lights: [{type: parallel, aim: [-0.8660254, 0, -0.5], "
                    "illuminance: 10000}]",
                    1e-5);
    pane_in_the_sun(75.0,
                    "lights: [{type: parallel, aim: [-0.2588190, 0, -0.9659258], "
                    "illuminance: 10000}]",
                    1e-5);
}

/* Its disk is 0.27 degrees in radius: at 60 degrees its mean reflectance is within 1e-4 of that in
 * its middle. */
TEST(a_pane_reflects_the_sun_by_angle)
{
    if (!POINTS_HAVE_IMAGES)
        skip();
    pane_in_the_sun(60.0,
                    "sky: {model: uniform, sun: disk, horizontal: 0, sun_illuminance: 10000, "
                    "ground: 0, sun_at: {azimuth: 90, elevation: 60}}",
                    1e-3);
    pane_in_the_sun(60.0,
                    "sky: {model: uniform, sun: point, horizontal: 0, sun_illuminance: 10000, "
                    "ground: 0, sun_at: {azimuth: 90, elevation: 60}}",
                    1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirrored_corridor_with_a_black_floor_shows_rows_of_panels),
        cmocka_unit_test(a_mirrored_corridor_with_a_matt_floor_shows_rows_of_floors),
        cmocka_unit_test(a_mirror_shows_a_point_lamp_again),
        cmocka_unit_test(a_corner_of_mirrors_shows_a_point_lamp_three_times_more),
        cmocka_unit_test(a_mirrored_corridor_shows_rows_of_point_lamps),
        cmocka_unit_test(a_pane_shows_a_point_lamp_again_by_angle),
        cmocka_unit_test(a_pane_reflects_parallel_light_by_angle),
        cmocka_unit_test(a_pane_reflects_the_sun_by_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
