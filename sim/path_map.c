/* sim/path_map.c -- illumination maps where paths come to matt surfaces (illumination_map.h).
 *
 * A path that has gone off in a direction drawn from many ends where a map knows what comes next:
 * the light that has been reflected before, all of it. Lights are asked there, too, and count in
 * full, as no ray goes on that could meet them. Focused light, which no path finds, is added
 * wherever it lies, and the path goes on.
 */
#include "core/color.h"
#include "sim/path_parts.h"

static vmask matt_lanes(const path_tracer *t, int k)
{
    const scene *s = t->s;
    if (!has_narrow(s) && !has_hollow(s) && !has_exteriors(s))
        return t->active[k];
    vint kind = t->does[k] & (DOES_ASK | DOES_NARROW | DOES_AROUND | DOES_HOLLOW);
    return t->active[k] & (kind == DOES_ASK);
}

/* Adds irradiance e of a group (-1: all, as dimmed), by what the surface gives back. */
static void add(path_tracer *t, int k, vmask lanes, vrgb e, vrgb back, int group)
{
    const scene *s = t->s;
    path_layer to  = { .group = group < 0 ? 0 : group, .dimming = 1.0f };
    if (group >= 0)
        to.dimming = scene_dimming_of_group(s, group);
    path_add(t, k, lanes, (vmask){ 0 }, vmul(back, e), &to);
}

/* By how much results with coarser cells would be off from these. */
static void note_smoothing(path_tracer *t, int k, vmask lanes, vrgb fine, vrgb coarse, vrgb back)
{
    path_bundle *b = t->b;
    if (!b->smoothed)
        return;
    vfloat off = vrgb_luminance(vmul(back, vsub(fine, coarse)));
    for (int bits = vbits(lanes); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        b->smoothed[t->id[k * LANES + i]] += lane(off, i);
    }
}

/* The lanes that the map knows. */
static vmask look(path_tracer *t, const illumination_map *m, int k, vmask lanes)
{
    const scene *s = t->s;
    int i          = k * LANES;
    vhit hit       = { .instance = vkeep_int(lanes, vload_int(t->instance + i)),
                       .triangle = vkeep_int(lanes, vload_int(t->triangle + i)),
                       .u        = vload(t->u + i),
                       .v        = vload(t->v + i) };
    vint set       = vgather_int((const int32_t *)t->b->set, vload_int(t->id + i));
    vmask front    = t->shading[k].front;
    vrgb albedo    = materials_albedo(s->materials, t->at[k].material, &t->shading[k], lanes);
    vfloat share   = first_of(t, k) * 0.318309886f;
    vrgb back      = vscale(vmul(worth_of(t, k), albedo), share);
    vrgb fine, coarse;
    vmask known = illumination_map_look(m, &hit, front, set, -1, lanes, &fine, &coarse);
    if (!vany(known))
        return known;
    note_smoothing(t, k, known, fine, coarse, back);
    if (!s->layered) {
        add(t, k, known, fine, back, -1);
        return known;
    }
    for (int g = 0; g < s->group_count; g++) {
        illumination_map_look(m, &hit, front, set, g, known, &fine, &coarse);
        add(t, k, known, fine, back, g);
    }
    return known;
}

void path_take_maps(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vmask lanes = matt_lanes(t, k);
        vmask ended = { 0 };
        if (t->indirect && vany(lanes & state_has(t, k, WIDE)))
            ended = look(t, t->indirect, k, lanes & state_has(t, k, WIDE));
        if (t->focused && vany(lanes & ~ended))
            look(t, t->focused, k, lanes & ~ended);
        t->active[k] = t->active[k] & ~ended;
        t->ends[k]   = ended;
    }
}
