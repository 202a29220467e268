/* data/model/glb.c -- a model as binary glTF 2.0: a header, a JSON chunk, a chunk of numbers.
 *
 * One buffer: for each patch its positions, normals and texture coordinates (float), of which it
 * may lack the last two, then its corners (unsigned short where they fit, else int); after the
 * patches the pictures (PNG). A patch is a primitive. Each of its lists has a buffer view and an
 * accessor with the same number; the pictures have the views after those.
 */
#define _GNU_SOURCE /* open_memstream */
#include "data/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RAD (3.14159265358979323846 / 180.0)

enum { PATCH_MAX = SHAPE_MAX * INK_MAX, PICTURE_MAX = 2 * INK_MAX };

/* A model, ready to be written. */
typedef struct book {
    const model *of;
    drawn patches[PATCH_MAX]; /* those that have triangles, in their order */
    int patch_count, view_count;
    char *pictures[PICTURE_MAX];
    size_t picture_bytes[PICTURE_MAX];
    int picture_count;
    uint32_t bytes; /* of the buffer */
} book;

static bool short_corners(const drawn *t) { return t->vertex_count <= 65535; }

static int lists_of(const drawn *t) { return 2 + (t->normals != NULL) + (t->uv != NULL); }

static uint32_t padded(size_t bytes) { return ((uint32_t)bytes + 3) & ~3u; }

static uint32_t corner_bytes(const drawn *t)
{
    return t->triangle_count * 3 * (short_corners(t) ? 2 : 4);
}

static uint32_t vertex_bytes(const drawn *t)
{
    return t->vertex_count * (12u + (t->normals ? 12u : 0u) + (t->uv ? 8u : 0u));
}

/* ---- numbers ---------------------------------------------------------------------------- */

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

static void put_vectors(FILE *to, const float *v, uint32_t count)
{
    for (uint32_t i = 0; v && i < count; i++) {
        put_float(to, v[3 * i]);
        put_float(to, v[3 * i + 2]);
        put_float(to, 0.0f - v[3 * i + 1]);
    }
}

static void put_patch(FILE *to, const drawn *t)
{
    put_vectors(to, t->xyz, t->vertex_count);
    put_vectors(to, t->normals, t->vertex_count);
    for (uint32_t i = 0; t->uv && i < 2 * t->vertex_count; i++)
        put_float(to, t->uv[i]);

    const uint32_t n = 3 * t->triangle_count;
    if (!short_corners(t)) {
        for (uint32_t i = 0; i < n; i++)
            put_u32(to, t->corners[i]);
        return;
    }
    for (uint32_t i = 0; i < n; i += 2)
        put_u32(to, t->corners[i] | (i + 1 < n ? t->corners[i + 1] << 16 : 0));
}

static void put_numbers(FILE *to, const book *b)
{
    for (int i = 0; i < b->patch_count; i++)
        put_patch(to, &b->patches[i]);
    for (int i = 0; i < b->picture_count; i++) {
        fwrite(b->pictures[i], 1, b->picture_bytes[i], to);
        for (size_t n = b->picture_bytes[i]; n % 4; n++)
            fputc(0, to);
    }
}

/* ---- JSON ------------------------------------------------------------------------------- */

static void view_json(FILE *to, uint32_t *at, uint32_t bytes, int target)
{
    fprintf(to, "%s{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u", *at ? "," : "", *at, bytes);
    if (target)
        fprintf(to, ",\"target\":%d", target);
    fprintf(to, "}");
    *at += padded(bytes);
}

static void views_json(FILE *to, const book *b)
{
    uint32_t at = 0;
    for (int i = 0; i < b->patch_count; i++) {
        const drawn *t = &b->patches[i];
        view_json(to, &at, t->vertex_count * 12, 34962);
        if (t->normals)
            view_json(to, &at, t->vertex_count * 12, 34962);
        if (t->uv)
            view_json(to, &at, t->vertex_count * 8, 34962);
        view_json(to, &at, corner_bytes(t), 34963);
    }
    for (int i = 0; i < b->picture_count; i++)
        view_json(to, &at, (uint32_t)b->picture_bytes[i], 0);
}

static void bounds_json(FILE *to, const drawn *t, int sign, const char *key)
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

static void accessors_json(FILE *to, const book *b)
{
    int view = 0;
    for (int i = 0; i < b->patch_count; i++) {
        const drawn *t = &b->patches[i];
        fprintf(to, "%s{\"bufferView\":%d,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"",
                view ? "," : "", view, t->vertex_count);
        view++;
        bounds_json(to, t, -1, "min");
        bounds_json(to, t, 1, "max");
        if (t->normals)
            fprintf(to,
                    "},{\"bufferView\":%d,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"",
                    view++, t->vertex_count);
        if (t->uv)
            fprintf(to,
                    "},{\"bufferView\":%d,\"componentType\":5126,\"count\":%u,\"type\":\"VEC2\"",
                    view++, t->vertex_count);
        fprintf(to, "},{\"bufferView\":%d,\"componentType\":%d,\"count\":%u,\"type\":\"SCALAR\"}",
                view++, short_corners(t) ? 5123 : 5125, 3 * t->triangle_count);
    }
}

