/* core/image_picture.c -- pictures that are no EXR, through liblux4_oiio.so.
 *
 * That library, and OpenImageIO with some 260 others behind it, is loaded when the first picture
 * is asked for: at each start it would cost 0.2 s.
 */
#define _GNU_SOURCE
#include "core/file.h"
#include "core/image.h"
#include "core/image_oiio.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define PLUGIN "liblux4_oiio.so"

static const size_t MOST_BYTES = (size_t)1 << 30; /* of a picture's file */

/* ---- finding it ------------------------------------------------------------------------- */

/* Where it may lie, seen from the program's folder: beside it, where `make install` puts it, and
 * for the tests, which lie deeper in the build folder. */
static const char *const PLACES[] = { "/", "/../lib/lux4/", "/../../", "/../../../" };

/* A library is loaded once in a process: the one thing here that outlives a call. */
static struct {
    pthread_once_t once;
    oiio_encode_function *encode;
    oiio_load_function *load;
    char reason[200]; /* why there are no functions */
} plugin = { .once = PTHREAD_ONCE_INIT };

static void *open_at(const char *folder, const char *place)
{
    char name[PATH_MAX];
    if (snprintf(name, sizeof name, "%s%s" PLUGIN, folder, place) >= (int)sizeof name)
        return NULL;
    if (access(name, F_OK))
        return NULL;
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        snprintf(plugin.reason, sizeof plugin.reason, "%s", dlerror());
    return library;
}

static void *open_plugin(void)
{
    char program[PATH_MAX] = "";
    ssize_t length         = readlink("/proc/self/exe", program, sizeof program - 1);
    void *library          = NULL;
    if (length > 0) {
        program[length]        = '\0';
        *strrchr(program, '/') = '\0'; /* the link is absolute */
        for (size_t i = 0; !library && i < sizeof PLACES / sizeof *PLACES; i++)
            library = open_at(program, PLACES[i]);
    }
#ifdef LUX4_LIBDIR
    if (!library)
        library = open_at(LUX4_LIBDIR, "/");
#endif
    if (!library && !plugin.reason[0])
        snprintf(plugin.reason, sizeof plugin.reason,
                 "it is neither beside the program (%.60s) nor in ../lib/lux4 from there", program);
    return library;
}

static void load(void)
{
    void *library = open_plugin();
    if (!library)
        return;
    /* POSIX has dlsym() give functions as objects; ISO C has no cast for that. */
    *(void **)&plugin.encode = dlsym(library, "lux4_oiio_encode");
    *(void **)&plugin.load   = dlsym(library, "lux4_oiio_load");
    if (!plugin.encode || !plugin.load)
        snprintf(plugin.reason, sizeof plugin.reason, "it is of another version");
}

static bool plugin_ready(const char *path, lux_error *err)
{
    pthread_once(&plugin.once, load);
    if (plugin.encode && plugin.load)
        return true;
    return failed(err, ERR_UNSUPPORTED,
                  "%s: pictures need " PLUGIN " and OpenImageIO (package libopenimageio2.4): %s",
                  path, plugin.reason);
}

bool image_pictures_ready(lux_error *err) { return plugin_ready("preview", err); }

/* ---- using it --------------------------------------------------------------------------- */

static bool put(void *context, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, context) == size;
}

bool image_write_rgb8(const char *path, int width, int height, const uint8_t *rgb, lux_error *err)
{
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return failed(err, ERR_ARGUMENT, "%s: %d x %d pixels, 1 to 65535 a side expected", path,
                      width, height);
    if (!plugin_ready(path, err))
        return false;
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    const oiio_picture picture = { path, width, height, rgb };
    oiio_message why           = { "" };
    /* Where storing failed, committing says why. */
    if (plugin.encode(&picture, (oiio_sink){ put, f.stream }, &why) || ferror(f.stream))
        return file_commit(&f, err);
    file_discard(&f);
    return failed(err, ERR_ARGUMENT, "%s: cannot be written: %s", path, why.text);
}

/* ---- PNG before it is read -------------------------------------------------------------- */

/* libpng, as OpenImageIO calls it, prints what it dislikes on stderr, and leaks where it fails. It
 * is given whole files alone, and none of the chunks that say nothing of the pixels. */

static const char PNG_MAGIC[8]    = { '\x89', 'P', 'N', 'G', '\r', '\n', '\x1a', '\n' };
static const char PNG_CHUNKS[][5] = { "IHDR", "PLTE", "tRNS", "IDAT", "IEND" };
enum { CHUNK_FRAME = 12, CHUNK_LAST = sizeof PNG_CHUNKS / sizeof *PNG_CHUNKS - 1 };

