/* sim/gltf_node.c -- the tree of nodes laid flat: places of meshes and cameras.
 *
 * Nothing here recurses: parents come before children in one list, however deep the tree. The
 * place of a node is  turn_up * parent's matrix * ... * its own  in double precision, where turn_up
 * takes glTF's frame to ours: (x, y, z) -> (x, -z, y).
 */
#include "sim/gltf_source.h"

#include <stdio.h>
#include <string.h>

static const uint32_t placements_most = 1u << 24;

static const transform turn_up = { { { 1, 0, 0, 0 }, { 0, 0, -1, 0 }, { 0, 1, 0, 0 } } };

typedef struct node_work {
    reader *r;
    uint32_t count;                       /* of nodes in the file */
    int64_t *parent;                      /* -1: a root */
    uint32_t *order;                      /* parents before children */
    transform *place;                     /* of each, in our frame */
    bool *shown;                          /* belongs to the scene */
    uint32_t *number;                     /* in the result, of those shown */
    uint32_t placements, cameras, lights; /* room, then how many there are */
} node_work;

/* ---- the tree ---- */

static bool find_parents(node_work *w, lux_error *err)
{
    for (uint32_t i = 0; i < w->count; i++)
        w->parent[i] = -1;
    for (uint32_t i = 0; i < w->count; i++) {
        const source_node *n = &w->r->source->nodes[i];
        for (uint32_t k = 0; k < n->child_count; k++) {
            int child = n->children[k];
            if (!index_valid(w->r, child, w->count, "node", err, "/nodes/%u/children/%u", i, k))
                return false;
            if (w->parent[child] >= 0)
                return failed(err, ERR_FORMAT,
                              "%s: /nodes/%u/children/%u: node %d is a child of "
                              "node %lld already",
                              w->r->file->path, i, k, child, (long long)w->parent[child]);
            w->parent[child] = i;
        }
    }
    return true;
}

/* Breadth first from all roots: who is not reached is its own ancestor. */
static bool find_order(node_work *w, lux_error *err)
{
    uint32_t end = 0;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->parent[i] < 0)
            w->order[end++] = i;
    for (uint32_t at = 0; at < end; at++) {
        const source_node *n = &w->r->source->nodes[w->order[at]];
        for (uint32_t k = 0; k < n->child_count; k++)
            w->order[end++] = (uint32_t)n->children[k];
    }
    if (end == w->count)
        return true;

    /* Up from anywhere outside, as many steps as there are nodes, ends within a cycle */
    bool *reached = w->shown;
    uint32_t lost = 0;
    for (uint32_t i = 0; i < end; i++)
        reached[w->order[i]] = true;
    while (reached[lost])
        lost++;
    for (uint32_t i = 0; i < w->count; i++)
        lost = (uint32_t)w->parent[lost];
    return failed(err, ERR_FORMAT, "%s: /nodes/%u: the node is its own ancestor", w->r->file->path,
                  lost);
}

static bool check_scene(const node_work *w, uint32_t number, lux_error *err)
{
    const source_scene *scene = &w->r->source->scenes[number];
    for (uint32_t k = 0; k < scene->node_count; k++) {
        int root = scene->nodes[k];
        if (!index_valid(w->r, root, w->count, "node", err, "/scenes/%u/nodes/%u", number, k))
            return false;
        if (w->parent[root] >= 0)
            return failed(err, ERR_FORMAT,
                          "%s: /scenes/%u/nodes/%u: node %d is no root, but a child "
                          "of node %lld",
                          w->r->file->path, number, k, root, (long long)w->parent[root]);
    }
    return true;
}

/* All scenes are checked, one is shown; without scenes, all nodes. */
static bool find_shown(node_work *w, lux_error *err)
{
    const source *s = w->r->source;
    uint32_t number = s->scene >= 0 ? (uint32_t)s->scene : 0;
    for (uint32_t i = 0; i < s->scene_count; i++)
        if (!check_scene(w, i, err))
            return false;
    if (s->scene >= 0 && !index_valid(w->r, s->scene, s->scene_count, "scene", err, "/scene"))
        return false;
    for (uint32_t i = 0; i < w->count; i++)
        w->shown[i] = !s->scene_count;
    for (uint32_t k = 0; s->scene_count && k < s->scenes[number].node_count; k++)
        w->shown[s->scenes[number].nodes[k]] = true;
    return true;
}

/* ---- matrices ---- */

static transform from_trs(const double move[3], const double q[4], const double scale[3])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    double turn[3][3] = {
        { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
        { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w) },
        { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y) },
    };
    transform t;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            t.m[i][j] = turn[i][j] * scale[j];
        t.m[i][3] = move[i];
    }
    return t;
}

/* Whether a matrix, and its determinant, can be reckoned with. */
static bool is_finite(const transform *t)
{
    double sum = transform_determinant(t) * 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            sum += t->m[i][j] * 0.0; /* NaN if one of them is not finite */
    return sum == 0;
}

