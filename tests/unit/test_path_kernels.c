/* tests/unit/test_path_kernels.c -- kernels that leave out what a scene does not call for find what
 * those find that do not, to the bit; and which scenes are grey.
 */
#include "sim/path_kernel.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

#define ROOM "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
#define LAMP "{type: disk, at: [2, 2, 2.4], radius: 0.2, lumens: 50000}"
#define DAY                                                                                        \
    "lux4: 1\n"                                                                                    \
    "room: {size: [4, 3, 2.5], reflectance: 0.5, windows: [{wall: south, at: [1, 0.8], size: [2, " \
    "1.2]}]}\n"                                                                                    \
    "sky: {model: clear, horizontal: 10000, sun_illuminance: 60000,\n"                             \
    "  sun_at: {azimuth: 170, elevation: 40}}\n"

/* A pane of glass that shines, beside a sheet of metal. */
static void write_things(lab *l)
{
    const quad upright[] = { { { { 1, 1, 0.5 }, { 2, 1, 0.5 }, { 2, 1, 2 }, { 1, 1, 2 } } } };
    const quad level[]   = { { { { 2, 1, 1 }, { 3, 1, 1 }, { 3, 2, 1 }, { 2, 2, 1 } } } };
    lab_quads(l, "metal.gltf", level, 1,
              "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.8,0.8,0.8,1],"
              "\"metallicFactor\":1,\"roughnessFactor\":0.3},\"doubleSided\":true");
    lab_quads(l, "glass.gltf", upright, 1,
              "\"emissiveFactor\":[0.5,0.5,0.5],\"pbrMetallicRoughness\":{\"roughnessFactor\":0},"
              "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}}");
}

/* ---- what is grey ---------------------------------------------------------------------------- */

static void assert_colored(const char *by, const char *text)
{
    lab l;
    lab_open(&l);
    const scene *s  = lab_scene(&l, text);
    const char *got = scene_colored_by(s);
    assert_true(s->grey == !by);
    if (by)
        assert_string_equal(got, by);
    else
        assert_null(got);
    lab_close(&l);
}

TEST(what_is_of_one_grey_is_told_from_what_is_not)
{
    assert_colored(NULL, ROOM "lights: [" LAMP "]\n");
    assert_colored(NULL, DAY);
    assert_colored("lamps are coloured", ROOM "lights: [{type: point, at: [2, 1, 2], lumens: 9, "
                                              "color: 3000K}]\n");
    assert_colored("lamps differ in colour", ROOM
                   "lights: [" LAMP ", {type: point, at: [2, 1, 2], lumens: 9, color: 3000K}]\n");
    assert_colored("surfaces are coloured",
                   "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: {ceiling: 0.5, walls: 0.5, "
                   "floor: [0.3, 0.3, 0.300001]}}\nlights: [" LAMP "]\n");
    assert_colored("the sky is coloured",
                   ROOM "sky: {model: overcast, horizontal: 10000, ground: [0.2, 0.2, 0.21]}\n");
}

/* ---- all kernels alike ----------------------------------------------------------------------- */

enum { COUNT = 500 };

static void begin_paths(path_bundle *b)
{
    b->count = COUNT;
    for (int i = 0; i < PATHS; i++) {
        b->x[i] = 1.5f, b->y[i] = 0.5f + 0.004f * (float)(i % COUNT), b->z[i] = 0.7f;
        b->nx[i] = b->ny[i] = 0.0f, b->nz[i] = 1.0f;
        b->error[i] = 0x1p-20f;
        b->index[i] = (uint32_t)i;
        b->seed[i] = 7, b->set[i] = 0;
    }
}

static void move_to_scene(const scene *s, path_bundle *b)
{
    for (int i = 0; i < PATHS; i++) {
        dvec3 at   = { (double)b->x[i], (double)b->y[i], (double)b->z[i] };
        vec3 place = scene_place(s, at);
        b->x[i] = place.x, b->y[i] = place.y, b->z[i] = place.z;
    }
}

static bool find_the_same(const path_bundle *a, const path_bundle *b)
{
    return !memcmp(a->direct, b->direct, sizeof a->direct) &&
           !memcmp(a->indirect, b->indirect, sizeof a->indirect) &&
           !memcmp(a->met, b->met, sizeof a->met);
}

/* Tries all kernels on a study; how many will do for it. */
static int kernels_of(const char *text)
{
    lab l;
    lab_open(&l);
    write_things(&l);
    const scene *s       = lab_scene(&l, text);
    lux_error err        = { 0 };
    path_tracer *t       = path_tracer_new(&l.a, s, &err);
    path_bundle *one     = calloc(1, sizeof *one);
    path_bundle *all     = calloc(1, sizeof *all);
    const path_options o = { .lamps = true, .bounce = true, .roulette_from = 2 };
    assert_true(t && one && all);
    begin_paths(all);
    move_to_scene(s, all);
    *one = *all;
    assert_int_equal(path_use_kernel(t, 0), 0);
    path_trace(t, all, &o);
    float sum = 0.0f;
    for (int i = 0; i < COUNT; i++)
        sum += all->indirect[2][i];
    assert_true(sum > 0.0f);

    int tried = 1;
    for (int kernel = 1; kernel < KERNELS; kernel++) {
        if (path_use_kernel(t, kernel) != kernel)
            continue;
        path_trace(t, one, &o);
        assert_true(find_the_same(one, all));
        tried++;
    }
    free(one);
    free(all);
    lab_close(&l);
    return tried;
}

TEST(all_kernels_find_the_same)
{
    assert_int_equal(kernels_of(ROOM "lights: [" LAMP "]\n"), 4);
    assert_int_equal(kernels_of(ROOM "lights: [{type: point, at: [2, 1, 2], lumens: 9, "
                                     "color: 3000K}]\n"),
                     2);
    assert_int_equal(kernels_of(DAY "lights: [" LAMP "]\n"), 4);
    assert_int_equal(kernels_of(ROOM "scene: metal.gltf\nlights: [" LAMP "]\n"), 2);
    assert_int_equal(kernels_of(DAY "scene: [{file: metal.gltf}, {file: glass.gltf}]\n"), 2);
}

TEST(what_the_scene_calls_for_is_not_left_out)
{
    lab l;
    lab_open(&l);
    lux_error err = { 0 };
    write_things(&l);
    const scene *s = lab_scene(&l, ROOM "scene: metal.gltf\nlights: [" LAMP "]\n");
    path_tracer *t = path_tracer_new(&l.a, s, &err);
    assert_int_equal(path_use_kernel(t, KERNEL_GREY), KERNEL_GREY);
    assert_int_equal(path_use_kernel(t, KERNEL_MATT), KERNEL_GREY);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_of_one_grey_is_told_from_what_is_not),
        cmocka_unit_test(all_kernels_find_the_same),
        cmocka_unit_test(what_the_scene_calls_for_is_not_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
