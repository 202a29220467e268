/* sim/lamp_boxes.c -- see lamp_boxes.h. Boxes are meshes in a world of their own. */
#include "sim/lamp_boxes.h"

#include "sim/room.h"

#include <stdlib.h>
#include <string.h>

enum { FEW = 8 /* that are not worth a box each */, MOST_MET = 16 };

static const double wider = 1e-4; /* than its lamp a box is, so that flat ones have an inside */

struct lamp_boxes {
    const seen_lamps *all;
    const world *w;       /* NULL: all lamps are given always */
    const int32_t *lamps; /* of each instance */
    const int32_t *always;
    int always_count; /* lamps without a box: far ones */
};

/* One box for all: from (0, 0, 0) to (1, 1, 1). */
static mesh unit_box(arena *a, lux_error *err)
{
    dvec3 corner[ROOM_POSITIONS];
    vec3 *positions   = arena_array(a, vec3, ROOM_POSITIONS, err);
    uint32_t *corners = arena_array(a, uint32_t, 3 * ROOM_TRIANGLES, err);
    uint32_t side[ROOM_TRIANGLES];
    if (!positions || !corners)
        return (mesh){ 0 };
    room_box((dvec3){ 1, 1, 1 }, corner, corners, side);
    for (int i = 0; i < ROOM_POSITIONS; i++)
        positions[i] = d3_to_float(corner[i]);
    return (mesh){ .positions      = positions,
                   .corners        = corners,
                   .position_count = ROOM_POSITIONS,
                   .triangle_count = ROOM_TRIANGLES };
}

static transform place_of(const light_bounds *b)
{
    dvec3 low = d3_from(b->low), size = d3_sub(d3_from(b->high), low);
    double far = fmax(d3_length(low), d3_length(d3_from(b->high)));
    double off = wider * (d3_length(size) + wider * far);
    return (transform){ { { size.x + 2 * off, 0, 0, low.x - off },
                          { 0, size.y + 2 * off, 0, low.y - off },
                          { 0, 0, size.z + 2 * off, low.z - off } } };
}

static const world *make_world(arena *a, const scene *s, lamp_boxes *b, lux_error *err)
{
    const seen_lamps *all     = b->all;
    arena scratch             = { 0 };
    size_t room               = (size_t)all->count + 1;
    int32_t *lamps            = arena_array(a, int32_t, room, err);
    int32_t *always           = arena_array(a, int32_t, room, err);
    world_instance *instances = arena_array(&scratch, world_instance, room, err);
    mesh box                  = unit_box(&scratch, err);
    world *w                  = NULL;
    uint32_t count            = 0;
    if (!lamps || !always || !instances || !box.corners)
        goto done;
    for (int i = 0; i < all->count; i++) {
        light_bounds bounds = light_bounds_of(s->lights[all->lamps[i]]);
        if (bounds.far) {
            always[b->always_count++] = all->lamps[i];
            continue;
        }
        instances[count] = (world_instance){ .place = place_of(&bounds) };
        lamps[count++]   = all->lamps[i];
    }
    b->lamps  = lamps;
    b->always = always;
    w         = world_new(a,
                          &(world_desc){ .meshes         = &box,
                                         .mesh_count     = 1,
                                         .instances      = instances,
                                         .instance_count = count,
                                         .threads        = 1 },
                          err);
done:
    arena_clear(&scratch);
    return w;
}

const lamp_boxes *lamp_boxes_new(arena *a, const scene *s, const seen_lamps *all, lux_error *err)
{
    lamp_boxes *b = arena_new(a, lamp_boxes, err);
    if (!b)
        return NULL;
    b->all = all;
    if (all->count <= FEW)
        return b;
    b->w = make_world(a, s, b, err);
    return b->w ? b : NULL;
}

static int ascending(const void *one, const void *other)
{
    int32_t a = *(const int32_t *)one, b = *(const int32_t *)other;
    return (a > b) - (a < b);
}

static int give_all(const lamp_boxes *b, int32_t *list)
{
    memcpy(list, b->all->lamps, (size_t)b->all->count * sizeof *list);
    return b->all->count;
}

static int add_once(int32_t *list, int count, int32_t lamp)
{
    for (int i = 0; i < count; i++)
        if (list[i] == lamp)
            return count;
    list[count] = lamp;
    return count + 1;
}

int lamp_boxes_met(const lamp_boxes *b, const vray *rays, vmask active, int32_t *list)
{
    vhit hits[MOST_MET];
    if (!b->w)
        return give_all(b, list);
    if (!world_every_hit(b->w, rays, &active, 1, MOST_MET, hits))
        return give_all(b, list); /* it goes through more boxes than are looked at */
    int count = b->always_count;
    memcpy(list, b->always, (size_t)count * sizeof *list);
    for (int k = 0; k < MOST_MET; k++)
        for (int bits = vbits(active & (hits[k].instance >= 0)); bits; bits &= bits - 1)
            count = add_once(list, count,
                             b->lamps[lane(hits[k].instance, __builtin_ctz((unsigned)bits))]);
    qsort(list, (size_t)count, sizeof *list, ascending);
    return count;
}
