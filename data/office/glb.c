/* data/office/glb.c -- a model as binary glTF 2.0: a header, a JSON chunk, a chunk of numbers.
 *
 * One buffer: for each patch its positions (float), then its corners (unsigned short where
 * they fit, else int). A patch is a primitive; it has two buffer views and two accessors with
 * the same numbers. Only base colours and roughness 1: matt paint. No normals: flat faces.
 */
#define _GNU_SOURCE /* open_memstream */
#include "data/office/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RAD (3.14159265358979323846 / 180.0)

static bool short_corners(const patch *t) { return t->vertex_count <= 65535; }

static uint32_t corner_bytes(const patch *t)
{
    return (t->triangle_count * 3 * (short_corners(t) ? 2 : 4) + 3) & ~3u;
}

static uint32_t patch_bytes(const patch *t)
{
    return t->triangle_count ? t->vertex_count * 12 + corner_bytes(t) : 0;
}

/* Calls for every patch that has triangles; `at` is where its bytes start. */
typedef void patch_visit(FILE *to, const patch *t, uint32_t at, int number);

static uint32_t each_patch(const model *m, FILE *to, patch_visit *visit)
{
    uint32_t at = 0;
    int number  = 0;
    for (int i = 0; i < m->shape_count; i++)
        for (int k = 0; k < MATERIAL_COUNT; k++) {
            const patch *t = &m->shapes[i].patches[k];
            if (t->triangle_count && visit)
                visit(to, t, at, number++);
            at += patch_bytes(t);
        }
    return at;
}

static void put_u32(FILE *to, uint32_t v)
{
    const unsigned char b[4] = { (unsigned char)v, (unsigned char)(v >> 8),
                                 (unsigned char)(v >> 16), (unsigned char)(v >> 24) };
    fwrite(b, 1, sizeof b, to);
}

static void put_float(FILE *to, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    put_u32(to, bits);
}

static void put_patch(FILE *to, const patch *t, uint32_t at, int number)
{
    (void)at, (void)number;
    for (uint32_t i = 0; i < t->vertex_count; i++) {
        put_float(to, t->xyz[3 * i]);
        put_float(to, t->xyz[3 * i + 2]);
        put_float(to, 0.0f - t->xyz[3 * i + 1]);
    }
    const uint32_t n = 3 * t->triangle_count;
    if (!short_corners(t)) {
        for (uint32_t i = 0; i < n; i++)
            put_u32(to, t->corners[i]);
        return;
    }
    for (uint32_t i = 0; i < n; i += 2)
        put_u32(to, t->corners[i] | (i + 1 < n ? t->corners[i + 1] << 16 : 0));
}

/* ---- JSON ------------------------------------------------------------------------------- */

static void views_json(FILE *to, const patch *t, uint32_t at, int number)
{
    fprintf(to,
            "%s{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u,\"target\":34962},"
            "{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u,\"target\":34963}",
            number ? "," : "", at, t->vertex_count * 12, at + t->vertex_count * 12,
            t->triangle_count * 3 * (short_corners(t) ? 2 : 4));
}

static void bounds_json(FILE *to, const patch *t, int sign, const char *key)
{
    double edge[3]; /* the largest of sign * coordinate */
    for (int c = 0; c < 3; c++) {
        const float *v = t->xyz + (c == 0 ? 0 : 3 - c);
        const double s = c == 2 ? -sign : sign;
        edge[c]        = -HUGE_VAL;
        for (uint32_t i = 0; i < t->vertex_count; i++)
            edge[c] = fmax(edge[c], s * (double)v[3 * i]);
        edge[c] = edge[c] * sign + 0.0;
    }
    fprintf(to, ",\"%s\":[%.9g,%.9g,%.9g]", key, edge[0], edge[1], edge[2]);
}

static void accessors_json(FILE *to, const patch *t, uint32_t at, int number)
{
    (void)at;
    fprintf(to, "%s{\"bufferView\":%d,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"",
            number ? "," : "", 2 * number, t->vertex_count);
    bounds_json(to, t, -1, "min");
    bounds_json(to, t, 1, "max");
    fprintf(to, "},{\"bufferView\":%d,\"componentType\":%d,\"count\":%u,\"type\":\"SCALAR\"}",
            2 * number + 1, short_corners(t) ? 5123 : 5125, 3 * t->triangle_count);
}

static void materials_json(FILE *to)
{
    fprintf(to, "\"materials\":[");
    for (int i = 0; i < MATERIAL_COUNT; i++) {
        const paint *p = paint_of((material)i);
        fprintf(to,
                "%s\n{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[%g,%g,%g,1],"
                "\"metallicFactor\":0,\"roughnessFactor\":1}}",
                i ? "," : "", p->name, p->color[0], p->color[1], p->color[2]);
    }
    fprintf(to, "],\n");
}

static void meshes_json(FILE *to, const model *m)
{
    int number = 0;
    fprintf(to, "\"meshes\":[");
    for (int i = 0; i < m->shape_count; i++) {
        const char *comma = "";
        fprintf(to, "%s\n{\"name\":\"%s\",\"primitives\":[", i ? "," : "", m->shapes[i].name);
        for (int k = 0; k < MATERIAL_COUNT; k++) {
            if (!m->shapes[i].patches[k].triangle_count)
                continue;
            fprintf(to, "%s{\"attributes\":{\"POSITION\":%d},\"indices\":%d,\"material\":%d}",
                    comma, 2 * number, 2 * number + 1, k);
            comma = ",";
            number++;
        }
        fprintf(to, "]}");
    }
    fprintf(to, "],\n");
}

