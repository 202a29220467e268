/* tests/unit/test_scene_materials.c -- what glTF's materials and a study's are taken for, and how
 * what lets light through stands apart.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const char lamp_ies[] =
    "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
    "1 -1 1 2 1 1 2 0 0 0\n1 1 25\n0 180\n0\n100 100\n";

static const quad floor_quad = { { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } } };

static quad level_quad(double z)
{
    return (quad){ { { 0, 0, z }, { 4, 0, z }, { 4, 4, z }, { 0, 4, z } } };
}

/* The scene of a study with what is told of it; NULL with *err. */
static const scene *try_scene(lab *l, const char *yaml, notices *told, lux_error *err)
{
    char path[4096];
    lab_write(l, "study.yaml", "%s", yaml);
    snprintf(path, sizeof path, "%s/study.yaml", l->folder);
    *told          = (notices){ .a = &l->a };
    const study *s = study_read(&l->a, path, NULL, told, err);
    return s ? scene_new(&l->a, s, &(scene_options){ .threads = 1 }, told, err) : NULL;
}

static const scene *scene_told(lab *l, const char *yaml, notices *told)
{
    lux_error err  = { 0 };
    const scene *s = try_scene(l, yaml, told, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static const scene_material *info_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->material_count; i++)
        if (!strcmp(s->material_info[i].name, name))
            return &s->material_info[i];
    fail_msg("no material %s", name);
    return NULL;
}

static const material *material_of(const scene *s, const char *name)
{
    return s->materials[info_of(s, name) - s->material_info];
}

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

#define ONE_NODE "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]"
#define STUDY    "lux4: 1\nscene: model.gltf\nlights: [{type: point, at: [2, 2, 9], lumens: 100}]\n"
#define GLASS                                                                                      \
    "\"name\":\"Glass\",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}" \
    "},\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0}"

/* ---- what glTF's materials are --------------------------------------------------------------- */

#define TRANSMISSION(t)                                                                            \
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":" t "}}"
#define SURFACE(m, r)                                                                              \
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":" m          \
    ",\"roughnessFactor\":" r "}"

TEST(each_gltf_material_is_of_the_kind_that_the_table_says)
{
    static const struct {
        const char *made_of, *kind;
    } rows[] = {
        { SURFACE("0", "1"), "diffuse" },
        { SURFACE("0", "0.99"), "gloss" },
        { SURFACE("1", "1"), "gloss" },
        { SURFACE("0.1", "1"), "gloss" },
        { "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]}", "diffuse" },
        { SURFACE("0", "0.1") ",\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}}",
          "diffuse" },
        { SURFACE("0", "1") ",\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0.9}}",
          "gloss" },
        { SURFACE("0", "1") ",\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.45}}", "diffuse" },
        { SURFACE("0", "1") ",\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.8}}", "gloss" },
        { SURFACE("1", "0") ",\"extensions\":{\"KHR_materials_unlit\":{}}", "diffuse" },
        { SURFACE("0", "0.02") "," TRANSMISSION("1"), "pane" },
        { SURFACE("0", "0.04") "," TRANSMISSION("1"), "gloss" },
        { SURFACE("0", "0") "," TRANSMISSION("0.5"), "gloss" },
        { SURFACE("1", "0") "," TRANSMISSION("1"), "gloss" },
        { SURFACE("0", "1") "," TRANSMISSION("1"), "gloss" },
        { SURFACE("0", "0") ",\"extensions\":{\"KHR_materials_transmission\":{"
                            "\"transmissionFactor\":1},\"KHR_materials_volume\":{"
                            "\"thicknessFactor\":1}}",
          "dielectric" },
        { SURFACE("0", "0") ",\"extensions\":{\"KHR_materials_transmission\":{"
                            "\"transmissionFactor\":1},\"KHR_materials_volume\":{"
                            "\"thicknessFactor\":0}}",
          "pane" },
    };
    lab l;
    lab_open(&l);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lab_quads(&l, "model.gltf", &floor_quad, 1,
                  text_of(&l.a, "\"name\":\"It\",%s", rows[i].made_of));
        const scene *s = lab_scene(&l, STUDY);
        if (strcmp(info_of(s, "It")->kind, rows[i].kind) != 0)
            fail_msg("%s, not %s: %s", info_of(s, "It")->kind, rows[i].kind, rows[i].made_of);
    }
    lab_close(&l);
}

