/* core/image_exr_read.c -- reads EXR files through OpenEXR's C API into planes of floats.
 *
 * The file is read whole first, so that the library never waits for a pipe or meets a file that
 * shrinks; it sees memory. Sizes that the library would believe are checked before any is used.
 * All compressions that the library decodes are read: in 3.1.5 its C API lacks DWAA and DWAB.
 */
#include "core/file.h"
#include "core/image.h"

#include <openexr.h>
#include <stdio.h>
#include <string.h>

enum { MOST_CHANNELS = 1024, MOST_PIXELS_A_SIDE = 1 << 26, MESSAGE_SIZE = 160 };

static const uint64_t MOST_BYTES  = 1ull << 32; /* of a file */
static const uint64_t MOST_FLOATS = 1ull << 31;

typedef struct reader {
    const char *path;
    const char *bytes;
    size_t size;
    char message[MESSAGE_SIZE]; /* the library's first complaint */
    exr_context_t exr;
    int part;  /* that is read */
    bool only; /* it must be the only one */
    exr_storage_t storage;
    exr_compression_t compression;
    int32_t x, y;         /* the data window begins here */
    uint64_t pixel_bytes; /* of all channels, as stored */
    image *im;
} reader;

/* ---- what the library calls ------------------------------------------------------------- */

static void keep_message(exr_const_context_t exr, exr_result_t code, const char *message)
{
    void *user = NULL;
    (void)code;
    if (exr_get_user_data(exr, &user) != EXR_ERR_SUCCESS || !user)
        return;
    reader *r = user;
    if (r->message[0])
        return;
    snprintf(r->message, sizeof r->message, "%s", message);
    for (char *c = r->message; *c; c++) /* it may quote what the file contains */
        if (*c < ' ' || *c > '~')
            *c = '?';
}

static int64_t read_bytes(exr_const_context_t exr, void *user, void *to, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    const reader *r = user;
    (void)exr, (void)complain;
    if (offset >= r->size)
        return 0;
    uint64_t rest = r->size - offset;
    uint64_t n    = size < rest ? size : rest;
    memcpy(to, r->bytes + offset, n);
    return (int64_t)n;
}

static int64_t total_bytes(exr_const_context_t exr, void *user)
{
    (void)exr;
    return (int64_t)((const reader *)user)->size;
}

static bool refused(const reader *r, exr_result_t code, lux_error *err)
{
    error_code as = code == EXR_ERR_OUT_OF_MEMORY             ? ERR_MEMORY
                    : code == EXR_ERR_FEATURE_NOT_IMPLEMENTED ? ERR_UNSUPPORTED
                                                              : ERR_FORMAT;
    return failed(err, as, "%s: cannot be read as EXR: %s", r->path,
                  r->message[0] ? r->message : exr_get_default_error_message(code));
}

/* ---- the header ------------------------------------------------------------------------- */

/* The most that one byte of a file can stand for: 1032 is what deflate can do, and a DCT block of
 * 64 halves may be one deflated coefficient. Twice, for halves become floats. */
static uint64_t most_expansion(exr_compression_t c)
{
    switch (c) {
    case EXR_COMPRESSION_NONE:
        return 2;
    case EXR_COMPRESSION_DWAA:
    case EXR_COMPRESSION_DWAB:
        return 2 * 64 * 1032;
    default:
        return 2 * 1032;
    }
}

static bool check_kind(reader *r, lux_error *err)
{
    int parts;
    exr_result_t code = exr_get_count(r->exr, &parts);
    if (!code && r->only && parts != 1)
        return failed(err, ERR_UNSUPPORTED, "%s: EXR of %d parts, one was expected", r->path,
                      parts);
    if (!code && (r->part < 0 || r->part >= parts))
        return failed(err, ERR_ARGUMENT, "%s: no part %d: EXR of %d parts", r->path, r->part,
                      parts);
    if (!code)
        code = exr_get_storage(r->exr, r->part, &r->storage);
    if (!code)
        code = exr_get_compression(r->exr, r->part, &r->compression);
    if (code)
        return refused(r, code, err);
    if (r->storage != EXR_STORAGE_SCANLINE && r->storage != EXR_STORAGE_TILED)
        return failed(err, ERR_UNSUPPORTED,
                      "%s: EXR with deep pixels, which are not supported: flat ones were expected",
                      r->path);
    return true;
}

static bool check_channels(reader *r, const exr_attr_chlist_t *list, lux_error *err)
{
    if (list->num_channels < 1 || list->num_channels > MOST_CHANNELS)
        return failed(err, ERR_FORMAT, "%s: %d channels, 1 to %d were expected", r->path,
                      list->num_channels, MOST_CHANNELS);
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        if (c->x_sampling != 1 || c->y_sampling != 1)
            return failed(err, ERR_UNSUPPORTED,
                          "%s: channel %s has a value for every %d x %d pixels only, which is not "
                          "supported",
                          r->path, c->name.str, c->x_sampling, c->y_sampling);
        if (c->pixel_type != EXR_PIXEL_UINT && c->pixel_type != EXR_PIXEL_HALF &&
            c->pixel_type != EXR_PIXEL_FLOAT)
            return failed(err, ERR_FORMAT, "%s: channel %s is of an unknown type", r->path,
                          c->name.str);
        r->pixel_bytes += c->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
    r->im->channel_count = list->num_channels;
    return true;
}

