/* tests/unit/test_gltf_textures.c -- pictures of glTF materials, and what meshes say of how they
 * lie.
 *
 * Pictures are made on the spot. Linear values by IEC 61966-2-1: 188 is 0.50289, 51 is 0.033105.
 */
#include "materials/look.h"
#include "sim/gltf.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

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

/* ---- pictures ---- */

static void put_word(uint8_t *to, uint32_t word) /* the highest byte first */
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> (24 - 8 * i));
}

static uint8_t *put_chunk(uint8_t *to, const char *kind, const void *bytes, size_t size)
{
    uint32_t crc = 0xffffffff;
    put_word(to, (uint32_t)size);
    memcpy(to + 4, kind, 4);
    if (size)
        memcpy(to + 8, bytes, size);
    for (size_t i = 4; i < 8 + size; i++) {
        crc ^= to[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    put_word(to + 8 + size, ~crc);
    return to + 12 + size;
}

/* A PNG of 8-bit RGBA, width by height pixels, deflated as one stored block; *size is its size. */
static uint8_t *png(uint32_t width, uint32_t height, const uint8_t *rgba, size_t *size)
{
    uint32_t row = 4 * width + 1, count = row * height, a = 1, b = 0;
    uint8_t head[13] = { 0 }, *raw = arena_array(&memory, uint8_t, count + 11, NULL);
    const uint8_t before[7] = {
        0x78, 1, 1, (uint8_t)count, (uint8_t)(count >> 8), (uint8_t)~count, (uint8_t)(~count >> 8)
    };
    memcpy(raw, before, 7);
    for (uint32_t y = 0; y < height; y++)
        memcpy(raw + 7 + y * row + 1, rgba + 4 * (size_t)width * y, 4 * (size_t)width);
    for (uint32_t i = 0; i < count; i++)
        a = (a + raw[7 + i]) % 65521, b = (b + a) % 65521;
    put_word(raw + 7 + count, b << 16 | a);
    put_word(head, width);
    put_word(head + 4, height);
    head[8] = 8, head[9] = 6;

    uint8_t *out = arena_array(&memory, uint8_t, count + 100, NULL), *to = out + 8;
    memcpy(out, "\x89PNG\r\n\x1a\n", 8);
    to    = put_chunk(to, "IHDR", head, 13);
    to    = put_chunk(to, "IDAT", raw, count + 11);
    to    = put_chunk(to, "IEND", NULL, 0);
    *size = (size_t)(to - out);
    return out;
}

/* Upper left red, upper right green with half its alpha, lower left blue, lower right (188, 188,
 * 51). */
static const uint8_t four[16] = {
    255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 255, 188, 188, 51, 255
};

static const char *picture(void)
{
    size_t size;
    const uint8_t *bytes = png(2, 2, four, &size);
    return text_of(&memory, "{\"uri\":\"%s\"}", data_uri(&memory, bytes, size));
}

/* ---- a scene ---- */

/* A square of two triangles, facing glTF's +z; accessors 0 to 4 are these. */
typedef struct square {
    float at[12];
    uint16_t corners[6];
    uint8_t first[8]; /* coordinates as bytes */
    float second[8];
    float normals[12];
} square;

static const square plain_square = {
    { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }, { 0, 1, 2, 2, 1, 3 },
    { 0, 255, 255, 255, 0, 0, 255, 0 },     { 0, 1, 2, 1, 0, -1, 2, -1 },
    { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 },
};

static const char views[] =
    "{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},"
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":8},"
    "{\"buffer\":0,\"byteOffset\":68,\"byteLength\":32},"
    "{\"buffer\":0,\"byteOffset\":100,\"byteLength\":48}";

static const char accessors[] =
    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},"
    "{\"bufferView\":2,\"componentType\":5121,\"count\":4,\"type\":\"VEC2\",\"normalized\":true},"
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":4,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";

/* The square as a primitive of material 0 with these attributes besides; `more` is the rest of the
 * file. NULL if it is refused. */
static const gltf *read_square(const square *s, const char *attributes, const char *more)
{
    const char *text = text_of(
        &memory,
        "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"buffers\":[{"
        "\"byteLength\":%zu,\"uri\":\"%s\"}],\"bufferViews\":[%s],\"accessors\":[%s],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":1,\"material\":0}]}],%s}",
        sizeof *s, data_uri(&memory, s, sizeof *s), views, accessors, attributes, more);
    said  = (notices){ .a = &memory };
    error = (lux_error){ 0 };
    return read_bytes(&memory, "scene.gltf", text, strlen(text), &said, &error);
}

/* The square with the picture as texture 0; `material` is what stands in its material. */
static const gltf *read_material(const char *material)
{
    return read_square(&plain_square, ",\"TEXCOORD_0\":2,\"TEXCOORD_1\":3",
                       text_of(&memory,
                               "\"images\":[%s],\"textures\":[{\"source\":0}],\"materials\":[{%s}]",
                               picture(), material));
}

static void assert_refused(const gltf *g, const char *sentence)
{
    if (g)
        fail_msg("read, though it should be refused: %s", sentence);
    if (!strstr(error.text, sentence))
        fail_msg("\"%s\" does not say \"%s\"", error.text, sentence);
}

static const material_textures *textures_of(const gltf *g, int material)
{
    if (!g)
        fail_msg("%s", error.text);
    return g->materials[material].textures;
}

static void assert_texel(const texture *t, float u, float v, const double want[4], double tolerance)
{
    assert_non_null(t);
    vtexel got = vtexture_lookup(t, vsplat(u), vsplat(v), vsplat(0.0f), vsplat(u) == vsplat(u));
    assert_near(lane(got.red, 0), want[0], tolerance);
    assert_near(lane(got.green, 0), want[1], tolerance);
    assert_near(lane(got.blue, 0), want[2], tolerance);
    assert_near(lane(got.alpha, 0), want[3], tolerance);
}

static const double red[4] = { 1, 0, 0, 1 }, blue[4] = { 0, 0, 1, 1 };

/* ---- pictures ---- */

TEST(colours_are_decoded_from_srgb_and_numbers_are_not)
{
    const material_textures *t = textures_of(
        read_material(
            "\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0},"
            "\"normalTexture\":{\"index\":0,\"scale\":0.5},\"pbrMetallicRoughness\":{"
            "\"baseColorTexture\":{\"index\":0},\"metallicRoughnessTexture\":{\"index\":0}},"
            "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5,"
            "\"transmissionTexture\":{\"index\":0}},\"KHR_materials_specular\":{"
            "\"specularTexture\":{\"index\":0},\"specularColorTexture\":{\"index\":0}}}"),
        0);
    assert_non_null(t);
    const double colour[4] = { 0.50289, 0.50289, 0.033105, 1 }; /* five digits */
    const double number[4] = { 188 / 255.0, 188 / 255.0, 51 / 255.0, 1 };
    assert_texel(t->base.texture, 0.75f, 0.75f, colour, 2e-5);
    assert_texel(t->surface.texture, 0.75f, 0.75f, number, 1e-6);
    assert_ptr_equal(t->emission.texture, t->base.texture);
    assert_ptr_equal(t->specular_color.texture, t->base.texture);
    assert_ptr_equal(t->specular_weight.texture, t->base.texture); /* alpha alone counts */
    assert_ptr_equal(t->normal.texture, t->surface.texture);
    assert_ptr_equal(t->transmission.texture, t->surface.texture);
    assert_near(t->normal_scale, 0.5, 0);
    assert_int_equal(said.count, 0);
}

TEST(a_picture_is_found_in_a_file_a_uri_and_a_buffer)
{
    size_t size;
    const uint8_t *bytes = png(2, 2, four, &size);
    scratch_write("a b.png", bytes, size);
    const char *const images[3] = { picture(), "{\"uri\":\"a%20b.png\"}",
                                    "{\"bufferView\":5,\"mimeType\":\"image/png\"}" };
    for (int i = 0; i < 3; i++) {
        const char *text = text_of(
            &memory,
            "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"buffers\":[{"
            "\"byteLength\":148,\"uri\":\"%s\"},{\"byteLength\":%zu,\"uri\":\"%s\"}],"
            "\"bufferViews\":[%s,{\"buffer\":1,\"byteLength\":%zu}],\"accessors\":[%s],\"meshes\":"
            "[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"images\":[%s],"
            "\"textures\":[{\"source\":0}],\"materials\":[{\"normalTexture\":{\"index\":0}}]}",
            data_uri(&memory, &plain_square, 148), size, data_uri(&memory, bytes, size), views,
            size, accessors, images[i]);
        const gltf *g = read_bytes(&memory, "scene.gltf", text, strlen(text), NULL, &error);
        assert_texel(textures_of(g, 0)->normal.texture, 0.25f, 0.75f, blue, 1e-6);
    }
}

TEST(samplers_wrap_and_filter)
{
    static const struct {
        int number;
        float u; /* of the picture's upper row */
        double is_red;
    } wraps[] = {
        { 10497, 1.25f, 1 },  /* repeated: 0.25 */
        { 10497, -0.25f, 0 }, /* 0.75 */
        { 33071, 1.25f, 0 },  /* the right edge */
        { 33071, -0.25f, 1 }, /* the left one */
        { 33648, 1.25f, 0 },  /* mirrored: 0.75 */
        { 33648, -0.25f, 1 }, /* 0.25 */
    };
    for (size_t i = 0; i < sizeof wraps / sizeof *wraps; i++)
        for (int axis = 0; axis < 2; axis++) {
            const gltf *g = read_square(
                &plain_square, ",\"TEXCOORD_0\":2",
                text_of(
                    &memory,
                    "\"images\":[%s],\"samplers\":[{\"%s\":%d,\"%s\":33071,\"magFilter\":9728}],"
                    "\"textures\":[{\"source\":0,\"sampler\":0}],"
                    "\"materials\":[{\"normalTexture\":{\"index\":0}}]",
                    picture(), axis ? "wrapT" : "wrapS", wraps[i].number,
                    axis ? "wrapS" : "wrapT"));
            const texture *t = textures_of(g, 0)->normal.texture;
            float u = wraps[i].u, v = 0.25f;
            vtexel got = vtexture_lookup(t, vsplat(axis ? v : u), vsplat(axis ? u : v),
                                         vsplat(0.0f), vsplat(u) == vsplat(u));
            assert_near(lane(got.red, 0), wraps[i].is_red, 1e-6);
        }
}

TEST(only_a_near_filter_that_is_nearest_takes_single_texels)
{
    static const struct {
        const char *sampler;
        double red;
    } filters[] = {
        { "", 0.5 },
        { "\"magFilter\":9729,\"minFilter\":9728", 0.5 },
        { "\"minFilter\":9984", 0.5 },
        { "\"magFilter\":9728,\"minFilter\":9987", 1 },
    };
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        const gltf *g = read_square(
            &plain_square, ",\"TEXCOORD_0\":2",
            text_of(&memory,
                    "\"images\":[%s],\"samplers\":[{%s}],\"textures\":[{\"source\":0,\"sampler\":0}"
                    "],\"materials\":[{\"normalTexture\":{\"index\":0}}]",
                    picture(), filters[i].sampler));
        /* In the upper row red is 1, then 0: half of it at the border, all of it just before */
        vtexel got = vtexture_lookup(textures_of(g, 0)->normal.texture, vsplat(0.4999999f),
                                     vsplat(0.25f), vsplat(0.0f), vsplat(0.0f) == vsplat(0.0f));
        assert_near(lane(got.red, 0), filters[i].red, 1e-5);
    }
}