TEST(a_matt_paint_reflects_its_base_colour)
{
    lab l;
    lab_open(&l);
    lab_quads(&l, "model.gltf", &floor_quad, 1,
              "\"name\":\"Wall\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,1,1],"
              "\"metallicFactor\":0}");
    notices told;
    const scene *s = scene_told(&l, STUDY, &told);
    vec3 r         = info_of(s, "Wall")->reflectance;
    assert_true(r.x == 0.1f && r.y == 0.2f && r.z == 0.995f); /* no more than any surface */
    assert_true(noticed(&told, "some materials reflect more than 99.5 %"));
    assert_false(s->hollow || s->narrow || s->textured || s->smooth || s->solids);
    assert_true(s->reflects);
    lab_close(&l);
}

static double straight(const material *m, float cosine, int channel)
{
    vvec3 up      = { vsplat(0), vsplat(0), vsplat(1) };
    vshading here = { .wo       = { vsplat(sqrtf(1 - cosine * cosine)), vsplat(0), vsplat(cosine) },
                      .n        = up,
                      .flat     = up,
                      .front    = vsplat(1) > 0.0f,
                      .distance = vsplat(1) };
    vrgb all      = materials_through(&m, vsplat_int(0), &here, ALL_LANES);
    return (double)lane(channel == 0 ? all.x : channel == 1 ? all.y : all.z, 0);
}

/* (1 - R) / (1 + R) = 2 n / (n^2 + 1) = 0.8 of n = 2 */
TEST(a_pane_of_gltf_lets_base_colour_through)
{
    lab l;
    lab_open(&l);
    lab_quads(&l, "model.gltf", &floor_quad, 1,
              "\"name\":\"Glass\",\"extensions\":{\"KHR_materials_ior\":{\"ior\":2},"
              "\"KHR_materials_transmission\":{\"transmissionFactor\":1}},"
              "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0,1],\"metallicFactor\":0,"
              "\"roughnessFactor\":0}");
    const scene *s     = lab_scene(&l, STUDY);
    const material *m  = material_of(s, "Glass");
    const double exact = 1e-5; /* float, by a logarithm and back */
    assert_near(straight(m, 1.0f, 0), 0.8, exact);
    assert_near(straight(m, 1.0f, 1), 0.4, exact);
    assert_near(straight(m, 1.0f, 2), 0.0, exact);
    assert_true(s->hollow && s->narrow && !s->solids);
    lab_close(&l);
}

/* exp(-absorption * distance) = color; the study doubles all lengths. */
TEST(a_solid_absorbs_by_its_distance_in_the_study)
{
    lab l;
    lab_open(&l);
    lab_quads(&l, "model.gltf", &floor_quad, 1,
              "\"name\":\"Block\",\"extensions\":{\"KHR_materials_transmission\":{"
              "\"transmissionFactor\":1},\"KHR_materials_volume\":{\"thicknessFactor\":1,"
              "\"attenuationDistance\":0.25,\"attenuationColor\":[1,0.5,0.1]}},"
              "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.5}");
    notices told;
    const scene *s = scene_told(&l,
                                "lux4: 1\nscene: {file: model.gltf, scale: 2}\n"
                                "lights: [{type: point, at: [2, 2, 9], lumens: 100}]\n",
                                &told);
    vec3 sigma     = material_of(s, "Block")->absorption;
    assert_near(sigma.x, 0.0, 0.0);
    assert_near(sigma.y, log(2.0) / 0.5, 1e-6); /* float */
    assert_near(sigma.z, log(10.0) / 0.5, 1e-6);
    assert_true(s->solids && s->hollow);
    assert_true(noticed(&told, "the rough border of a solid is taken as smooth"));
    assert_true(noticed(&told, "the light of lamps is taken to pass it straight"));
    lab_close(&l);
}