static void children_json(FILE *to, const model *m, int parent)
{
    const char *comma = "";
    for (int i = 0; i < m->node_count; i++)
        if (m->nodes[i].parent == parent) {
            fprintf(to, "%s%d", comma, i);
            comma = ",";
        }
}

static bool has_children(const model *m, int parent)
{
    for (int i = parent + 1; i < m->node_count; i++)
        if (m->nodes[i].parent == parent)
            return true;
    return false;
}

static void node_json(FILE *to, const model *m, int i)
{
    const node *n = &m->nodes[i];
    fprintf(to, "%s\n{\"name\":\"%s\"", i ? "," : "", n->name);
    if (n->shape != NO_SHAPE)
        fprintf(to, ",\"mesh\":%d", n->shape);
    if (n->at.x != 0.0 || n->at.y != 0.0 || n->at.z != 0.0)
        fprintf(to, ",\"translation\":[%.6g,%.6g,%.6g]", n->at.x, n->at.z, 0.0 - n->at.y);
    if (n->turn_deg != 0.0)
        fprintf(to, ",\"rotation\":[0,%.7f,0,%.7f]", sin(n->turn_deg * RAD / 2),
                cos(n->turn_deg * RAD / 2));
    if (n->mirror)
        fprintf(to, ",\"scale\":[-1,1,1]");
    if (has_children(m, i)) {
        fprintf(to, ",\"children\":[");
        children_json(to, m, i);
        fprintf(to, "]");
    }
    fprintf(to, "}");
}

/* glTF cameras look along -z: first pitched about x, then turned about y (our z). */
static void camera_node_json(FILE *to, const camera *c, int number)
{
    const double x = c->target.x - c->eye.x, y = c->target.y - c->eye.y, z = c->target.z - c->eye.z;
    const double turn = atan2(-x, y) / 2, pitch = atan2(z, hypot(x, y)) / 2;
    fprintf(to,
            ",\n{\"name\":\"%s\",\"camera\":%d,\"translation\":[%.6g,%.6g,%.6g],"
            "\"rotation\":[%.7f,%.7f,%.7f,%.7f]}",
            c->name, number, c->eye.x, c->eye.z, -c->eye.y, cos(turn) * sin(pitch),
            sin(turn) * cos(pitch), -sin(turn) * sin(pitch), cos(turn) * cos(pitch));
}

static void nodes_json(FILE *to, const model *m)
{
    fprintf(to, "\"nodes\":[");
    for (int i = 0; i < m->node_count; i++)
        node_json(to, m, i);
    for (int i = 0; i < m->camera_count; i++)
        camera_node_json(to, &m->cameras[i], i);
    fprintf(to, "],\n\"scene\":0,\"scenes\":[{\"name\":\"Office\",\"nodes\":[");
    children_json(to, m, NO_PARENT);
    for (int i = 0; i < m->camera_count; i++)
        fprintf(to, ",%d", m->node_count + i);
    fprintf(to, "]}],\n\"cameras\":[");
    for (int i = 0; i < m->camera_count; i++)
        fprintf(to,
                "%s{\"name\":\"%s\",\"type\":\"perspective\",\"perspective\":{\"yfov\":%.6f,"
                "\"aspectRatio\":1.333333,\"znear\":0.01}}",
                i ? "," : "", m->cameras[i].name, m->cameras[i].yfov_deg * RAD);
    fprintf(to, "],\n");
}

static void model_json(FILE *to, const model *m)
{
    fprintf(to, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"lux4 make_office\"},\n");
    materials_json(to);
    meshes_json(to, m);
    nodes_json(to, m);
    fprintf(to, "\"accessors\":[");
    each_patch(m, to, accessors_json);
    fprintf(to, "],\n\"bufferViews\":[");
    each_patch(m, to, views_json);
    fprintf(to, "],\n\"buffers\":[{\"byteLength\":%u}]}", each_patch(m, to, NULL));
}

bool model_write_glb(const model *m, FILE *to)
{
    char *json  = NULL;
    size_t size = 0;
    FILE *text  = open_memstream(&json, &size);
    if (!text)
        return false;
    model_json(text, m);
    for (long n = ftell(text); n % 4; n++)
        fputc(' ', text);
    const bool whole = fclose(text) == 0 && !m->overflow;

    const uint32_t numbers = each_patch(m, to, NULL), letters = (uint32_t)size;
    if (whole) {
        fwrite("glTF", 1, 4, to);
        put_u32(to, 2);
        put_u32(to, 12 + 8 + letters + 8 + numbers);
        put_u32(to, letters);
        fwrite("JSON", 1, 4, to);
        fwrite(json, 1, size, to);
        put_u32(to, numbers);
        fwrite("BIN\0", 1, 4, to);
        each_patch(m, to, put_patch);
    }
    free(json);
    return whole && !ferror(to);
}
