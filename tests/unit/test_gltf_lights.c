/* tests/unit/test_gltf_lights.c -- measured and glowing lights of glTF, and whose nodes are whose.
 *
 * Expected values are worked out by hand from the READMEs of the extensions; (x, y, z) of glTF is
 * (x, -z, y) of ours.
 */
#include "lights/photometry.h"
#include "sim/gltf.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ASSET "\"asset\":{\"version\":\"2.0\"}"

static arena memory;
static notices said;
static lux_error error;

static int forget(void **state)
{
    (void)state;
    scratch_remove();
    arena_clear(&memory);
    return 0;
}

static const gltf *read_text(const char *text)
{
    said  = (notices){ .a = &memory };
    error = (lux_error){ 0 };
    return read_bytes(&memory, "scene.gltf", text, strlen(text), &said, &error);
}

/* A scene of one node: members of the node, of its extensions and of the root's. */
static const gltf *read_node(const char *node, const char *node_ext, const char *root_ext)
{
    return read_text(text_of(&memory,
                             "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{%s\"name\":\"N\","
                             "\"extensions\":{%s}}],\"extensions\":{%s}}",
                             node, node_ext, root_ext));
}

static const gltf_light *read_light(const char *node, const char *node_ext, const char *root_ext)
{
    const gltf *g = read_node(node, node_ext, root_ext);
    if (!g)
        fail_msg("%s", error.text);
    assert_int_equal(g->light_count, 1);
    return &g->lights[0];
}

static void assert_node_refused(const char *node, const char *node_ext, const char *root_ext,
                                const char *sentence)
{
    if (read_node(node, node_ext, root_ext))
        fail_msg("read, though it should be refused: %s", sentence);
    if (!strstr(error.text, sentence))
        fail_msg("\"%s\" does not say \"%s\"", error.text, sentence);
}

static void assert_vec(dvec3 got, double x, double y, double z)
{
    assert_near(got.x, x, 1e-12);
    assert_near(got.y, y, 1e-12);
    assert_near(got.z, z, 1e-12);
}

/* ---- EXT_lights_ies ---- */

#define AT_IES     "\"EXT_lights_ies\":{\"light\":0}"
#define IES(light) "\"EXT_lights_ies\":{\"lights\":[" light "]}"

/* A web that tells its directions: 100 cd to gamma 0; at gamma 90, 10 at C0 and 40 at C90. */
static const char web[] = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 0\n0 90\n"
                          "0 90 180\n100 10\n100 40\n100 10\n";

static const char *light_with_data(void)
{
    return text_of(&memory, "\"EXT_lights_ies\":{\"lights\":[{\"uri\":\"%s\"}]}",
                   data_uri(&memory, web, strlen(web)));
}

static const photometry *web_of(const gltf_light *l)
{
    const photometry *p = l->photometry_path
                              ? photometry_read(&memory, l->photometry_path, &said, &error)
                              : photometry_parse(&memory, l->photometry_name, l->photometry_bytes,
                                                 l->photometry_size, &said, &error);
    if (!p)
        fail_msg("%s", error.text);
    return p;
}

TEST(a_web_within_the_scene_is_kept_with_a_nul_behind_it)
{
    const gltf_light *l = read_light("", AT_IES, light_with_data());
    assert_int_equal(l->kind, GLTF_IES);
    assert_string_equal(l->name, "N");
    assert_int_equal(l->photometry_size, strlen(web));
    assert_string_equal(l->photometry_bytes, web);
    assert_null(l->photometry_path);
    assert_non_null(
        strstr(l->photometry_name, "scene.gltf: /extensions/EXT_lights_ies/lights/0/uri"));
    assert_near(l->multiplier, 1, 0);
    assert_vec(d3_from(l->color), 1, 1, 1);
    assert_near(photometry_candela(web_of(l), 90, 90), 40, 1e-5);
    assert_int_equal(said.count, 0);
}

