/* tests/lab_picture.c -- see lab_picture.h. PNG (ISO/IEC 15948) with one block that is stored. */
#include "tests/lab_picture.h"

#include "tests/gltf_text.h"

#include <string.h>

static void put_word(uint8_t *to, uint32_t word) /* the highest byte first */
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> (24 - 8 * i));
}

static uint8_t *put_chunk(uint8_t *to, const char *kind, const uint8_t *bytes, uint32_t size)
{
    uint32_t crc = 0xffffffff;
    put_word(to, size);
    memcpy(to + 4, kind, 4);
    memcpy(to + 8, bytes, size);
    for (uint32_t i = 4; i < 8 + size; i++) {
        crc ^= to[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    put_word(to + 8 + size, ~crc);
    return to + 12 + size;
}

/* zlib's stream: a head, the block's, rows that each begin with their filter, 0, and Adler's sum */
static uint32_t store_rows(const picture *p, uint8_t *to)
{
    uint32_t row = 4 * (uint32_t)p->width + 1, count = row * (uint32_t)p->height, a = 1, b = 0;
    const uint8_t head[7] = {
        0x78, 1, 1, (uint8_t)count, (uint8_t)(count >> 8), (uint8_t)~count, (uint8_t)(~count >> 8)
    };
    memcpy(to, head, 7);
    for (int y = 0; y < p->height; y++) {
        uint8_t *at = to + 7 + row * (uint32_t)y;
        at[0]       = 0;
        memcpy(at + 1, p->rgba + (row - 1) * (uint32_t)y, row - 1);
    }
    for (uint32_t i = 0; i < count; i++)
        a = (a + to[7 + i]) % 65521, b = (b + a) % 65521;
    put_word(to + 7 + count, b << 16 | a);
    return count + 11;
}

static const char *png_of(lab *l, const picture *p)
{
    size_t room      = 4 * (size_t)(p->width + 1) * (size_t)p->height + 100;
    uint8_t *rows    = arena_array(&l->a, uint8_t, room, NULL);
    uint8_t *out     = arena_array(&l->a, uint8_t, room, NULL);
    uint8_t head[13] = { [8] = 8, [9] = 6 }; /* bits, RGBA */
    put_word(head, (uint32_t)p->width);
    put_word(head + 4, (uint32_t)p->height);
    memcpy(out, "\x89PNG\r\n\x1a\n", 8);
    uint8_t *to = put_chunk(out + 8, "IHDR", head, sizeof head);
    to          = put_chunk(to, "IDAT", rows, store_rows(p, rows));
    to          = put_chunk(to, "IEND", head, 0);
    return data_uri(&l->a, out, (size_t)(to - out));
}

void lab_picture(lab *l, const char *name, const quad *q, const picture *p, const char *made_of)
{
    static const float uv[4][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
    static const int around[6]  = { 0, 1, 2, 0, 2, 3 };
    float at[6][5], low[3], high[3];
    for (int i = 0; i < 6; i++) {
        dvec3 c  = q->corner[around[i]];
        at[i][0] = (float)c.x, at[i][1] = (float)c.z, at[i][2] = (float)-c.y;
        memcpy(at[i] + 3, uv[around[i]], sizeof uv[0]);
        for (int k = 0; k < 3; k++) {
            low[k]  = i ? fminf(low[k], at[i][k]) : at[i][k];
            high[k] = i ? fmaxf(high[k], at[i][k]) : at[i][k];
        }
    }
    lab_write(l, name,
              "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_texture_transform\","
              "\"KHR_materials_emissive_strength\"],\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
              "\"mesh\":0}],\"materials\":[{%s}],\"images\":[{\"uri\":\"data:image/png;%s\"}],"
              "\"samplers\":[{%s}],\"textures\":[{\"source\":0,\"sampler\":0}],\"buffers\":[{"
              "\"byteLength\":120,\"uri\":\"%s\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":"
              "120,\"byteStride\":20}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
              "\"type\":\"VEC3\",\"count\":6,\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
              "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"type\":\"VEC2\","
              "\"count\":6}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
              "\"TEXCOORD_0\":1},\"material\":0}]}]}",
              made_of, strchr(png_of(l, p), ';') + 1, p->sampler, data_uri(&l->a, at, sizeof at),
              (double)low[0], (double)low[1], (double)low[2], (double)high[0], (double)high[1],
              (double)high[2]);
}
