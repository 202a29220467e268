/* tests/unit/test_gltf.c -- what a glTF file says is what is read, in our frame.
 *
 * Expected values are worked out by hand from the glTF 2.0 specification; (x, y, z) of glTF is
 * (x, -z, y) of ours.
 */
#include "sim/gltf.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <string.h>

#define ASSET    "\"asset\":{\"version\":\"2.0\"}"
#define ONE_NODE "\"scene\":0,\"scenes\":[{\"nodes\":[0]}]"

static arena memory;
static notices said;
static lux_error error;

static const gltf *read_text(const char *text)
{
    said          = (notices){ .a = &memory };
    error         = (lux_error){ 0 };
    const gltf *g = read_bytes(&memory, "scene.gltf", text, strlen(text), &said, &error);
    if (!g)
        print_message("%s\n", error.text);
    return g;
}

static int forget(void **state)
{
    (void)state;
    scratch_remove();
    arena_clear(&memory);
    return 0;
}

/* A scene of one node with one mesh: `bytes` as the buffer, the rest as given. */
static const gltf *read_mesh(const void *bytes, size_t size, const char *views,
                             const char *accessors, const char *primitives, const char *more)
{
    return read_text(
        text_of(&memory,
                "{" ASSET "," ONE_NODE ",\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}],"
                "\"bufferViews\":[%s],\"accessors\":[%s],\"meshes\":[{\"name\":\"M\","
                "\"primitives\":[%s]}],\"nodes\":[{\"mesh\":0}]%s}",
                size, data_uri(&memory, bytes, size), views, accessors, primitives, more));
}

static void assert_vec(vec3 got, double x, double y, double z)
{
    assert_near(got.x, x, 1e-6);
    assert_near(got.y, y, 1e-6);
    assert_near(got.z, z, 1e-6);
}

static void assert_point(const transform *t, dvec3 from, double x, double y, double z)
{
    dvec3 got = transform_point(t, from);
    assert_near(got.x, x, 1e-12);
    assert_near(got.y, y, 1e-12);
    assert_near(got.z, z, 1e-12);
}

static void assert_corners(const mesh *m, uint32_t triangle, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(triangle < m->triangle_count);
    assert_int_equal(m->corners[3 * triangle], a);
    assert_int_equal(m->corners[3 * triangle + 1], b);
    assert_int_equal(m->corners[3 * triangle + 2], c);
}

/* Five points of a zigzag, of which any three are a triangle. */
static const float zigzag[15] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 2, 3 };
static const char all_bytes[] = "{\"buffer\":0,\"byteLength\":60}";
static const char floats5[] =
    "{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}";

static const mesh *read_zigzag(const char *primitives, const char *more)
{
    const gltf *g = read_mesh(zigzag, sizeof zigzag, all_bytes, floats5, primitives, more);
    assert_non_null(g);
    assert_int_equal(g->mesh_count, 1);
    return &g->meshes[0].triangles;
}

TEST(strips_and_fans_turn_as_the_specification_says)
{
    const mesh *m = read_zigzag("{\"attributes\":{\"POSITION\":0},\"mode\":5}", "");
    assert_int_equal(m->triangle_count, 3);
    assert_int_equal(m->position_count, 5);
    assert_corners(m, 0, 0, 1, 2);
    assert_corners(m, 1, 1, 3, 2);
    assert_corners(m, 2, 2, 3, 4);

    m = read_zigzag("{\"attributes\":{\"POSITION\":0},\"mode\":6}", "");
    assert_int_equal(m->triangle_count, 3);
    assert_corners(m, 0, 1, 2, 0);
    assert_corners(m, 2, 3, 4, 0);
}

TEST(geometry_without_indices_is_one_triangle_after_the_other)
{
    const mesh *m = read_zigzag("{\"attributes\":{\"POSITION\":0}}", "");
    assert_int_equal(m->triangle_count, 1); /* two points are left over */
    assert_corners(m, 0, 0, 1, 2);
    assert_vec(m->positions[4], 0, 2, 3);
    assert_int_equal(said.count, 0);
}

