/* sim/gltf_access.c -- accessors: numbers out of bytes, whatever their type, stride or gaps.
 *
 * glTF 2.0.1, sections 3.6.2 and 3.11: little-endian; normalised integers are c / max, signed
 * ones no lower than -1; a sparse accessor replaces some elements of its base, which is zeros
 * if it has no buffer view.
 */
#include "sim/gltf_source.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { BYTE = 5120, UBYTE, SHORT, USHORT, UINT = 5125, FLOAT = 5126 };

static size_t component_size(int component)
{
    switch (component) {
    case BYTE:
    case UBYTE:
        return 1;
    case SHORT:
    case USHORT:
        return 2;
    case UINT:
    case FLOAT:
        return 4;
    default:
        return 0;
    }
}

/* ---- that nothing lies outside ---- */

bool index_valid(const reader *r, source_index i, uint32_t count, const char *what, lux_error *err,
                 const char *pointer, ...)
{
    if (i >= 0 && (uint32_t)i < count)
        return true;
    char place[200];
    va_list args;
    va_start(args, pointer);
    vsnprintf(place, sizeof place, pointer, args);
    va_end(args);
    return failed(err, ERR_FORMAT, "%s: %s: %s %d of %u", r->file->path, place, what, i, count);
}

static bool view_has_bytes(const reader *r, source_index view, const char *pointer, lux_error *err)
{
    source_index buffer = r->source->views[view].buffer;
    return r->file->buffers[buffer].bytes ||
           failed(err, ERR_FORMAT, "%s: %s/bufferView: buffer %d has neither uri nor binary chunk",
                  r->file->path, pointer, buffer);
}

/* That `count` elements of `size` bytes, `stride` apart, lie within a view from offset on. */
static bool fits(const reader *r, source_index view, size_t offset, size_t count, size_t size,
                 size_t stride, const char *pointer, lux_error *err)
{
    if (!index_valid(r, view, r->source->view_count, "bufferView", err, "%s/bufferView", pointer))
        return false;
    if (!view_has_bytes(r, view, pointer, err))
        return false;
    size_t length = r->source->views[view].length, end;
    if (__builtin_mul_overflow(count - 1, stride, &end) ||
        __builtin_add_overflow(end, size, &end) || __builtin_add_overflow(end, offset, &end) ||
        end > length)
        return failed(err, ERR_FORMAT,
                      "%s: %s: %zu elements, %zu bytes apart, from byte %zu on; bufferView %d has "
                      "%zu bytes",
                      r->file->path, pointer, count, stride, offset, view, length);
    return true;
}

static bool view_valid(const reader *r, uint32_t i, lux_error *err)
{
    const source_view *v = &r->source->views[i];
    if (!index_valid(r, v->buffer, r->file->buffer_count, "buffer", err, "/bufferViews/%u/buffer",
                     i))
        return false;
    size_t have = r->file->buffers[v->buffer].declared;
    if (v->length > have || v->offset > have - v->length)
        return failed(err, ERR_FORMAT,
                      "%s: /bufferViews/%u: %zu bytes from byte %zu on; buffer %d has %zu bytes",
                      r->file->path, i, v->length, v->offset, v->buffer, have);
    return true;
}

static size_t element_stride(const reader *r, const source_accessor *a)
{
    size_t stride = a->view >= 0 ? r->source->views[a->view].stride : 0;
    return stride ? stride : component_size(a->component) * (size_t)a->width;
}

static bool sparse_valid(const reader *r, const source_accessor *a, const char *pointer,
                         lux_error *err)
{
    int c          = a->index_component;
    size_t integer = c == UBYTE || c == USHORT || c == UINT ? component_size(c) : 0;
    size_t size    = component_size(a->component) * (size_t)a->width;
    char where[80];
    if (!integer)
        return failed(err, ERR_FORMAT,
                      "%s: %s/sparse/indices/componentType: %d, wanted 5121, 5123 "
                      "or 5125",
                      r->file->path, pointer, c);
    if (a->sparse_count > a->count)
        return failed(err, ERR_FORMAT, "%s: %s/sparse/count: %zu of %zu elements", r->file->path,
                      pointer, a->sparse_count, a->count);
    snprintf(where, sizeof where, "%s/sparse/indices", pointer);
    if (!fits(r, a->index_view, a->index_offset, a->sparse_count, integer, integer, where, err))
        return false;
    snprintf(where, sizeof where, "%s/sparse/values", pointer);
    return fits(r, a->value_view, a->value_offset, a->sparse_count, size, size, where, err);
}

