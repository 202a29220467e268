/* sim/camera.h -- from places in a picture to rays of the scene. */
#ifndef SIM_CAMERA_H
#define SIM_CAMERA_H

#include "sim/scene.h"

typedef struct camera {
    int width, height; /* pixels */
    bool perspective;
    vec3 eye;                /* m, in the scene's frame */
    vec3 right, up, forward; /* perspective: to the edges of the picture at unit distance;
                                orthographic: m, half the picture; forward is unit */
    float spread;            /* rad: of a pixel at the middle of the picture; orthographic: 0 */
} camera;

/* The camera of a view: its own eye and target, or the glTF camera that it names. False, with
 * *err, if there is no such camera or it sees nothing (eye and target are one). */
bool camera_of_view(const scene *s, const study_view *v, camera *out, lux_error *err);

/* The ray through (x, y) in pixels, from the top left corner of the picture. */
vray camera_ray(const camera *c, vfloat x, vfloat y);

#endif