TEST(primitives_share_positions_and_keep_their_materials)
{
    const mesh *m = read_zigzag("{\"attributes\":{\"POSITION\":0},\"material\":1},"
                                "{\"attributes\":{\"POSITION\":0},\"mode\":6}",
                                ",\"materials\":[{},{\"name\":\"B\"}]");
    assert_int_equal(m->position_count, 5);
    assert_int_equal(m->triangle_count, 4);
    assert_int_equal(m->material[0], 1);
    assert_int_equal(m->material[1], 2); /* the default one, behind the two of the file */
}

TEST(points_lines_colours_and_targets_are_noticed_once)
{
    const mesh *m = read_zigzag(
        "{\"attributes\":{\"POSITION\":0},\"mode\":0},"
        "{\"attributes\":{\"POSITION\":0},\"mode\":3},"
        "{\"attributes\":{\"POSITION\":0,\"COLOR_0\":0},\"targets\":[{\"POSITION\":0}]}",
        "");
    assert_int_equal(m->triangle_count, 1);
    assert_int_equal(said.count, 3);
    assert_true(noticed(&said, "/meshes/0/primitives/0: 2 primitives of points or lines"));
    assert_true(noticed(&said, "COLOR_0"));
    assert_true(noticed(&said, "morph"));
}

TEST(triangles_without_area_are_left_out_and_counted)
{
    static const struct {
        float p[12];
        uint8_t i[12];
    } b           = { { 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0 }, { 0, 1, 2, 0, 1, 3, 3, 3, 1 } };
    const gltf *g = read_mesh(
        &b, sizeof b,
        "{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":9}",
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5121,\"count\":9,\"type\":\"SCALAR\"}",
        "{\"attributes\":{\"POSITION\":0},\"indices\":1}", "");
    assert_non_null(g);
    assert_int_equal(g->meshes[0].triangles.triangle_count, 1);
    assert_corners(&g->meshes[0].triangles, 0, 0, 1, 3);
    assert_true(noticed(&said, "2 triangles without area"));
}

TEST(a_mesh_of_nothing_is_not_placed)
{
    const gltf *g = read_mesh(zigzag, sizeof zigzag, all_bytes, floats5,
                              "{\"attributes\":{\"POSITION\":0},\"mode\":1}", "");
    assert_non_null(g);
    assert_int_equal(g->placement_count, 0);
    assert_true(noticed(&said, "no triangles"));
}

/* The first of three elements 8 bytes apart, 2 bytes into the view: shorts or bytes, and 77s
 * that are no position. */
static vec3 quantised(int component, const char *normalized)
{
    static const int16_t b[13] = { 99, 32767, 0, -32768, 77, 0, 16384, 1, 77, -32767, 2, 3, 77 };
    const gltf *g =
        read_mesh(b, sizeof b, "{\"buffer\":0,\"byteLength\":26,\"byteStride\":8}",
                  text_of(&memory,
                          "{\"bufferView\":0,\"byteOffset\":2,\"componentType\":%d,\"count\":3,"
                          "\"type\":\"VEC3\",\"normalized\":%s}",
                          component, normalized),
                  "{\"attributes\":{\"POSITION\":0}}", "");
    assert_non_null(g);
    assert_int_equal(g->meshes[0].triangles.position_count, 3);
    return g->meshes[0].triangles.positions[0];
}

TEST(interleaved_and_quantised_positions_are_read)
{
    assert_vec(quantised(5122, "true"), 1, 0, -1); /* -32768 / 32767 is no less than -1 */
    assert_vec(quantised(5122, "false"), 32767, 0, -32768);
    assert_vec(quantised(5123, "true"), 32767 / 65535.0, 0, 32768 / 65535.0);
    assert_vec(quantised(5121, "true"), 1, 127 / 255.0, 0); /* the bytes ff 7f 00 */
    assert_vec(quantised(5120, "true"), -1 / 127.0, 1, 0);
    assert_vec(quantised(5120, "false"), -1, 127, 0);
}

