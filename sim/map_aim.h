/* sim/map_aim.h -- particles of focused light, aimed at what may focus it.
 *
 * Light of MAP_FOCUSED turns first at a surface that is not matt. So a place q on one of these is
 * drawn first, then a place of a lamp or sun that shines there, by its sample():
 *
 *             * lamp        flux = E |cos| A / share           E at q on a plane square to the
 *              \            ray, A the area of the cell that q is even in, `share` with which
 *               \           this cell of that source is drawn
 *        -----.--q--.-----
 *             cell
 *
 * A particle counts if q is where it turns first: what stands before lets it pass straight or ends
 * it, and if it is turned there another cell stands for it. So each way that light takes is drawn
 * once, whatever surfaces overlap; the weights are unbiased with any shares above 0, and nothing is
 * left out.
 *
 * Shares are learned from rounds of pilots, by what of their light came through squares around
 * sensors and to matt surfaces: best is what goes as the root of its mean square in each cell.
 * Cells are cut anew after each round, the finer the larger their share. A part of all is always
 * drawn as the sources shine on cells, so that no weight is far above that of plain drawing.
 */
#ifndef SIM_MAP_AIM_H
#define SIM_MAP_AIM_H

#include "sim/map_parts.h"

/* For whom aims are found. */
typedef struct aim_desc {
    const scene *s;
    uint32_t seed;
    int threads;
    int64_t particles;          /* that are to come; 0: not known */
    const map_cells *meshes;    /* their triangles in order */
    map_tracer *const *tracers; /* of each thread */
    const map_sensors *sensors; /* NULL */
    const volatile bool *stop;  /* NULL */
} aim_desc;

/* NULL, with *err: memory is out, or (ERR_INTERRUPTED) the user stopped it. */
const map_aim *map_aim_new(arena *a, const aim_desc *d, lux_error *err);

/* W, by channel: all light of the lamps and suns, as maintained, wherever it goes. */
vec3 map_aim_flux(const map_aim *m);

/* Which its pilots traced. */
int64_t map_aim_rays(const map_aim *m);

/* Where a particle is to turn first. */
typedef struct vaimed {
    vfloat distance;         /* m, along its ray */
    vint instance, triangle; /* of the scene's world */
    vint cell;               /* that it is drawn from */
} vaimed;

/* As emission_draw() does. */
vmask map_aim_draw(const map_aim *m, vuint index, vuint seed, vmask active, vparticle *out,
                   vaimed *to);

/* m: how far off `distance` may be, of a particle that came so far. */
vfloat map_aim_tolerance(const map_aim *m, vfloat distance);

#endif
