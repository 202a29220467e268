/* tests/unit/test_gltf_hostile.c -- no file, however broken, does more than be refused. */
#include "sim/gltf.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* One pixel as PNG. */
#define PIXEL                                                                                      \
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGPYw/AfAAM3AbykcnaaAAAA"             \
    "AElFTkSuQmCC"

#define ASSET "\"asset\":{\"version\":\"2.0\"}"

static int forget(void **state)
{
    (void)state;
    scratch_remove();
    return 0;
}

/* That the file is refused by an error that holds `sentence` (NULL: any of one line). */
static void assert_refused(const char *name, const void *bytes, size_t size, const char *sentence)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    lux_error err = { 0 };
    const gltf *g = read_bytes(&a, name, bytes, size, &n, &err);
    if (g)
        fail_msg("read, though it should be refused: %s: %.300s", sentence, (const char *)bytes);
    assert_int_not_equal(err.code, ERR_NONE);
    assert_true(err.text[0] && !strchr(err.text, '\n'));
    assert_non_null(strstr(err.text, name));
    if (sentence && !strstr(err.text, sentence))
        fail_msg("\"%s\" does not say \"%s\"", err.text, sentence);
    arena_clear(&a);
}

static void assert_text_refused(const char *text, const char *sentence)
{
    assert_refused("scene.gltf", text, strlen(text), sentence);
}

/* That what gltf.h says of a light holds. */
static void assert_light(const gltf *g, const gltf_light *l)
{
    assert_true(l->node < g->node_count);
    assert_true(l->intensity >= 0 && isfinite(l->intensity));
    assert_true(l->color.x >= 0 && l->color.y >= 0 && l->color.z >= 0);
    if (l->kind == GLTF_IES) {
        assert_true(!l->photometry_path != !l->photometry_bytes);
        assert_true(!l->photometry_bytes || !l->photometry_bytes[l->photometry_size]);
        assert_true(l->multiplier >= 0 && isfinite(l->multiplier));
    }
    if (l->kind == GLTF_AREA_RECT)
        assert_true(l->width > 0 && l->height > 0 && isfinite((float)(l->width * l->height)));
    if (l->kind == GLTF_AREA_DISK)
        assert_true(l->radius > 0 && isfinite((float)(l->radius * l->radius)));
}

/* That it does not crash; whether it is read. */
static bool survives(const void *bytes, size_t size)
{
    arena a       = { 0 };
    notices n     = { .a = &a };
    lux_error err = { 0 };
    const gltf *g = read_bytes(&a, "scene.gltf", bytes, size, &n, &err);
    for (uint32_t i = 0; g && i < g->mesh_count; i++) {
        const mesh *m = &g->meshes[i].triangles;
        for (uint32_t k = 0; k < 3 * m->triangle_count; k++)
            assert_true(m->corners[k] < m->position_count);
        for (uint32_t k = 0; k < m->triangle_count; k++)
            assert_true(m->material[k] < g->material_count);
    }
    for (uint32_t i = 0; g && i < g->placement_count; i++)
        assert_true(g->placements[i].mesh < g->mesh_count && g->placements[i].node < g->node_count);
    for (uint32_t i = 0; g && i < g->light_count; i++)
        assert_light(g, &g->lights[i]);
    assert_true(g || (err.code != ERR_NONE && !strchr(err.text, '\n')));
    arena_clear(&a);
    return g != NULL;
}

/* A scene that uses everything that is read. The buffer: 4 positions (48 bytes), 6 indices of 2
 * bytes (12), a sparse index (2) and pad (2), a sparse value (12), 2 moves (24): 100 bytes. */
static uint8_t whole_buffer[100];

