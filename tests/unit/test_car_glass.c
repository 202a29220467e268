/* tests/unit/test_car_glass.c -- the car and the room full of glass, as shipped, are what their
 * programs make; both are sound, and read by our own reader as they were meant. */
#define _GNU_SOURCE /* open_memstream */
#include "core/image.h"
#include "data/car/car.h"
#include "materials/look.h"
#include "sim/gltf.h"
#include "tests/solids.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

void glass_build(model *m); /* data/glass/glass.h, whose names of paints are those of the car */

static model built;
static arena memory;

static int forget(void **state)
{
    (void)state;
    model_clear(&built);
    arena_clear(&memory);
    return 0;
}

static bool write_car(FILE *to)
{
    car_build(&built);
    return model_write_glb(&built, to);
}

static bool write_glass(FILE *to)
{
    glass_build(&built);
    return model_write_glb(&built, to);
}

TEST(the_car_in_the_repository_is_that_which_the_program_makes)
{
    assert_file_is("data/car/car.glb", write_car);
}

TEST(the_room_in_the_repository_is_that_which_the_program_makes)
{
    assert_file_is("data/glass/glass.glb", write_glass);
}

/* ---- what is made ------------------------------------------------------------------------- */

TEST(the_car_has_140000_triangles)
{
    car_build(&built);
    assert_false(built.overflow);
    assert_near(model_triangles(&built), 140000.0, 0.05);
}

TEST(the_room_has_45000_triangles)
{
    glass_build(&built);
    assert_false(built.overflow);
    assert_near(model_triangles(&built), 45000.0, 0.05);
}

/* Those that refract; returns how many. */
static int assert_glass_is_closed(const model *m)
{
    int count = 0;
    for (int i = 0; i < m->shape_count; i++)
        for (int k = 0; k < m->paint_count; k++) {
            const patch *t = &m->shapes[i].patches[k];
            double volume6;
            if (m->paints[k].thickness <= 0.0 || !t->triangle_count)
                continue;
            count++;
            if (!patch_is_closed(t))
                fail_msg("%s, %s: open", m->shapes[i].name, m->paints[k].name);
            patch_least_area(t, &volume6);
            assert_true(volume6 > 0.0);
        }
    return count;
}

TEST(all_solids_of_glass_are_closed_and_look_outward)
{
    car_build(&built);
    assert_int_equal(assert_glass_is_closed(&built), 1); /* both covers */
    model_clear(&built);
    glass_build(&built);
    assert_int_equal(assert_glass_is_closed(&built), 5);
}

/* Triangles of which a millimetre in front of their middle is not further out than behind it. */
static uint32_t looking_inward(const patch *t)
{
    uint32_t wrong = 0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i += 3) {
        const point a = patch_corner(t, i), b = patch_corner(t, i + 1), c = patch_corner(t, i + 2);
        const point n = cross(minus(b, a), minus(c, a));
        const point m =
            times((point){ a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z }, 1.0 / 3);
        if (length(n) > 0.0)
            wrong +=
                form(minus(m, times(unit(n), -0.001))) <= form(minus(m, times(unit(n), 0.001)));
    }
    return wrong;
}

TEST(the_body_of_the_car_looks_outward)
{
    shape s = car_body();
    assert_false(s.out_of_memory);
    for (int k = 0; k < PAINT_COUNT; k++)
        assert_int_equal(looking_inward(&s.patches[k]), 0);
    assert_true(s.patches[PAINT].triangle_count > 30000);
    assert_true(s.patches[WINDOW].triangle_count > 3000);
    solid_clear(&s);
}

/* ---- what is read ------------------------------------------------------------------------- */

static const gltf *read_file(const char *path)
{
    notices said    = { .a = &memory };
    lux_error error = { 0 };
    const gltf *g   = gltf_read(&memory, path, &said, &error);
    if (!g)
        fail_msg("%s", error.text);
    return g;
}

/* Unit, and on the front side; (0, 0, 0) stands for the triangle's own. */
static void assert_normals(const mesh *m)
{
    for (uint32_t i = 0; m->normals && i < 3 * m->triangle_count; i++) {
        const uint32_t *c = m->corners + i / 3 * 3;
        const dvec3 a = d3_from(m->positions[c[0]]), n = d3_from(m->normals[i]);
        const dvec3 own = d3_cross(d3_sub(d3_from(m->positions[c[1]]), a),
                                   d3_sub(d3_from(m->positions[c[2]]), a));
        if (d3_length(n) == 0.0)
            continue;
        assert_near(d3_length(n), 1.0, 1e-6);
        assert_true(d3_dot(n, own) > 0.0);
    }
}