TEST(one_texture_serves_all_that_want_it_the_same)
{
    const gltf *g = read_square(
        &plain_square, ",\"TEXCOORD_0\":2",
        text_of(&memory,
                "\"images\":[%s],\"samplers\":[{\"wrapS\":33071},{\"wrapS\":33071,\"name\":\"x\"},"
                "{}],\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":0,\"sampler\":1},"
                "{\"source\":0,\"sampler\":2},{\"source\":0}],\"materials\":[{\"emissiveFactor\":"
                "[1,1,1],\"emissiveTexture\":{\"index\":1},\"normalTexture\":{\"index\":2},"
                "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
                "\"metallicRoughnessTexture\":{\"index\":3}}}]",
                picture()));
    const material_textures *t = textures_of(g, 0);
    assert_ptr_equal(t->base.texture, t->emission.texture);
    assert_ptr_equal(t->normal.texture, t->surface.texture);
    assert_ptr_not_equal(t->base.texture, t->normal.texture);
    assert_int_equal(g->texture_count, 2);
}

TEST(pictures_that_nothing_shows_are_not_opened)
{
    const gltf *g = read_square(
        &plain_square, "",
        "\"images\":[{\"uri\":\"none.png\"}],\"textures\":[{\"source\":0}],\"materials\":[{"
        "\"emissiveTexture\":{\"index\":0},\"extensions\":{\"KHR_materials_transmission\":{"
        "\"transmissionTexture\":{\"index\":0}}}},{\"normalTexture\":{\"index\":0}}]");
    assert_null(textures_of(g, 0)); /* what it would be multiplied with is 0 */
    assert_null(textures_of(g, 1)); /* no triangle is of it */
    assert_int_equal(g->texture_count, 0);
    g = read_square(&plain_square, "",
                    "\"images\":[{\"uri\":\"none.png\"}],\"textures\":[{\"source\":0}],"
                    "\"materials\":[{\"normalTexture\":{\"index\":0}}]");
    assert_refused(g, "scene.gltf: /images/0/uri: ");
}

