/* tests/gltf_text.c -- see gltf_text.h. */
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILES_MOST = 16 };

static char folder[64], files[FILES_MOST][128];
static int file_count;

const char *scratch_folder(void)
{
    if (!*folder) {
        /* Thousands of small files: in memory where there is such a place */
        strcpy(folder,
               access("/dev/shm", W_OK) ? "/tmp/lux4_gltf_XXXXXX" : "/dev/shm/lux4_gltf_XXXXXX");
        assert_non_null(mkdtemp(folder));
    }
    return folder;
}

void scratch_remove(void)
{
    for (int i = 0; i < file_count; i++)
        unlink(files[i]);
    if (*folder)
        rmdir(folder);
    *folder    = 0;
    file_count = 0;
}

const char *scratch_write(const char *name, const void *bytes, size_t size)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", scratch_folder(), name);
    int i = 0;
    while (i < file_count && strcmp(files[i], path) != 0)
        i++;
    assert_true(i < FILES_MOST);
    if (i == file_count)
        strcpy(files[file_count++], path);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_true(!size || fwrite(bytes, 1, size, f) == size);
    assert_int_equal(fclose(f), 0);
    return path;
}

const gltf *read_bytes(arena *a, const char *name, const void *bytes, size_t size, notices *n,
                       lux_error *err)
{
    return gltf_read(a, scratch_write(name, bytes, size), n, err);
}

const char *data_uri(arena *a, const void *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const char head[]   = "data:application/octet-stream;base64,";
    const uint8_t *b           = bytes;
    char *uri                  = arena_array(a, char, sizeof head + (size + 2) / 3 * 4, NULL);
    char *to                   = uri + sizeof head - 1;
    memcpy(uri, head, sizeof head);
    for (size_t i = 0; i < size; i += 3) {
        uint32_t three = (uint32_t)b[i] << 16;
        three |= i + 1 < size ? (uint32_t)b[i + 1] << 8 : 0;
        three |= i + 2 < size ? (uint32_t)b[i + 2] : 0;
        for (int k = 0; k < 4; k++)
            *to++ = digits[three >> (18 - 6 * k) & 63];
        if (i + 2 >= size)
            to[-1] = '=';
        if (i + 1 >= size)
            to[-2] = '=';
    }
    return uri;
}

static void put_word(uint8_t *to, size_t word)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> (8 * i));
}

uint8_t *make_glb(arena *a, const char *json, const void *chunk, size_t size, size_t *total)
{
    size_t length = (strlen(json) + 3) / 4 * 4, bin = (size + 3) / 4 * 4;
    *total       = 20 + length + (chunk ? 8 + bin : 0);
    uint8_t *glb = arena_array(a, uint8_t, *total, NULL);
    memcpy(glb, "glTF", 4);
    put_word(glb + 4, 2);
    put_word(glb + 8, *total);
    put_word(glb + 12, length);
    memcpy(glb + 16, "JSON", 4);
    memset(glb + 20, ' ', length);
    memcpy(glb + 20, json, strlen(json));
    if (chunk) {
        put_word(glb + 20 + length, bin);
        memcpy(glb + 24 + length, "BIN", 4);
        memcpy(glb + 28 + length, chunk, size);
    }
    return glb;
}

char *text_of(arena *a, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = arena_array(a, char, (size_t)length + 1, NULL);
    va_start(args, format);
    vsnprintf(text, (size_t)length + 1, format, args);
    va_end(args);
    return text;
}

bool noticed(const notices *n, const char *text)
{
    for (const notice *line = n->first; line; line = line->next)
        if (strstr(line->text, text))
            return true;
    return false;
}
