/* tests/quads_gltf.c -- see quads_gltf.h. A unit square, placed by the matrices of nodes that all
 * hang at the scene's root but for those with a parent, which is an empty node beside its mesh.
 */
#include "tests/quads_gltf.h"

#include "tests/folder.h"
#include "tests/test.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct text {
    char out[65536];
    size_t used;
} text;

static void add(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(text *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    t->used += (size_t)vsnprintf(t->out + t->used, sizeof t->out - t->used, format, list);
    va_end(list);
    assert_true(t->used < sizeof t->out);
}

/* glTF's y is up. */
static void add_column(text *t, dvec3 a, int last)
{
    add(t, "%s%.17g,%.17g,%.17g,%d", t->out[t->used - 1] == '[' ? "" : ",", a.x, a.z, -a.y, last);
}

/* Node 2 i has the name and holds node 2 i + 1, which has the mesh, and its children. */
static void add_node(text *t, const quad *quads, int count, int i)
{
    const quad *q = &quads[i];
    add(t, "%s{\"name\":\"%s\",\"children\":[%d", i ? "," : "", q->node, 2 * i + 1);
    for (int k = 0; k < count; k++)
        if (quads[k].parent == i)
            add(t, ",%d", 2 * k);
    add(t, "]},{\"mesh\":%d,\"matrix\":[", q->material);
    dvec3 n = d3_cross(q->u, q->v);
    add_column(t, q->u, 0);
    add_column(t, q->v, 0);
    add_column(t, d3_scale(n, 1 / d3_length(n)), 0);
    add_column(t, q->at, 1);
    add(t, "]}");
}

static void add_material(text *t, const char *name)
{
    static const char glass[] = "\"extensions\":{\"KHR_materials_transmission\":"
                                "{\"transmissionFactor\":1}},";
    add(t,
        "{\"name\":\"%s\",%s\"pbrMetallicRoughness\":{\"baseColorFactor\":[%s,1],"
        "\"metallicFactor\":0,\"roughnessFactor\":%d}}",
        name, strncmp(name, "Glass", 5) ? "" : glass,
        strncmp(name, "Glass", 5) ? "0.5,0.5,0.5" : "0.9,0.9,0.9", strncmp(name, "Glass", 5) != 0);
}

void quads_gltf_write(const char *folder, const char *name, const quad *quads, int count,
                      const char *const *materials, int material_count)
{
    static text t;
    t = (text){ .used = 0 };
    add(&t, "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_transmission\"],"
            "\"scene\":0,\"scenes\":[{\"nodes\":[");
    for (int i = 0, roots = 0; i < count; i++)
        if (quads[i].parent < 0)
            add(&t, "%s%d", roots++ ? "," : "", 2 * i);
    add(&t, "]}],\"nodes\":[");
    for (int i = 0; i < count; i++)
        add_node(&t, quads, count, i);
    add(&t, "],\"materials\":[");
    for (int m = 0; m < material_count; m++) {
        add(&t, "%s", m ? "," : "");
        add_material(&t, materials[m]);
    }
    add(&t, "],\"meshes\":[");
    for (int m = 0; m < material_count; m++)
        add(&t,
            "%s{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,"
            "\"material\":%d}]}",
            m ? "," : "", m);
    add(&t, "],\"buffers\":[{\"byteLength\":60,\"uri\":\"data:application/octet-stream;base64,"
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAABAAIAAAACAAMA\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
            "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","
            "\"min\":[0,0,0],\"max\":[1,1,0]},"
            "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}]}");
    folder_write(folder, name, t.out);
}

void quads_box(quad out[6], const char *node, int made_of, dvec3 low, dvec3 high)
{
    dvec3 s = d3_sub(high, low);
    dvec3 x = { s.x, 0, 0 }, y = { 0, s.y, 0 }, z = { 0, 0, s.z };
    const dvec3 at[6] = { low, d3_add(low, y), low, d3_add(low, x), low, d3_add(low, z) };
    const dvec3 u[6] = { x, z, z, y, y, x }, v[6] = { z, x, y, z, x, y };
    for (int k = 0; k < 6; k++)
        out[k] = (quad){ node, made_of, -1, at[k], u[k], v[k] };
}