static char *whole_scene(arena *a, bool binary)
{
    static const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 };
    static const uint16_t indices[8] = { 0, 1, 2, 2, 1, 3, 3, 0 };
    static const float rest[9]       = { 1, 2, 3, 4, 5, 6, 7, 8, 9 };
    memcpy(whole_buffer, positions, 48);
    memcpy(whole_buffer + 48, indices, 16);
    memcpy(whole_buffer + 64, rest, 36);
    const char *uri = binary ? "" : text_of(a, "\"uri\":\"%s\",", data_uri(a, whole_buffer, 100));
    return text_of(
        a,
        "{" ASSET
        ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"extensionsUsed\":[\"KHR_lights_punctual\"],"
        "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"buffers\":[{%s\"byteLength\":100}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48,\"byteStride\":12},{"
        "\"buffer\":0,"
        "\"byteOffset\":48,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":2},{"
        "\"buffer\":0,"
        "\"byteOffset\":64,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":76,\"byteLength\":24}],"
        "\"accessors\":[{\"bufferView\":0,\"byteOffset\":0,\"componentType\":5126,\"count\":4,"
        "\"type\":\"VEC3\","
        "\"normalized\":false,\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":2,\"byteOffset\":"
        "0,"
        "\"componentType\":5123},\"values\":{\"bufferView\":3,\"byteOffset\":0}}},{\"bufferView\":"
        "1,"
        "\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},{\"bufferView\":4,"
        "\"componentType\":5126,"
        "\"count\":2,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5121,\"count\":4,"
        "\"type\":\"VEC2\",\"normalized\":true}],\"meshes\":[{\"name\":\"m\",\"primitives\":[{"
        "\"attributes\":{"
        "\"POSITION\":0,\"NORMAL\":0,\"TEXCOORD_0\":3},\"indices\":1,\"material\":0,\"mode\":4}]}],"
        "\"materials\":[{\"name\":"
        "\"x\","
        "\"emissiveFactor\":[0,0,1],\"alphaMode\":\"OPAQUE\",\"pbrMetallicRoughness\":{"
        "\"baseColorFactor\":"
        "[0,0,0,1],\"metallicFactor\":0,\"roughnessFactor\":1},\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":2},\"KHR_materials_"
        "transmission\":{"
        "\"transmissionFactor\":0},\"KHR_materials_ior\":{\"ior\":1.5},\"KHR_materials_specular\":"
        "{\"specularFactor\":1,\"specularColorFactor\":[1,1,1],\"specularTexture\":{\"index\":"
        "0}},\"KHR_materials_volume\":{\"thicknessFactor\":0,\"attenuationDistance\":1,"
        "\"attenuationColor\":[1,1,1]}},\"normalTexture\":{\"index\":0,\"texCoord\":0,\"scale\":"
        "1,\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0,0],\"rotation\":0,\"scale\":"
        "[1,1],\"texCoord\":0}}}}],\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{"
        "\"magFilter\":9729,\"wrapS\":10497}],\"images\":[{\"uri\":\"data:image/png;base64," PIXEL
        "\"}],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{"
        "\"yfov\":1,"
        "\"znear\":1,\"aspectRatio\":1}},{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,"
        "\"ymag\":1,"
        "\"znear\":0,\"zfar\":1}}],\"nodes\":[{\"children\":[1,2],\"matrix\":[1,0,0,0,0,1,0,0,0,0,"
        "1,0,0,0,0,1],"
        "\"camera\":0},{\"mesh\":0,\"translation\":[1,2,3],\"rotation\":[0,0,0,1],\"scale\":[1,1,1]"
        ","
        "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":2}}}},{"
        "\"name\":\"n\","
        "\"camera\":1,\"extensions\":{\"KHR_lights_punctual\":{\"light\":0},\"EXT_lights_ies\":{"
        "\"light\":1,\"multiplier\":2,\"color\":[1,1,1]},\"EXT_lights_area\":{\"light\":0}}}],"
        "\"animations\":[{"
        "\"channels\":[],"
        "\"samplers\":[]}],\"skins\":[{\"joints\":[0]}],\"extensions\":{\"KHR_lights_punctual\":{"
        "\"lights\":[{"
        "\"type\":\"spot\",\"color\":[1,1,1],\"intensity\":5,\"range\":3,\"spot\":{"
        "\"innerConeAngle\":0,"
        "\"outerConeAngle\":0.5}}]},\"EXT_lights_ies\":{\"lights\":[{\"uri\":\"a.ies\"},{"
        "\"bufferView\":1,\"mimeType\":\"application/x-ies-lm-63\"}]},\"EXT_lights_area\":{"
        "\"lights\":[{\"type\":\"rect\",\"shape\":\"rect\",\"intensity\":5,\"size\":1,\"color\":"
        "[1,1,1],\"rect\":{\"aspect\":2}},{\"shape\":\"disk\",\"luminance\":5,\"width\":1,"
        "\"height\":1,\"radius\":1}]}}}",
        uri);
}

