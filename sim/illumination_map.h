/* sim/illumination_map.h -- interreflected light that lies on matt surfaces, as particles left it.
 *
 * Particles set out from every source (emission.h), and are followed from surface to surface as
 * paths are, by the same materials; where one comes to a matt surface its flux is added to the cell
 * there. Cells lie on surfaces: a tree for each side of each smooth connected piece of a placed
 * mesh, whose nodes are sets of its triangles, then parts of one triangle; irradiance is flux over
 * area. Nothing is gathered through a wall, around a corner or across a crease, as no cell lies on
 * both: one over which a wall stands is divided until it is small, and is then told to have no
 * value. Nor have surfaces to which too few particles came to tell: paths go on from these.
 *
 * Light that comes straight from a source is not deposited, nor what is found by asking for mirror
 * images (mirrors.h): paths ask for these. There are SCRAMBLES maps, of independent particles, on
 * the same cells, which are found from particles of their own: so the spread of the means of
 * results of each tells their noise, that of the maps included. What is left is what a cell
 * smoothes; results with the cells' parents in their place tell how much that is.
 */
#ifndef SIM_ILLUMINATION_MAP_H
#define SIM_ILLUMINATION_MAP_H

#include "core/progress.h"
#include "sim/accuracy.h"
#include "sim/scene.h"

typedef enum map_light {
    MAP_INDIRECT, /* all light that has been reflected or refracted, but for mirror images */
    MAP_FOCUSED,  /* of that only what has met no matt surface before: CLASS_FOCUSED */
} map_light;

/* Places in the air at which focused light is to be known as well: a small square about each, or of
 * cylinders two upright ones. */
typedef struct map_sensors {
    int count;
    const vec3 *at, *normal; /* m, in the scene's frame; unit */
    float side;              /* m, of the squares, */
    study_quantity quantity; /* that they measure */
    const float *sides;      /* m, or of each sensor's, none larger; NULL */
    const float *allowed;    /* lx, of each: how far off it may be, about; NULL: all the same */
} map_sensors;

static inline float map_sensor_side(const map_sensors *m, int sensor)
{
    return m->sides ? m->sides[sensor] : m->side;
}

typedef struct map_options {
    map_light light;
    uint32_t seed;
    int threads;
    int64_t particles; /* of all maps together; 0: as many as `accuracy` calls for, about */
    double accuracy;   /* relative, of the mean irradiance on all surfaces that are lit */
    double deadline;   /* s, on clock_seconds(): then what there is must do; HUGE_VAL */
    const map_sensors *sensors; /* MAP_FOCUSED; NULL */
    progress *progress;         /* NULL */
} map_options;

/* How far off what maps smooth may make a result, in steps to coarser cells, of half the size: what
 * is in error falls by a half or more with each step, so that all finer ones together are worth
 * one; doubled. */
#define STEPS_SMOOTHED 2.0

typedef struct illumination_map illumination_map;

/* NULL, with *err: memory is out, or (ERR_INTERRUPTED) the user stopped it. */
const illumination_map *illumination_map_new(arena *a, const scene *s, const map_options *o,
                                             lux_error *err);

/* The lanes where the map knows the irradiance at the hit on the side that `front` says, W/m^2, by
 * channel, of all light as dimmed or (group >= 0) of a group undimmed; by map number `set`, <
 * SCRAMBLES. *coarse: the same by the cell's parent, but for its noise. */
vmask illumination_map_look(const illumination_map *m, const vhit *hit, vmask front, vint set,
                            int group, vmask active, vrgb *fine, vrgb *coarse);

/* The same at sensor number `sensor` of the options, W/m^2 (coarse: by a square of twice the area).
 */
vec3 illumination_map_at_sensor(const illumination_map *m, int sensor, int set, int group,
                                vec3 *coarse);

typedef struct map_figures {
    int64_t particles;
    int64_t rays; /* those of pilots included */
    int64_t cells, bytes;
    double seconds;
    vec3 sources;                    /* W: all light of what particles set out from */
    vec3 emitted, absorbed, escaped; /* W: what became of that of the particles; aimed ones
                                        (MAP_FOCUSED) that miss are absorbed */
    vec3 dropped;                    /* W, of particles that were given up: 0 but for no memory */
    vec3 unplaced; /* W, of the light that is deposited: where no cell has a value */
} map_figures;
map_figures illumination_map_figures(const illumination_map *m);

/* Of no more is a map made, whatever accuracy calls for. */
enum { MAP_MOST_PARTICLES = 1 << 26 };

/* How many particles a map for that accuracy would be made of, as the few of this one tell, which
 * was not read; *pilots (may be NULL): how many more would find its cells. */
int64_t illumination_map_calls_for(const illumination_map *m, double accuracy, int64_t *pilots);

/* How far off all light that it holds may be, as its sets tell: half of the 95 % interval,
 * relative. It is in all results alike. */
double illumination_map_noise(const illumination_map *m);

/* To a file, and back. A file holds the cells, values of each group undimmed, and a fingerprint of
 * all of the scene that they depend on (geometry, materials, lights but for their dimming, seed and
 * particles): read() returns NULL without an error where there is no such file or it is of another
 * scene (*why says in what; else NULL), and NULL with *err where it is damaged. */
bool illumination_map_write(const char *path, const illumination_map *m, lux_error *err);
const illumination_map *illumination_map_read(arena *a, const char *path, const scene *s,
                                              const map_options *o, const char **why,
                                              lux_error *err);

#endif