TEST(a_web_in_a_buffer_view_is_that_part_of_the_buffer)
{
    char bytes[sizeof web + 9];
    snprintf(bytes, sizeof bytes, "before%sXYZ", web);
    const gltf *g = read_text(
        text_of(&memory,
                "{" ASSET ",\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}],\"bufferViews\":[{"
                "\"buffer\":0,\"byteOffset\":6,\"byteLength\":%zu}],\"scenes\":[{\"nodes\":[0,1]}],"
                "\"nodes\":[{\"extensions\":{" AT_IES "}},{\"extensions\":{" AT_IES "}}],"
                "\"extensions\":{" IES("{\"bufferView\":0,\"name\":\"W\","
                                       "\"mimeType\":\"application/x-ies-lm-63\"}") "}}",
                strlen(bytes), data_uri(&memory, bytes, strlen(bytes)), strlen(web)));
    assert_non_null(g);
    assert_int_equal(g->light_count, 2);
    assert_string_equal(g->lights[0].name, "W");
    assert_string_equal(g->lights[0].photometry_bytes, web);
    assert_ptr_equal(g->lights[0].photometry_bytes, g->lights[1].photometry_bytes);
    assert_non_null(strstr(g->lights[0].photometry_name, "/lights/0/bufferView"));
}

TEST(a_web_beside_the_scene_is_found_by_its_decoded_name)
{
    scratch_write("a b.ies", web, strlen(web));
    const gltf_light *l = read_light("", AT_IES, IES("{\"uri\":\"a%20b.\\u0069es\"}"));
    assert_null(l->photometry_bytes);
    assert_non_null(strstr(l->photometry_path, "/a b.ies"));
    assert_near(photometry_candela(web_of(l), 0, 0), 100, 1e-5);
    l = read_light("", AT_IES, IES("{\"uri\":\"missing.ies\"}")); /* for its user to say */
    assert_non_null(strstr(l->photometry_path, "/missing.ies"));
}

/* Untransformed, gamma 0 is glTF's -z (our north), C0 its +x (east), C90 its +y (up). */
TEST(a_web_hangs_by_its_node_whatever_the_scale)
{
    const gltf_light *l = read_light("", AT_IES, light_with_data());
    assert_vec(transform_vector(&l->place, (dvec3){ 0, 0, -1 }), 0, 1, 0);
    assert_vec(transform_vector(&l->place, (dvec3){ 1, 0, 0 }), 1, 0, 0);
    assert_vec(transform_vector(&l->place, (dvec3){ 0, 1, 0 }), 0, 0, 1);

    /* A quarter turn about -x aims it down; then C0 is east and C90 north, as in a study */
    l = read_light("\"rotation\":[-0.70710678118654752,0,0,0.70710678118654752],\"scale\":[5,5,5],"
                   "\"translation\":[1,2,3],",
                   AT_IES, light_with_data());
    assert_near(l->multiplier, 1, 0);
    assert_vec(transform_point(&l->place, (dvec3){ 0, 0, 0 }), 1, -3, 2);
    assert_vec(transform_vector(&l->place, (dvec3){ 0, 0, -1 }), 0, 0, -5);
    assert_vec(transform_vector(&l->place, (dvec3){ 1, 0, 0 }), 5, 0, 0);
    assert_vec(transform_vector(&l->place, (dvec3){ 0, 1, 0 }), 0, 5, 0);
}

TEST(a_node_dims_and_tints_its_web)
{
    const gltf_light *l =
        read_light("", "\"EXT_lights_ies\":{\"light\":0,\"multiplier\":2.5,\"color\":[0.25,2,0]}",
                   light_with_data());
    assert_near(l->multiplier, 2.5, 0);
    assert_vec(d3_from(l->color), 0.25, 1, 0); /* "clamped to the [0, 1] range" */
    assert_true(noticed(&said, "/nodes/0/extensions/EXT_lights_ies/color: 1 colours"));
}

