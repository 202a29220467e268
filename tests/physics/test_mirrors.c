/* tests/physics/test_mirrors.c -- light by way of mirrors: as much as from the images behind them.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/slab.h"
#include "tests/test.h"

enum { N = 5 };

static const dvec3 up = { 0, 0, 1 };

static void sensors(lab_probe p[N])
{
    const lab_probe all[N] = { { { 1, 1, 0 }, up },
                               { { 2.5, 2, 0 }, up },
                               { { 0.5, 3, 0.2 }, { -0.6, 0, 0.8 } },
                               { { 2, 2, 1 }, { -1, 0, 0 } },
                               { { 1.5, 0.5, 0.5 }, { 0, 0.6, 0.8 } } };
    for (int i = 0; i < N; i++)
        p[i] = all[i];
}

/* The rectangle, mirrored by the plane x = at. */
static void mirrored(const dvec3 corner[4], double at, dvec3 out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = (dvec3){ 2.0 * at - corner[i].x, corner[i].y, corner[i].z };
}

static void write_mirror(lab *l, const char *name, double x)
{
    quad q = { { { x, -30, -30 }, { x, 30, -30 }, { x, 30, 30 }, { x, -30, 30 } } };
    lab_quads(l, name, &q, 1, "\"name\":\"Mirror\"");
}

static const dvec3 panel[4] = { { 1, 1, 2.5 }, { 3, 1, 2.5 }, { 3, 3, 2.5 }, { 1, 3, 2.5 } };