static bool accessor_valid(const reader *r, uint32_t i, lux_error *err)
{
    const source_accessor *a = &r->source->accessors[i];
    size_t size              = component_size(a->component) * (size_t)a->width;
    char pointer[48];
    snprintf(pointer, sizeof pointer, "/accessors/%u", i);
    if (!size || a->width < 1)
        return failed(err, ERR_FORMAT,
                      "%s: %s/componentType: %d, wanted 5120 to 5123, 5125 or 5126", r->file->path,
                      pointer, a->component);
    if (a->view < 0 && a->count > ZEROS_MOST)
        return failed(err, ERR_FORMAT,
                      "%s: %s/count: %zu elements without a bufferView, at most %d", r->file->path,
                      pointer, a->count, ZEROS_MOST);
    if (a->view >= 0 &&
        (!index_valid(r, a->view, r->source->view_count, "bufferView", err, "%s/bufferView",
                      pointer) ||
         !fits(r, a->view, a->offset, a->count, size, element_stride(r, a), pointer, err)))
        return false;
    return !a->sparse || sparse_valid(r, a, pointer, err);
}

bool accessors_check(const reader *r, lux_error *err)
{
    for (uint32_t i = 0; i < r->source->view_count; i++)
        if (!view_valid(r, i, err))
            return false;
    for (uint32_t i = 0; i < r->source->accessor_count; i++)
        if (!accessor_valid(r, i, err))
            return false;
    return true;
}

/* ---- numbers ---- */

static const uint8_t *view_bytes(const reader *r, source_index view, size_t offset)
{
    const source_view *v = &r->source->views[view];
    return r->file->buffers[v->buffer].bytes + v->offset + offset;
}

