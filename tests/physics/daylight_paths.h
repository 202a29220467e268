/* tests/physics/daylight_paths.h -- the light of day by whichever way paths find it.
 *
 * Light that comes in by an opening is found by asking the sky through portals, by asking it
 * anywhere, and by rays that leave the scene; light of a sunlit patch by asking the patch and by
 * meeting it. Whatever is known of the openings, the same room has the same light. For
 * test_daylight_paths.c and, to a narrower interval, long_daylight_paths.c.
 */
#ifndef TESTS_PHYSICS_DAYLIGHT_PATHS_H
#define TESTS_PHYSICS_DAYLIGHT_PATHS_H

#include "core/image.h"
#include "sim/moment_sky.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

/* ---- a room with a hole ---------------------------------------------------------------------- */

/* 4 m by 5 m by 3 m; in the south wall a hole of 2 m by 1.2 m. */
enum { SENSORS = 6 };
static const lab_probe probe[SENSORS] = {
    { { 2.0, 1.0, 0.001 }, { 0, 0, 1 } },  { { 1.2, 4.0, 0.8 }, { 0, 0, 1 } },
    { { 2.3, 2.0, 2.999 }, { 0, 0, -1 } }, { { 1.5, 4.999, 1.5 }, { 0, -1, 0 } },
    { { 3.999, 3.0, 1.0 }, { -1, 0, 0 } }, { { 2.0, 0.001, 0.5 }, { 0, 1, 0 } },
};

typedef enum opening {
    ROOM_WINDOW, /* a portal by itself */
    PLAIN_HOLE,  /* nobody knows of it */
    NAMED_HOLE,  /* `portals` names a surface of nothing that lies in it */
    WRONG_HOLE,  /* `portals` names one that lies elsewhere, over the hole's half */
    OPENINGS,
} opening;

static const char *const walls[OPENINGS] = {
    "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], size: [2, "
    "1.2]}]}\n",
    "scene: [box.gltf]\nmaterials: [{match: Box, reflectance: 0.5}]\n",
    "scene: [box.gltf, {file: air.gltf, portals: Air}]\n"
    "materials: [{match: Box, reflectance: 0.5}]\n",
    "scene: [box.gltf, {file: air.gltf, portals: Air, at: [-1.5, 0, 0.7]}]\n"
    "materials: [{match: Box, reflectance: 0.5}]\n",
};

static inline quad upright(double x0, double x1, double z0, double z1)
{
    return (quad){ { { x0, 0, z0 }, { x1, 0, z0 }, { x1, 0, z1 }, { x0, 0, z1 } } };
}

static inline void write_box(lab *l)
{
    quad side[6], wall[9], air = upright(1, 3, 1, 2.2);
    int count = 0;
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 4, 5, 3 }, side);
    for (int i = 0; i < 6; i++) {
        bool south = true;
        for (int k = 0; k < 4; k++)
            south = south && side[i].corner[k].y == 0.0;
        if (!south)
            wall[count++] = side[i];
    }
    wall[count++] = upright(0, 1, 0, 3);
    wall[count++] = upright(3, 4, 0, 3);
    wall[count++] = upright(1, 3, 0, 1);
    wall[count++] = upright(1, 3, 2.2, 3);
    assert_int_equal(count, 9);
    lab_quads(l, "box.gltf", wall, count, "\"name\":\"Box\"");
    lab_quads(l, "air.gltf", &air, 1,
              "\"name\":\"Air\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
              "\"baseColorFactor\":[1,1,1,0]}");
}

/* 16 by 8 pixels that differ, darker below the horizon. */
static inline void write_panorama(const lab *l)
{
    enum { W = 16, H = 8 };
    char path[4096];
    float rgb[3][W * H];
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++)
            rgb[c][i] = (i < W * H / 2 ? 20.0f : 4.0f) * (1.0f + 0.1f * (float)(i * (3 + c) % 17));
    image_channel c[3] = { { "B", rgb[2] }, { "G", rgb[1] }, { "R", rgb[0] } };
    image im           = { .width = W, .height = H, .channel_count = 3, .channels = c };
    lux_error err      = { 0 };
    snprintf(path, sizeof path, "%s/sky.exr", l->folder);
    if (!image_write_exr(path, &im, false, NULL, &err))
        fail_msg("%s", err.text);
}

/* ---- what agrees ----------------------------------------------------------------------------- */

/* Student's t of 15 degrees of freedom, once in 10,000 by once in 20: hundreds are compared. */
static const double stretch = 5.2391 / 2.1314;

static inline void assert_agree(const char *what, const grid_moment *a, const grid_moment *b,
                                int count)
{
    for (int k = 0; k < count; k++) {
        double x = a->illuminance[k], y = b->illuminance[k];
        double rounding = 1e-5 * fabs(y); /* floats */
        if (!(fabs(x - y) <= stretch * hypot(a->half_width[k], b->half_width[k]) + rounding))
            fail_msg("%s, sensor %d: %.6g +- %.2g and %.6g +- %.2g lx, %.2g %% apart", what, k, x,
                     a->half_width[k], y, b->half_width[k], 100.0 * fabs(x / y - 1.0));
    }
}

static inline grid_moment light_of(const grid_result *r)
{
    return (grid_moment){ .illuminance = r->illuminance, .half_width = r->half_width };
}

static inline void measure(lab *l, opening o, const char *yaml, double accuracy, grid_result *out)
{
    lab_measure(l, text_of(&l->a, "%s%s", walls[o], yaml), NULL, probe, SENSORS,
                &(run_options){ .accuracy = accuracy, .threads = 2 }, out);
}

/* The less is known, the more it costs. */
static inline void all_openings_agree(const char *lit, double known, double unknown, double misled)
{
    const double accuracy[OPENINGS] = { known, unknown, known, misled };
    grid_result first, r;
    lab l;
    lab_open(&l);
    write_box(&l);
    write_panorama(&l);
    measure(&l, ROOM_WINDOW, lit, known, &first);
    grid_moment want = light_of(&first);
    for (opening o = PLAIN_HOLE; o < OPENINGS; o++) {
        measure(&l, o, lit, accuracy[o], &r);
        grid_moment got = light_of(&r);
        assert_agree(text_of(&l.a, "%sopening %d", lit, o), &got, &want, SENSORS);
    }
    lab_close(&l);
}

#define SUN_ALONE(azimuth, elevation, kind)                                                        \
    "sky: {model: uniform, sun: " kind ", sun_at: {azimuth: " azimuth ", elevation: " elevation    \
    "}, horizontal: 0, sun_illuminance: 50000, ground: "

#endif
