/* sim/daylight_write.h -- daylight studies as files: tables (CSV) and pictures (EXR).
 *
 * Places to 12 digits, light to 9. What an interrupted run left out is said in a last line
 * "# partial: ..." of a table and by the attribute lux4:partial of a picture.
 */
#ifndef SIM_DAYLIGHT_WRITE_H
#define SIM_DAYLIGHT_WRITE_H

#include "sim/daylight.h"
#include "sim/daylight_factor.h"

/* A row a sensor and moment, moment by moment: time,x,y,z,nx,ny,nz,illuminance_lx,direct_lx,
 * indirect_lx,half_width_lx. */
bool daylight_write_csv(const char *path, const daylight_series *s, lux_error *err);

/* A part a moment, named by its time ("undated" where it has none): Y, direct.Y, indirect.Y and
 * halfWidth.Y in lux, sun.Y in [0, 1] where there may be sun; the top row has the largest v, cells
 * without a sensor are 0. */
bool daylight_write_exr(const char *path, const study *from, const daylight_series *s,
                        lux_error *err);

/* A row a sensor: x,y,z,nx,ny,nz and sun_hours, or of a series over several dates
 * sun_hours_per_day, the mean. Only where s->sun_hours is there. */
bool daylight_write_sun(const char *path, const daylight_series *s, lux_error *err);

/* A row a sensor: x,y,z,nx,ny,nz,daylight_factor_percent,sky_percent,external_percent,
 * internal_percent,half_width_percent; and the same as channels Y, sky.Y, external.Y, internal.Y
 * and halfWidth.Y. */
bool daylight_factor_write_csv(const char *path, const daylight_factor *f, lux_error *err);
bool daylight_factor_write_exr(const char *path, const study *from, const daylight_factor *f,
                               lux_error *err);

#endif