static bool check_size(reader *r, lux_error *err)
{
    exr_attr_box2i_t window;
    exr_result_t code = exr_get_data_window(r->exr, r->part, &window);
    if (code)
        return refused(r, code, err);
    int64_t width  = (int64_t)window.max.x - window.min.x + 1;
    int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > MOST_PIXELS_A_SIDE || height > MOST_PIXELS_A_SIDE)
        return failed(err, ERR_FORMAT, "%s: %lld x %lld pixels, 1 to %d a side were expected",
                      r->path, (long long)width, (long long)height, MOST_PIXELS_A_SIDE);
    uint64_t floats = (uint64_t)width * (uint64_t)height * (uint64_t)r->im->channel_count;
    if (floats > MOST_FLOATS || floats * sizeof(float) / most_expansion(r->compression) > r->size)
        return failed(err, ERR_FORMAT,
                      "%s: %lld x %lld pixels of %d channels cannot be in a file of %zu bytes",
                      r->path, (long long)width, (long long)height, r->im->channel_count, r->size);
    r->x          = window.min.x;
    r->y          = window.min.y;
    r->im->width  = (int)width;
    r->im->height = (int)height;
    return true;
}

static const char *copy_text(arena *a, const char *text, size_t length, lux_error *err)
{
    char *copy = arena_array(a, char, length + 1, err);
    return copy ? memcpy(copy, text, length) : NULL;
}

static bool make_channels(reader *r, arena *a, const exr_attr_chlist_t *list, lux_error *err)
{
    size_t pixels   = (size_t)r->im->width * (size_t)r->im->height;
    r->im->channels = arena_array(a, image_channel, (size_t)list->num_channels, err);
    for (int i = 0; r->im->channels && i < list->num_channels; i++) {
        const exr_attr_string_t *name = &list->entries[i].name;
        image_channel *c              = &r->im->channels[i];
        c->name                       = copy_text(a, name->str, (size_t)name->length, err);
        c->values                     = arena_array(a, float, pixels, err);
        if (!c->name || !c->values)
            return false;
    }
    return r->im->channels;
}

static bool add_attribute(reader *r, arena *a, const exr_attribute_t *from, lux_error *err)
{
    image_attribute *to = &r->im->attributes[r->im->attribute_count];
    if (from->type == EXR_ATTR_STRING && strcmp(from->name, "type") != 0) {
        to->type = ATTRIBUTE_STRING;
        to->text = copy_text(a, from->string->str, (size_t)from->string->length, err);
        if (!to->text)
            return false;
    } else if (from->type == EXR_ATTR_FLOAT) {
        to->type   = ATTRIBUTE_FLOAT;
        to->number = from->f;
    } else {
        return true;
    }
    r->im->attribute_count++;
    to->name = copy_text(a, from->name, strlen(from->name), err);
    return to->name;
}

static bool read_attributes(reader *r, arena *a, lux_error *err)
{
    int32_t count;
    exr_result_t code = exr_get_attribute_count(r->exr, r->part, &count);
    if (code)
        return refused(r, code, err);
    r->im->attributes = arena_array(a, image_attribute, (size_t)count, err);
    if (!r->im->attributes)
        return false;
    for (int32_t i = 0; i < count; i++) {
        const exr_attribute_t *from;
        code = exr_get_attribute_by_index(r->exr, r->part, EXR_ATTR_LIST_FILE_ORDER, i, &from);
        if (code)
            return refused(r, code, err);
        if (!add_attribute(r, a, from, err))
            return false;
    }
    return true;
}

/* Everything but the pixels: out is complete afterwards, and its values are zero. */
static bool read_header(reader *r, arena *a, lux_error *err)
{
    const exr_attr_chlist_t *list;
    if (!check_kind(r, err))
        return false;
    exr_result_t code = exr_get_channels(r->exr, r->part, &list);
    if (code)
        return refused(r, code, err);
    return check_channels(r, list, err) && check_size(r, err) && make_channels(r, a, list, err) &&
           read_attributes(r, a, err);
}

/* ---- the pixels ------------------------------------------------------------------------- */

typedef struct rectangle {
    int x, y, width, height; /* pixels of the image */
} rectangle;

/* Whether a chunk is what the header makes us expect. */
static bool chunk_sound(const reader *r, const exr_chunk_info_t *c, rectangle to)
{
    uint64_t stored = r->pixel_bytes * (uint64_t)to.width * (uint64_t)to.height;
    return c->width == to.width && c->height == to.height && c->unpacked_size == stored &&
           c->data_offset <= r->size && c->packed_size <= r->size - c->data_offset &&
           (r->compression != EXR_COMPRESSION_NONE || c->packed_size == stored);
}