static bool own_matrix(const node_work *w, uint32_t i, transform *t, lux_error *err)
{
    const source_node *n = &w->r->source->nodes[i];
    if (!n->has_matrix) {
        *t = from_trs(n->move, n->turn, n->scale);
        return is_finite(t) || failed(err, ERR_FORMAT,
                                      "%s: /nodes/%u/rotation: a quaternion "
                                      "without a length",
                                      w->r->file->path, i);
    }
    const double *m = n->matrix;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        return failed(err, ERR_FORMAT,
                      "%s: /nodes/%u/matrix: the last row is %g %g %g %g, wanted "
                      "0 0 0 1",
                      w->r->file->path, i, m[3], m[7], m[11], m[15]);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            t->m[row][column] = m[4 * column + row];
    return true;
}

static bool find_places(node_work *w, lux_error *err)
{
    for (uint32_t k = 0; k < w->count; k++) {
        uint32_t i       = w->order[k];
        transform before = w->parent[i] < 0 ? turn_up : w->place[w->parent[i]], own;
        if (!own_matrix(w, i, &own, err))
            return false;
        w->place[i] = transform_product(&before, &own);
        if (!is_finite(&w->place[i]))
            return failed(err, ERR_FORMAT,
                          "%s: /nodes/%u: with those above it, its matrix is beyond "
                          "every number",
                          w->r->file->path, i);
        if (w->parent[i] >= 0)
            w->shown[i] = w->shown[w->parent[i]];
    }
    return true;
}

/* ---- what hangs on the nodes ---- */

static bool check_node(const node_work *w, uint32_t i, lux_error *err)
{
    const source *s      = w->r->source;
    const source_node *n = &s->nodes[i];
    return (n->mesh < 0 ||
            index_valid(w->r, n->mesh, s->mesh_count, "mesh", err, "/nodes/%u/mesh", i)) &&
           (n->camera < 0 ||
            index_valid(w->r, n->camera, s->camera_count, "camera", err, "/nodes/%u/camera", i)) &&
           (n->skin < 0 ||
            index_valid(w->r, n->skin, w->r->file->skin_count, "skin", err, "/nodes/%u/skin", i)) &&
           node_lights_valid(w->r, i, err);
}

/* How many instances EXT_mesh_gpu_instancing makes of a node's mesh; 0, with *err, if its
 * accessors are wrong. */
static uint64_t instance_count(const node_work *w, uint32_t i, lux_error *err)
{
    const source *s                  = w->r->source;
    const source_node *n             = &s->nodes[i];
    const source_index which[3]      = { n->instance_move, n->instance_turn, n->instance_scale };
    static const char *const names[] = { "TRANSLATION", "ROTATION", "SCALE" };
    static const char at[]           = "/nodes/%u/extensions/EXT_mesh_gpu_instancing/attributes/%s";
    uint64_t count                   = 0;
    for (int k = 0; k < 3; k++) {
        if (which[k] < 0)
            continue;
        if (!index_valid(w->r, which[k], s->accessor_count, "accessor", err, at, i, names[k]))
            return 0;
        uint64_t here = s->accessors[which[k]].count;
        if (count && here != count) {
            failed(err, ERR_FORMAT,
                   "%s: /nodes/%u/extensions/EXT_mesh_gpu_instancing: %s has %llu "
                   "elements, another %llu",
                   w->r->file->path, i, names[k], (unsigned long long)here,
                   (unsigned long long)count);
            return 0;
        }
        count = here;
    }
    return count ? count : 1; /* without any attribute: the mesh itself */
}

/* Checks the nodes, and counts what the scene has of each kind. */
static bool count_parts(node_work *w, lux_error *err)
{
    uint64_t placements = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        const source_node *n = &w->r->source->nodes[i];
        if (!check_node(w, i, err))
            return false;
        uint64_t many = n->mesh >= 0 && n->instanced ? instance_count(w, i, err) : n->mesh >= 0;
        if (n->mesh >= 0 && !many)
            return false;
        if (!w->shown[i])
            continue;
        w->number[i] = w->r->out->node_count++;
        placements += many;
        w->cameras += n->camera >= 0;
        w->lights += node_light_count(n);
        if (n->skin >= 0)
            tally_add(w->r, TALLY_SKIN, "/nodes/%u", i);
        if (placements > placements_most)
            return failed(err, ERR_UNSUPPORTED, "%s: /nodes/%u: more than %u placed meshes",
                          w->r->file->path, i, placements_most);
    }
    w->placements = (uint32_t)placements;
    return true;
}

/* Adds the node's mesh in one place; left out where that place has no volume. */
static void add_placement(node_work *w, uint32_t i, const transform *place)
{
    gltf *out = w->r->out;
    if (transform_determinant(place) == 0)
        tally_add(w->r, TALLY_SINGULAR, "/nodes/%u", i);
    else
        out->placements[out->placement_count++] = (gltf_placement){
            .mesh = (uint32_t)w->r->source->nodes[i].mesh, .node = w->number[i], .place = *place
        };
}