TEST(a_texture_without_picture_is_white)
{
    const gltf *g = read_square(&plain_square, ",\"TEXCOORD_0\":2",
                                "\"textures\":[{\"extensions\":{\"KHR_texture_basisu\":{\"source\":"
                                "0}}}],\"materials\":[{\"normalTexture\":{\"index\":0}}]");
    assert_null(textures_of(g, 0));
    assert_true(noticed(&said, "/textures/0: 1 textures have no picture"));
}

TEST(a_webp_that_cannot_be_read_is_replaced)
{
    static const char scene[] =
        "\"images\":[{\"uri\":\"data:image/"
        "webp;base64,AAAA\"},%s],\"textures\":[{%s\"extensions\":{"
        "\"EXT_texture_webp\":{\"source\":%d}}}],\"materials\":[{\"normalTexture\":{\"index\":0},"
        "\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{\"index\":0}}}]";
    const gltf *g = read_square(&plain_square, ",\"TEXCOORD_0\":2",
                                text_of(&memory, scene, picture(), "\"source\":1,", 0));
    assert_texel(textures_of(g, 0)->normal.texture, 0.25f, 0.25f, red, 1e-6);
    assert_true(noticed(&said, "/textures/0: 1 textures in WebP cannot be read"));
    g = read_square(&plain_square, "", text_of(&memory, scene, picture(), "", 0));
    assert_refused(g, "/images/0/uri");
    g = read_square(&plain_square, ",\"TEXCOORD_0\":2",
                    text_of(&memory, scene, picture(), "\"source\":0,", 1));
    assert_texel(textures_of(g, 0)->normal.texture, 0.25f, 0.25f, red, 1e-6);
    assert_int_equal(said.count, 0);
}

