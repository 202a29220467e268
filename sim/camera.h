/* sim/camera.h -- from places in a picture to rays of the scene. */
#ifndef SIM_CAMERA_H
#define SIM_CAMERA_H

#include "sim/scene.h"

typedef struct camera {
    int width, height; /* pixels */
    study_projection projection;
    vec3 eye;                /* m, in the scene's frame */
    vec3 right, up, forward; /* perspective: to the edges of the picture at unit distance;
                                orthographic: m, half the picture; else unit; forward is unit */
    float spread;            /* rad: of a pixel at the middle of the picture; orthographic: 0 */
} camera;

/* The camera of a view: its own eye and target, or the glTF camera that it names. False, with
 * *err, if there is no such camera or it sees nothing (eye and target are one). */
bool camera_of_view(const scene *s, const study_view *v, camera *out, lux_error *err);

/* The ray through (x, y) in pixels, from the top left corner of the picture. A fisheye's distance
 * from the middle of the picture goes with the angle to `forward`, 90 degrees at the edge of the
 * largest circle in the picture. A panorama's columns go around `up`, the middle one along
 * `forward`, angles clockwise seen from above growing to the right; its rows from `up` to below. */
vray camera_ray(const camera *c, vfloat x, vfloat y);

/* The lanes for which there is such a ray: all, but for those outside of a fisheye's circle. */
vmask camera_sees(const camera *c, vfloat x, vfloat y);

#endif