/* Three or four numbers of instance k, or what stands for them if the accessor is not there. */
static void instance_numbers(const double *all, size_t k, int width, double otherwise, double *out)
{
    for (int c = 0; c < width; c++)
        out[c] = all ? all[k * (size_t)width + (size_t)c] : otherwise;
}

static bool add_instances(node_work *w, uint32_t i, arena *own, lux_error *err)
{
    const source_node *n = &w->r->source->nodes[i];
    char at[80];
    snprintf(at, sizeof at, "/nodes/%u/extensions/EXT_mesh_gpu_instancing", i);
    const double *move = NULL, *turn = NULL, *scale = NULL;
    if ((n->instance_move >= 0 &&
         !(move = accessor_numbers(w->r, own, n->instance_move, 3, at, err))) ||
        (n->instance_turn >= 0 &&
         !(turn = accessor_numbers(w->r, own, n->instance_turn, 4, at, err))) ||
        (n->instance_scale >= 0 &&
         !(scale = accessor_numbers(w->r, own, n->instance_scale, 3, at, err))))
        return false;

    uint64_t count = instance_count(w, i, err);
    for (size_t k = 0; k < count; k++) {
        double t[3], q[4] = { 0, 0, 0, 1 }, s[3];
        instance_numbers(move, k, 3, 0.0, t);
        instance_numbers(scale, k, 3, 1.0, s);
        if (turn)
            instance_numbers(turn, k, 4, 0.0, q);
        transform own_place = from_trs(t, q, s);
        transform place     = transform_product(&w->place[i], &own_place);
        if (!is_finite(&place))
            return failed(err, ERR_FORMAT, "%s: %s: instance %zu has no finite matrix",
                          w->r->file->path, at, k);
        add_placement(w, i, &place);
    }
    return true;
}

static bool add_mesh(node_work *w, uint32_t i, lux_error *err)
{
    const source_node *n = &w->r->source->nodes[i];
    if (n->mesh < 0 || !w->r->out->meshes[n->mesh].triangles.triangle_count)
        return true;
    if (!n->instanced) {
        add_placement(w, i, &w->place[i]);
        return true;
    }
    arena own = { 0 };
    bool good = add_instances(w, i, &own, err);
    arena_clear(&own);
    return good;
}

static bool add_camera(node_work *w, uint32_t i, lux_error *err)
{
    const source_node *n = &w->r->source->nodes[i];
    if (n->camera < 0)
        return true;
    if (transform_determinant(&w->place[i]) == 0) {
        tally_add(w->r, TALLY_SINGULAR, "/nodes/%u", i);
        return true;
    }
    const source_camera *c = &w->r->source->cameras[n->camera];
    gltf_camera *to        = &w->r->out->cameras[w->r->out->camera_count++];
    *to                    = (gltf_camera){ .place       = w->place[i],
                                            .perspective = c->perspective,
                                            .yfov        = c->yfov,
                                            .aspect      = c->aspect,
                                            .xmag        = fabs(c->xmag),
                                            .ymag        = fabs(c->ymag) };
    to->name               = read_name(w->r, *c->name ? c->name : n->name, err);
    return to->name != NULL;
}

static bool add_parts(node_work *w, lux_error *err)
{
    gltf *out       = w->r->out;
    arena *a        = w->r->a;
    out->nodes      = arena_array(a, gltf_node, out->node_count, err);
    out->placements = arena_array(a, gltf_placement, w->placements, err);
    out->cameras    = arena_array(a, gltf_camera, w->cameras, err);
    out->lights     = arena_array(a, gltf_light, w->lights, err);
    if (!out->nodes || !out->placements || !out->cameras || !out->lights)
        return false;
    for (uint32_t i = 0; i < w->count; i++) {
        if (!w->shown[i])
            continue;
        gltf_node *to = &out->nodes[w->number[i]];
        to->name      = read_name(w->r, w->r->source->nodes[i].name, err);
        to->place     = w->place[i];
        to->parent    = w->parent[i] < 0 ? -1 : (int32_t)w->number[w->parent[i]];
        if (!to->name || !add_mesh(w, i, err) || !add_camera(w, i, err) ||
            !node_lights_add(w->r, i, w->number[i], &w->place[i], err))
            return false;
    }
    return true;
}

bool read_nodes(reader *r, lux_error *err)
{
    arena *scratch = r->file->scratch;
    uint32_t count = r->source->node_count;
    node_work w    = { .r      = r,
                       .count  = count,
                       .parent = arena_array(scratch, int64_t, count, err),
                       .order  = arena_array(scratch, uint32_t, count, err),
                       .place  = arena_array(scratch, transform, count, err),
                       .shown  = arena_array(scratch, bool, count, err),
                       .number = arena_array(scratch, uint32_t, count, err) };
    if (!w.parent || !w.order || !w.place || !w.shown || !w.number || !find_parents(&w, err) ||
        !find_order(&w, err))
        return false;
    if (!r->source->scene_count && count)
        notice_add(r->notices, "%s: /scenes: there are none, all nodes are shown", r->file->path);
    return find_shown(&w, err) && find_places(&w, err) && count_parts(&w, err) &&
           add_parts(&w, err);
}