TEST(what_is_wrong_with_a_profile_is_refused_where_it_stands)
{
    static const char at[] = "/extensions/EXT_lights_ies/lights/0";
#define IES_REFUSED(light, sentence)                                                               \
    assert_node_refused("", AT_IES, IES(light), text_of(&memory, "%s%s", at, sentence))
    IES_REFUSED("{}", ": neither \"uri\" nor \"bufferView\", wanted one of them");
    IES_REFUSED("{\"name\":\"x\",\"extras\":{}}", ": neither \"uri\" nor");
    IES_REFUSED("{\"uri\":\"a.ies\",\"bufferView\":0}", "/uri: there is a bufferView too");
    IES_REFUSED("{\"bufferView\":0}", "/bufferView: bufferView 0 of 0");
    IES_REFUSED("{\"bufferView\":-1}", "/bufferView: -1, wanted an index");
    IES_REFUSED("{\"uri\":7}", "/uri: 7, wanted a string");
    IES_REFUSED("{\"uri\":\"\"}", "/uri: a URI that names no file");
    IES_REFUSED("{\"uri\":\"../a.ies\"}", "/uri: \"../a.ies\" leaves the scene's folder");
    IES_REFUSED("{\"uri\":\"/etc/passwd\"}", "/uri: \"/etc/passwd\" leaves the scene's folder");
    IES_REFUSED("{\"uri\":\"%2e%2e/a.ies\"}", "/uri: \"../a.ies\" leaves");
    IES_REFUSED("{\"uri\":\"https://a.b/c.ies\"}", "/uri: \"https://a.b/c.ies\", wanted a file");
    IES_REFUSED("{\"uri\":\"data:application/x-ies-lm-63;base64,\"}", "/uri: no bytes");
    IES_REFUSED("{\"uri\":\"data:;base64,A!\"}", "/uri: a character that is not base64");
    IES_REFUSED("{\"uri\":\"a.ies\",\"mimeType\":\"text/plain\"}",
                "/mimeType: \"text/plain\", wanted one of application/x-ies-lm-63");
}

TEST(a_profile_in_an_empty_view_or_buffer_is_refused)
{
    static const char scene[] =
        "{" ASSET ",\"buffers\":[{\"byteLength\":4}],\"bufferViews\":[{"
        "\"buffer\":0,\"byteLength\":%d}],\"extensions\":{" IES("{\"bufferView\":0}") "}}";
    assert_null(read_text(text_of(&memory, scene, 0)));
    assert_non_null(strstr(error.text, "/bufferViews/0/byteLength: 0, wanted"));
    assert_null(read_text(text_of(&memory, scene, 4)));
    assert_non_null(strstr(error.text, "/extensions/EXT_lights_ies/lights/0/bufferView"));
    assert_non_null(strstr(error.text, "buffer 0 has neither uri nor binary chunk"));
}

/* 80 views of the same MiB stand for more than 64 of them. */
TEST(few_bytes_do_not_stand_for_many_profiles)
{
    enum { MIB = 1 << 20, MANY = 80 };
    char *zeros = arena_array(&memory, char, MIB, NULL);
    char *list  = arena_array(&memory, char, 20 * (size_t)MANY, NULL);
    char *end   = list;
    for (int i = 0; i < MANY; i++)
        end += sprintf(end, "%s{\"bufferView\":0}", i ? "," : "");
    scratch_write("zeros.bin", zeros, MIB);
    assert_null(read_text(text_of(
        &memory,
        "{" ASSET ",\"buffers\":[{\"byteLength\":%d,\"uri\":\"zeros.bin\"}],\"bufferViews\":[{"
        "\"buffer\":0,\"byteLength\":%d}],\"extensions\":{\"EXT_lights_ies\":{\"lights\":[%s]}}}",
        MIB, MIB, list)));
    assert_int_equal(error.code, ERR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "/extensions/EXT_lights_ies/lights/64/bufferView: with it"));
}

TEST(a_link_out_of_the_folder_is_no_web)
{
    char outside[128], link[128];
    snprintf(outside, sizeof outside, "%s/../lux4_outside_XXXXXX", scratch_folder());
    int fd = mkstemp(outside);
    assert_true(fd >= 0);
    close(fd);
    snprintf(link, sizeof link, "%s/link.ies", scratch_folder());
    assert_int_equal(symlink(outside, link), 0);
    assert_node_refused("", AT_IES, IES("{\"uri\":\"link.ies\"}"), "leaves the scene's folder");
    unlink(link);
    unlink(outside);
}

/* ---- EXT_lights_area ---- */

#define AT_AREA     "\"EXT_lights_area\":{\"light\":0}"
#define AREA(light) "\"EXT_lights_area\":{\"lights\":[" light "]}"