TEST(the_scene_that_is_broken_below_is_good)
{
    arena a    = { 0 };
    char *text = whole_scene(&a, false);
    assert_true(survives(text, strlen(text)));
    arena_clear(&a);
}

TEST(what_is_no_file_is_refused)
{
    lux_error err = { 0 };
    arena a       = { 0 };
    assert_null(gltf_read(&a, "no/such/scene.gltf", NULL, &err));
    assert_int_equal(err.code, ERR_IO);
    assert_null(gltf_read(&a, "/tmp", NULL, &err));
    arena_clear(&a);
    assert_refused("scene.gltf", "", 0, "empty");
    assert_refused("scene.gltf", "\0\1\2\3\4\5\6\7", 8, NULL);
    assert_text_refused("hello", NULL);
    assert_text_refused("[1,2]", "an array, wanted an object");
    assert_text_refused("{}", "no \"asset\"");
}

TEST(every_truncation_is_refused)
{
    arena a = { 0 };
    size_t size;
    char *text = whole_scene(&a, false), *json = whole_scene(&a, true);
    for (size_t length = 0; length < strlen(text); length += 3)
        assert_refused("scene.gltf", text, length, NULL);
    assert_refused("scene.gltf", text, strlen(text) - 1, "the JSON ends here");

    uint8_t *glb = make_glb(&a, json, whole_buffer, sizeof whole_buffer, &size);
    assert_true(survives(glb, size));
    for (size_t length = 0; length < size; length += 3)
        assert_refused("scene.gltf", glb, length, NULL);
    assert_refused("scene.gltf", glb, size - 1, "a length of");
    arena_clear(&a);
}

/* The end of the JSON value at p, which is well formed. */
static const char *value_end(const char *p)
{
    int depth = 0;
    do {
        if (*p == '"') {
            for (p++; *p != '"'; p++)
                p += *p == '\\';
            p++;
        } else if (*p == '{' || *p == '[') {
            depth++, p++;
        } else if (*p == '}' || *p == ']') {
            depth--, p++;
        } else if (depth) {
            p++;
        } else {
            p += strcspn(p, ",]}");
        }
    } while (depth);
    return p;
}

TEST(any_value_may_be_anything)
{
    static const char *const others[] = { "7",  "-1", "1e14", "1e400", "2147483648", "\"x\"",
                                          "{}", "[]", "null", "true",  "\"\"",       "0.5" };
    arena a                           = { 0 };
    const char *text                  = whole_scene(&a, false);
    char *changed                     = arena_array(&a, char, strlen(text) + 64, NULL);
    char within[32]                   = "";
    int depth = 0, values = 0, read = 0;
    for (const char *p = text; *p; p++) {
        char before = p > text ? p[-1] : 0;
        bool starts = before == ':' || (before == '[' && *p != ']') ||
                      (before == ',' && within[depth] == '[');
        for (size_t k = 0; starts && k < sizeof others / sizeof *others; k++, values++) {
            int size = sprintf(changed, "%.*s%s%s", (int)(p - text), text, others[k], value_end(p));
            read += survives(changed, (size_t)size);
        }
        if (*p == '"')
            p = value_end(p) - 1;
        else if (*p == '{' || *p == '[')
            within[++depth] = *p;
        else if (*p == '}' || *p == ']')
            depth--;
    }
    assert_true(values > 1000);
    assert_true(read > 100 && read < values / 2); /* some fit or are not looked at, most do not */
    arena_clear(&a);
}

TEST(a_byte_changed_anywhere_is_survived)
{
    arena a = { 0 };
    size_t size;
    uint8_t *glb  = make_glb(&a, whole_scene(&a, true), whole_buffer, sizeof whole_buffer, &size);
    uint32_t dice = 1;
    for (size_t i = 0; i < size; i++) {
        uint8_t good = glb[i];
        dice         = dice * 1664525u + 1013904223u;
        glb[i]       = (uint8_t)(dice >> 24);
        survives(glb, size);
        glb[i] = good;
    }
    arena_clear(&a);
}