TEST(sparse_accessors_replace_elements)
{
    static const struct {
        float base[9];
        uint16_t index[2];
        float value[6];
    } b = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 2 }, { 7, 8, 9, 4, 5, 6 } };
    static const char views[] =
        "{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":4},"
        "{\"buffer\":0,\"byteOffset\":40,\"byteLength\":24}";
    static const char rest[] =
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":2,"
        "\"indices\":{\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":2}}}";
    for (int based = 0; based < 2; based++) {
        const gltf *g = read_mesh(&b, sizeof b, views,
                                  text_of(&memory, "{%s%s", based ? "\"bufferView\":0," : "", rest),
                                  "{\"attributes\":{\"POSITION\":0}}", "");
        assert_non_null(g);
        const vec3 *p = g->meshes[0].triangles.positions;
        assert_vec(p[0], 7, 8, 9);
        assert_vec(p[1], based, 0, 0); /* without a base: zeros */
        assert_vec(p[2], 4, 5, 6);
    }
}

TEST(nodes_turn_scale_and_move_their_children_into_our_frame)
{
    const gltf *g =
        read_text("{" ASSET "," ONE_NODE
                  ",\"nodes\":[{\"name\":\"top\",\"children\":[2],\"translation\":[1,2,3],"
                  "\"rotation\":[0,0.70710678118654752,0,0.70710678118654752],\"scale\":[2,1,1]},{"
                  "\"name\":\"no\"},"
                  "{\"name\":\"below\",\"matrix\":[1,0,0,0, 0,-1,0,0, 0,0,1,0, 5,6,7,1]}]}");
    assert_non_null(g);
    assert_int_equal(g->node_count, 2); /* node 1 is in no scene */
    assert_string_equal(g->nodes[0].name, "top");
    assert_string_equal(g->nodes[1].name, "below");
    /* (1,0,0): twice as long, a quarter turn about y to -z, moved: (1,2,1) in glTF's frame */
    assert_point(&g->nodes[0].place, (dvec3){ 1, 0, 0 }, 1, -1, 2);
    /* (0,1,0): mirrored and moved (5,5,7), scaled (10,5,7), turned (7,5,-10), moved (8,7,-7) */
    assert_point(&g->nodes[1].place, (dvec3){ 0, 1, 0 }, 8, 7, 7);
    assert_near(transform_determinant(&g->nodes[1].place), -2, 1e-12);
}

TEST(a_mesh_is_kept_once_however_often_it_is_placed)
{
    static const float moves[9]  = { 1, 2, 3, -1, -2, -3, 0, 0, 0 };
    static const float scales[9] = { 1, 1, 1, 2, 2, 2, 0, 1, 1 };
    float b[33];
    memcpy(b, zigzag, 60);
    memcpy(b + 15, moves, 36);
    memcpy(b + 24, scales, 36);
    const gltf *g = read_text(text_of(
        &memory,
        "{" ASSET
        ",\"scenes\":[{\"nodes\":[0,1]}],\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],"
        "\"buffers\":[{\"byteLength\":132,\"uri\":\"%s\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":60},"
        "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":96,"
        "\"byteLength\":36}],"
        "\"accessors\":[%s,{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0},"
        "{\"mesh\":0,\"translation\":[10,0,0],\"extensions\":{\"EXT_mesh_gpu_instancing\":"
        "{\"attributes\":{\"TRANSLATION\":1,\"SCALE\":2}}}}]}",
        data_uri(&memory, b, sizeof b), floats5));
    assert_non_null(g);
    assert_int_equal(g->mesh_count, 1);
    assert_int_equal(g->placement_count, 3); /* the third instance is flat */
    assert_true(noticed(&said, "/nodes/1: 1 parts are left out"));
    assert_point(&g->placements[0].place, (dvec3){ 1, 1, 1 }, 1, -1, 1);
    assert_point(&g->placements[1].place, (dvec3){ 1, 1, 1 }, 12, -4, 3);
    assert_point(&g->placements[2].place, (dvec3){ 1, 1, 1 }, 11, 1,
                 0); /* 2 - (1,2,3), in our frame */
    assert_int_equal(g->placements[2].node, 1);
}