TEST(an_area_that_says_nothing_has_the_defaults_of_the_draft)
{
    const gltf_light *l = read_light("", AT_AREA, AREA("{\"type\":\"rect\"}"));
    assert_int_equal(l->kind, GLTF_AREA_RECT);
    assert_string_equal(l->name, "N");
    assert_near(l->intensity, 1000, 0);
    assert_vec(d3_from(l->color), 1, 1, 1);
    assert_near(l->width, 1, 0);
    assert_near(l->height, 1, 0);
    assert_near(l->radius, 0, 0);

    l = read_light("", AT_AREA, AREA("{\"type\":\"disk\"}"));
    assert_int_equal(l->kind, GLTF_AREA_DISK);
    assert_near(l->radius, 0.5, 0); /* the size is the diameter */
    assert_near(l->width, 0, 0);
    assert_int_equal(said.count, 0);
}

TEST(an_area_is_scaled_by_the_largest_scale_of_its_place)
{
    static const char rect[] = AREA("{\"type\":\"rect\",\"name\":\"panel\",\"size\":0.5,\"rect\":{"
                                    "\"aspect\":4},\"intensity\":3000,\"color\":[1,0.5,0]}");
    const gltf_light *l      = read_light("\"scale\":[1,-3,2],", AT_AREA, rect);
    assert_string_equal(l->name, "panel");
    assert_near(l->intensity, 3000, 0);
    assert_vec(d3_from(l->color), 1, 0.5, 0);
    assert_near(l->width, 6, 1e-12);    /* 3 * 0.5 * 4 */
    assert_near(l->height, 1.5, 1e-12); /* 3 * 0.5 */

    /* Turned within a node that is scaled itself: 2 of the parent, 3 of its own */
    const gltf *g = read_text(text_of(
        &memory,
        "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1],\"scale\":[2,2,2]},{"
        "\"rotation\":[0.5,0.5,0.5,0.5],\"scale\":[3,1,1],\"extensions\":{" AT_AREA
        "}}],\"extensions\":{" AREA("{\"shape\":\"disk\",\"size\":0.5}") "}}"));
    assert_non_null(g);
    assert_near(g->lights[0].radius, 1.5, 1e-12);
    assert_int_equal(g->lights[0].node, 1);
}

TEST(an_area_of_the_older_draft_is_read_too)
{
    const gltf_light *l =
        read_light("\"scale\":[2,2,2],", AT_AREA,
                   AREA("{\"shape\":\"rect\",\"luminance\":7,\"width\":3,\"height\":0.5}"));
    assert_int_equal(l->kind, GLTF_AREA_RECT);
    assert_near(l->intensity, 7, 0);
    assert_near(l->width, 6, 1e-12);
    assert_near(l->height, 1, 1e-12);
    l = read_light("", AT_AREA, AREA("{\"shape\":\"disk\",\"type\":\"disk\",\"radius\":3}"));
    assert_int_equal(l->kind, GLTF_AREA_DISK);
    assert_near(l->radius, 3, 0);
}

TEST(what_is_wrong_with_an_area_is_refused_where_it_stands)
{
    static const char at[] = "/extensions/EXT_lights_area/lights/0";
#define AREA_REFUSED(light, sentence)                                                              \
    assert_node_refused("", AT_AREA, AREA(light), text_of(&memory, "%s%s", at, sentence))
    AREA_REFUSED("{}", ": neither \"type\" nor \"shape\", wanted one of them");
    AREA_REFUSED("{\"type\":\"rect\",\"shape\":\"disk\"}", ": type \"rect\", but shape \"disk\"");
    AREA_REFUSED("{\"type\":\"sphere\"}", "/type: \"sphere\", wanted one of rect|disk");
    AREA_REFUSED("{\"type\":\"rect\",\"size\":-1}", "/size: -1, wanted above 0");
    AREA_REFUSED("{\"type\":\"rect\",\"size\":0}", "/size: 0, wanted above 0");
    AREA_REFUSED("{\"type\":\"rect\",\"intensity\":-1}", "/intensity: -1, wanted 0 to 2e+09");
    AREA_REFUSED("{\"type\":\"rect\",\"color\":[1,-1,1]}", "/color/1: -1, wanted 0 to");
    AREA_REFUSED("{\"type\":\"rect\",\"color\":[1,1]}", "/color: 2 numbers, wanted 3");
    AREA_REFUSED("{\"type\":\"rect\",\"rect\":{\"aspect\":0}}", "/rect/aspect: 0, wanted above 0");
    AREA_REFUSED("{\"type\":\"rect\",\"rect\":7}", "/rect: 7, wanted an object");
    assert_node_refused("\"scale\":[1e30,1,1],", AT_AREA, AREA("{\"type\":\"rect\",\"size\":2}"),
                        "/nodes/0/extensions/EXT_lights_area/light: 2e+30 by 2e+30 m, wanted");
    assert_node_refused("", AT_AREA, AREA("{\"type\":\"disk\",\"size\":1e-30}"),
                        "/nodes/0/extensions/EXT_lights_area/light: 5e-31 by");
}

