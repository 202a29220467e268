/* sim/light_maps.h -- the illumination maps that a run takes light from, made or read for it. */
#ifndef SIM_LIGHT_MAPS_H
#define SIM_LIGHT_MAPS_H

#include "sim/grid.h"
#include "sim/illumination_map.h"

typedef struct light_maps {
    const illumination_map *indirect; /* NULL: interreflection is followed by paths */
    const illumination_map *focused;  /* NULL: nothing is focused, or nothing goes on */
    int64_t rays;
    double left_out_lm; /* lm: of light that maps are to find, what they do not hold; */
    bool matters;       /* enough of all to be seen in results */
} light_maps;

/* For a run with these options; `accuracy` is what it aims at, sensors (NULL: none) where focused
 * light is asked for in the air. Reads or writes the options' file of maps. */
bool light_maps_make(arena *a, const scene *s, const run_options *o, double accuracy,
                     const map_sensors *sensors, light_maps *out, lux_error *err);

/* The map of focused light alone, anew, by so many particles. */
bool light_maps_focused(arena *a, const scene *s, const run_options *o, double accuracy,
                        const map_sensors *sensors, int64_t particles, light_maps *out,
                        lux_error *err);

/* The map of interreflected light alone, for several runs (run_options.indirect). A file of maps
 * that is replaced is told in n, which may be NULL. */
bool light_maps_indirect(arena *a, const scene *s, const run_options *o, double accuracy,
                         const illumination_map **out, notices *n, lux_error *err);

#endif
