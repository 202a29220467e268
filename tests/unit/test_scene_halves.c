/* tests/unit/test_scene_halves.c -- what lets light straight through stands apart in the world:
 * which triangle is which, and what it keeps of coordinates, normals and glow.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <string.h>

static const quad floor_quad = { { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } } };

static const char lamp_ies[] =
    "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
    "1 -1 1 2 1 1 2 0 0 0\n1 1 25\n0 180\n0\n100 100\n";

static quad level_quad(double z)
{
    return (quad){ { { 0, 0, z }, { 4, 0, z }, { 4, 4, z }, { 0, 4, z } } };
}

#define ONE_NODE "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]"
#define STUDY    "lux4: 1\nscene: model.gltf\nlights: [{type: point, at: [2, 2, 9], lumens: 100}]\n"
#define GLASS                                                                                      \
    "\"name\":\"Glass\",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}" \
    "},\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0}"

/* ---- models of several materials ------------------------------------------------------------- */

typedef struct part {
    quad q;
    int made_of;
} part;

/* A mesh of quads, each a primitive; nodes: the file's. */
static void write_model(lab *l, const char *materials, const char *nodes, const part *p, int count)
{
    static const int around[6] = { 0, 1, 2, 0, 2, 3 };
    float at[8][6][3];
    char *accessors = text_of(&l->a, "%s", ""), *primitives = accessors;
    assert_true(count <= 8);
    for (int i = 0; i < count; i++) {
        float low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { -1e9f, -1e9f, -1e9f };
        for (int k = 0; k < 6; k++) {
            dvec3 c     = p[i].q.corner[around[k]];
            at[i][k][0] = (float)c.x, at[i][k][1] = (float)c.z, at[i][k][2] = (float)-c.y;
            for (int d = 0; d < 3; d++) {
                low[d]  = fminf(low[d], at[i][k][d]);
                high[d] = fmaxf(high[d], at[i][k][d]);
            }
        }
        accessors  = text_of(&l->a,
                             "%s%s{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5126,"
                              "\"count\":6,\"type\":\"VEC3\",\"min\":[%g,%g,%g],\"max\":[%g,%g,%g]}",
                             accessors, i ? "," : "", 72 * i, (double)low[0], (double)low[1],
                             (double)low[2], (double)high[0], (double)high[1], (double)high[2]);
        primitives = text_of(&l->a, "%s%s{\"attributes\":{\"POSITION\":%d},\"material\":%d}",
                             primitives, i ? "," : "", i, p[i].made_of);
    }
    lab_write(l, "model.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,%s,\"materials\":[%s],"
              "\"buffers\":[{\"byteLength\":%d,\"uri\":\"%s\"}],"
              "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"accessors\":[%s],"
              "\"meshes\":[{\"primitives\":[%s]}]}",
              nodes, materials, 72 * count, data_uri(&l->a, at, 72 * (size_t)count), 72 * count,
              accessors, primitives);
}

/* ---- what is hollow -------------------------------------------------------------------------- */

static vray ray_down(const scene *s, dvec3 from)
{
    vec3 o = scene_place(s, from);
    return (vray){ vspread(o), { vsplat(0), vsplat(0), vsplat(-1) }, vsplat(100) };
}

/* Straight down from z = 5: the heights of what is met. */
static int heights(const scene *s, dvec3 from, double z[4], vhit hits[4])
{
    vray r       = ray_down(s, from);
    vmask active = ALL_LANES;
    int count    = 0;
    assert_true(world_all_hits(s->world, &r, &active, 1, 4, hits));
    for (; count < 4 && lane(hits[count].instance, 0) >= 0; count++)
        z[count] = from.z - (double)lane(hits[count].distance, 0);
    return count;
}

static bool blocked(const scene *s, dvec3 from, float reach)
{
    vray r       = ray_down(s, from);
    r.reach      = vsplat(reach);
    vmask active = ALL_LANES, hit;
    world_any_hit(s->world, &r, &active, NULL, 1, RAYS_COHERENT, &hit);
    return vany(hit);
}