TEST(cameras_look_where_their_node_points)
{
    const gltf *g = read_text(
        "{" ASSET
        ",\"scenes\":[{\"nodes\":[0,1]}],\"cameras\":[{\"type\":\"perspective\",\"perspective\":"
        "{\"yfov\":0.5,\"znear\":0.1,\"aspectRatio\":1.5}},{\"name\":\"plan\",\"type\":"
        "\"orthographic\","
        "\"orthographic\":{\"xmag\":4,\"ymag\":3,\"znear\":0,\"zfar\":10}}],\"nodes\":[{\"name\":"
        "\"eye\","
        "\"camera\":0,\"translation\":[0,2,0]},{\"camera\":1,\"name\":\"other\"}]}");
    assert_non_null(g);
    assert_int_equal(g->camera_count, 2);
    assert_string_equal(g->cameras[0].name, "eye");
    assert_true(g->cameras[0].perspective);
    assert_near(g->cameras[0].yfov, 0.5, 0);
    assert_near(g->cameras[0].aspect, 1.5, 0);
    assert_point(&g->cameras[0].place, (dvec3){ 0, 0, -1 }, 0, 1, 2); /* north, from 2 m up */
    assert_point(&g->cameras[0].place, (dvec3){ 0, 1, 0 }, 0, 0, 3);
    assert_string_equal(g->cameras[1].name, "plan");
    assert_false(g->cameras[1].perspective);
    assert_near(g->cameras[1].xmag, 4, 0);
    assert_near(g->cameras[1].ymag, 3, 0);
}

TEST(punctual_lights_keep_their_candelas_whatever_the_scale)
{
    const gltf *g = read_text(
        "{" ASSET
        ",\"scenes\":[{\"nodes\":[0,1,2]}],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
        "{\"type\":\"point\",\"name\":\"bulb\",\"color\":[1,0.5,0.25],\"intensity\":100,\"range\":"
        "5},"
        "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.2,\"outerConeAngle\":0.4}},"
        "{\"type\":\"directional\",\"intensity\":1000}]}},\"nodes\":["
        "{\"scale\":[3,3,3],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
        "{\"name\":\"S\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}},"
        "\"rotation\":[-0.70710678118654752,0,0,0.70710678118654752]},"
        "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}]}");
    assert_non_null(g);
    assert_int_equal(g->light_count, 3);
    assert_int_equal(g->lights[0].kind, GLTF_POINT);
    assert_string_equal(g->lights[0].name, "bulb");
    assert_vec(g->lights[0].color, 1, 0.5, 0.25);
    assert_near(g->lights[0].intensity, 100, 0);
    assert_int_equal(g->lights[1].kind, GLTF_SPOT);
    assert_string_equal(g->lights[1].name, "S");
    assert_near(g->lights[1].intensity, 1, 0);
    assert_near(g->lights[1].inner, 0.2, 0);
    assert_near(g->lights[1].outer, 0.4, 0);
    assert_point(&g->lights[1].place, (dvec3){ 0, 0, -1 }, 0, 0, -1); /* down */
    assert_int_equal(g->lights[2].kind, GLTF_DIRECTIONAL);
    assert_near(g->lights[2].intensity, 1000, 0);
    assert_true(noticed(&said, "1 lights have a range"));
}