/* One pixel of Radiance's format: 0.5, 0.5, 0.25 times 2^2. */
TEST(only_what_glows_may_be_above_1)
{
    static const char hdr[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x40\x82";
    static const double glows[4] = { 2, 2, 1, 1 }, reflects[4] = { 1, 1, 1, 1 };
    const gltf *g = read_square(
        &plain_square, ",\"TEXCOORD_0\":2",
        text_of(&memory,
                "\"images\":[{\"uri\":\"%s\"}],\"textures\":[{\"source\":0}],\"materials\":[{"
                "\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0},"
                "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}]",
                data_uri(&memory, hdr, sizeof hdr - 1)));
    const material_textures *t = textures_of(g, 0);
    assert_texel(t->emission.texture, 0.5f, 0.5f, glows, 1e-6);
    assert_texel(t->base.texture, 0.5f, 0.5f, reflects, 1e-6);
    assert_int_equal(g->texture_count, 2);
}

/* ---- where they lie ---- */

static texture_slot slot_of(const char *changes)
{
    const gltf *g              = read_material(text_of(
                     &memory, "\"normalTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{%s}}}",
                     changes));
    const material_textures *t = textures_of(g, 0);
    assert_non_null(t);
    return t->normal;
}

static void assert_moved(const texture_slot *s, double u, double v, double to_u, double to_v)
{
    assert_near((double)s->m[0] * u + (double)s->m[1] * v + (double)s->m[2], to_u, 1e-6);
    assert_near((double)s->m[3] * u + (double)s->m[4] * v + (double)s->m[5], to_v, 1e-6);
}

TEST(coordinates_are_scaled_then_turned_then_moved)
{
    texture_slot s = slot_of("");
    assert_moved(&s, 0.3, 0.6, 0.3, 0.6);
    s = slot_of("\"offset\":[0.1,-2]");
    assert_moved(&s, 0.3, 0.6, 0.4, -1.4);
    s = slot_of("\"scale\":[2,-3]");
    assert_moved(&s, 0.3, 0.6, 0.6, -1.8);

    /* The second example of the extension: v from below */
    s = slot_of("\"offset\":[0,1],\"scale\":[1,-1]");
    assert_moved(&s, 0.3, 0.6, 0.3, 0.4);

    /* u = 0.3 by 30 degrees: cos 0.86603, sin 0.5; up in the picture is toward smaller v */
    s = slot_of("\"rotation\":0.52359877559829887");
    assert_moved(&s, 0.3, 0, 0.3 * 0.86602540378, -0.15);
    assert_moved(&s, 0, 0.6, 0.3, 0.6 * 0.86602540378);

    /* All: (0.3, 0.6) becomes (1.2, 3), turned (0.6 + ..., ...), moved */
    s = slot_of("\"rotation\":0.52359877559829887,\"scale\":[4,5],\"offset\":[0.1,0.2]");
    assert_moved(&s, 0.3, 0.6, 1.2 * 0.86602540378 + 1.5 + 0.1, -0.6 + 3 * 0.86602540378 + 0.2);
}

/* The first example of the extension "utilizes only the lower left quadrant of the source image".
 */
TEST(the_example_of_the_extension_shows_the_lower_left_quarter)
{
    texture_slot s = slot_of("\"offset\":[0,1],\"rotation\":1.57079632679,\"scale\":[0.5,0.5]");
    assert_moved(&s, 0, 0, 0, 1);
    assert_moved(&s, 1, 0, 0, 0.5);
    assert_moved(&s, 0, 1, 0.5, 1);
    assert_moved(&s, 1, 1, 0.5, 0.5);
}

TEST(a_transform_may_name_another_set)
{
    const material_textures *t = textures_of(
        read_material("\"normalTexture\":{\"index\":0,\"texCoord\":1},\"pbrMetallicRoughness\":{"
                      "\"baseColorTexture\":{\"index\":0,\"texCoord\":0,\"extensions\":{"
                      "\"KHR_texture_transform\":{\"texCoord\":1}}},\"metallicRoughnessTexture\":{"
                      "\"index\":0,\"texCoord\":1,\"extensions\":{\"KHR_texture_transform\":{"
                      "\"texCoord\":0}}}}"),
        0);
    assert_int_equal(t->normal.set, 1);
    assert_int_equal(t->base.set, 1);
    assert_int_equal(t->surface.set, 0);
    assert_refused(read_material("\"normalTexture\":{\"index\":0,\"texCoord\":2}"),
                   "/materials/0/normalTexture/texCoord: 2, wanted 0 or 1");
}

TEST(alpha_is_opaque_cut_or_blended)
{
    const gltf *g = read_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.25],"
                                  "\"baseColorTexture\":{\"index\":0}}");
    assert_int_equal(textures_of(g, 0)->alpha, ALPHA_OPAQUE);
    assert_near(g->materials[0].alpha, 1, 0);
    g = read_material("\"alphaMode\":\"MASK\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                      "[1,1,1,0.25]}");
    assert_int_equal(textures_of(g, 0)->alpha, ALPHA_MASK); /* without any picture */
    assert_near(textures_of(g, 0)->cutoff, 0.5, 0);
    assert_near(g->materials[0].alpha, 0.25, 0);
    g = read_material("\"alphaMode\":\"BLEND\",\"alphaCutoff\":0.75,\"pbrMetallicRoughness\":{"
                      "\"baseColorTexture\":{\"index\":0}}");
    assert_int_equal(textures_of(g, 0)->alpha, ALPHA_BLEND);
    assert_near(textures_of(g, 0)->cutoff, 0.75, 0);
    g = read_material("\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                      "[1,1,1,0.25]}");
    assert_null(textures_of(g, 0)); /* a constant says it all */
    assert_near(g->materials[0].alpha, 0.25, 0);
}