TEST(a_node_names_a_light_that_is_there)
{
    static const char light[] = "/nodes/0/extensions/EXT_lights_";
    assert_node_refused("", "\"EXT_lights_ies\":{\"light\":1}", IES("{\"uri\":\"a.ies\"}"),
                        text_of(&memory, "%sies/light: light 1 of 1", light));
    assert_node_refused("", "\"EXT_lights_area\":{\"light\":2}", AREA("{\"type\":\"rect\"}"),
                        text_of(&memory, "%sarea/light: light 2 of 1", light));
    assert_node_refused("", AT_AREA, "", text_of(&memory, "%sarea/light: light 0 of 0", light));
    assert_node_refused("", AT_IES, "", text_of(&memory, "%sies/light: light 0 of 0", light));
    assert_node_refused("", "\"EXT_lights_area\":{}", AREA("{\"type\":\"rect\"}"),
                        text_of(&memory, "%sarea: no \"light\"", light));
    assert_node_refused("", "\"EXT_lights_ies\":{\"light\":0,\"multiplier\":-1}",
                        IES("{\"uri\":\"a.ies\"}"),
                        text_of(&memory, "%sies/multiplier: -1, wanted 0 to 2e+09", light));
}

TEST(a_node_may_carry_a_light_of_each_extension)
{
    const gltf *g = read_node("", "\"KHR_lights_punctual\":{\"light\":0}," AT_IES "," AT_AREA,
                              "\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\"}]}," IES(
                                  "{\"uri\":\"a.ies\"}") "," AREA("{\"type\":\"disk\"}"));
    assert_non_null(g);
    assert_int_equal(g->light_count, 3);
    assert_int_equal(g->lights[0].kind, GLTF_POINT);
    assert_int_equal(g->lights[1].kind, GLTF_IES);
    assert_int_equal(g->lights[2].kind, GLTF_AREA_DISK);
    for (int i = 0; i < 3; i++)
        assert_int_equal(g->lights[i].node, 0);
}

TEST(what_has_no_direction_gives_no_light)
{
    const gltf *g = read_node("\"scale\":[1,1,0],", AT_IES "," AT_AREA,
                              IES("{\"uri\":\"a.ies\"}") "," AREA("{\"type\":\"rect\"}"));
    assert_non_null(g);
    assert_int_equal(g->light_count, 0);
    assert_true(noticed(&said, "/nodes/0: 2 parts are left out"));
}

/* ---- emission, ownership, real files ---- */

TEST(emission_is_factor_times_strength)
{
    const gltf *g = read_text("{" ASSET ",\"materials\":[{\"emissiveFactor\":[1,0,0.25],"
                              "\"extensions\":{\"KHR_materials_emissive_strength\":{"
                              "\"emissiveStrength\":4000}}}]}");
    assert_non_null(g);
    assert_near(g->materials[0].emission.x, 4000, 0);
    assert_near(g->materials[0].emission.y, 0, 0);
    assert_near(g->materials[0].emission.z, 1000, 0);
}

/*  The scene shows node 3:   3        in the result,   2
 *                           / \       without 0:      / \
 *                          1   5                     0   4
 *                          |   |                     |   |
 *                          4   2                     3   1    */
