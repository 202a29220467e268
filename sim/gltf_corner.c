/* sim/gltf_corner.c -- what the corners of triangles have besides a place: texture coordinates
 * where some texture goes by them, and normals where they say more than the triangles themselves.
 *
 * Meshes are mostly exported with normals, flat ones too: those of a triangle count only if they
 * are not all its own.
 */
#include "sim/gltf_source.h"

#include <stdio.h>

static const uint64_t values_most = 3 * (uint64_t)(1u << 28); /* of vertices of all meshes */

static const double flat_cosine = 0.99999847691; /* of 0.1 degree */

bool corner_open(corner_data *c, reader *r, lux_error *err)
{
    uint32_t count = r->source->accessor_count;
    *c             = (corner_data){ .r       = r,
                                    .values  = arena_array(r->file->scratch, const float *, count, err),
                                    .read_in = arena_array(r->file->scratch, uint32_t, count, err) };
    return c->values && c->read_in;
}

void corner_begin(corner_data *c, uint32_t number, size_t triangles)
{
    c->mesh        = number;
    c->triangles   = triangles;
    c->texcoord[0] = c->texcoord[1] = NULL;
    c->normals                      = NULL;
}

void corner_end(corner_data *c) { arena_clear(&c->own); }

/* ---- of a primitive's vertices ---- */

/* Counts the elements of an accessor that is to be read. */
static bool count_values(reader *r, const source_accessor *a, const char *pointer, lux_error *err)
{
    uint64_t zeros = a->view < 0 ? a->count : 0;
    if (a->count > values_most - r->positions || zeros > ZEROS_MOST - r->zeros)
        return failed(err, ERR_UNSUPPORTED, "%s: %s: with it more than %llu vertices",
                      r->file->path, pointer, (unsigned long long)values_most);
    r->positions += a->count;
    r->zeros += zeros;
    return true;
}

static bool all_finite(const reader *r, source_index accessor, const float *values,
                       const char *pointer, lux_error *err)
{
    const source_accessor *a = &r->source->accessors[accessor];
    size_t width             = (size_t)a->width;
    for (size_t i = 0; i < width * a->count; i++)
        if (!isfinite(values[i]))
            return failed(err, ERR_FORMAT, "%s: %s: element %zu of accessor %d is not finite",
                          r->file->path, pointer, i / width, accessor);
    return true;
}

/* An attribute of a primitive, read once for a mesh whose primitives share it. */
static const float *attribute(corner_data *c, uint32_t number, const char *name,
                              source_index accessor, lux_error *err)
{
    reader *r                 = c->r;
    const source *s           = r->source;
    const source_primitive *p = &s->meshes[c->mesh].primitives[number];
    const int width           = *name == 'N' ? 3 : 2; /* a normal, or coordinates */
    char at[100];
    snprintf(at, sizeof at, "/meshes/%u/primitives/%u/attributes/%s", c->mesh, number, name);
    if (!index_valid(r, accessor, s->accessor_count, "accessor", err, "%s", at))
        return NULL;
    const source_accessor *a = &s->accessors[accessor];
    size_t count             = s->accessors[p->position].count;
    if (c->read_in[accessor] == c->mesh + 1 && a->width == width && a->count == count)
        return c->values[accessor];
    if (!count_values(r, a, at, err))
        return NULL;
    const float *values = accessor_attribute(r, &c->own, accessor, width, count, at, err);
    if (!values || (width == 2 && !all_finite(r, accessor, values, at, err)))
        return NULL;
    c->read_in[accessor]       = c->mesh + 1;
    return c->values[accessor] = values;
}

bool corner_primitive(corner_data *c, uint32_t number, vertex_data *out, lux_error *err)
{
    static const char *const names[] = { "TEXCOORD_0", "TEXCOORD_1" };
    const source_primitive *p        = &c->r->source->meshes[c->mesh].primitives[number];
    bool missing                     = false;
    *out                             = (vertex_data){ 0 };
    for (int k = 0; k < 2; k++) {
        if (!slots_use_set(c->r, p->material, k))
            continue;
        missing = missing || p->texcoord[k] < 0;
        if (p->texcoord[k] < 0)
            continue;
        out->texcoord[k] = attribute(c, number, names[k], p->texcoord[k], err);
        if (!out->texcoord[k])
            return false;
        if (!c->texcoord[k])
            c->texcoord[k] = arena_array(c->r->a, float, 6 * c->triangles, err);
        if (!c->texcoord[k])
            return false;
    }
    if (missing)
        tally_add(c->r, TALLY_NO_TEXCOORD, "/meshes/%u/primitives/%u", c->mesh, number);
    if (p->normal >= 0)
        out->normals = attribute(c, number, "NORMAL", p->normal, err);
    return p->normal < 0 || out->normals;
}

/* ---- of a triangle ---- */

/* Unit normals of the three corners; false if one of them is none, or points to the back. *flat:
 * all are the triangle's own. */
static bool corner_normals(const float *all, const uint32_t vertex[3], const vec3 at[3],
                           vec3 out[3], bool *flat)
{
    dvec3 a     = d3_from(at[0]);
    dvec3 plane = d3_cross(d3_sub(d3_from(at[1]), a), d3_sub(d3_from(at[2]), a));
    *flat       = true;
    for (int k = 0; k < 3; k++) {
        const float *from = all + 3 * (size_t)vertex[k];
        dvec3 n           = { (double)from[0], (double)from[1], (double)from[2] };
        double length     = d3_length(n);
        double cosine     = d3_dot(n, plane) / (length * d3_length(plane));
        if (!(cosine > 0.0)) /* NaN of what is not finite or has no length */
            return false;
        *flat  = *flat && cosine >= flat_cosine;
        out[k] = d3_to_float(d3_scale(n, 1.0 / length));
    }
    return true;
}

bool corner_add(corner_data *c, const vertex_data *d, size_t triangle, const uint32_t vertex[3],
                const vec3 at[3], lux_error *err)
{
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; d->texcoord[k] && i < 3; i++) {
            float *to = c->texcoord[k] + 2 * (3 * triangle + i);
            to[0]     = d->texcoord[k][2 * (size_t)vertex[i]];
            to[1]     = d->texcoord[k][2 * (size_t)vertex[i] + 1];
        }
    if (!d->normals)
        return true;
    vec3 n[3];
    bool flat;
    if (!corner_normals(d->normals, vertex, at, n, &flat)) {
        tally_add(c->r, TALLY_NORMAL, "/meshes/%u", c->mesh);
        return true;
    }
    if (flat)
        return true;
    if (!c->normals) /* zeros: the triangles before are flat */
        c->normals = arena_array(c->r->a, vec3, 3 * c->triangles, err);
    for (size_t i = 0; c->normals && i < 3; i++)
        c->normals[3 * triangle + i] = n[i];
    return c->normals != NULL;
}
