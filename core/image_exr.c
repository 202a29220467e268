/* core/image_exr.c -- writes EXR files through OpenEXR's C API: scanlines, ZIP, float or half.
 *
 * What the library (3.1.5) leaves to its callers is done here:
 * - it reports success where the disk was full, so that the bytes go through our own function,
 *   which keeps the first error;
 * - it reads a chunk that compresses to exactly its own size as if it were not compressed
 *   (openexr#2306): such chunks are stored as they are;
 * - it makes halves above 65504 infinite: they are clamped;
 * - it sorts the channels: they are matched by name;
 * - it prints its errors unless it is given a handler.
 */
#define _GNU_SOURCE
#include "core/file.h"
#include "core/image.h"

#include <errno.h>
#include <math.h>
#include <openexr.h>
#include <string.h>
#include <unistd.h>

enum {
    MOST_PIXELS_A_SIDE = 1 << 26, /* so that a line's bytes fit the library's 32 bits */
    NAME_MOST          = 255,     /* bytes of a name in an EXR */
    NAME_SHORT         = 31,      /* beyond, the file is marked: old readers do not take it */
};

static const float HALF_MOST = 65504.0f;

/* Rec. 709: ITU-R BT.709-6, items 1.3 and 1.4. */
static const exr_attr_chromaticities_t REC709_D65 = { 0.64f, 0.33f, 0.30f,   0.60f,
                                                      0.15f, 0.06f, 0.3127f, 0.3290f };

typedef struct writer {
    const char *path;
    const image *parts;
    int part_count;
    const image *im; /* that of the parts which is looked at, and its number */
    int part;
    bool half;
    int fd;
    int code; /* errno of the first write that failed; 0: none did */
    exr_context_t exr;
    arena scratch;
    float *clamped; /* half only: the lines of one chunk, channel after channel */
} writer;

/* ---- what the library calls ------------------------------------------------------------- */

/* The library may hold its lock here, so that not even exr_get_user_data() can be asked where to
 * keep the message: the code that its functions return must do. */
static void ignore_message(exr_const_context_t exr, exr_result_t code, const char *message)
{
    (void)exr, (void)code, (void)message;
}

static int64_t write_bytes(exr_const_context_t exr, void *user, const void *bytes, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t complain)
{
    writer *w     = user;
    uint64_t done = 0;
    (void)exr, (void)complain;
    while (done < size && !w->code) {
        ssize_t n = pwrite(w->fd, (const char *)bytes + done, size - done, (off_t)(offset + done));
        if (n > 0)
            done += (uint64_t)n;
        else if (n == 0 || errno != EINTR)
            w->code = n < 0 ? errno : ENOSPC;
    }
    return done == size ? (int64_t)size : -1;
}

/* The library's own compression, then a chunk that gained nothing is stored raw. */
static exr_result_t compress(exr_encode_pipeline_t *e)
{
    exr_result_t (*const *usual)(exr_encode_pipeline_t *) = e->encoding_user_data;
    exr_result_t result                                   = (*usual)(e);
    if (result == EXR_ERR_SUCCESS && e->compressed_bytes == e->packed_bytes &&
        e->compressed_buffer != e->packed_buffer)
        memcpy(e->compressed_buffer, e->packed_buffer, e->packed_bytes);
    return result;
}

/* ---- the contents ----------------------------------------------------------------------- */

static void look_at(writer *w, int part)
{
    w->im   = &w->parts[part];
    w->part = part;
}

static bool name_fits(const writer *w, const char *name, lux_error *err)
{
    size_t length = strlen(name);
    if (length >= 1 && length <= NAME_MOST)
        return true;
    return failed(err, ERR_ARGUMENT, "%s: name of %zu bytes, 1 to %d expected: %.40s", w->path,
                  length, NAME_MOST, name);
}

static bool all_finite(const writer *w, const image_channel *c, lux_error *err)
{
    size_t pixels = (size_t)w->im->width * (size_t)w->im->height;
    for (size_t i = 0; i < pixels; i++)
        if (!isfinite(c->values[i]))
            return failed(err, ERR_ARGUMENT, "%s: channel %s is %s at column %zu of row %zu",
                          w->path, c->name, isnan(c->values[i]) ? "no number" : "infinite",
                          i % (size_t)w->im->width, i / (size_t)w->im->width);
    return true;
}

