/* sim/gltf_file.c -- the bytes of a scene: .gltf, .glb, buffers beside it and within it.
 *
 *     0        4        8        12             16      20                 (little-endian words)
 *     "glTF"   2        length   JSON's bytes   "JSON"  ...  bytes  "BIN\0"  ...
 */
#include "core/file.h"
#include "sim/gltf_source.h"

#include <stdio.h>
#include <string.h>

static const size_t file_most = (size_t)1 << 31;

static uint32_t word_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

/* ---- .glb ---- */

static const uint32_t chunk_json = 0x4e4f534a, chunk_bin = 0x004e4942;

/* The chunk at *offset of a file that ends at `length`; *offset goes behind it. */
static bool take_chunk(gltf_file *f, const uint8_t *bytes, size_t length, size_t *offset,
                       uint32_t wanted, const uint8_t **chunk, size_t *size, lux_error *err)
{
    if (length - *offset < 8)
        return failed(err, ERR_FORMAT, "%s: byte %zu: %zu bytes left, a chunk's header has 8",
                      f->path, *offset, length - *offset);
    uint32_t declared = word_at(bytes + *offset);
    uint32_t kind     = word_at(bytes + *offset + 4);
    if (declared > length - *offset - 8)
        return failed(err, ERR_FORMAT, "%s: byte %zu: a chunk of %u bytes where %zu are left",
                      f->path, *offset, declared, length - *offset - 8);
    *chunk = kind == wanted ? bytes + *offset + 8 : NULL;
    *size  = kind == wanted ? declared : 0;
    *offset += 8 + (size_t)declared;
    return true;
}

static bool open_binary(gltf_file *f, uint8_t *bytes, size_t size, lux_error *err)
{
    if (size < 20)
        return failed(err, ERR_FORMAT, "%s: %zu bytes, a .glb has 20 at least", f->path, size);
    if (word_at(bytes + 4) != 2)
        return failed(err, ERR_UNSUPPORTED, "%s: byte 4: .glb of version %u, wanted 2", f->path,
                      word_at(bytes + 4));
    size_t length = word_at(bytes + 8);
    if (length > size || length < 20)
        return failed(err, ERR_FORMAT, "%s: byte 8: a length of %zu, the file has %zu bytes",
                      f->path, length, size);

    const uint8_t *json;
    size_t offset = 12;
    if (!take_chunk(f, bytes, length, &offset, chunk_json, &json, &f->json_size, err))
        return false;
    if (!json)
        return failed(err, ERR_FORMAT, "%s: byte 16: the first chunk is not JSON", f->path);
    if (offset < length &&
        !take_chunk(f, bytes, length, &offset, chunk_bin, &f->chunk, &f->chunk_size, err))
        return false;

    /* Its own copy: it shall end with a NUL, and what stands behind it shall stay */
    f->json = arena_array(f->scratch, char, f->json_size + 1, err);
    if (f->json)
        memcpy(f->json, json, f->json_size);
    return f->json != NULL;
}

bool gltf_file_open(gltf_file *f, const char *path, lux_error *err)
{
    size_t size;
    f->path    = path;
    char *text = file_read(f->scratch, path, file_most, &size, err);
    if (!text)
        return false;
    if (size == 0)
        return failed(err, ERR_FORMAT, "%s: the file is empty, wanted glTF", path);
    if (size >= 4 && !memcmp(text, "glTF", 4))
        return open_binary(f, (uint8_t *)text, size, err);

    int mark     = size >= 3 && !memcmp(text, "\xef\xbb\xbf", 3) ? 3 : 0; /* of UTF-8 */
    f->json      = text + mark;
    f->json_size = size - (size_t)mark;
    return true;
}

/* ---- buffers ---- */

/* Gets buffer i; all files together may have *left bytes. */
static bool buffer_bytes(const gltf_file *f, uint32_t i, size_t *left, lux_error *err)
{
    source_buffer *b = &f->buffers[i];
    char pointer[48];
    snprintf(pointer, sizeof pointer, "/buffers/%u%s", i, b->uri ? "/uri" : "");

    const uint8_t *bytes = f->chunk;
    size_t size          = f->chunk_size;
    const char *path     = NULL;
    if (b->uri && !gltf_file_locate(f, pointer, b->uri, b->uri_length, &bytes, &size, &path, err))
        return false;
    if (!b->uri && (i > 0 || !bytes))
        return true; /* of no bytes: extensions may fill it, and nothing is read from it */
    if (path) {
        lux_error why = { 0 };
        bytes         = (const uint8_t *)file_read(f->scratch, path, *left, &size, &why);
        if (!bytes)
            return failed(err, why.code, "%s: %s: %s", f->path, pointer, why.text);
        *left -= size;
    }
    if (size < b->declared)
        return failed(err, ERR_FORMAT, "%s: %s: %zu bytes, byteLength wants %zu", f->path, pointer,
                      size, b->declared);
    b->bytes = bytes;
    return true;
}

bool gltf_file_buffers(gltf_file *f, lux_error *err)
{
    size_t left = file_most;
    for (uint32_t i = 0; i < f->buffer_count; i++)
        if (!buffer_bytes(f, i, &left, err))
            return false;
    return true;
}