static uint32_t integer_at(const uint8_t *p, int component)
{
    uint32_t low = p[0];
    if (component_size(component) >= 2)
        low |= (uint32_t)p[1] << 8;
    if (component_size(component) == 4)
        low |= (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
    return low;
}

static double number_at(const uint8_t *p, int component, bool normalized)
{
    uint32_t bits = integer_at(p, component);
    float single;
    double value, most;
    switch (component) {
    case FLOAT:
        memcpy(&single, &bits, sizeof single);
        return (double)single;
    case BYTE:
        value = (int8_t)bits, most = 127;
        break;
    case SHORT:
        value = (int16_t)bits, most = 32767;
        break;
    case UBYTE:
        value = bits, most = 255;
        break;
    case USHORT:
        value = bits, most = 65535;
        break;
    default:
        value = bits, most = 4294967295.0;
        break;
    }
    return normalized ? fmax(value / most, -1.0) : value;
}

/* The accessor, if it is there, has the width that is wanted, and was not refused above. */
static const source_accessor *accessor_of(const reader *r, source_index accessor, int width,
                                          const char *pointer, lux_error *err)
{
    if (!index_valid(r, accessor, r->source->accessor_count, "accessor", err, "%s", pointer))
        return NULL;
    const source_accessor *a = &r->source->accessors[accessor];
    if (a->width != width)
        return failed(err, ERR_FORMAT, "%s: %s: accessor %d has %d components, wanted %d",
                      r->file->path, pointer, accessor, a->width, width);
    return a;
}

/* Where sparse value k goes; SIZE_MAX, with *err, if that is no element, or not behind the last. */
static size_t sparse_target(const reader *r, source_index accessor, size_t k, size_t last,
                            lux_error *err)
{
    const source_accessor *a = &r->source->accessors[accessor];
    const uint8_t *indices   = view_bytes(r, a->index_view, a->index_offset);
    size_t i = integer_at(indices + k * component_size(a->index_component), a->index_component);
    if (i < a->count && (k == 0 || i > last))
        return i;
    failed(err, ERR_FORMAT,
           "%s: /accessors/%d/sparse/indices: index %zu is %zu, wanted ascending "
           "ones below %zu",
           r->file->path, accessor, k, i, a->count);
    return SIZE_MAX;
}

bool content_locate(const reader *r, const source_content *c, const char *pointer,
                    const uint8_t **bytes, size_t *size, const char **path, lux_error *err)
{
    if (c->uri)
        return gltf_file_locate(r->file, pointer, c->uri, c->uri_length, bytes, size, path, err);
    if (!index_valid(r, c->view, r->source->view_count, "bufferView", err, "%s", pointer) ||
        !view_has_bytes(r, c->view, pointer, err))
        return false;
    *bytes = view_bytes(r, c->view, 0);
    *size  = r->source->views[c->view].length;
    return true;
}

/* Each element's bytes, base or sparse, one call. */
typedef void (*element_sink)(void *out, size_t element, const uint8_t *bytes,
                             const source_accessor *a);

static bool each_element(const reader *r, source_index accessor, element_sink put, void *out,
                         lux_error *err)
{
    const source_accessor *a = &r->source->accessors[accessor];
    size_t stride            = element_stride(r, a);
    const uint8_t *base      = a->view >= 0 ? view_bytes(r, a->view, a->offset) : NULL;
    for (size_t i = 0; base && i < a->count; i++)
        put(out, i, base + i * stride, a);

    size_t size = component_size(a->component) * (size_t)a->width, i = 0;
    const uint8_t *values = a->sparse ? view_bytes(r, a->value_view, a->value_offset) : NULL;
    for (size_t k = 0; values && k < a->sparse_count; k++) {
        i = sparse_target(r, accessor, k, i, err);
        if (i == SIZE_MAX)
            return false;
        put(out, i, values + k * size, a);
    }
    return true;
}

static void put_numbers(void *out, size_t element, const uint8_t *bytes, const source_accessor *a)
{
    double *to = (double *)out + element * (size_t)a->width;
    for (int c = 0; c < a->width; c++)
        to[c] = number_at(bytes + (size_t)c * component_size(a->component), a->component,
                          a->normalized);
}

static void put_position(void *out, size_t element, const uint8_t *bytes, const source_accessor *a)
{
    double p[3];
    put_numbers(p, 0, bytes, a);
    ((vec3 *)out)[element] = (vec3){ (float)p[0], (float)p[1], (float)p[2] };
}

static void put_floats(void *out, size_t element, const uint8_t *bytes, const source_accessor *a)
{
    float *to = (float *)out + element * (size_t)a->width;
    for (int c = 0; c < a->width; c++)
        to[c] = (float)number_at(bytes + (size_t)c * component_size(a->component), a->component,
                                 a->normalized);
}

static void put_index(void *out, size_t element, const uint8_t *bytes, const source_accessor *a)
{
    ((uint32_t *)out)[element] = integer_at(bytes, a->component);
}

const double *accessor_numbers(const reader *r, arena *into, source_index accessor, int width,
                               const char *pointer, lux_error *err)
{
    const source_accessor *a = accessor_of(r, accessor, width, pointer, err);
    double *out              = a ? arena_array(into, double, a->count *(size_t)width, err) : NULL;
    if (!out || !each_element(r, accessor, put_numbers, out, err))
        return NULL;
    for (size_t i = 0; i < a->count * (size_t)width; i++)
        if (!isfinite(out[i]))
            return failed(err, ERR_FORMAT, "%s: %s: element %zu of accessor %d is not finite",
                          r->file->path, pointer, i / (size_t)width, accessor);
    return out;
}

bool accessor_positions(const reader *r, source_index accessor, vec3 *out, const char *pointer,
                        lux_error *err)
{
    const source_accessor *a = accessor_of(r, accessor, 3, pointer, err);
    if (!a || !each_element(r, accessor, put_position, out, err))
        return false;
    for (size_t i = 0; i < a->count; i++)
        if (!isfinite(out[i].x) || !isfinite(out[i].y) || !isfinite(out[i].z))
            return failed(err, ERR_FORMAT, "%s: %s: position %zu of accessor %d is not finite",
                          r->file->path, pointer, i, accessor);
    return true;
}

const float *accessor_attribute(const reader *r, arena *into, source_index accessor, int width,
                                size_t count, const char *pointer, lux_error *err)
{
    const source_accessor *a = accessor_of(r, accessor, width, pointer, err);
    if (!a)
        return NULL;
    if (a->component == UINT)
        return failed(err, ERR_FORMAT,
                      "%s: %s: accessor %d has componentType 5125, wanted 5126, or 5120 to 5123",
                      r->file->path, pointer, accessor);
    if (a->count != count)
        return failed(err, ERR_FORMAT, "%s: %s: accessor %d has %zu elements, POSITION %zu",
                      r->file->path, pointer, accessor, a->count, count);
    float *out = arena_array(into, float, a->count *(size_t)width, err);
    return out && each_element(r, accessor, put_floats, out, err) ? out : NULL;
}

const uint32_t *accessor_indices(const reader *r, arena *into, source_index accessor,
                                 uint32_t limit, const char *pointer, lux_error *err)
{
    const source_accessor *a = accessor_of(r, accessor, 1, pointer, err);
    if (!a)
        return NULL;
    if (a->component != UBYTE && a->component != USHORT && a->component != UINT)
        return failed(err, ERR_FORMAT,
                      "%s: %s: accessor %d has componentType %d, wanted 5121, 5123 "
                      "or 5125",
                      r->file->path, pointer, accessor, a->component);
    uint32_t *out = arena_array(into, uint32_t, a->count, err);
    if (!out || !each_element(r, accessor, put_index, out, err))
        return NULL;
    for (size_t i = 0; i < a->count; i++)
        if (out[i] >= limit)
            return failed(err, ERR_FORMAT, "%s: %s: index %zu is %u, of %u positions",
                          r->file->path, pointer, i, out[i], limit);
    return out;
}
