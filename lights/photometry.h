/* lights/photometry.h -- the light of a luminaire by direction, as a laboratory measured it.
 *
 * Read from LM-63 (.ies) or EULUMDAT (.ldt) files: the contents decide, not the name.
 */
#ifndef LIGHTS_PHOTOMETRY_H
#define LIGHTS_PHOTOMETRY_H

#include "core/arena.h"
#include "core/error.h"
#include "core/notice.h"

/* A web in type C: candela[plane * gamma_count + ring], linear between the angles given; planes
 * ascend through [0, 360) and wrap around; below the first and above the last gamma is darkness.
 * Symmetry is unfolded: one plane (rotational) or planes all the way around. */
typedef struct photometry {
    int plane_count, gamma_count;
    const float *plane_deg; /* [0, 360), ascending, C0 along the axes of interface.md */
    const float *gamma_deg; /* [0, 180], ascending, 0 along the aim */
    const float *candela;   /* cd, >= 0, all factors of the file applied */
    double luminaire_lumens; /* lm, the integral of the web */
    double lamp_lumens;      /* lm, as the file says; 0: not said (absolute photometry) */
} photometry;

/* Reads the file at path into a. NULL, with *err naming file, line and what was expected. */
const photometry *photometry_read(arena *a, const char *path, notices *n, lux_error *err);

#endif
