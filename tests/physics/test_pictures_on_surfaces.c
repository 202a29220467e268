/* tests/physics/test_pictures_on_surfaces.c -- textures in whole scenes: the colours at their
 * places in a view, what a patterned floor gives back, holes, bumps.
 *
 * Linear values of 8-bit sRGB by IEC 61966-2-1: 188 is 0.502886, 128 is 0.215861, 51 is 0.0331048.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/gltf_text.h"
#include "tests/lab_picture.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <string.h>

static const double value_188 = 0.502886, value_128 = 0.215861, value_51 = 0.0331048;

#define MATT(more)                                                                                 \
    "\"name\":\"Picture\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{"   \
    "\"index\":0" more "}}"

/* ---- a view of four colours ------------------------------------------------------------------ */

/* Upper left, upper right, lower left, lower right */
static const uint8_t four[16] = { 188, 0,   51,  255, 0,   188, 128, 255,
                                  51,  128, 188, 255, 128, 51,  0,   255 };

static void look_down(lab *l, const char *lamp, view_result *out)
{
    const scene *s = lab_scene(
        l, text_of(&l->a,
                   "lux4: 1\nscene: picture.gltf\n%s"
                   "views: [{name: v, projection: orthographic, eye: [0, 0, 3], target: [0, 0, 0], "
                   "width: 2, size: [8, 8]}]\n",
                   lamp));
    run_options o = { .accuracy = 0.1, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    assert_true(view_run(&l->a, s, &s->study->views[0], &o, out, NULL));
}

/* Which of the four is seen in each quarter: north-west, north-east, south-west, south-east. A
 * texture repeated shows the first quarter of each. */
static void four_seen(const char *moved, const int want[4], int repeats)
{
    lab l;
    lab_open(&l);
    quad q = quad_level(0, 0, 0, 2);
    lab_picture(&l, "picture.gltf", &q, &(picture){ 2, 2, four, NEAREST_TEXEL },
                text_of(&l.a, MATT("%s"), moved));
    view_result r;
    look_down(&l, "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000}]\n", &r);
    int side = 8 / repeats; /* pixels of one picture */
    for (int i = 0; i < 64; i++) {
        int x = i % 8 % side, y = i / 8 % side, quarter = 2 * (y >= side / 2) + (x >= side / 2);
        for (int c = 0; c < 3; c++) {
            int byte     = four[4 * want[quarter] + c];
            double value = byte == 188   ? value_188
                           : byte == 128 ? value_128
                           : byte == 51  ? value_51
                                         : 0.0;
            double got   = LUMENS_PER_WATT * (double)r.radiance[c][i];
            assert_near(got, value * 1000.0 / M_PI, 1e-5);
            assert_near(r.albedo[c][i], value, 1e-5);
        }
    }
    lab_close(&l);
}

TEST(a_picture_lies_upright_in_its_colours) { four_seen("", (int[]){ 0, 1, 2, 3 }, 1); }

#define MOVED(text) ",\"extensions\":{\"KHR_texture_transform\":{" text "}}"

TEST(an_offset_moves_the_picture_to_the_left)
{
    four_seen(MOVED("\"offset\":[0.5,0]"), (int[]){ 1, 0, 3, 2 }, 1);
}
TEST(a_scale_repeats_the_picture) { four_seen(MOVED("\"scale\":[2,2]"), (int[]){ 0, 1, 2, 3 }, 2); }
/* u' = v, v' = -u: what was below left comes to lie above it. */
TEST(a_quarter_turn_turns_the_picture)
{
    four_seen(MOVED("\"rotation\":1.57079632679"), (int[]){ 2, 0, 3, 1 }, 1);
}

/* ---- bumps ----------------------------------------------------------------------------------- */

/* All normals lean by 37 degrees, to the picture's right, or upward: rho / pi E cos, E square to
 * the beam, and cos the angle to the normal as it is turned. */
static void leaning(const uint8_t rgb[3], dvec3 n)
{
    static const dvec3 from[] = { { 0, 0, 1 },     { 0.6, 0, 0.8 },    { -0.28, 0, 0.96 },
                                  { 0, 0.6, 0.8 }, { -0.96, 0, 0.28 }, { 0, -0.28, 0.96 } };
    for (int i = 0; i < 6; i++) {
        lab l;
        lab_open(&l);
        quad q                 = quad_level(0, 0, 0, 3);
        const uint8_t texel[4] = { rgb[0], rgb[1], rgb[2], 255 };
        lab_picture(&l, "picture.gltf", &q, &(picture){ 1, 1, texel, "" },
                    "\"name\":\"Bumps\",\"normalTexture\":{\"index\":0},\"pbrMetallicRoughness\":{"
                    "\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.5,0.5,1]}");
        view_result r;
        look_down(&l,
                  text_of(&l.a,
                          "lights: [{type: parallel, aim: [%g, %g, %g], illuminance: 1000}]\n",
                          -from[i].x, -from[i].y, -from[i].z),
                  &r);
        double want = 0.5 / M_PI * 1000.0 * fmax(d3_dot(n, from[i]), 0.0);
        for (int k = 0; k < 64; k++) {
            assert_near(LUMENS_PER_WATT * (double)r.radiance[1][k], want, 1e-4);
            assert_near(r.illuminance[k], 1000.0 * from[i].z, 1e-4); /* of the surface itself */
        }
        lab_close(&l);
    }
}

static dvec3 decoded(const uint8_t rgb[3])
{
    dvec3 n = { rgb[0] / 127.5 - 1.0, rgb[1] / 127.5 - 1.0, rgb[2] / 127.5 - 1.0 };
    return d3_scale(n, 1.0 / d3_length(n));
}

TEST(bumps_that_lean_to_the_right_are_lit_from_the_right)
{
    const uint8_t rgb[3] = { 204, 128, 230 };
    leaning(rgb, decoded(rgb));
}
TEST(bumps_that_lean_upward_are_lit_from_above)
{
    const uint8_t rgb[3] = { 128, 204, 230 };
    leaning(rgb, decoded(rgb));
}

/* ---- floors, holes --------------------------------------------------------------------------- */

enum { CHECKS = 32 };

static const uint8_t *checkerboard(lab *l, uint8_t white, bool holes)
{
    uint8_t *rgba = arena_array(&l->a, uint8_t, 4 * CHECKS * CHECKS, NULL);
    for (int i = 0; i < CHECKS * CHECKS; i++) {
        bool on = (i % CHECKS + i / CHECKS) % 2;
        memset(rgba + 4 * i, on ? white : 0, 3);
        rgba[4 * i + 3] = on || !holes ? 255 : 0;
    }
    return rgba;
}

/* From the wall, squares of 3 cm are even: the mean of their reflectances, not of their bytes. */
static void floor_gives_back(const char *sampler)
{
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 2, 0, 4);
    lab_picture(&l, "picture.gltf", &q,
                &(picture){ CHECKS, CHECKS, checkerboard(&l, 188, false), sampler },
                MATT(",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[4,4]}}"));
    const lab_probe p[] = { { { 2, 0, 1 }, { 0, 1, 0 } },
                            { { 2, 0, 2 }, { 0, 1, 0 } },
                            { { 1, 3, 3 }, { 0, 0, -1 } } };
    double want[3];
    for (int i = 0; i < 3; i++)
        want[i] = 0.5 * value_188 * 1000.0 / M_PI * polygon_lux(q.corner, 4, p[i].at, p[i].normal);
    grid_result r;
    lab_measure(&l,
                "scene: picture.gltf\n"
                "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000}]",
                NULL, p, 3, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("checkerboard", &r, want, 1e-3, 0.01);
    lab_close(&l);
}

TEST(a_checkerboard_gives_back_its_mean) { floor_gives_back(""); }
TEST(a_checkerboard_of_sharp_texels_gives_back_its_mean) { floor_gives_back(NEAREST_TEXEL); }

typedef struct screen {
    dvec3 at, normal;
    double z, size; /* of the screen about (2, 2) */
} screen;

static double passes_hole(const void *context, dvec3 wi)
{
    const screen *s = context;
    double t        = (s->z - s->at.z) / wi.z;
    double u        = (s->at.x + t * wi.x - 2.0) / s->size + 0.5,
           v        = 0.5 - (s->at.y + t * wi.y - 2.0) / s->size;
    bool hole       = ((int)floor(u * CHECKS) + (int)floor(v * CHECKS)) % 2 == 0;
    return hole ? fmax(d3_dot(wi, s->normal), 0.0) : 0.0;
}

/* A screen of 4 m with squares of 12.5 cm, every other one a hole; 1e-3: of the integral. */
TEST(holes_of_a_screen_let_half_of_the_light_through)
{
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 2, 1, 4), glow = quad_level(2, 2, 2, 1.5);
    lab_picture(&l, "picture.gltf", &q,
                &(picture){ CHECKS, CHECKS, checkerboard(&l, 0, true), NEAREST_TEXEL },
                MATT("") ",\"alphaMode\":\"MASK\"");
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    const lab_probe p[] = { { { 2, 2, 0 }, { 0, 0, 1 } },
                            { { 1.33, 2.21, 0.1 }, { 0, 0.6, 0.8 } },
                            { { 2.7, 1.6, 0.3 }, { 0, 0, 1 } } };
    double want[3];
    for (int i = 0; i < 3; i++) {
        screen s   = { p[i].at, p[i].normal, 1.0, 4.0 };
        want[i]    = 1000.0 * quad_integral(&glow, p[i].at, 500, passes_hole, &s);
        double all = 1000.0 * polygon_lux(glow.corner, 4, p[i].at, p[i].normal);
        assert_near(want[i], 0.5 * all, 0.1);
    }
    grid_result r;
    lab_measure(&l, "scene: [picture.gltf, glow.gltf]\n", NULL, p, 3,
                &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("holes", &r, want, 1e-3, 0.01);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_lies_upright_in_its_colours),
        cmocka_unit_test(an_offset_moves_the_picture_to_the_left),
        cmocka_unit_test(a_scale_repeats_the_picture),
        cmocka_unit_test(a_quarter_turn_turns_the_picture),
        cmocka_unit_test(bumps_that_lean_to_the_right_are_lit_from_the_right),
        cmocka_unit_test(bumps_that_lean_upward_are_lit_from_above),
        cmocka_unit_test(a_checkerboard_gives_back_its_mean),
        cmocka_unit_test(a_checkerboard_of_sharp_texels_gives_back_its_mean),
        cmocka_unit_test(holes_of_a_screen_let_half_of_the_light_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
