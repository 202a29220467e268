/* sim/gltf_mesh.c -- primitives of a mesh joined into one list of triangles.
 *
 * glTF 2.0.1, section 3.7.2.1: with vertices v0, v1, ... triangle i of a strip is
 * (vi, vi+1+i%2, vi+2-i%2), of a fan (vi+1, vi+2, v0).
 */
#include "sim/gltf_source.h"

#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP, FAN };

static const uint64_t triangles_most = 1u << 28;

/* Positions that several primitives of a mesh use are kept once. */
typedef struct joined {
    uint32_t *base;    /* of an accessor: its first position in the mesh */
    uint32_t *used_in; /* of an accessor: 1 + the mesh that it was last used in */
} joined;

typedef struct mesh_work {
    reader *r;
    joined *joined;
    uint32_t number; /* of the mesh */
    vec3 *positions;
    uint32_t *corners, *material;
    uint32_t position_count, triangle_count;
} mesh_work;

static uint64_t triangles_of(int mode, uint64_t vertices)
{
    if (mode == TRIANGLES)
        return vertices / 3;
    return vertices < 3 ? 0 : vertices - 2;
}

static uint64_t vertex_count(const reader *r, const source_primitive *p)
{
    return r->source->accessors[p->indices >= 0 ? p->indices : p->position].count;
}

/* Notes what of a primitive is not taken as it is. */
static void tally_primitive(const mesh_work *w, const source_primitive *p, uint32_t number)
{
    static const char at[] = "/meshes/%u/primitives/%u";
    if (p->position < 0)
        tally_add(w->r, TALLY_NO_POSITION, at, w->number, number);
    else if (p->mode < TRIANGLES)
        tally_add(w->r, TALLY_LINES, at, w->number, number);
    if (p->colored)
        tally_add(w->r, TALLY_COLOR, at, w->number, number);
    if (p->morphed)
        tally_add(w->r, TALLY_MORPH, at, w->number, number);
}

/* Counts what primitive `number` adds, and checks all its indices. */
static bool count_primitive(mesh_work *w, uint32_t number, lux_error *err)
{
    reader *r                 = w->r;
    const source *s           = r->source;
    const source_primitive *p = &s->meshes[w->number].primitives[number];
    static const char at[]    = "/meshes/%u/primitives/%u%s";
    if ((p->position >= 0 && !index_valid(r, p->position, s->accessor_count, "accessor", err, at,
                                          w->number, number, "/attributes/POSITION")) ||
        (p->indices >= 0 && !index_valid(r, p->indices, s->accessor_count, "accessor", err, at,
                                         w->number, number, "/indices")) ||
        (p->material >= 0 && !index_valid(r, p->material, s->material_count, "material", err, at,
                                          w->number, number, "/material")))
        return false;
    tally_primitive(w, p, number);
    if (p->position < 0 || p->mode < TRIANGLES)
        return true;

    uint64_t vertices  = s->accessors[p->position].count;
    uint64_t triangles = triangles_of(p->mode, vertex_count(r, p));
    uint64_t fresh     = w->joined->used_in[p->position] != w->number + 1 ? vertices : 0;
    uint64_t zeros     = s->accessors[p->position].view < 0 ? fresh : 0;
    if (triangles > triangles_most - r->triangles || fresh > 3 * triangles_most - r->positions ||
        zeros > ZEROS_MOST - r->zeros)
        return failed(err, ERR_UNSUPPORTED,
                      "%s: /meshes/%u/primitives/%u: with it more than %llu triangles or positions",
                      r->file->path, w->number, number, (unsigned long long)triangles_most);
    r->triangles += triangles;
    r->positions += fresh;
    r->zeros += zeros;
    w->triangle_count += (uint32_t)triangles;
    w->position_count += (uint32_t)fresh;
    w->joined->used_in[p->position] = w->number + 1;
    return true;
}

static dvec3 corner(const mesh_work *w, uint32_t i) { return d3_from(w->positions[i]); }

static bool is_flat(const mesh_work *w, const uint32_t c[3])
{
    dvec3 a = corner(w, c[0]);
    dvec3 n = d3_cross(d3_sub(corner(w, c[1]), a), d3_sub(corner(w, c[2]), a));
    return n.x == 0 && n.y == 0 && n.z == 0;
}