TEST(what_of_a_material_is_not_taken_is_told)
{
    const gltf *g = read_material("\"occlusionTexture\":{\"index\":0},\"extensions\":{"
                                  "\"KHR_materials_ior\":{\"ior\":50},\"KHR_materials_volume\":{"
                                  "\"thicknessFactor\":0.5,\"thicknessTexture\":{\"index\":0}}}");
    assert_null(textures_of(g, 0));
    assert_near(g->materials[0].ior, 4, 0);
    assert_true(g->materials[0].volume);
    assert_near(g->materials[0].thickness, 0.5, 0);
    assert_int_equal(said.count, 3);
    assert_true(noticed(&said, "/materials/0/occlusionTexture: 1 materials"));
    assert_true(noticed(&said, "KHR_materials_volume/thicknessTexture: 1 materials"));
    assert_true(noticed(&said, "/ior: 1 materials have an index of refraction above 4"));
}

/* ---- coordinates of corners ---- */

TEST(corners_have_the_coordinates_that_textures_go_by)
{
    const gltf *g = read_material("\"normalTexture\":{\"index\":0},\"pbrMetallicRoughness\":{"
                                  "\"baseColorTexture\":{\"index\":0,\"texCoord\":1}}");
    assert_non_null(textures_of(g, 0));
    const mesh *m                 = &g->meshes[0].triangles;
    static const float first[12]  = { 0, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0 };
    static const float second[12] = { 0, 1, 2, 1, 0, -1, 0, -1, 2, 1, 2, -1 };
    assert_non_null(m->texcoord[0]);
    assert_non_null(m->texcoord[1]);
    assert_memory_equal(m->texcoord[0], first, sizeof first);
    assert_memory_equal(m->texcoord[1], second, sizeof second);

    g = read_material("\"normalTexture\":{\"index\":0,\"texCoord\":1}");
    assert_null(g->meshes[0].triangles.texcoord[0]);
    assert_memory_equal(g->meshes[0].triangles.texcoord[1], second, sizeof second);
    g = read_material("\"occlusionTexture\":{\"index\":0}");
    assert_null(g->meshes[0].triangles.texcoord[0]);
    assert_null(g->meshes[0].triangles.texcoord[1]);
}

/* The coordinates of an accessor of that type over the bytes of `second`. */
static const float *quantised(int component, const char *normalized, int count)
{
    const char *text = text_of(
        &memory,
        "{" ASSET ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"buffers\":[{"
        "\"byteLength\":148,\"uri\":\"%s\"}],\"bufferViews\":[%s],\"accessors\":[%s,{"
        "\"bufferView\":"
        "3,\"componentType\":%d,\"count\":%d,\"type\":\"VEC2\",\"normalized\":%s}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":5},\"indices\":1,"
        "\"material\":0}]}],\"images\":[%s],\"textures\":[{\"source\":0}],"
        "\"materials\":[{\"normalTexture\":{\"index\":0}}]}",
        data_uri(&memory, &plain_square, sizeof plain_square), views, accessors, component, count,
        normalized, picture());
    error         = (lux_error){ 0 };
    const gltf *g = read_bytes(&memory, "scene.gltf", text, strlen(text), NULL, &error);
    return g ? g->meshes[0].triangles.texcoord[0] : NULL;
}

/* The bytes of 0.0f and 1.0f, little-endian: 0 0 0 0 0 0 128 63. */
TEST(quantised_coordinates_are_read)
{
    const float *uv = quantised(5121, "true", 4);
    assert_non_null(uv);
    assert_near(uv[10], 128 / 255.0, 1e-7); /* corner 2 of triangle 1: vertex 3 */
    assert_near(uv[11], 63 / 255.0, 1e-7);
    uv = quantised(5121, "false", 4);
    assert_near(uv[10], 128, 0);
    uv = quantised(5120, "true", 4);
    assert_near(uv[10], -1, 0);
    uv = quantised(5123, "true", 4);
    assert_near(uv[2], 0, 0); /* vertex 1: 0 and 0x3f80 */
    assert_near(uv[3], 0x3f80 / 65535.0, 1e-7);
    uv = quantised(5122, "true", 4);
    assert_near(uv[3], 0x3f80 / 32767.0, 1e-7);
    assert_null(quantised(5125, "false", 4));
    assert_non_null(strstr(error.text, "/meshes/0/primitives/0/attributes/TEXCOORD_0: accessor 5 "
                                       "has componentType 5125"));
    assert_null(quantised(5121, "true", 3));
    assert_non_null(strstr(error.text, "accessor 5 has 3 elements, POSITION 4"));
}