/* The whole scene with `from` replaced by `to` is refused by `sentence`. */
static void assert_change_refused(const char *from, const char *to, const char *sentence)
{
    arena a          = { 0 };
    const char *text = whole_scene(&a, false), *at = strstr(text, from);
    assert_non_null(at);
    assert_text_refused(text_of(&a, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from)),
                        sentence);
    arena_clear(&a);
}

TEST(an_error_names_the_pointer_and_what_is_wrong)
{
    assert_change_refused("\"POSITION\":0", "\"POSITION\":7",
                          "/meshes/0/primitives/0/attributes/POSITION: accessor 7 of 4");
    assert_change_refused("\"indices\":1", "\"indices\":77",
                          "/meshes/0/primitives/0/indices: accessor 77 of 4");
    assert_change_refused("\"material\":0", "\"material\":1",
                          "/meshes/0/primitives/0/material: material 1 of 1");
    assert_change_refused("\"mesh\":0", "\"mesh\":1", "/nodes/1/mesh: mesh 1 of 1");
    assert_change_refused("\"camera\":1", "\"camera\":2", "/nodes/2/camera: camera 2 of 2");
    assert_change_refused("\"light\":0", "\"light\":3",
                          "/nodes/2/extensions/KHR_lights_punctual/light: light 3 of 1");
    assert_change_refused("\"scene\":0", "\"scene\":5", "/scene: scene 5 of 1");
    assert_change_refused("[{\"nodes\":[0]}]", "[{\"nodes\":[9]}]",
                          "/scenes/0/nodes/0: node 9 of 3");
    assert_change_refused("{\"buffer\":0", "{\"buffer\":77",
                          "/bufferViews/0/buffer: buffer 77 of 1");
    assert_change_refused("\"bufferView\":1,", "\"bufferView\":6,",
                          "/accessors/1/bufferView: bufferView 6 of 5");
    assert_change_refused("\"count\":4", "\"count\":5", "/accessors/0: 5 elements, 12 bytes apart");
    assert_change_refused("\"count\":4", "\"count\":100000000000000",
                          "/accessors/0: 100000000000000 elements");
    assert_change_refused("\"count\":4", "\"count\":1e14",
                          "/accessors/0/count: 1e14, wanted an integer");
    assert_change_refused("\"byteOffset\":76", "\"byteOffset\":77",
                          "/bufferViews/4: 24 bytes from byte 77 on; buffer 0 has 100 bytes");
    assert_change_refused("\"byteOffset\":76", "\"byteOffset\":9007199254740991",
                          "/bufferViews/4: 24 bytes");
    assert_change_refused("\"byteLength\":100", "\"byteLength\":101",
                          "/buffers/0/uri: 100 bytes, byteLength wants 101");
    assert_change_refused("\"bufferView\":3", "\"bufferView\":30",
                          "/accessors/0/sparse/values/bufferView");
    assert_change_refused("\"count\":1", "\"count\":2", "/accessors/0/sparse/indices: 2 elements");
    assert_change_refused("\"translation\":[1,2,3]", "\"translation\":[1,2]",
                          "/nodes/1/translation: 2 numbers, wanted 3");
    assert_change_refused("\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0,0]", "/nodes/1/rotation");
    assert_change_refused("1,2,3],\"rot", "1,2,1e999],\"rot",
                          "/nodes/1/translation/2: 1e999, wanted a finite");
    assert_change_refused("\"scale\":[1,1,1]", "\"scale\":[1e300,1e300,1]", NULL);
    assert_change_refused("\"nodes\":[{", "\"nodes\":7,\"x\":[{",
                          "/nodes: 7, wanted an array of objects");
    assert_change_refused("\"mode\":4", "\"mode\":4,\"mode\":5",
                          "/meshes/0/primitives/0/mode: it is there twice");
    assert_change_refused("0,0,0,1],\"cam", "0,0,0,2],\"cam", "/nodes/0/matrix: the last row is");
}