/* Whether the part can be written at all. */
static bool part_writable(const writer *w, lux_error *err)
{
    const image *im = w->im;
    if (im->width < 1 || im->height < 1 || im->width > MOST_PIXELS_A_SIDE ||
        im->height > MOST_PIXELS_A_SIDE)
        return failed(err, ERR_ARGUMENT, "%s: %d x %d pixels, 1 to %d a side expected", w->path,
                      im->width, im->height, MOST_PIXELS_A_SIDE);
    if (im->channel_count < 1)
        return failed(err, ERR_ARGUMENT, "%s: an image without channels", w->path);
    for (int i = 0; i < im->channel_count; i++) {
        if (!name_fits(w, im->channels[i].name, err) || !all_finite(w, &im->channels[i], err))
            return false;
        for (int j = 0; j < i; j++)
            if (strcmp(im->channels[i].name, im->channels[j].name) == 0)
                return failed(err, ERR_ARGUMENT, "%s: two channels %s", w->path,
                              im->channels[i].name);
    }
    for (int i = 0; i < im->attribute_count; i++)
        if (!name_fits(w, im->attributes[i].name, err))
            return false;
    return true;
}

/* Asked before anything is created. */
static bool writable(writer *w, lux_error *err)
{
    for (int p = 0; p < w->part_count; p++) {
        look_at(w, p);
        if (!part_writable(w, err) || (w->part_count > 1 && !name_fits(w, w->im->part, err)))
            return false;
        for (int q = 0; q < p; q++)
            if (strcmp(w->parts[q].part, w->im->part) == 0)
                return failed(err, ERR_ARGUMENT, "%s: two parts %s", w->path, w->im->part);
    }
    return true;
}

static bool has_long_names(const image *im)
{
    for (int i = 0; i < im->channel_count; i++)
        if (strlen(im->channels[i].name) > NAME_SHORT)
            return true;
    for (int i = 0; i < im->attribute_count; i++)
        if (strlen(im->attributes[i].name) > NAME_SHORT)
            return true;
    return false;
}

static exr_result_t set_attribute(const writer *w, const image_attribute *a)
{
    return a->type == ATTRIBUTE_STRING ? exr_attr_set_string(w->exr, w->part, a->name, a->text)
                                       : exr_attr_set_float(w->exr, w->part, a->name, a->number);
}