/* What the panel of 1000 cd/m^2 gives by a mirror in x = 0, besides what it gives straight. */
static void by_one_mirror(const char *yaml, const char *reflectance, double share)
{
    lab l;
    lab_open(&l);
    lab_probe p[N];
    double want[N];
    dvec3 image[4];
    quad glow = { { panel[0], panel[1], panel[2], panel[3] } };
    sensors(p);
    mirrored(panel, 0.0, image);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    write_mirror(&l, "mirror.gltf", 0.0);
    for (int i = 0; i < N; i++)
        want[i] = 1000.0 * (polygon_lux(panel, 4, p[i].at, p[i].normal) +
                            share * polygon_lux(image, 4, p[i].at, p[i].normal));
    grid_result r;
    lab_measure(&l,
                text_of(&l.a, "%s\nmaterials: [{match: Mirror, mirror: %s}]\n", yaml, reflectance),
                NULL, p, N, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("mirror", &r, want, 1e-4, 0.02);
    for (int i = 0; i < N; i++)
        assert_near(r.direct[i], 1000.0 * polygon_lux(panel, 4, p[i].at, p[i].normal), 0.02);
    lab_close(&l);
}

TEST(a_mirror_doubles_what_glows) { by_one_mirror("scene: [glow.gltf, mirror.gltf]", "0.9", 0.9); }

TEST(a_coloured_mirror_colours_the_image)
{
    by_one_mirror("scene: [glow.gltf, mirror.gltf]", "[0.9, 0.5, 0.2]",
                  0.2126 * 0.9 + 0.7152 * 0.5 + 0.0722 * 0.2);
}

/* One-sided, and no part of the scene: paths meet it by way of the mirror. */
TEST(a_mirror_doubles_a_lamp_with_extent)
{
    by_one_mirror("scene: mirror.gltf\nlights: [{type: rect, at: [2, 2, 2.5], aim: [0, 0, -1], "
                  "size: [2, 2], luminance: 1000}]",
                  "0.9", 0.9);
}

/* A disk above the middle, by the closed form of a parallel disk off its axis. */
static double disk_lux(double a, double h, double d)
{
    double s = sqrt(pow(h * h + d * d + a * a, 2.0) - 4.0 * a * a * d * d);
    return 0.5 * M_PI * (1.0 - (h * h + d * d - a * a) / s);
}

TEST(a_mirror_doubles_a_disk)
{
    lab l;
    lab_open(&l);
    write_mirror(&l, "mirror.gltf", 0.0);
    const lab_probe p[] = { { { 1, 2, 0 }, up }, { { 0.1, 1, 0 }, up } };
    double want[2];
    for (int i = 0; i < 2; i++) {
        double y = p[i].at.y - 2.0;
        want[i]  = 1000.0 * (disk_lux(0.8, 2, hypot(p[i].at.x - 1.5, y)) +
                            0.8 * disk_lux(0.8, 2, hypot(p[i].at.x + 1.5, y)));
    }
    grid_result r;
    lab_measure(&l,
                "scene: mirror.gltf\nmaterials: [{match: Mirror, mirror: 0.8}]\n"
                "lights: [{type: disk, at: [1.5, 2, 2], radius: 0.8, luminance: 1000}]",
                NULL, p, 2, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("disk", &r, want, 1e-4, 0.02);
    lab_close(&l);
}

/* Mirrors in x = 0 and x = 4: image k lies behind k of them. */
TEST(a_corridor_of_two_mirrors_is_a_row_of_images)
{
    enum { IMAGES = 60 };
    const double rho = 0.8;
    lab l;
    lab_open(&l);
    lab_probe p[N];
    double want[N] = { 0 };
    quad glow      = { { panel[0], panel[1], panel[2], panel[3] } };
    sensors(p);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    write_mirror(&l, "one.gltf", 0.0);
    write_mirror(&l, "other.gltf", 4.0);
    for (int side = 0; side < 2; side++) {
        dvec3 image[4], next[4];
        for (int i = 0; i < 4; i++)
            image[i] = panel[i];
        for (int k = side; k < IMAGES; k++) { /* the panel itself once */
            if (k > 0) {
                bool first = (k + side) % 2;
                mirrored(image, first ? 0.0 : 4.0, next);
                for (int i = 0; i < 4; i++)
                    image[i] = next[i];
            }
            for (int i = 0; i < N; i++)
                want[i] += 1000.0 * pow(rho, k) * polygon_lux(image, 4, p[i].at, p[i].normal);
        }
    }
    grid_result r;
    lab_measure(&l,
                "scene: [glow.gltf, one.gltf, other.gltf]\n"
                "materials: [{match: Mirror, mirror: 0.8}]\n",
                NULL, p, N, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("corridor", &r, want, 1e-4, 0.02);
    lab_close(&l);
}

/* A glowing quad, the eye and a mirror: what is seen is 0.9 L where the image is, to the left. */
TEST(a_view_into_a_mirror_shows_the_image_the_right_way_round)
{
    lab l;
    lab_open(&l);
    /* The eye looks along -x into the mirror; the quad stands at y in 1 ... 2, facing the mirror */
    quad glow = { { { 4, 1, 0 }, { 4, 2, 0 }, { 4, 2, 1 }, { 4, 1, 1 } } };
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    write_mirror(&l, "mirror.gltf", 0.0);
    const scene *s = lab_scene(
        &l, "lux4: 1\nscene: [glow.gltf, mirror.gltf]\nmaterials: [{match: Mirror, mirror: 0.9}]\n"
            "views: [{name: v, projection: orthographic, eye: [2, 0, 0], target: [0, 0, 0], "
            "width: 4, size: [8, 8]}]\n");
    run_options o = { .accuracy = 0.05, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    view_result r;
    assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, NULL));
    for (int i = 0; i < 64; i++) {
        /* Looking along -x, the right is +y; the orthographic image is its own size */
        double y = -2.0 + 0.5 * (i % 8 + 0.5), z = 2.0 - 0.5 * (i / 8 + 0.5);
        double want = y > 1.0 && y < 2.0 && z > 0.0 && z < 1.0 ? 900.0 : 0.0;
        assert_near(LUMENS_PER_WATT * (double)r.radiance[1][i], want, 0.1); /* twice as asked */
    }
    lab_close(&l);
}

/* Its image is asked for. */
TEST(a_mirror_doubles_a_point)
{
    lab l;
    lab_open(&l);
    lab_probe p[N];
    double want[N] = { 0 };
    sensors(p);
    write_mirror(&l, "mirror.gltf", 0.0);
    for (int i = 0; i < N; i++)
        for (int image = 0; image < 2; image++) {
            dvec3 d = d3_sub((dvec3){ image ? -2 : 2, 2, 2.5 }, p[i].at);
            want[i] += 500.0 * (image ? 0.9 : 1.0) * fmax(d3_dot(d, p[i].normal), 0.0) /
                       pow(d3_dot(d, d), 1.5);
        }
    grid_result r;
    lab_measure(&l,
                "scene: mirror.gltf\nmaterials: [{match: Mirror, mirror: 0.9}]\n"
                "lights: [{type: point, at: [2, 2, 2.5], intensity: 500}]",
                NULL, p, N, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("point", &r, want, 1e-5, 0.02);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirror_doubles_what_glows),
        cmocka_unit_test(a_coloured_mirror_colours_the_image),
        cmocka_unit_test(a_mirror_doubles_a_lamp_with_extent),
        cmocka_unit_test(a_mirror_doubles_a_disk),
        cmocka_unit_test(a_corridor_of_two_mirrors_is_a_row_of_images),
        cmocka_unit_test(a_view_into_a_mirror_shows_the_image_the_right_way_round),
        cmocka_unit_test(a_mirror_doubles_a_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
