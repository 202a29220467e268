/* sim/scene_nodes.c -- luminaires at the nodes of glTF files, and the bodies that hang there.
 *
 * A node whose name matches carries a luminaire; all that is placed below the node is its body,
 * which does not shade it. A match below a match is part of that body. Several luminaires at one
 * node share the body.
 */
#include "sim/scene_build.h"

enum { UNKNOWN = -2, NONE = -1 };

/* By way of a stack, since trees may be deep. */
bool scene_node_carriers(const gltf *g, const char *pattern, int64_t *carrier, uint32_t *stack)
{
    bool any = false;
    for (uint32_t n = 0; n < g->node_count; n++)
        carrier[n] = UNKNOWN;
    for (uint32_t n = 0; n < g->node_count; n++) {
        size_t height = 0;
        int64_t up    = n;
        for (; up >= 0 && carrier[up] == UNKNOWN; up = g->nodes[up].parent)
            stack[height++] = (uint32_t)up;
        int64_t above = up < 0 ? NONE : carrier[up];
        while (height-- > 0) {
            uint32_t at = stack[height];
            if (above == NONE && study_match(pattern, g->nodes[at].name))
                above = at, any = true;
            carrier[at] = above;
        }
    }
    return any;
}

/* Gives what hangs at each carrier one owner in copy c: the one that it has already, or a new one.
 */
static bool own_bodies(scene_build *b, int i, int c, const int64_t *carrier, int32_t *owner_of)
{
    const gltf *g   = b->files[i];
    size_t room     = (size_t)b->study->scenes[i].at_count * g->placement_count;
    int first       = scene_first_use(b, i);
    b->owners[i]    = b->owners[i] ? b->owners[i] : arena_array(b->a, int32_t, room + 1, b->err);
    b->owned[first] = b->owned[first] ? b->owned[first]
                                      : arena_array(b->a, bool, (size_t)g->mesh_count + 1, b->err);
    if (!b->owners[i] || !b->owned[first])
        return false;
    int32_t *owners = b->owners[i] + (size_t)c * g->placement_count;
    for (uint32_t n = 0; n < g->node_count; n++)
        owner_of[n] = 0;
    for (uint32_t k = 0; k < g->placement_count; k++) {
        int64_t at = carrier[g->placements[k].node];
        if (at >= 0 && !owner_of[at])
            owner_of[at] = owners[k] ? owners[k] : ++b->owner_count;
    }
    for (uint32_t k = 0; k < g->placement_count; k++) {
        int64_t at = carrier[g->placements[k].node];
        if (at < 0)
            continue;
        owners[k]                              = owners[k] ? owners[k] : owner_of[at];
        b->owned[first][g->placements[k].mesh] = true;
    }
    return true;
}

static bool add_lamps(scene_build *b, const study_luminaire *l, node_lamps *to, int i,
                      const int64_t *carrier, int32_t *owner_of)
{
    const study_scene *s = &b->study->scenes[i];
    const gltf *g        = b->files[i];
    for (int c = 0; c < s->at_count; c++) {
        transform copy = scene_copy_place(s, c);
        if (!own_bodies(b, i, c, carrier, owner_of))
            return false;
        for (uint32_t n = 0; n < g->node_count; n++) {
            if (carrier[n] != n)
                continue;
            if (transform_determinant(&g->nodes[n].place) == 0.0)
                return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                    "node \"%s\" of %s is scaled to nothing", g->nodes[n].name,
                                    s->file);
            node_lamp *lamp = list_new(&to->lamps, b->a, node_lamp, b->err);
            if (!lamp)
                return false;
            *lamp = (node_lamp){ transform_product(&copy, &g->nodes[n].place), owner_of[n] };
        }
    }
    return true;
}

static bool find_nodes(scene_build *b, const study_luminaire *l, node_lamps *to, int i)
{
    const gltf *g     = b->files[i];
    arena scratch     = { 0 };
    size_t nodes      = (size_t)g->node_count + 1;
    int64_t *carrier  = arena_array(&scratch, int64_t, nodes, b->err);
    uint32_t *stack   = carrier ? arena_array(&scratch, uint32_t, nodes, b->err) : NULL;
    int32_t *owner_of = stack ? arena_array(&scratch, int32_t, nodes, b->err) : NULL;
    bool good         = owner_of && (!scene_node_carriers(g, l->nodes, carrier, stack) ||
                             add_lamps(b, l, to, i, carrier, owner_of));
    arena_clear(&scratch);
    return good;
}

bool build_bodies(scene_build *b)
{
    const study *s = b->study;
    b->at_nodes    = arena_array(b->a, node_lamps, (size_t)s->luminaire_count + 1, b->err);
    b->owners      = arena_array(b->a, int32_t *, (size_t)s->scene_count + 1, b->err);
    b->owned       = arena_array(b->a, bool *, (size_t)s->scene_count + 1, b->err);
    if (!b->at_nodes || !b->owners || !b->owned)
        return false;
    for (int i = 0; i < s->luminaire_count; i++) {
        const study_luminaire *l = &s->luminaires[i];
        if (!l->nodes)
            continue;
        for (int k = 0; k < s->scene_count; k++)
            if (!find_nodes(b, l, &b->at_nodes[i], k))
                return false;
        if (!b->at_nodes[i].lamps.count)
            return study_failed(s, l->where, b->err, ERR_ARGUMENT,
                                "`nodes: %s` matches no node of the scene", l->nodes);
    }
    return true;
}