#define TWO_MATERIALS                                                                              \
    "{" GLASS "},{\"name\":\"Floor\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"              \
    "\"baseColorFactor\":[0.3,0.3,0.3,1]}}"

static void assert_pane_above_floor(const scene *s, dvec3 at)
{
    double z[4];
    vhit hits[4];
    assert_int_equal(heights(s, (dvec3){ at.x + 1, at.y + 2, 5 }, z, hits), 2);
    assert_near(z[0], 1.0, 1e-5);
    assert_near(z[1], 0.0, 1e-5);
    assert_false(blocked(s, (dvec3){ at.x + 1, at.y + 2, 5 }, 4.5f)); /* by the pane */
    assert_true(blocked(s, (dvec3){ at.x + 1, at.y + 2, 5 }, 5.5f));
}

TEST(panes_stand_apart_from_what_is_opaque)
{
    const part parts[] = { { level_quad(1), 0 }, { floor_quad, 1 } };
    lab l;
    lab_open(&l);
    write_model(&l, TWO_MATERIALS, ONE_NODE, parts, 2);
    assert_pane_above_floor(lab_scene(&l, STUDY), (dvec3){ 0, 0, 0 });
    lab_close(&l);
}

/* The body of a lamp is no part of the common mesh: here it stands at two nodes. */
TEST(meshes_with_a_place_of_their_own_are_split_too)
{
    const part parts[] = { { level_quad(1), 0 }, { floor_quad, 1 } };
    lab l;
    lab_open(&l);
    write_model(&l, TWO_MATERIALS,
                "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"name\":\"Lamp\",\"mesh\":0},"
                "{\"name\":\"Lamp\",\"mesh\":0,\"translation\":[10,0,0]}]",
                parts, 2);
    lab_write(&l, "lamp.ies", "%s", lamp_ies);
    const scene *s = lab_scene(&l, "lux4: 1\nscene: model.gltf\n"
                                   "luminaires: [{photometry: lamp.ies, nodes: Lamp}]\n");
    assert_pane_above_floor(s, (dvec3){ 0, 0, 0 });
    assert_pane_above_floor(s, (dvec3){ 10, 0, 0 });
    lab_close(&l);
}

/* ---- coordinates and normals ----------------------------------------------------------------- */

/* A quad of 4 x 4 m with a picture upright on it, u = x / 4, and all of its normals leaning to +x;
 * named Lamp, at a node that mirrors x and stretches it. */
static void write_leaning_quad(lab *l)
{
    static const int around[6] = { 0, 1, 2, 0, 2, 3 };
    float at[6][8];
    for (int k = 0; k < 6; k++) {
        dvec3 c      = floor_quad.corner[around[k]];
        float row[8] = { (float)c.x, 0, (float)-c.y,    0.6f,
                         0.8f,       0, (float)c.x / 4, 1 - (float)c.y / 4 };
        memcpy(at[k], row, sizeof row);
    }
    lab_write(
        l, "model.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
        "\"name\":\"Lamp\",\"mesh\":0,\"scale\":[-2,1,1]}],\"materials\":[{"
        "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}}],"
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJ"
        "RU5ErkJggg==\"}],\"buffers\":[{\"byteLength\":192,\"uri\":\"%s\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":192,\"byteStride\":32}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\","
        "\"min\":[0,0,-4],\"max\":[4,0,0]},{\"bufferView\":0,\"byteOffset\":12,"
        "\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},{\"bufferView\":0,"
        "\"byteOffset\":24,\"componentType\":5126,\"count\":6,\"type\":\"VEC2\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
        "\"TEXCOORD_0\":2},\"material\":0}]}]}",
        data_uri(&l->a, at, sizeof at));
}

