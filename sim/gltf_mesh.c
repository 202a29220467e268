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
    corner_data *data;
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

static bool is_flat(const vec3 at[3])
{
    dvec3 a = d3_from(at[0]);
    dvec3 n = d3_cross(d3_sub(d3_from(at[1]), a), d3_sub(d3_from(at[2]), a));
    return n.x == 0 && n.y == 0 && n.z == 0;
}

/* The vertices of a primitive, in the order of its triangles. */
typedef struct vertex_list {
    const uint32_t *indices; /* NULL: one after the other */
    uint64_t count;
    vertex_data data;
} vertex_list;

/* The vertices of triangle i. */
static void triangle_at(int mode, const vertex_list *l, uint64_t i, uint32_t out[3])
{
    uint64_t v[3] = { 3 * i, 3 * i + 1, 3 * i + 2 };
    if (mode == STRIP)
        v[0] = i, v[1] = i + 1 + i % 2, v[2] = i + 2 - i % 2;
    else if (mode == FAN)
        v[0] = i + 1, v[1] = i + 2, v[2] = 0;
    for (int k = 0; k < 3; k++)
        out[k] = l->indices ? l->indices[v[k]] : (uint32_t)v[k];
}

static bool add_triangles(mesh_work *w, const source_primitive *p, const vertex_list *l,
                          lux_error *err)
{
    uint32_t base     = w->joined->base[p->position];
    uint32_t material = p->material >= 0 ? (uint32_t)p->material : w->r->source->material_count;
    uint64_t many     = triangles_of(p->mode, l->count);
    for (uint64_t i = 0; i < many; i++) {
        uint32_t v[3];
        vec3 at[3];
        triangle_at(p->mode, l, i, v);
        for (int k = 0; k < 3; k++)
            at[k] = w->positions[base + v[k]];
        if (is_flat(at)) {
            tally_add(w->r, TALLY_FLAT, "/meshes/%u", w->number);
            continue;
        }
        size_t number = w->triangle_count++;
        for (size_t k = 0; k < 3; k++)
            w->corners[3 * number + k] = base + v[k];
        w->material[number] = material;
        if (!corner_add(w->data, &l->data, number, v, at, err))
            return false;
    }
    return true;
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

    arena own     = { 0 };
    vertex_list l = { .count = vertex_count(w->r, p) };
    snprintf(pointer, sizeof pointer, "/meshes/%u/primitives/%u/indices", w->number, number);
    if (p->indices >= 0)
        l.indices = accessor_indices(w->r, &own, p->indices, vertices, pointer, err);
    bool good = (p->indices < 0 || l.indices) && corner_primitive(w->data, number, &l.data, err) &&
                add_triangles(w, p, &l, err);
    arena_clear(&own);
    return good;
}

static bool read_mesh(reader *r, joined *j, corner_data *data, uint32_t number, gltf_mesh *out,
                      lux_error *err)
{
    const source_mesh *from = &r->source->meshes[number];
    mesh_work w             = { .r = r, .joined = j, .data = data, .number = number };
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
    corner_begin(data, number, w.triangle_count);
    w.position_count = w.triangle_count = 0;
    for (uint32_t i = 0; i < from->primitive_count; i++)
        if (!add_primitive(&w, i, err))
            return false;

    out->triangles = (mesh){ .positions      = w.positions,
                             .corners        = w.corners,
                             .material       = w.material,
                             .position_count = w.position_count,
                             .triangle_count = w.triangle_count,
                             .texcoord       = { data->texcoord[0], data->texcoord[1] },
                             .normals        = data->normals };
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
    corner_data data;
    if (!j.base || !j.used_in || !r->out->meshes || !corner_open(&data, r, err))
        return false;
    bool good = true;
    for (uint32_t i = 0; good && i < count; i++) {
        good = read_mesh(r, &j, &data, i, &r->out->meshes[i], err);
        corner_end(&data);
    }
    r->out->mesh_count = count;
    return good;
}