/* Adds the triangles over `count` vertices: those that indices name, or one after the other. */
static void add_triangles(mesh_work *w, const source_primitive *p, const uint32_t *indices,
                          uint64_t count)
{
    uint32_t base     = w->joined->base[p->position];
    uint32_t material = p->material >= 0 ? (uint32_t)p->material : w->r->source->material_count;
    uint64_t many     = triangles_of(p->mode, count);
    for (uint64_t i = 0; i < many; i++) {
        uint64_t v[3] = { 3 * i, 3 * i + 1, 3 * i + 2 };
        if (p->mode == STRIP)
            v[0] = i, v[1] = i + 1 + i % 2, v[2] = i + 2 - i % 2;
        else if (p->mode == FAN)
            v[0] = i + 1, v[1] = i + 2, v[2] = 0;

        uint32_t *c = &w->corners[3 * (size_t)w->triangle_count];
        for (int k = 0; k < 3; k++)
            c[k] = base + (indices ? indices[v[k]] : (uint32_t)v[k]);
        w->material[w->triangle_count] = material;
        if (is_flat(w, c))
            tally_add(w->r, TALLY_FLAT, "/meshes/%u", w->number);
        else
            w->triangle_count++;
    }
}

static bool add_primitive(mesh_work *w, uint32_t number, lux_error *err)
{
    const source *s           = w->r->source;
    const source_primitive *p = &s->meshes[w->number].primitives[number];
    if (p->mode < TRIANGLES || p->position < 0)
        return true;
    char pointer[80];
    uint32_t vertices = (uint32_t)s->accessors[p->position].count;
    if (w->joined->used_in[p->position] != w->number + 1) {
        snprintf(pointer, sizeof pointer, "/meshes/%u/primitives/%u/attributes/POSITION", w->number,
                 number);
        if (!accessor_positions(w->r, p->position, w->positions + w->position_count, pointer, err))
            return false;
        w->joined->used_in[p->position] = w->number + 1;
        w->joined->base[p->position]    = w->position_count;
        w->position_count += vertices;
    }

    arena own               = { 0 };
    const uint32_t *indices = NULL;
    snprintf(pointer, sizeof pointer, "/meshes/%u/primitives/%u/indices", w->number, number);
    if (p->indices >= 0)
        indices = accessor_indices(w->r, &own, p->indices, vertices, pointer, err);
    bool good = p->indices < 0 || indices;
    if (good)
        add_triangles(w, p, indices, vertex_count(w->r, p));
    arena_clear(&own);
    return good;
}

static bool read_mesh(reader *r, joined *j, uint32_t number, gltf_mesh *out, lux_error *err)
{
    const source_mesh *from = &r->source->meshes[number];
    mesh_work w             = { .r = r, .joined = j, .number = number };
    for (uint32_t i = 0; i < from->primitive_count; i++)
        if (!count_primitive(&w, i, err))
            return false;
    for (uint32_t i = 0; i < from->primitive_count; i++) /* the second time they are read */
        if (from->primitives[i].position >= 0)
            j->used_in[from->primitives[i].position] = 0;

    w.positions = arena_array(r->a, vec3, w.position_count, err);
    w.corners   = arena_array(r->a, uint32_t, 3 * (size_t)w.triangle_count, err);
    w.material  = arena_array(r->a, uint32_t, w.triangle_count, err);
    out->name   = read_name(r, from->name, err);
    if (!w.positions || !w.corners || !w.material || !out->name)
        return false;
    w.position_count = w.triangle_count = 0;
    for (uint32_t i = 0; i < from->primitive_count; i++)
        if (!add_primitive(&w, i, err))
            return false;

    out->triangles = (mesh){ .positions      = w.positions,
                             .corners        = w.corners,
                             .material       = w.material,
                             .position_count = w.position_count,
                             .triangle_count = w.triangle_count };
    if (!w.triangle_count)
        tally_add(r, TALLY_EMPTY, "/meshes/%u", number);
    return true;
}

bool read_meshes(reader *r, lux_error *err)
{
    uint32_t count = r->source->mesh_count;
    joined j       = { arena_array(r->file->scratch, uint32_t, r->source->accessor_count, err),
                       arena_array(r->file->scratch, uint32_t, r->source->accessor_count, err) };
    r->out->meshes = arena_array(r->a, gltf_mesh, count, err);
    if (!j.base || !j.used_in || !r->out->meshes)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_mesh(r, &j, i, &r->out->meshes[i], err))
            return false;
    r->out->mesh_count = count;
    return true;
}