TEST(materials_are_read_with_their_defaults)
{
    const gltf *g = read_text(
        "{" ASSET
        ",\"scenes\":[{}],\"materials\":[{},{\"name\":\"lamp\",\"emissiveFactor\":[1,0.5,0],"
        "\"alphaMode\":\"MASK\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,0.3,0.4],"
        "\"metallicFactor\":0.25,\"roughnessFactor\":0.75},\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":200},"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":0.9}}}]}");
    assert_non_null(g);
    assert_int_equal(g->material_count, 3);
    for (int i = 0; i < 3; i += 2) { /* one that says nothing, and the default one */
        assert_vec(g->materials[i].base_color, 1, 1, 1);
        assert_near(g->materials[i].metallic, 1, 0);
        assert_near(g->materials[i].roughness, 1, 0);
        assert_vec(g->materials[i].emission, 0, 0, 0);
        assert_near(g->materials[i].alpha, 1, 0);
        assert_near(g->materials[i].ior, 1.5, 0);
        assert_near(g->materials[i].specular, 1, 0);
        assert_vec(g->materials[i].specular_color, 1, 1, 1);
        assert_vec(g->materials[i].attenuation_color, 1, 1, 1);
        assert_true(isinf(g->materials[i].attenuation_distance));
        assert_false(g->materials[i].volume || g->materials[i].unlit);
        assert_null(g->materials[i].textures);
    }
    const gltf_material *m = &g->materials[1];
    assert_string_equal(m->name, "lamp");
    assert_vec(m->base_color, 0.1, 0.2, 0.3);
    assert_near(m->alpha, 0.4, 1e-6);
    assert_near(m->metallic, 0.25, 0);
    assert_near(m->roughness, 0.75, 0);
    assert_near(m->transmission, 0.9, 1e-6);
    assert_vec(m->emission, 200, 100, 0);
}

TEST(a_binary_file_and_its_text_twin_are_the_same)
{
    static const char json[] =
        "{" ASSET "," ONE_NODE ",\"buffers\":[{\"byteLength\":60}],\"bufferViews\":"
        "[{\"buffer\":0,\"byteLength\":60}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":5}]}],"
        "\"nodes\":[{\"mesh\":0}]}";
    size_t size;
    uint8_t *glb  = make_glb(&memory, json, zigzag, sizeof zigzag, &size);
    said          = (notices){ .a = &memory };
    const gltf *g = read_bytes(&memory, "any.name", glb, size, &said, &error);
    assert_non_null(g);
    const mesh *text = read_zigzag("{\"attributes\":{\"POSITION\":0},\"mode\":5}", "");
    const mesh *bin  = &g->meshes[0].triangles;
    assert_int_equal(bin->triangle_count, text->triangle_count);
    assert_memory_equal(bin->positions, text->positions, 5 * sizeof(vec3));
    assert_memory_equal(bin->corners, text->corners, 9 * sizeof(uint32_t));
}

TEST(a_buffer_file_is_found_by_its_decoded_name)
{
    scratch_write("a+b c.bin", zigzag, sizeof zigzag);
    const gltf *g = read_text(
        text_of(&memory,
                "{" ASSET "," ONE_NODE
                ",\"buffers\":[{\"byteLength\":48,\"uri\":\"a+b%%20c.\\u0062in\"}],\"bufferViews\":"
                "[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,"
                "\"componentType\":5126,"
                "\"count\":4,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
                "\"POSITION\":0}}]}],"
                "\"nodes\":[{\"mesh\":0}]}"));
    assert_non_null(g);
    assert_vec(g->meshes[0].triangles.positions[3], 1, 1, 1);
}

TEST(the_scene_that_is_asked_for_is_shown)
{
    static const char rest[] =
        "\"nodes\":[{\"name\":\"a\"},{\"name\":\"b\",\"children\":[2]},{\"name\":\"c\"}]}";
    static const char two[] = "\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1,0]}],";
    const gltf *g           = read_text(text_of(&memory, "{" ASSET ",\"scene\":1,%s%s", two, rest));
    assert_int_equal(g->node_count, 3);
    g = read_text(text_of(&memory, "{" ASSET ",\"scene\":0,%s%s", two, rest));
    assert_int_equal(g->node_count, 1);
    g = read_text(text_of(&memory, "{" ASSET ",%s%s", two, rest));
    assert_int_equal(g->node_count, 1);
    assert_int_equal(said.count, 0);
    g = read_text(text_of(&memory, "{" ASSET ",%s", rest));
    assert_int_equal(g->node_count, 3);
    assert_true(noticed(&said, "all nodes are shown"));
}