static exr_result_t add_part(writer *w)
{
    const image *im       = w->im;
    exr_pixel_type_t type = w->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    int added;
    exr_result_t r = exr_add_part(w->exr, im->part, EXR_STORAGE_SCANLINE, &added);
    if (!r)
        r = exr_initialize_required_attr_simple(w->exr, w->part, im->width, im->height,
                                                EXR_COMPRESSION_ZIP);
    for (int i = 0; !r && i < im->channel_count; i++)
        r = exr_add_channel(w->exr, w->part, im->channels[i].name, type,
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    if (!r)
        r = exr_attr_set_chromaticities(w->exr, w->part, "chromaticities", &REC709_D65);
    for (int i = 0; !r && i < im->attribute_count; i++)
        r = set_attribute(w, &im->attributes[i]);
    return r;
}

static exr_result_t write_header(writer *w)
{
    bool longer = false;
    for (int p = 0; p < w->part_count; p++)
        longer |= has_long_names(&w->parts[p]);
    exr_result_t r = exr_set_longname_support(w->exr, longer);
    for (int p = 0; !r && p < w->part_count; p++) {
        look_at(w, p);
        r = add_part(w);
    }
    return r ? r : exr_write_header(w->exr);
}

static const image_channel *channel_named(const image *im, const char *name)
{
    const image_channel *c = im->channels;
    while (strcmp(c->name, name) != 0) /* the library knows no channels but ours */
        c++;
    return c;
}

/* Where the library finds the values of the c-th channel for the lines of a chunk. */
static const float *chunk_values(writer *w, const exr_encode_pipeline_t *e, int c, int y)
{
    size_t width        = (size_t)w->im->width;
    const float *values = channel_named(w->im, e->channels[c].channel_name)->values;
    values += (size_t)y * width;
    if (!w->half)
        return values;
    size_t count = (size_t)e->chunk.height * width;
    float *copy  = w->clamped + (size_t)c * count;
    for (size_t i = 0; i < count; i++)
        copy[i] = fminf(fmaxf(values[i], -HALF_MOST), HALF_MOST);
    return copy;
}

static exr_result_t write_chunk(writer *w, int y)
{
    exr_chunk_info_t chunk;
    exr_encode_pipeline_t e = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t (*usual)(exr_encode_pipeline_t *);
    exr_result_t r = exr_write_scanline_chunk_info(w->exr, w->part, y, &chunk);
    if (!r)
        r = exr_encoding_initialize(w->exr, w->part, &chunk, &e);
    for (int c = 0; !r && c < e.channel_count; c++) {
        exr_coding_channel_info_t *to = &e.channels[c];
        to->user_bytes_per_element    = sizeof(float);
        to->user_data_type            = EXR_PIXEL_FLOAT;
        to->user_pixel_stride         = sizeof(float);
        to->user_line_stride          = (int32_t)sizeof(float) * w->im->width;
        to->encode_from_ptr           = (const uint8_t *)chunk_values(w, &e, c, y);
    }
    if (!r)
        r = exr_encoding_choose_default_routines(w->exr, w->part, &e);
    if (!r) {
        usual                = e.compress_fn;
        e.encoding_user_data = &usual;
        e.compress_fn        = compress;
        r                    = exr_encoding_run(w->exr, w->part, &e);
    }
    exr_encoding_destroy(w->exr, &e);
    return r;
}

static exr_result_t write_chunks(writer *w)
{
    exr_result_t r = EXR_ERR_SUCCESS;
    for (int p = 0; !r && p < w->part_count; p++) { /* one after the other: the library's rule */
        int lines;
        look_at(w, p);
        r = exr_get_scanlines_per_chunk(w->exr, p, &lines);
        for (int y = 0; !r && y < w->im->height; y += lines)
            r = write_chunk(w, y);
    }
    return r;
}

/* Everything between a created file and its last byte. */
static exr_result_t write_all(writer *w)
{
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn          = ignore_message;
    init.write_fn                  = write_bytes;
    init.user_data                 = w;

    exr_result_t r = exr_start_write(&w->exr, w->path, EXR_WRITE_FILE_DIRECTLY, &init);
    if (!r)
        r = write_header(w);
    if (!r)
        r = write_chunks(w);
    exr_result_t last = exr_finish(&w->exr); /* writes where the chunks are */
    return r ? r : last;
}

static void notice_clamped(const writer *w, notices *n)
{
    const image *im = w->im;
    size_t pixels   = (size_t)im->width * (size_t)im->height;
    for (int c = 0; c < im->channel_count; c++) {
        size_t beyond = 0;
        for (size_t i = 0; i < pixels; i++)
            beyond += fabsf(im->channels[c].values[i]) > HALF_MOST;
        if (beyond)
            notice_add(n,
                       "%s: channel %s: %zu of %zu values are beyond 65504, the most that half "
                       "floats hold, and were clamped",
                       w->path, im->channels[c].name, beyond, pixels);
    }
}

/* A line of scratch for every line of a chunk, of which ZIP makes 16. */
static bool make_clamped(writer *w, lux_error *err)
{
    if (!w->half)
        return true;
    size_t lines = (size_t)(w->im->height < 16 ? w->im->height : 16);
    w->clamped   = arena_array(&w->scratch, float,
                               (size_t)w->im->channel_count *lines *(size_t)w->im->width, err);
    return w->clamped;
}

static bool write_file(writer *w, lux_error *err)
{
    output_file f;
    if (!file_create(&f, w->path, err))
        return false;
    w->fd          = fileno(f.stream);
    exr_result_t r = write_all(w);
    if (!r && !w->code)
        return file_commit(&f, err);

    char text[128];
    if (w->code)
        failed(err, ERR_IO, "%s: cannot write: %s", w->path,
               strerror_r(w->code, text, sizeof text));
    else
        failed(err, r == EXR_ERR_OUT_OF_MEMORY ? ERR_MEMORY : ERR_ARGUMENT,
               "%s: cannot be written as EXR: %s", w->path, exr_get_default_error_message(r));
    file_discard(&f);
    return false;
}

bool image_write_exr(const char *path, const image *im, bool half, notices *n, lux_error *err)
{
    writer w = { .path = path, .parts = im, .part_count = 1, .half = half, .fd = -1 };
    bool ok  = writable(&w, err) && make_clamped(&w, err) && write_file(&w, err);
    arena_clear(&w.scratch);
    if (ok && half)
        notice_clamped(&w, n);
    return ok;
}

bool image_write_exr_parts(const char *path, const image *parts, int count, lux_error *err)
{
    writer w = { .path = path, .parts = parts, .part_count = count, .fd = -1 };
    return writable(&w, err) && write_file(&w, err);
}