TEST(coordinates_that_are_missing_or_wrong_are_told)
{
    static const char textured[] = "\"images\":[%s],\"textures\":[{\"source\":0}],"
                                   "\"materials\":[{\"normalTexture\":{\"index\":0}}]";
    const char *more             = text_of(&memory, textured, picture());
    const gltf *g                = read_square(&plain_square, ",\"TEXCOORD_1\":3", more);
    assert_non_null(textures_of(g, 0));
    assert_null(g->meshes[0].triangles.texcoord[0]);
    assert_true(noticed(&said, "/meshes/0/primitives/0: 1 primitives lack coordinates"));

    static const char at[] = "/meshes/0/primitives/0/attributes/TEXCOORD_0: ";
    assert_refused(read_square(&plain_square, ",\"TEXCOORD_0\":9", more),
                   text_of(&memory, "%saccessor 9 of 5", at));
    assert_refused(read_square(&plain_square, ",\"TEXCOORD_0\":4", more),
                   text_of(&memory, "%saccessor 4 has 3 components, wanted 2", at));
    square s    = plain_square;
    s.second[5] = NAN;
    assert_refused(read_square(&s, ",\"TEXCOORD_0\":3", more),
                   text_of(&memory, "%selement 2 of accessor 3 is not finite", at));
    s.second[5] = INFINITY;
    assert_refused(read_square(&s, ",\"TEXCOORD_0\":3", more), at);
}

/* ---- normals of corners ---- */

static const mesh *read_normals(const square *s)
{
    const gltf *g = read_square(s, ",\"NORMAL\":4", "\"materials\":[{}]");
    if (!g)
        fail_msg("%s", error.text);
    return &g->meshes[0].triangles;
}

static void assert_normal(vec3 got, double x, double y, double z)
{
    assert_near(got.x, x, 1e-6);
    assert_near(got.y, y, 1e-6);
    assert_near(got.z, z, 1e-6);
}

TEST(normals_of_flat_triangles_are_not_kept)
{
    assert_null(read_normals(&plain_square)->normals);
    square s     = plain_square;
    s.normals[0] = 0.00174f; /* 0.0997 degrees */
    assert_null(read_normals(&s)->normals);
    assert_int_equal(said.count, 0);
}

TEST(normals_that_say_more_are_kept_as_unit_vectors)
{
    square s      = plain_square;
    s.normals[9]  = 0.00176f; /* of vertex 3: 0.1008 degrees */
    s.normals[5]  = 2;        /* of vertex 1 */
    const mesh *m = read_normals(&s);
    assert_non_null(m->normals);
    for (int k = 0; k < 3; k++)
        assert_normal(m->normals[k], 0, 0, 0); /* the first triangle is flat */
    assert_normal(m->normals[3], 0, 0, 1);
    assert_normal(m->normals[4], 0, 0, 1);
    assert_normal(m->normals[5], sin(atan(0.00176)), 0, cos(atan(0.00176)));
    assert_int_equal(said.count, 0);
}

TEST(normals_that_are_none_or_of_the_back_leave_a_triangle_flat)
{
    static const vec3 wrong[] = {
        { 0, 0, 0 }, { 0, 0, -1 }, { 1, 0, 0 }, { NAN, 0, 1 }, { 0, INFINITY, 1 }
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        square s     = plain_square;
        s.normals[0] = wrong[i].x, s.normals[1] = wrong[i].y, s.normals[2] = wrong[i].z;
        s.normals[9]  = 0.5f;
        const mesh *m = read_normals(&s);
        assert_non_null(m->normals);
        assert_normal(m->normals[0], 0, 0, 0);
        assert_normal(m->normals[2], 0, 0, 0);
        assert_normal(m->normals[5], sqrt(0.2), 0, sqrt(0.8)); /* (1/2, 0, 1) */
        assert_true(noticed(&said, "/meshes/0: 1 triangles have normals that are none"));
    }
}

TEST(what_a_triangle_without_area_had_goes_with_it)
{
    square s = plain_square;
    memcpy(s.corners, (const uint16_t[6]){ 0, 1, 1, 2, 1, 3 }, 12);
    s.normals[9]  = 0.5f;
    const gltf *g = read_square(
        &s, ",\"NORMAL\":4,\"TEXCOORD_0\":2",
        text_of(&memory,
                "\"images\":[%s],\"textures\":[{\"source\":0}],\"materials\":[{\"normalTexture\":{"
                "\"index\":0}}]",
                picture()));
    assert_non_null(textures_of(g, 0));
    const mesh *m              = &g->meshes[0].triangles;
    static const float last[6] = { 0, 0, 1, 1, 1, 0 };
    assert_int_equal(m->triangle_count, 1);
    assert_memory_equal(m->texcoord[0], last, sizeof last);
    assert_normal(m->normals[2], sqrt(0.2), 0, sqrt(0.8));
}

/* ---- what is wrong ---- */