/* Whole numbers beyond 32 bits would come out of the library as others. */
TEST(large_whole_numbers_are_refused_not_wrapped)
{
    assert_change_refused("\"emissiveStrength\":2", "\"emissiveStrength\":4294967297",
                          "/emissiveStrength: 4294967297, wanted 0 to 2e+09");
    assert_change_refused("\"multiplier\":2", "\"multiplier\":2147483648",
                          "/multiplier: 2147483648, wanted");
    assert_change_refused("\"size\":1", "\"size\":4294967297", "/size: 4294967297, wanted above 0");
}

/* Once a key like "mesh\u0065s" passed every rule, and the library read it: a crash. */
TEST(a_key_does_not_hide_behind_an_escape)
{
    assert_text_refused("{" ASSET ",\"m\\u0065shes\":[{\"primitives\":[{\"attributes\":"
                        "{\"POSITION\":0}}]}]}",
                        "/m\\u0065shes: a key with a backslash");
    assert_change_refused("\"light\":1", "\"l\\u0069ght\":9", "a key with a backslash");
    static const char extras[] = "{" ASSET ",\"extras\":{\"caf\\u00e9\":1}}";
    assert_true(survives(extras, strlen(extras)));
}

TEST(a_graph_with_cycles_or_two_parents_is_refused)
{
    assert_text_refused("{" ASSET
                        ",\"nodes\":[{\"children\":[1]},{\"children\":[2]},{\"children\":[1]}]}",
                        "is a child of node 0 already");
    assert_text_refused("{" ASSET ",\"nodes\":[{},{\"children\":[2]},{\"children\":[1]}]}",
                        "is its own ancestor");
    assert_text_refused("{" ASSET ",\"nodes\":[{\"children\":[0]}]}",
                        "/nodes/0: the node is its own ancestor");
    assert_text_refused("{" ASSET
                        ",\"scenes\":[{\"nodes\":[1]}],\"nodes\":[{\"children\":[1]},{}]}",
                        "/scenes/0/nodes/0: node 1 is no root, but a child of node 0");
    assert_text_refused("{" ASSET ",\"nodes\":[{\"children\":[1]}]}",
                        "/nodes/0/children/0: node 1 of 1");
}

/* "[[[...]]]" within an object, `depth` deep. */
static char *nested(arena *a, size_t depth)
{
    char *text = text_of(a, "{" ASSET ",\"extras\":%*s}", (int)(2 * depth), "");
    char *at   = strchr(text, ' ');
    memset(at, '[', depth);
    memset(at + depth, ']', depth);
    return text;
}

TEST(deep_json_is_refused_before_anybody_walks_into_it)
{
    arena a = { 0 };
    size_t size;
    char *text = nested(&a, 100000);
    assert_text_refused(text, "nested more than 256 deep");
    uint8_t *glb = make_glb(&a, text, NULL, 0, &size);
    assert_refused("scene.glb", glb, size, "nested more than 256 deep");
    text = nested(&a, 250);
    assert_true(survives(text, strlen(text)));
    arena_clear(&a);
}

TEST(a_deep_hierarchy_is_walked_without_a_stack)
{
    enum { DEEP = 100000 };
    arena a    = { 0 };
    char *text = arena_array(&a, char, 100 + 24 * (size_t)DEEP, NULL);
    char *at   = text + sprintf(text, "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (int i = 1; i < DEEP; i++)
        at += sprintf(at, "{\"children\":[%d]},", i);
    at += sprintf(at, "{\"translation\":[1,2,3]}]}");
    lux_error err = { 0 };
    const gltf *g = read_bytes(&a, "scene.gltf", text, (size_t)(at - text), NULL, &err);
    assert_non_null(g);
    assert_int_equal(g->node_count, DEEP);
    assert_near(g->nodes[DEEP - 1].place.m[1][3], -3, 0);
    arena_clear(&a);
}

TEST(numbers_in_buffers_are_checked)
{
    static const char scene[] =
        "{" ASSET ",\"buffers\":[{\"byteLength\":42,\"uri\":\"%s\"}],\"bufferViews\":"
        "[{\"buffer\":0,\"byteLength\":42}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":0,"
        "\"byteOffset\":36,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]}";
    struct {
        float p[9];
        uint16_t i[3];
    } b     = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 1, 3 } };
    arena a = { 0 };
    assert_text_refused(text_of(&a, scene, data_uri(&a, &b, 42)),
                        "/meshes/0/primitives/0/indices: index 2 is 3, of 3 positions");
    b.i[2]     = 2;
    char *text = text_of(&a, scene, data_uri(&a, &b, 42));
    assert_true(survives(text, strlen(text)));
    for (int k = 0; k < 2; k++) {
        b.p[4] = k ? NAN : -INFINITY;
        assert_text_refused(text_of(&a, scene, data_uri(&a, &b, 42)),
                            "/meshes/0/primitives/0/attributes/POSITION: position 1 of accessor 0");
    }
    arena_clear(&a);
}

