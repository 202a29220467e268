/* sim/map_look.c -- see illumination_map.h: what is asked of a map.
 */
#include "sim/map_parts.h"

static size_t difference_at(const illumination_map *m, size_t node, int slot)
{
    return (node * (size_t)m->slots + (size_t)slot) * 3;
}

/* By how much less the parent has, in the mean of all sets: a set's own difference is mostly noise.
 */
static void find_difference(illumination_map *m, size_t node, size_t parent, int slot)
{
    float *to = m->smoothed + difference_at(m, node, slot);
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (int set = 0; set < SCRAMBLES; set++)
            sum += (double)m->values[map_value_at(m, node, slot, set) + (size_t)c] -
                   (double)m->values[map_value_at(m, parent, slot, set) + (size_t)c];
        to[c] = (float)(sum / SCRAMBLES);
    }
}

bool map_find_smoothing(arena *a, illumination_map *m, lux_error *err)
{
    const map_node *nodes = m->cells.nodes;
    size_t count          = (size_t)m->cells.node_count;
    m->smoothed           = arena_array(a, float, difference_at(m, count, 0) + 1, err);
    for (size_t n = 0; m->smoothed && n < count; n++) {
        int32_t parent = nodes[n].parent;
        if (parent < 0 || nodes[parent].walled)
            continue;
        for (int slot = 0; slot < m->slots; slot++)
            find_difference(m, n, (size_t)parent, slot);
    }
    return m->smoothed != NULL;
}

static int slot_of(const illumination_map *m, int group)
{
    return m->slots == 1 || group < 0 ? 0 : 1 + group;
}

static vec3 value_of(const illumination_map *m, size_t bin, int group, int set)
{
    const float *v = m->values + map_value_at(m, bin, slot_of(m, group), set);
    return (vec3){ v[0], v[1], v[2] };
}

vmask illumination_map_look(const illumination_map *m, const vhit *hit, vmask front, vint set,
                            int group, vmask active, vrgb *fine, vrgb *coarse)
{
    float f[3][LANES] = { 0 }, p[3][LANES] = { 0 };
    int32_t known[LANES] = { 0 };
    for (int bits = vbits(active & (hit->instance >= 0)); bits; bits &= bits - 1) {
        int i       = __builtin_ctz((unsigned)bits);
        map_mark at = { .instance = lane(hit->instance, i),
                        .triangle = lane(hit->triangle, i),
                        .front    = vbits(front) >> i & 1,
                        .u        = lane(hit->u, i),
                        .v        = lane(hit->v, i) };
        int32_t n   = map_cells_find(&m->cells, world_mesh(m->s->world, at.instance), &at);
        if (n < 0)
            continue;
        const float *less = m->smoothed + difference_at(m, (size_t)n, slot_of(m, group));
        vec3 e            = value_of(m, (size_t)n, group, lane(set, i));
        known[i]          = 1;
        f[0][i] = e.x, f[1][i] = e.y, f[2][i] = e.z;
        p[0][i] = e.x - less[0], p[1][i] = e.y - less[1], p[2][i] = e.z - less[2];
    }
    *fine   = (vrgb){ vload(f[0]), vload(f[1]), vload(f[2]) };
    *coarse = (vrgb){ vload(p[0]), vload(p[1]), vload(p[2]) };
    return vload_int(known) != 0;
}

vec3 illumination_map_at_sensor(const illumination_map *m, int sensor, int set, int group,
                                vec3 *coarse)
{
    size_t bin = (size_t)m->cells.node_count + 2 * (size_t)sensor;
    *coarse    = value_of(m, bin + 1, group, set);
    return value_of(m, bin, group, set);
}