static uint32_t assert_within(const gltf *g, dvec3 low, dvec3 high)
{
    uint32_t triangles = 0;
    for (uint32_t i = 0; i < g->placement_count; i++) {
        const gltf_placement *at = &g->placements[i];
        const mesh *m            = &g->meshes[at->mesh].triangles;
        triangles += m->triangle_count;
        assert_normals(m);
        for (uint32_t v = 0; v < m->position_count; v++) {
            const dvec3 p = transform_point(&at->place, d3_from(m->positions[v]));
            assert_true(p.x >= low.x && p.y >= low.y && p.z >= low.z);
            assert_true(p.x <= high.x && p.y <= high.y && p.z <= high.z);
        }
    }
    return triangles;
}

static int smooth_meshes(const gltf *g)
{
    int count = 0;
    for (uint32_t i = 0; i < g->mesh_count; i++)
        count += g->meshes[i].triangles.normals != NULL;
    return count;
}

TEST(our_reader_takes_the_car_as_it_is)
{
    const gltf *g = read_file("data/car/car.glb");
    assert_near(assert_within(g, (dvec3){ -11, -11, -0.2 }, (dvec3){ 11, 11, 5.1 }), 140000.0,
                0.05);
    assert_int_equal(g->flat_triangles, 0);
    assert_int_equal(g->material_count, PAINT_COUNT + 1);
    assert_string_equal(g->materials[PAINT].name, "Paint");
    assert_near(g->materials[LENS].ior, 1.58, 1e-6);
    assert_true(g->materials[LENS].volume);
    assert_near(g->materials[WINDOW].transmission, 1.0, 0.0);
    assert_false(g->materials[WINDOW].volume);
    assert_true(smooth_meshes(g) >= 6);
}

TEST(our_reader_takes_the_room_as_it_is)
{
    const gltf *g = read_file("data/glass/glass.glb");
    assert_near(assert_within(g, (dvec3){ -0.35, -0.25, -0.25 }, (dvec3){ 5.25, 4.25, 3.0 }),
                45000.0, 0.05);
    assert_int_equal(g->flat_triangles, 0);
    assert_int_equal(g->texture_count, 13);
    int textured = 0, cut = 0, solid = 0;
    for (uint32_t i = 0; i < g->material_count; i++) {
        const material_textures *t = g->materials[i].textures;
        textured += t != NULL;
        cut += t && t->alpha == ALPHA_MASK;
        solid += g->materials[i].volume;
    }
    assert_int_equal(textured, 13); /* the two woods have one picture, the tiles have two */
    assert_int_equal(cut, 1);
    assert_int_equal(solid, 4);
}

/* ---- pictures ----------------------------------------------------------------------------- */

static void slanted(double u, double v, double c[4])
{
    c[0] = u;
    c[1] = v;
    c[2] = noise(8.0 * u, 8.0 * v, 8, 1);
    c[3] = u + v < 0.7 ? 0.0 : 1.0;
}

static void plain(double u, double v, double c[4]) { c[0] = c[1] = c[2] = u < 0.5 ? 0.25 : v; }

/* Another program's reader (OpenImageIO's) finds the bytes that the formula says. */
static void assert_read_back(const picture *p)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *to    = open_memstream(&bytes, &size);
    assert_true(to && picture_write_png(p, to));
    assert_int_equal(fclose(to), 0);

    lux_error error = { 0 };
    int width = 0, height = 0;
    float *rgba = NULL;
    if (!image_load_rgba(p->name, bytes, size, false, &memory, &width, &height, &rgba, &error))
        fail_msg("%s", error.text);
    free(bytes);
    assert_int_equal(width, p->width);
    assert_int_equal(height, p->height);
    for (int i = 0; i < width * height; i++) {
        double c[4] = { 0, 0, 0, 1 };
        p->at((i % width + 0.5) / width, (i / width + 0.5) / height, c);
        for (int k = 0; k < 4; k++)
            assert_true(fabs((double)rgba[4 * i + k] - c[k]) < 0.5 / 255.0 + 1e-6); /* 8 bits */
    }
}

TEST(pictures_are_png_that_others_read)
{
    assert_read_back(&(picture){ "slanted", 61, 47, true, slanted });
    assert_read_back(&(picture){ "plain", 300, 200, false, plain });
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_car_in_the_repository_is_that_which_the_program_makes,
                                  forget),
        cmocka_unit_test_teardown(the_room_in_the_repository_is_that_which_the_program_makes,
                                  forget),
        cmocka_unit_test_teardown(the_car_has_140000_triangles, forget),
        cmocka_unit_test_teardown(the_room_has_45000_triangles, forget),
        cmocka_unit_test_teardown(all_solids_of_glass_are_closed_and_look_outward, forget),
        cmocka_unit_test(the_body_of_the_car_looks_outward),
        cmocka_unit_test_teardown(our_reader_takes_the_car_as_it_is, forget),
        cmocka_unit_test_teardown(our_reader_takes_the_room_as_it_is, forget),
        cmocka_unit_test_teardown(pictures_are_png_that_others_read, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