TEST(wrong_indices_and_numbers_are_named)
{
    static const struct {
        const char *more, *sentence;
    } wrong[] = {
        { "\"materials\":[{\"normalTexture\":{\"index\":0}}]",
          "/materials/0/normalTexture/index: texture 0 of 0" },
        { "\"materials\":[{},{\"extensions\":{\"KHR_materials_specular\":{\"specularTexture\":{"
          "\"index\":3}}}}]",
          "/materials/1/extensions/KHR_materials_specular/specularTexture/index: texture 3 of 0" },
        { "\"textures\":[{\"source\":1}]", "/textures/0/source: image 1 of 0" },
        { "\"textures\":[{\"sampler\":1}],\"samplers\":[{}]",
          "/textures/0/sampler: sampler 1 of 1" },
        { "\"textures\":[{\"extensions\":{\"EXT_texture_webp\":{\"source\":2}}}]",
          "/textures/0/extensions/EXT_texture_webp/source: image 2 of 0" },
        { "\"samplers\":[{},{\"wrapT\":10498}]", "/samplers/1/wrapT: 10498, wanted 10497" },
        { "\"samplers\":[{\"magFilter\":9984}]", "/samplers/0/magFilter: 9984, wanted 9728 to" },
        { "\"samplers\":[{\"wrapS\":\"x\"}]", "/samplers/0/wrapS: a string, wanted an index" },
        { "\"materials\":[{\"normalTexture\":{}}]", "/materials/0/normalTexture: no \"index\"" },
        { "\"materials\":[{\"normalTexture\":{\"index\":0,\"extensions\":{"
          "\"KHR_texture_transform\":{\"scale\":[1]}}}}]",
          "/KHR_texture_transform/scale: 1 numbers, wanted 2" },
        { "\"materials\":[{\"normalTexture\":{\"index\":0,\"extensions\":{"
          "\"KHR_texture_transform\":{\"offset\":[1e10,0]}}}}]",
          "/KHR_texture_transform/offset/0: 1e10, wanted -1e+09 to 1e+09" },
        { "\"materials\":[{\"extensions\":{\"KHR_materials_ior\":{\"ior\":0.5}}}]",
          "/materials/0/extensions/KHR_materials_ior/ior: 0.5, wanted 0, or 1 and more" },
        { "\"materials\":[{\"extensions\":{\"KHR_materials_volume\":{\"attenuationDistance\":0}}}]",
          "/KHR_materials_volume/attenuationDistance: 0, wanted above 0" },
        { "\"materials\":[{\"extensions\":{\"KHR_materials_volume\":{\"attenuationDistance\":"
          "10000000000}}}]",
          "/attenuationDistance: 10000000000, wanted a whole number below 2^31" },
        { "\"materials\":[{\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":1.5}}}]",
          "/KHR_materials_specular/specularFactor: 1.5, wanted 0 to 1" },
        { "\"materials\":[{\"alphaCutoff\":-1}]", "/materials/0/alphaCutoff: -1, wanted" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const char *text = text_of(&memory, "{" ASSET ",%s}", wrong[i].more);
        error            = (lux_error){ 0 };
        assert_refused(read_bytes(&memory, "scene.gltf", text, strlen(text), NULL, &error),
                       wrong[i].sentence);
    }
}

TEST(the_constants_of_gloss_and_volume_are_read)
{
    const gltf *g = read_material(
        "\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.75},\"KHR_materials_unlit\":{},"
        "\"KHR_materials_specular\":{\"specularFactor\":0.25,\"specularColorFactor\":[0.5,1,2]},"
        "\"KHR_materials_volume\":{\"thicknessFactor\":2,\"attenuationDistance\":1e12,"
        "\"attenuationColor\":[0,0.5,1]}}");
    assert_null(textures_of(g, 0));
    const gltf_material *m = &g->materials[0];
    assert_near(m->ior, 1.75, 0);
    assert_near(m->specular, 0.25, 0);
    assert_normal(m->specular_color, 0.5, 1, 2);
    assert_true(m->unlit && m->volume);
    assert_near(m->attenuation_distance, 1e12, 1e-6);
    assert_true(m->attenuation_color.x > 0.0f && isfinite(logf(m->attenuation_color.x)));
    assert_near(m->attenuation_color.y, 0.5, 0);
    g = read_material("\"extensions\":{\"KHR_materials_volume\":{\"attenuationDistance\":1e-300}}");
    assert_non_null(g);
    assert_false(g->materials[0].volume); /* thin: its thickness is 0 */
    assert_near(g->materials[0].attenuation_distance, 1e-9, 1e-6);
}

/* ---- files of Blender's exporter ---- */

#define SHARED "../shared/data/gltf/blender_io/roundtrip/"

static const gltf *read_shared(const char *name)
{
    struct stat there;
    const char *path = text_of(&memory, SHARED "%s/%s.gltf", name, name);
    if (stat(path, &there) != 0)
        skip();
    said          = (notices){ .a = &memory };
    const gltf *g = gltf_read(&memory, path, &said, &error);
    if (!g)
        fail_msg("%s", error.text);
    return g;
}

TEST(a_file_of_transforms_is_read)
{
    const gltf *g              = read_shared("09_texture_transform");
    const material_textures *t = textures_of(g, 0);
    assert_non_null(g->meshes[0].triangles.texcoord[0]);
    assert_moved(&t->base, 1, 0, 4 * cos(0.3) + 0.1, -4 * sin(0.3) + 0.2);
    assert_moved(&t->surface, 0, 1, 6 * sin(0.4) + 0.2, 6 * cos(0.4) + 0.3);
    assert_moved(&t->normal, 0, 0, 0.3, 0.4);
    assert_null(t->emission.texture); /* its emissiveFactor is 0 */
}

TEST(a_file_of_two_sets_is_read)
{
    const gltf *g              = read_shared("12_orm_two_uvmaps");
    const material_textures *t = textures_of(g, 0);
    assert_int_equal(t->surface.set, 0);
    assert_non_null(t->surface.texture);
    assert_non_null(g->meshes[0].triangles.texcoord[0]);
    assert_null(g->meshes[0].triangles.texcoord[1]); /* of the occlusion alone */
}