TEST(a_node_knows_its_parent)
{
    const gltf *g = read_text("{" ASSET ",\"scenes\":[{\"nodes\":[3]}],\"nodes\":[{},{\"children\":"
                              "[4]},{\"name\":\"Spot.\\u00e9\"},{\"children\":[1,5]},{},{"
                              "\"children\":[2]}]}");
    static const int parent[5] = { 2, 4, -1, 0, 2 };
    assert_non_null(g);
    assert_int_equal(g->node_count, 5);
    for (uint32_t i = 0; i < 5; i++)
        assert_int_equal(g->nodes[i].parent, parent[i]);
    assert_string_equal(g->nodes[1].name, "Spot.\xc3\xa9");
    assert_string_equal(g->nodes[0].name, "");
}

TEST(the_same_web_beside_and_within_the_scene_is_the_same)
{
    static const char folder[] = "../shared/data/gltf/babylon_EXT_lights_ies/";
    const photometry *webs[2];
    const gltf_light *l[2];
    for (int i = 0; i < 2; i++) {
        const char *path =
            text_of(&memory, "%s%s", folder, i ? "Example_bufferView.gltf" : "Example.gltf");
        if (access(path, R_OK) != 0)
            skip();
        said          = (notices){ .a = &memory };
        const gltf *g = gltf_read(&memory, path, &said, &error);
        assert_non_null(g);
        assert_int_equal(g->light_count, 1);
        assert_int_equal(said.count, 0);
        l[i]    = &g->lights[0];
        webs[i] = web_of(l[i]);
    }
    assert_true(l[0]->photometry_path && l[1]->photometry_bytes);
    assert_memory_equal(&l[0]->place, &l[1]->place, sizeof(transform));
    assert_vec(d3_from(l[0]->color), (double)0.181f, (double)0.485f, 0);
    assert_near(transform_vector(&l[0]->place, (dvec3){ 0, 0, -1 }).z, -1, 1e-12); /* down */

    /* LightProfile.ies: 8500 cd to gamma 0, 5250 to 30, one plane */
    assert_int_equal(webs[0]->gamma_count, webs[1]->gamma_count);
    assert_memory_equal(webs[0]->candela, webs[1]->candela,
                        (size_t)webs[0]->gamma_count * sizeof(float));
    assert_near(photometry_candela(webs[1], 0, 0), 8500, 1e-6);
    assert_near(photometry_candela(webs[1], 77, 30), 5250, 1e-6);
}

#define LIGHT_TEST(name) cmocka_unit_test_teardown(name, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        LIGHT_TEST(a_web_within_the_scene_is_kept_with_a_nul_behind_it),
        LIGHT_TEST(a_web_in_a_buffer_view_is_that_part_of_the_buffer),
        LIGHT_TEST(a_web_beside_the_scene_is_found_by_its_decoded_name),
        LIGHT_TEST(a_web_hangs_by_its_node_whatever_the_scale),
        LIGHT_TEST(a_node_dims_and_tints_its_web),
        LIGHT_TEST(what_is_wrong_with_a_profile_is_refused_where_it_stands),
        LIGHT_TEST(a_profile_in_an_empty_view_or_buffer_is_refused),
        LIGHT_TEST(few_bytes_do_not_stand_for_many_profiles),
        LIGHT_TEST(a_link_out_of_the_folder_is_no_web),
        LIGHT_TEST(an_area_that_says_nothing_has_the_defaults_of_the_draft),
        LIGHT_TEST(an_area_is_scaled_by_the_largest_scale_of_its_place),
        LIGHT_TEST(an_area_of_the_older_draft_is_read_too),
        LIGHT_TEST(what_is_wrong_with_an_area_is_refused_where_it_stands),
        LIGHT_TEST(a_node_names_a_light_that_is_there),
        LIGHT_TEST(a_node_may_carry_a_light_of_each_extension),
        LIGHT_TEST(what_has_no_direction_gives_no_light),
        LIGHT_TEST(emission_is_factor_times_strength),
        LIGHT_TEST(a_node_knows_its_parent),
        LIGHT_TEST(the_same_web_beside_and_within_the_scene_is_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