TEST(more_than_a_file_can_stand_for_is_refused)
{
    assert_text_refused(
        "{" ASSET ",\"accessors\":[{\"componentType\":5126,\"count\":90000000,\"type\":\"VEC3\"}]}",
        "/accessors/0/count: 90000000 elements without a bufferView");
}

TEST(a_picture_that_is_not_there_is_named)
{
    static const char scene[] =
        "{" ASSET ",\"images\":[%s],\"textures\":[{\"source\":%d}],\"materials\":"
        "[{\"normalTexture\":{\"index\":%d}}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"buffers\":[{"
        "\"byteLength\":36,\"uri\":\"%s\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
        "\"VEC3\"}]}";
    static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    arena a                        = { 0 };
    const char *uri                = data_uri(&a, triangle, sizeof triangle);
    assert_text_refused(text_of(&a, scene, "{\"uri\":\"none.png\"}", 0, 0, uri), "/images/0/uri: ");
    assert_text_refused(text_of(&a, scene, "{\"uri\":\"../none.png\"}", 0, 0, uri),
                        "/images/0/uri: \"../none");
    assert_text_refused(text_of(&a, scene, "{\"uri\":\"data:image/png;base64,AAAA\"}", 0, 0, uri),
                        "/images/0/uri: ");
    assert_text_refused(text_of(&a, scene, "{\"bufferView\":3}", 0, 0, uri),
                        "/images/0/bufferView: bufferView 3 of 1");
    assert_text_refused(text_of(&a, scene, "{}", 1, 0, uri), "/textures/0/source: image 1 of 1");
    assert_text_refused(text_of(&a, scene, "{}", 0, 2, uri),
                        "/materials/0/normalTexture/index: texture 2 of 1");
    arena_clear(&a);
}

static void assert_uri_refused(const char *uri, const char *sentence)
{
    arena a = { 0 };
    assert_text_refused(
        text_of(&a, "{" ASSET ",\"buffers\":[{\"byteLength\":4,\"uri\":\"%s\"}]}", uri), sentence);
    arena_clear(&a);
}

TEST(a_uri_does_not_leave_the_folder)
{
    char outside[128], link[128], name[160];
    snprintf(outside, sizeof outside, "%s/../lux4_outside_XXXXXX", scratch_folder());
    int fd = mkstemp(outside);
    assert_int_equal(write(fd, "abcd", 4), 4);
    close(fd);
    snprintf(link, sizeof link, "%s/link.bin", scratch_folder());
    assert_int_equal(symlink(outside, link), 0);

    assert_uri_refused("link.bin", "/buffers/0/uri: \"link.bin\" leaves the scene's folder");
    assert_uri_refused(outside, "leaves the scene's folder");
    assert_uri_refused("../nothing.bin", "leaves the scene's folder");
    assert_uri_refused("%2e%2e/nothing.bin", "leaves the scene's folder");
    assert_uri_refused("a/../../nothing.bin", "leaves the scene's folder");
    snprintf(name, sizeof name, "..%s", strrchr(outside, '/'));
    assert_uri_refused(name, "leaves the scene's folder");
    snprintf(name, sizeof name, "..\\/%s", strrchr(outside, '/') + 1);
    assert_uri_refused(name, "leaves the scene's folder");
    assert_uri_refused("http://example.com/a.bin", "wanted a file in the scene's folder");
    assert_uri_refused("file:///etc/passwd", "wanted a file in the scene's folder");
    assert_uri_refused("missing.bin", "no such file");
    assert_uri_refused("", "names no file");
    assert_uri_refused(".", "leaves the scene's folder");
    assert_uri_refused("a%00b", "names no file");
    assert_uri_refused("a\\u0000b", "stands for no character");
    assert_uri_refused("data:;base64,AA!A", "not base64");
    assert_uri_refused("data:,abcd", "base64");
    unlink(link);
    unlink(outside);
}

