/* tests/unit/test_scene_materials.c -- what glTF's materials and a study's are taken for. */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const quad floor_quad = { { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } } };

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

#define STUDY "lux4: 1\nscene: model.gltf\nlights: [{type: point, at: [2, 2, 9], lumens: 100}]\n"
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
    assert_true(noticed(
        &told, "1 material reflects more than 99.5 %, as no real surface does, first \"Wall\""));
    assert_false(s->hollow || s->narrow || s->textured || s->smooth || s->solids);
    assert_true(s->reflects);
    lab_close(&l);
}

/* The narrow lobe of what passes in part; wide ones settle. */
TEST(nearly_smooth_surfaces_that_are_clear_in_part_are_told_of)
{
    static const struct {
        const char *made_of;
        bool told;
    } rows[] = {
        { SURFACE("0", "0") "," TRANSMISSION("0.5"), true },
        { SURFACE("0", "0.09") "," TRANSMISSION("0.5"), true },
        { SURFACE("0", "0.11") "," TRANSMISSION("0.5"), false },
        { SURFACE("0", "0.09") "," TRANSMISSION("0"), false },
    };
    lab l;
    lab_open(&l);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        notices told;
        lab_quads(&l, "model.gltf", &floor_quad, 1,
                  text_of(&l.a, "\"name\":\"It\",%s", rows[i].made_of));
        scene_told(&l, STUDY, &told);
        assert_int_equal(noticed(&told, "results are slow to settle"), rows[i].told);
    }
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
    assert_non_null(strstr(scene_left_to_chance(s, false), "taken as clear"));
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
    assert_near(it->there, 0.25, 1e-6);
    assert_true(it->reflectance.x > 0.3f && it->reflectance.x < 0.5f); /* the lobe's horizon */
    assert_string_equal(info_of(s, "")->kind, "mirror");
    lab_close(&l);
}

TEST(tables_that_are_not_there_are_told_where_the_study_names_them)
{
    lab l;
    lab_open(&l);
    lux_error err = { 0 };
    notices told;
    lab_quads(&l, "model.gltf", &floor_quad, 1, "\"name\":\"It\"");
    assert_null(try_scene(&l, STUDY "materials: [{match: It, brdf: none.brdf}]\n", &told, &err));
    assert_non_null(strstr(err.text, "/study.yaml:4:13: "));
    assert_non_null(strstr(err.text, "none.brdf: no such file"));
    err = (lux_error){ 0 };
    assert_null(try_scene(&l, STUDY "materials: [{match: It, brdf: none.xml}]\n", &told, &err));
    assert_non_null(strstr(err.text, "/study.yaml:4:13: "));
    err = (lux_error){ 0 };
    lab_write(&l, "poor.brdf", "lux4 brdf 1\nparameters none\n");
    assert_null(try_scene(&l, STUDY "materials: [{match: It, brdf: poor.brdf}]\n", &told, &err));
    assert_non_null(strstr(err.text, "/poor.brdf:2: "));
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_gltf_material_is_of_the_kind_that_the_table_says),
        cmocka_unit_test(a_matt_paint_reflects_its_base_colour),
        cmocka_unit_test(nearly_smooth_surfaces_that_are_clear_in_part_are_told_of),
        cmocka_unit_test(a_pane_of_gltf_lets_base_colour_through),
        cmocka_unit_test(a_solid_absorbs_by_its_distance_in_the_study),
        cmocka_unit_test(a_study_replaces_all_but_glow_and_holes),
        cmocka_unit_test(tables_that_are_not_there_are_told_where_the_study_names_them),
        cmocka_unit_test(closed_plates_of_glass_are_taken_as_one_pane),
        cmocka_unit_test(plates_are_told_by_their_size_in_the_scene),
        cmocka_unit_test(studies_are_told_where_pane_and_box_do_not_fit),
        cmocka_unit_test(a_picture_of_holes_alone_has_no_colour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