static uint32_t big_endian(const uint8_t *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* ISO/IEC 15948, annex D, four bits at a time. */
static uint32_t png_crc(const uint8_t *bytes, size_t size)
{
    static const uint32_t table[16] = {
        0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
        0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
        0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c,
    };
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        crc = crc >> 4 ^ table[crc & 15];
        crc = crc >> 4 ^ table[crc & 15];
    }
    return ~crc;
}

static bool is_png(const void *bytes, size_t size)
{
    return size >= sizeof PNG_MAGIC && memcmp(bytes, PNG_MAGIC, sizeof PNG_MAGIC) == 0;
}

/* Which of PNG_CHUNKS this is; -1: another. */
static int chunk_kind(const uint8_t *chunk)
{
    for (int i = 0; i <= CHUNK_LAST; i++)
        if (memcmp(chunk + 4, PNG_CHUNKS[i], 4) == 0)
            return i;
    return -1;
}

/* Copies a PNG, be it onto itself, without the chunks that are not needed; its size then, or 0 if
 * the file is cut or damaged. Each chunk is its length, four letters, as many bytes as its length
 * says, a CRC.
 */
static size_t png_copy(const uint8_t *from, size_t size, uint8_t *to)
{
    size_t at = sizeof PNG_MAGIC, copied = sizeof PNG_MAGIC;
    memmove(to, from, at);
    while (size - at >= CHUNK_FRAME) {
        size_t length = big_endian(from + at);
        if (length > size - at - CHUNK_FRAME)
            return 0;
        if (png_crc(from + at + 4, length + 4) != big_endian(from + at + 8 + length))
            return 0;
        int kind = chunk_kind(from + at);
        if (kind >= 0) {
            memmove(to + copied, from + at, length + CHUNK_FRAME);
            copied += length + CHUNK_FRAME;
        }
        if (kind == CHUNK_LAST)
            return copied;
        at += length + CHUNK_FRAME;
    }
    return 0;
}

/* `to` has room for all of it. */
static bool prepare_png(oiio_source *from, const char *path, uint8_t *to, lux_error *err)
{
    from->size  = png_copy(from->bytes, from->size, to);
    from->bytes = to;
    return from->size || failed(err, ERR_FORMAT, "%s: PNG that is cut off or damaged", path);
}

/* ---- reading ---------------------------------------------------------------------------- */

static bool prepare(oiio_source *from, const char *path, arena *scratch, lux_error *err)
{
    void *own = NULL;
    if (!from->bytes)
        from->bytes = own = file_read(scratch, path, MOST_BYTES, &from->size, err);
    if (!from->bytes)
        return false;
    if (is_png(from->bytes, from->size)) {
        uint8_t *to = own ? own : arena_array(scratch, uint8_t, from->size, err);
        return to && prepare_png(from, path, to, err);
    }
    if (own) {
        arena_clear(scratch);
        from->bytes = NULL; /* not all formats can be read from memory */
    }
    return true;
}

typedef struct picture {
    arena *a;
    int width, height;
    float *rgba;
    lux_error err; /* why there is no room */
} picture;

static float *make_room(void *context, int width, int height)
{
    picture *p = context;
    p->width   = width;
    p->height  = height;
    p->rgba    = arena_array(p->a, float, (size_t)width *(size_t)height * 4, &p->err);
    return p->rgba;
}

static bool load_picture(oiio_source from, const char *path, arena *a, int *width, int *height,
                         float **values, lux_error *err)
{
    arena scratch    = { 0 };
    oiio_message why = { "" };
    picture p        = { .a = a };
    bool ok          = prepare(&from, path, &scratch, err) && plugin_ready(path, err);
    if (ok && !plugin.load(&from, (oiio_place){ make_room, &p }, &why))
        ok = p.err.code
                 ? failed(err, p.err.code, "%s: %s", path, p.err.text)
                 : failed(err, ERR_FORMAT, "%s: cannot be read as a picture: %s", path, why.text);
    arena_clear(&scratch);
    if (!ok)
        return false;
    *width  = p.width;
    *height = p.height;
    *values = p.rgba;
    return true;
}

bool image_load_rgba(const char *path, const void *bytes, size_t size, bool srgb, arena *a,
                     int *width, int *height, float **rgba, lux_error *err)
{
    oiio_source from = { .name = path, .bytes = bytes, .size = size, .srgb = srgb };
    return load_picture(from, path, a, width, height, rgba, err);
}

bool image_load_radiance(const char *path, arena *a, int *width, int *height, float **rgb0,
                         lux_error *err)
{
    oiio_source from = { .name = path, .srgb = true, .radiance = true };
    return load_picture(from, path, a, width, height, rgb0, err);
}