TEST(a_file_of_transmission_is_read)
{
    const gltf *g = read_shared("15_transmission");
    for (uint32_t i = 0; i < 5; i++) {
        const gltf_material *m = &g->materials[i];
        bool textured          = !strcmp(m->name, "transmissionTexture") ||
                        !strcmp(m->name, "transmissionFactorTexture");
        assert_true(textured == (m->textures && m->textures->transmission.texture));
    }
    assert_int_equal(g->texture_count, 1);
}

TEST(files_of_index_and_gloss_are_read)
{
    const gltf *g = read_shared("17_ior");
    assert_near(g->materials[0].ior, 1.5, 0);
    assert_near(g->materials[2].ior, 2, 0);
    assert_near(g->materials[3].ior, 1.45, 1e-6);
    g = read_shared("20_specular");
    assert_int_equal(g->texture_count, 1); /* four textures of one picture and sampler */
    assert_near(g->materials[1].specular, 0.8, 1e-6);
    assert_normal(g->materials[2].specular_color, 0.1, 0.2, 0.3);
    assert_non_null(textures_of(g, 3)->specular_weight.texture);
    assert_non_null(textures_of(g, 5)->specular_color.texture);
}

TEST(a_file_of_custom_normals_is_read)
{
    const gltf *g = read_shared("10_custom_normals");
    bool some     = false;
    for (uint32_t i = 0; i < g->mesh_count; i++) {
        const mesh *m = &g->meshes[i].triangles;
        for (uint32_t k = 0; m->normals && k < 3 * m->triangle_count; k++) {
            double length = (double)v3_length(m->normals[k]);
            assert_true(length == 0.0 || fabs(length - 1.0) < 1e-6);
            some = some || length > 0.0;
        }
    }
    assert_true(some);
}

/* A red picture in WebP; the picture beside it is blue at that place. */
TEST(a_webp_is_preferred_to_the_picture_beside_it)
{
    FILE *f = fopen("../shared/data/gltf/khronos_validator/ext/EXT_texture_webp/data/image/"
                    "VP8L_red.webp",
                    "rb");
    uint8_t bytes[256];
    if (!f)
        skip();
    size_t size = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    const gltf *g = read_square(
        &plain_square, ",\"TEXCOORD_0\":2",
        text_of(&memory,
                "\"images\":[%s,{\"uri\":\"%s\"}],\"textures\":[{\"source\":0,\"extensions\":{"
                "\"EXT_texture_webp\":{\"source\":1}}}],\"materials\":[{\"normalTexture\":{"
                "\"index\":0}}]",
                picture(), data_uri(&memory, bytes, size)));
    assert_texel(textures_of(g, 0)->normal.texture, 0.25f, 0.75f, red, 1e-6);
    assert_int_equal(said.count, 0);
}

#define GLTF_TEST(name) cmocka_unit_test_teardown(name, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        GLTF_TEST(colours_are_decoded_from_srgb_and_numbers_are_not),
        GLTF_TEST(a_picture_is_found_in_a_file_a_uri_and_a_buffer),
        GLTF_TEST(samplers_wrap_and_filter),
        GLTF_TEST(only_a_near_filter_that_is_nearest_takes_single_texels),
        GLTF_TEST(one_texture_serves_all_that_want_it_the_same),
        GLTF_TEST(pictures_that_nothing_shows_are_not_opened),
        GLTF_TEST(a_texture_without_picture_is_white),
        GLTF_TEST(a_webp_that_cannot_be_read_is_replaced),
        GLTF_TEST(only_what_glows_may_be_above_1),
        GLTF_TEST(coordinates_are_scaled_then_turned_then_moved),
        GLTF_TEST(the_example_of_the_extension_shows_the_lower_left_quarter),
        GLTF_TEST(a_transform_may_name_another_set),
        GLTF_TEST(alpha_is_opaque_cut_or_blended),
        GLTF_TEST(what_of_a_material_is_not_taken_is_told),
        GLTF_TEST(corners_have_the_coordinates_that_textures_go_by),
        GLTF_TEST(quantised_coordinates_are_read),
        GLTF_TEST(coordinates_that_are_missing_or_wrong_are_told),
        GLTF_TEST(normals_of_flat_triangles_are_not_kept),
        GLTF_TEST(normals_that_say_more_are_kept_as_unit_vectors),
        GLTF_TEST(normals_that_are_none_or_of_the_back_leave_a_triangle_flat),
        GLTF_TEST(what_a_triangle_without_area_had_goes_with_it),
        GLTF_TEST(wrong_indices_and_numbers_are_named),
        GLTF_TEST(the_constants_of_gloss_and_volume_are_read),
        GLTF_TEST(a_file_of_transforms_is_read),
        GLTF_TEST(a_file_of_two_sets_is_read),
        GLTF_TEST(a_file_of_transmission_is_read),
        GLTF_TEST(files_of_index_and_gloss_are_read),
        GLTF_TEST(a_file_of_custom_normals_is_read),
        GLTF_TEST(a_webp_is_preferred_to_the_picture_beside_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