static void primitive_json(FILE *to, const drawn *t, int *view, int material)
{
    fprintf(to, "{\"attributes\":{\"POSITION\":%d", (*view)++);
    if (t->normals)
        fprintf(to, ",\"NORMAL\":%d", (*view)++);
    if (t->uv)
        fprintf(to, ",\"TEXCOORD_0\":%d", (*view)++);
    fprintf(to, "},\"indices\":%d,\"material\":%d}", (*view)++, material);
}

static void meshes_json(FILE *to, const book *b)
{
    const model *m = b->of;
    int view = 0, number = 0;
    fprintf(to, "\"meshes\":[");
    for (int i = 0; i < m->shape_count; i++) {
        const char *comma = "";
        fprintf(to, "%s\n{\"name\":\"%s\",\"primitives\":[", i ? "," : "", m->shapes[i].name);
        for (int k = 0; k < INK_MAX; k++)
            if (m->shapes[i].patches[k].triangle_count) {
                fprintf(to, "%s", comma);
                primitive_json(to, &b->patches[number++], &view, k);
                comma = ",";
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
    fprintf(to, "],\n\"scene\":0,\"scenes\":[{\"name\":\"%s\",\"nodes\":[", m->title);
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

static void used_json(FILE *to, const model *m)
{
    bool glows = false, ior = false, lets = false, solid = false, moved = false;
    for (int i = 0; i < m->paint_count; i++) {
        const paint *p = &m->paints[i];
        glows |= p->emission > 0.0;
        ior |= p->ior > 0.0;
        lets |= p->transmission > 0.0;
        solid |= p->transmission > 0.0 && p->thickness > 0.0;
        moved |= (p->base || p->relief) && (p->turn_deg != 0.0 || p->shrink > 0.0);
    }
    const char *names[] = { glows ? "materials_emissive_strength" : NULL,
                            ior ? "materials_ior" : NULL, lets ? "materials_transmission" : NULL,
                            solid ? "materials_volume" : NULL, moved ? "texture_transform" : NULL };
    const char *before = "\"extensionsUsed\":[";
    for (int i = 0; i < COUNT(names); i++)
        if (names[i]) {
            fprintf(to, "%s\"KHR_%s\"", before, names[i]);
            before = ",";
        }
    if (*before == ',')
        fprintf(to, "],\n");
}

static void model_json(FILE *to, const book *b)
{
    const model *m = b->of;
    fprintf(to, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"lux4 %s\"},\n", m->maker);
    used_json(to, m);
    paints_json(to, m, b->view_count);
    meshes_json(to, b);
    nodes_json(to, m);
    fprintf(to, "\"accessors\":[");
    accessors_json(to, b);
    fprintf(to, "],\n\"bufferViews\":[");
    views_json(to, b);
    fprintf(to, "],\n\"buffers\":[{\"byteLength\":%u}]}", b->bytes);
}

/* ---- the whole -------------------------------------------------------------------------- */

static bool draw_patches(book *b)
{
    const model *m = b->of;
    for (int i = 0; i < m->shape_count; i++)
        for (int k = 0; k < INK_MAX; k++) {
            const patch *t = &m->shapes[i].patches[k];
            drawn *d       = &b->patches[b->patch_count];
            if (!t->triangle_count)
                continue;
            b->patch_count++;
            if (k >= m->paint_count || !draw_patch(t, &m->paints[k], d))
                return false;
            b->view_count += lists_of(d);
            b->bytes += vertex_bytes(d) + padded(corner_bytes(d));
        }
    return true;
}

static bool draw_pictures(book *b)
{
    const picture *list[PICTURE_MAX];
    const int count = model_pictures(b->of, list);
    for (int i = 0; i < count; i++) {
        FILE *to        = open_memstream(&b->pictures[i], &b->picture_bytes[i]);
        const bool done = to && picture_write_png(list[i], to);
        b->picture_count++;
        if (!to || fclose(to) != 0 || !done)
            return false;
        b->bytes += padded(b->picture_bytes[i]);
    }
    return true;
}

static void book_close(book *b)
{
    for (int i = 0; i < b->patch_count; i++)
        drawn_clear(&b->patches[i]);
    for (int i = 0; i < b->picture_count; i++)
        free(b->pictures[i]);
    free(b);
}

static bool write_book(const book *b, FILE *to)
{
    char *json  = NULL;
    size_t size = 0;
    FILE *text  = open_memstream(&json, &size);
    if (!text)
        return false;
    model_json(text, b);
    for (long n = ftell(text); n % 4; n++)
        fputc(' ', text);
    const bool whole = fclose(text) == 0;
    if (whole) {
        const uint32_t letters = (uint32_t)size;
        fwrite("glTF", 1, 4, to);
        put_u32(to, 2);
        put_u32(to, 12 + 8 + letters + 8 + b->bytes);
        put_u32(to, letters);
        fwrite("JSON", 1, 4, to);
        fwrite(json, 1, size, to);
        put_u32(to, b->bytes);
        fwrite("BIN\0", 1, 4, to);
        put_numbers(to, b);
    }
    free(json);
    return whole && !ferror(to);
}

bool model_write_glb(const model *m, FILE *to)
{
    book *b = calloc(1, sizeof *b);
    if (!b)
        return false;
    b->of           = m;
    const bool done = !m->overflow && draw_patches(b) && draw_pictures(b) && write_book(b, to);
    book_close(b);
    return done;
}