/* Reads every scene below a folder; how many there were. */
static int read_all_below(const char *folder, int *refused)
{
    DIR *d    = opendir(folder);
    int count = 0;
    for (const struct dirent *e; d && (e = readdir(d));) {
        char path[1024];
        struct stat s;
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        const char *dot = strrchr(e->d_name, '.');
        if (e->d_name[0] == '.' || stat(path, &s) != 0)
            continue;
        if (S_ISDIR(s.st_mode)) {
            count += read_all_below(path, refused);
        } else if (dot && (!strcmp(dot, ".gltf") || !strcmp(dot, ".glb"))) {
            arena a       = { 0 };
            lux_error err = { 0 };
            bool read     = gltf_read(&a, path, NULL, &err) != NULL;
            assert_true(read || (err.code != ERR_NONE && !strncmp(err.text, path, strlen(path))));
            *refused += !read;
            count++;
            arena_clear(&a);
        }
    }
    if (d)
        closedir(d);
    return count;
}

TEST(every_file_of_others_is_read_or_refused_with_a_reason)
{
    int refused = 0;
    if (!read_all_below("../shared/data/gltf", &refused))
        skip();
}

TEST(what_the_khronos_validator_calls_an_error_is_refused)
{
    static const char *const wrong[] = {
        "asset/invalid_version",
        "asset/min_version_invalid",
        "buffer/not_found",
        "buffer/zero_bytelength",
        "camera/empty_objects",
        "camera/infinite_znear",
        "mesh/unresolved_indices",
        "mesh/unresolved_material",
        "mesh/unresolved_positions",
        "mesh/indices_invalid_format",
        "mesh/position_accessor_invalid_format",
        "node/node_loop",
        "node/node_loop_scene",
        "node/node_parent_override",
        "node/unresolved_camera",
        "node/unresolved_child_node",
        "node/unresolved_mesh",
        "node/unresolved_skin",
        "node/matrix_indecomposable",
        "node/infinite_transform",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char path[256];
        struct stat s;
        arena a       = { 0 };
        lux_error err = { 0 };
        snprintf(path, sizeof path, "../shared/data/gltf/khronos_validator/base/data/%s.gltf",
                 wrong[i]);
        if (stat(path, &s) == 0 && gltf_read(&a, path, NULL, &err))
            fail_msg("%s is read", path);
        arena_clear(&a);
    }
}

#define HOSTILE(name) cmocka_unit_test_teardown(name, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        HOSTILE(the_scene_that_is_broken_below_is_good),
        HOSTILE(what_is_no_file_is_refused),
        HOSTILE(every_truncation_is_refused),
        HOSTILE(any_value_may_be_anything),
        HOSTILE(a_byte_changed_anywhere_is_survived),
        HOSTILE(an_error_names_the_pointer_and_what_is_wrong),
        HOSTILE(large_whole_numbers_are_refused_not_wrapped),
        HOSTILE(a_key_does_not_hide_behind_an_escape),
        HOSTILE(a_graph_with_cycles_or_two_parents_is_refused),
        HOSTILE(deep_json_is_refused_before_anybody_walks_into_it),
        HOSTILE(a_deep_hierarchy_is_walked_without_a_stack),
        HOSTILE(numbers_in_buffers_are_checked),
        HOSTILE(more_than_a_file_can_stand_for_is_refused),
        HOSTILE(a_picture_that_is_not_there_is_named),
        HOSTILE(a_uri_does_not_leave_the_folder),
        HOSTILE(every_file_of_others_is_read_or_refused_with_a_reason),
        HOSTILE(what_the_khronos_validator_calls_an_error_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