TEST(a_node_without_volume_loses_its_mesh)
{
    const gltf *g = read_text(text_of(
        &memory,
        "{" ASSET "," ONE_NODE
        ",\"buffers\":[{\"byteLength\":60,\"uri\":\"%s\"}],\"bufferViews\":[%s],"
        "\"accessors\":[%s],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"nodes\":[{\"mesh\":0,\"scale\":[1,0,1]}]}",
        data_uri(&memory, zigzag, sizeof zigzag), all_bytes, floats5));
    assert_non_null(g);
    assert_int_equal(g->placement_count, 0);
    assert_int_equal(g->node_count, 1);
    assert_true(noticed(&said, "/nodes/0: 1 parts are left out"));
}

TEST(extensions_that_are_not_simulated_are_named)
{
    lux_error err             = { 0 };
    static const char draco[] = "{" ASSET ",\"extensionsRequired\":[\"KHR_mesh_quantization\","
                                "\"KHR_draco_mesh_compression\"]}";
    assert_null(read_bytes(&memory, "d.gltf", draco, strlen(draco), NULL, &err));
    assert_int_equal(err.code, ERR_UNSUPPORTED);
    assert_non_null(strstr(err.text, "/extensionsRequired/1: \"KHR_draco_mesh_compression\""));

    const gltf *g = read_text("{" ASSET "," ONE_NODE
                              ",\"extensionsUsed\":[\"EXT_lights_ies\",\"KHR_materials_ior\","
                              "\"X_y\"],\"extensionsRequired\":[\"KHR_materials_ior\","
                              "\"EXT_lights_ies\",\"EXT_lights_area\"],\"nodes\":[{}]}");
    assert_non_null(g);
    assert_int_equal(said.count, 1);
    assert_true(noticed(&said, "ignored: X_y"));
}

TEST(no_memory_is_an_error)
{
    static const char text[] = "{" ASSET "," ONE_NODE ",\"nodes\":[{}]}";
    arena a                  = { 0 };
    lux_error err            = { 0 };
    const char *path         = scratch_write("scene.gltf", text, strlen(text));
    memory_is_out            = true;
    const gltf *g            = gltf_read(&a, path, NULL, &err);
    memory_is_out            = false;
    assert_null(g);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

#define GLTF_TEST(name) cmocka_unit_test_teardown(name, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        GLTF_TEST(strips_and_fans_turn_as_the_specification_says),
        GLTF_TEST(geometry_without_indices_is_one_triangle_after_the_other),
        GLTF_TEST(primitives_share_positions_and_keep_their_materials),
        GLTF_TEST(points_lines_colours_and_targets_are_noticed_once),
        GLTF_TEST(triangles_without_area_are_left_out_and_counted),
        GLTF_TEST(a_mesh_of_nothing_is_not_placed),
        GLTF_TEST(interleaved_and_quantised_positions_are_read),
        GLTF_TEST(sparse_accessors_replace_elements),
        GLTF_TEST(nodes_turn_scale_and_move_their_children_into_our_frame),
        GLTF_TEST(a_mesh_is_kept_once_however_often_it_is_placed),
        GLTF_TEST(cameras_look_where_their_node_points),
        GLTF_TEST(punctual_lights_keep_their_candelas_whatever_the_scale),
        GLTF_TEST(materials_are_read_with_their_defaults),
        GLTF_TEST(a_binary_file_and_its_text_twin_are_the_same),
        GLTF_TEST(a_buffer_file_is_found_by_its_decoded_name),
        GLTF_TEST(the_scene_that_is_asked_for_is_shown),
        GLTF_TEST(a_node_without_volume_loses_its_mesh),
        GLTF_TEST(extensions_that_are_not_simulated_are_named),
        GLTF_TEST(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