/* ---- what the study says instead ------------------------------------------------------------- */

TEST(a_study_replaces_all_but_glow_and_holes)
{
    lab l;
    lab_open(&l);
    lab_quads(&l, "model.gltf", &floor_quad, 1,
              "\"name\":\"It\",\"alphaMode\":\"BLEND\",\"emissiveFactor\":[1,0.5,0],"
              "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.9,0.9,0.9,0.25]}");
    const scene *s =
        lab_scene(&l, STUDY "materials: [{match: '*', mirror: 0.1}, {match: It, reflectance: 0.2,"
                            " specular: 0.3, exponent: 20}]\n");
    const scene_material *it = info_of(s, "It");
    assert_string_equal(it->kind, "phong");
    assert_true(it->overridden && it->holes);
    assert_near(it->emission.y, 0.5, 1e-6);
    assert_near(material_of(s, "It")->look.openness, 0.75, 1e-6);
    assert_true(it->reflectance.x > 0.3f && it->reflectance.x < 0.5f); /* the lobe's horizon */
    assert_string_equal(info_of(s, "")->kind, "mirror");
    lab_close(&l);
}

TEST(tables_are_read_once_and_their_errors_are_those_of_the_file)
{
    lab l;
    lab_open(&l);
    lux_error err = { 0 };
    notices told;
    lab_quads(&l, "model.gltf", &floor_quad, 1, "\"name\":\"It\"");
    assert_null(try_scene(&l, STUDY "materials: [{match: It, brdf: none.brdf}]\n", &told, &err));
    assert_non_null(strstr(err.text, "none.brdf"));
    assert_null(try_scene(&l, STUDY "materials: [{match: It, brdf: none.xml}]\n", &told, &err));
    assert_non_null(strstr(err.text, "none.xml"));
    lab_close(&l);
}

/* ---- panes and boxes ------------------------------------------------------------------------- */

static void box_model(lab *l, dvec3 high, int sides)
{
    quad q[6];
    quads_of_box((dvec3){ 0, 0, 0 }, high, q);
    lab_quads(l, "model.gltf", q, sides, GLASS);
}

TEST(closed_plates_of_glass_are_taken_as_one_pane)
{
    static const struct {
        dvec3 high;
        int sides;
        bool box;
    } rows[] = {
        { { 2, 0.006, 1 }, 6, true },
        { { 2, 0.006, 1 }, 5, false }, /* open */
        { { 1, 1, 1 }, 6, false },     /* a vessel: each of its walls is a pane */
        { { 1000, 0.006, 1 }, 6, true },
        { { 1, 0.2, 1 }, 6, false }, /* 2 V / A = 0.4 / 2.8 of the longest side: above 0.1 */
        { { 1, 0.1, 1 }, 6, true },  /* 0.2 / 2.4: below */
    };
    lab l;
    lab_open(&l);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        notices told;
        box_model(&l, rows[i].high, rows[i].sides);
        const scene *s = scene_told(&l, STUDY, &told);
        if (info_of(s, "Glass")->box != rows[i].box)
            fail_msg("row %zu: box is %d", i, info_of(s, "Glass")->box);
        assert_int_equal(noticed(&told, "closed boxes of glass: each is taken as one pane"),
                         rows[i].box);
    }
    lab_close(&l);
}

/* A unit cube that its node makes a plate; and two faces of one quad, which enclose nothing. */
TEST(plates_are_told_by_their_size_in_the_scene)
{
    lab l;
    lab_open(&l);
    quad q[6];
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 1, 1, 1 }, q);
    lab_write(&l, "model.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
              "\"mesh\":0,\"scale\":[2,1,-0.006]}],\"materials\":[{%s}],%s}",
              GLASS, lab_mesh(&l, q, 6, NULL, 0));
    assert_true(info_of(lab_scene(&l, STUDY), "Glass")->box);

    quad two[2] = { floor_quad, floor_quad };
    for (int i = 0; i < 4; i++)
        two[1].corner[i] = floor_quad.corner[3 - i];
    lab_quads(&l, "model.gltf", two, 2, GLASS);
    assert_false(info_of(lab_scene(&l, STUDY), "Glass")->box);
    lab_close(&l);
}

