/* sim/map_arrive.c -- see map_tracer.h: where particles come to, and what they leave there.
 */
#include "sim/map_tracer.h"

#include "core/color.h"
#include "sim/shading.h"

static const float wide_spread = 0.03f; /* rad: as in path.c */

vmask map_counts(const map_tracer *t, int k)
{
    vint state = vload_int(t->state + k * LANES);
    vmask some = ((state & NO_IMAGE) != 0) & ((state & LOST) == 0);
    return t->job->kind == MAP_INDIRECT ? some : some & ((state & SPREAD) == 0);
}

static void note_way(map_tracer *t, int i)
{
    if (!(t->state[i] & FROM_MATT))
        return;
    double d = (double)t->distance[i];
    t->balance->way2 += d * d;
    t->balance->ways++;
}

static void deposit(map_tracer *t, int i, int32_t bin, int32_t group, vec3 flux)
{
    map_deposit *to = map_list_add(t->out);
    if (to)
        *to = (map_deposit){ bin, group, t->carried[DIMMING][i], flux };
}

static void lay_down(map_tracer *t, int i, int32_t front, vec3 flux)
{
    const map_job *job = t->job;
    if (job->learns) {
        deposit(t, i, -1, t->aim_cell[i], flux);
        return;
    }
    map_mark mark = { .instance = t->instance[i],
                      .triangle = t->triangle[i],
                      .front    = front,
                      .u        = t->u[i],
                      .v        = t->v[i],
                      .weight   = rgb_luminance(flux) };
    if (!job->cells) {
        map_mark *to = map_list_add(t->out);
        if (to)
            *to = mark;
        note_way(t, i);
        return;
    }
    int32_t bin = map_cells_find(job->cells, world_mesh(job->s->world, mark.instance), &mark);
    if (bin < 0) {
        const float missed[3] = { flux.x, flux.y, flux.z };
        for (int c = 0; c < 3; c++)
            t->balance->unplaced[c] += (double)missed[c];
        return;
    }
    deposit(t, i, bin, t->group[i], flux);
}

vmask map_arrive(map_tracer *t, int k)
{
    const scene *s = t->job->s;
    vmask active   = living(t, k);
    vhit hit       = hit_of(t, k, active);
    vvec3 way      = load3(t, WAY, k);
    scene_shade(s, &hit, &way, wide_spread * hit.distance, active, &t->at[k], &t->shading[k]);

    vint does = vgather_int(s->material_does, vkeep_int(active, t->at[k].material));
    vfloat turned =
        s->smooth || s->textured ? tilt(&t->shading[k], &t->shading[k].wo) : vsplat(1.0f);
    vrgb flux    = vscale(load3(t, FLUX, k), turned);
    vmask copies = (vload_int(t->state + k * LANES) & COPY) != 0;
    for (int bits = vbits(active & map_counts(t, k) & ~copies); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits), i = k * LANES + j;
        if (is_matt(lane(does, j)))
            lay_down(t, i, vbits(t->shading[k].front) >> j & 1,
                     (vec3){ lane(flux.x, j), lane(flux.y, j), lane(flux.z, j) });
    }
    return active;
}