static void aim_channel(const reader *r, exr_coding_channel_info_t *c, int i, rectangle to)
{
    float *values             = r->im->channels[i].values;
    size_t first              = (size_t)to.y * (size_t)r->im->width + (size_t)to.x;
    c->user_bytes_per_element = sizeof(float);
    c->user_data_type         = EXR_PIXEL_FLOAT;
    c->user_pixel_stride      = sizeof(float);
    c->user_line_stride       = (int32_t)sizeof(float) * r->im->width;
    c->decode_to_ptr          = (uint8_t *)(values + first);
}

static bool read_chunk(reader *r, const exr_chunk_info_t *chunk, rectangle to, lux_error *err)
{
    if (!chunk_sound(r, chunk, to))
        return failed(err, ERR_FORMAT,
                      "%s: cannot be read as EXR: the pixels from row %d on are "
                      "not stored as its header says",
                      r->path, to.y);
    exr_decode_pipeline_t d = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t code       = exr_decoding_initialize(r->exr, r->part, chunk, &d);
    bool same               = !code && d.channel_count == r->im->channel_count;
    for (int i = 0; same && i < d.channel_count; i++) {
        same = strcmp(d.channels[i].channel_name, r->im->channels[i].name) == 0 &&
               d.channels[i].width == to.width && d.channels[i].height == to.height;
        aim_channel(r, &d.channels[i], i, to);
    }
    if (!code && !same)
        code = EXR_ERR_INVALID_ATTR;
    if (!code)
        code = exr_decoding_choose_default_routines(r->exr, r->part, &d);
    if (!code)
        code = exr_decoding_run(r->exr, r->part, &d);
    exr_decoding_destroy(r->exr, &d);
    return code ? refused(r, code, err) : true;
}

static int smaller(int a, int b) { return a < b ? a : b; }

static bool read_scanlines(reader *r, lux_error *err)
{
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(r->exr, r->part, &lines);
    if (code || lines < 1)
        return refused(r, code ? code : EXR_ERR_FILE_BAD_HEADER, err);
    for (int y = 0; y < r->im->height; y += lines) {
        rectangle to = { 0, y, r->im->width, smaller(lines, r->im->height - y) };
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(r->exr, r->part, r->y + y, &chunk);
        if (code)
            return refused(r, code, err);
        if (!read_chunk(r, &chunk, to, err))
            return false;
    }
    return true;
}

static bool read_tile(reader *r, int column, int row, rectangle to, lux_error *err)
{
    exr_chunk_info_t chunk;
    exr_result_t code = exr_read_tile_chunk_info(r->exr, r->part, column, row, 0, 0, &chunk);
    return code ? refused(r, code, err) : read_chunk(r, &chunk, to, err);
}

/* The tiles of the finest level; the others are copies. */
static bool read_tiles(reader *r, lux_error *err)
{
    int32_t width, height;
    exr_result_t code = exr_get_tile_sizes(r->exr, r->part, 0, 0, &width, &height);
    if (code || width < 1 || height < 1 || width > MOST_PIXELS_A_SIDE ||
        height > MOST_PIXELS_A_SIDE)
        return refused(r, code ? code : EXR_ERR_FILE_BAD_HEADER, err);
    for (int y = 0; y < r->im->height; y += height) {
        for (int x = 0; x < r->im->width; x += width) {
            rectangle to = { x, y, smaller(width, r->im->width - x),
                             smaller(height, r->im->height - y) };
            if (!read_tile(r, x / width, y / height, to, err))
                return false;
        }
    }
    return true;
}

static bool read_image(reader *r, arena *a, lux_error *err)
{
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn          = keep_message;
    init.read_fn                   = read_bytes;
    init.size_fn                   = total_bytes;
    init.user_data                 = r;
    /* A file without the places of its chunks was not finished. */
    init.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;

    exr_result_t code = exr_start_read(&r->exr, r->path, &init);
    if (code)
        return refused(r, code, err);
    bool ok = read_header(r, a, err) &&
              (r->storage == EXR_STORAGE_TILED ? read_tiles(r, err) : read_scanlines(r, err));
    exr_finish(&r->exr);
    return ok;
}

static bool read_file(const char *path, int part, bool only, arena *a, image *out, lux_error *err)
{
    arena scratch = { 0 };
    image im      = { 0 };
    reader r      = { .path = path, .part = part, .only = only, .im = &im };
    r.bytes       = file_read(&scratch, path, MOST_BYTES, &r.size, err);
    bool ok       = r.bytes && read_image(&r, a, err);
    arena_clear(&scratch);
    if (ok)
        *out = im;
    return ok;
}

bool image_read_exr(const char *path, arena *a, image *out, lux_error *err)
{
    return read_file(path, 0, true, a, out, err);
}

bool image_read_exr_part(const char *path, int part, arena *a, image *out, lux_error *err)
{
    return read_file(path, part, false, a, out, err);
}
