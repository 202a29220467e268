/* tests/shapes.h -- meshes and rays for tests and benchmarks of tracing. */
#ifndef TESTS_SHAPES_H
#define TESTS_SHAPES_H

#include "core/world.h"

/* A mesh that grows; zeros are an empty one. Memory is from the C library: shape_clear. */
typedef struct shape {
    vec3 *positions;
    uint32_t *corners;
    uint32_t position_count, triangle_count, position_room, triangle_room;
} shape;

mesh shape_mesh(const shape *s);
void shape_clear(shape *s);
uint32_t shape_point(shape *s, vec3 p);
void shape_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c);

/* Closed, corners shared, front outside: at `centre`, of radius `radius`. */
void shape_sphere(shape *s, vec3 centre, float radius, int rings);
void shape_torus(shape *s, vec3 centre, float radius, float tube, int rings);
/* Each side a net of cells x cells squares. */
void shape_box(shape *s, vec3 low, vec3 high, int cells);
/* Triangles of about `size` anywhere in [-1, 1]^3 */
void shape_soup(shape *s, int triangles, float size, uint32_t seed);

/* Numbers in [0, 1), the same on every machine. */
float random_unit(uint32_t *state);
vec3 random_direction(uint32_t *state);
vec3 random_point(uint32_t *state);              /* in [-1, 1)^3 */
vec3 random_offset(float size, uint32_t *state); /* anywhere, shorter than size */

/* One lane of a ray. */
void ray_set(vray *r, int lane_number, vec3 origin, vec3 direction, float reach);
/* The nearest hit by testing everything, with the arithmetic of the world's watertight test. */
vhit brute_first(const world_desc *d, const vray *ray, vmask active);

#endif