/* Normals go by the inverse, transposed: (0.6, 0.8) to (0.6 / -2, 0.8). */
static void assert_leaning_quad(const scene *s)
{
    vray r       = ray_down(s, (dvec3){ -6, 1, 5 });
    vmask active = ALL_LANES;
    vhit hit;
    vdetail d;
    world_first_hit(s->world, &r, &active, 1, RAYS_COHERENT, &hit);
    assert_near((double)lane(hit.distance, 0), 5.0, 1e-5);
    world_detail(s->world, &hit, ALL_LANES, &d);
    assert_near((double)lane(d.u[0], 0), 0.75, 1e-5);
    assert_near((double)lane(d.v[0], 0), 0.75, 1e-5);
    assert_near((double)lane(d.along_u[0].x, 0), -1.0, 1e-5);
    assert_true(lane(d.mirrored[0], 0) & 1);
    assert_near((double)lane(d.normal.x, 0), -0.3 / sqrt(0.73), 1e-5);
    assert_near((double)lane(d.normal.z, 0), 0.8 / sqrt(0.73), 1e-5);
    assert_true(s->smooth && s->textured && !s->hollow);
    assert_true(s->texture_bytes > s->picture_bytes && s->picture_bytes >= 16);
}

TEST(coordinates_and_normals_stay_with_their_corners_where_a_place_mirrors)
{
    lab l;
    lab_open(&l);
    write_leaning_quad(&l);
    assert_leaning_quad(lab_scene(&l, STUDY)); /* baked */
    lab_write(&l, "lamp.ies", "%s", lamp_ies);
    assert_leaning_quad(lab_scene(&l, "lux4: 1\nscene: model.gltf\n"
                                      "luminaires: [{photometry: lamp.ies, nodes: Lamp}]\n"));
    lab_close(&l);
}

/* ---- glow ------------------------------------------------------------------------------------ */

/* Four sheets, of which the first and third have holes and glow half as much as they would. */
TEST(glowing_triangles_keep_their_numbers_where_meshes_are_split)
{
    static const char materials[] =
        "{\"name\":\"Holes\",\"alphaMode\":\"BLEND\",\"emissiveFactor\":[1,1,1],"
        "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,0.5],\"metallicFactor\":0}},"
        "{\"name\":\"Whole\",\"emissiveFactor\":[1,1,1],\"pbrMetallicRoughness\":{"
        "\"baseColorFactor\":[0,0,0,1],\"metallicFactor\":0}},"
        "{\"name\":\"Dark\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"baseColorFactor\":["
        "0,0,0,0.5],\"metallicFactor\":0}}";
    const part parts[] = {
        { level_quad(4), 0 }, { level_quad(3), 2 }, { level_quad(2), 0 }, { level_quad(1), 1 }
    };
    lab l;
    lab_open(&l);
    write_model(&l, materials, ONE_NODE, parts, 4);
    const scene *s = lab_scene(&l, STUDY);
    double z[4];
    vhit hits[4];
    assert_int_equal(s->emitter_count, 6);
    assert_int_equal(heights(s, (dvec3){ 1, 2, 5 }, z, hits), 4);
    for (int i = 0; i < 4; i++) {
        assert_near(z[i], 4.0 - i, 1e-5);
        int64_t first = s->first_emitter[lane(hits[i].instance, 0)];
        assert_true(first >= 0);
        int32_t number = s->emitter_of[first + lane(hits[i].triangle, 0)];
        if (i == 1) {
            assert_int_equal(number, -1);
            continue;
        }
        light_bounds box = light_bounds_of(s->lights[s->light_count + number]);
        assert_near((double)box.low.z + s->centre.z, z[i], 1e-4); /* the one that was met */
        assert_near((double)box.high.z + s->centre.z, z[i], 1e-4);
    }
    /* 2 pi L A: 16 m^2 of 1 cd/m^2, twice 16 m^2 of half of it */
    assert_near(scene_glow_lumens(s), 2.0 * M_PI * 32.0, 1e-3);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_stand_apart_from_what_is_opaque),
        cmocka_unit_test(meshes_with_a_place_of_their_own_are_split_too),
        cmocka_unit_test(coordinates_and_normals_stay_with_their_corners_where_a_place_mirrors),
        cmocka_unit_test(glowing_triangles_keep_their_numbers_where_meshes_are_split),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