TEST(studies_are_told_where_pane_and_box_do_not_fit)
{
    lab l;
    lab_open(&l);
    notices told;
    box_model(&l, (dvec3){ 2, 0.006, 1 }, 6);
    const scene *s =
        scene_told(&l, STUDY "materials: [{match: Glass, transmittance: 0.8}]\n", &told);
    assert_false(info_of(s, "Glass")->box);
    assert_true(noticed(&told, "study.yaml:4:13: material \"Glass\" has closed boxes of glass"));
    assert_true(noticed(&told, "say `pane: box`"));

    s = scene_told(&l, STUDY "materials: [{match: Glass, transmittance: 0.8, pane: box}]\n", &told);
    assert_true(info_of(s, "Glass")->box);
    assert_false(noticed(&told, "pane: box"));

    box_model(&l, (dvec3){ 2, 0.006, 1 }, 4);
    scene_told(&l, STUDY "materials: [{match: Glass, transmittance: 0.8, pane: box}]\n", &told);
    assert_true(noticed(&told, "has surfaces that enclose nothing"));
    lab_close(&l);
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
    assert_true(s->texture_bytes >= 16);
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

/* What a study replaces keeps the holes of its picture, not its colours. */
TEST(a_picture_of_holes_alone_has_no_colour)
{
    lab l;
    lab_open(&l);
    const float texel[4] = { 0.2f, 0.4f, 0.6f, 0.25f };
    const texture_desc t = { .name = "t", .width = 1, .height = 1, .rgba = texel };
    material_textures of = { .alpha      = ALPHA_BLEND,
                             .alpha_only = true,
                             .base       = { .texture = texture_new(&l.a, &t, NULL),
                                             .m       = { 1, 0, 0, 0, 1, 0 } } };
    const diffuse_desc d = { { 0.5f, 0.5f, 0.5f }, { .textures = &of } };
    const material *m    = material_diffuse(&l.a, &d, NULL);
    vshading s           = { 0 };
    materials_look(&m, vsplat_int(0), &(vdetail){ 0 }, vsplat(0), ALL_LANES, &s);
    assert_near((double)lane(s.look.color.x, 0), 0.5, 0.0);
    assert_near((double)lane(s.look.openness, 0), 0.75, 0.0);
    assert_near((double)m->reflectance.y, 0.5, 0.0);
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
        cmocka_unit_test(each_gltf_material_is_of_the_kind_that_the_table_says),
        cmocka_unit_test(a_matt_paint_reflects_its_base_colour),
        cmocka_unit_test(a_pane_of_gltf_lets_base_colour_through),
        cmocka_unit_test(a_solid_absorbs_by_its_distance_in_the_study),
        cmocka_unit_test(a_study_replaces_all_but_glow_and_holes),
        cmocka_unit_test(tables_are_read_once_and_their_errors_are_those_of_the_file),
        cmocka_unit_test(closed_plates_of_glass_are_taken_as_one_pane),
        cmocka_unit_test(plates_are_told_by_their_size_in_the_scene),
        cmocka_unit_test(studies_are_told_where_pane_and_box_do_not_fit),
        cmocka_unit_test(panes_stand_apart_from_what_is_opaque),
        cmocka_unit_test(meshes_with_a_place_of_their_own_are_split_too),
        cmocka_unit_test(coordinates_and_normals_stay_with_their_corners_where_a_place_mirrors),
        cmocka_unit_test(a_picture_of_holes_alone_has_no_colour),
        cmocka_unit_test(glowing_triangles_keep_their_numbers_where_meshes_are_split),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
