/* sky/sky.h -- light from all around that comes from infinitely far: skies, ground, panoramas.
 *
 * A sky is a radiance by direction, W/(sr m^2), in the scene's frame (z up; directions leave the
 * point that is lit). Skies are immutable once made: any thread may ask, nothing fails. Lanes
 * outside `active` come back zero. The sun is none of a sky's: it is a lamp (sun_light.h).
 *
 * Makers take irradiances and radiances as luminance in W/m^2 and W/(sr m^2) (lx and cd/m^2 by 179,
 * core/color.h); check what they are given, and return a sky that lives as long as a does, or NULL
 * with *err.
 */
#ifndef SKY_SKY_H
#define SKY_SKY_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"

typedef struct sky sky;

typedef struct sky_type {
    const char *name;
    /* Finite and >= 0 in every direction. */
    vrgb (*radiance)(const sky *self, const vvec3 *wi, vmask active);
} sky_type;

/* The first member of every sky. */
struct sky {
    const sky_type *type;
    vec3 horizontal;   /* W/m^2, on level ground that sees all of it */
    bool below;        /* it gives light from below the horizon, too; else 0 comes from there */
    int columns, rows; /* of a table that tells its brightness well: longitude, latitude (all
                          around, pole to pole); 0: any will do */
};

static inline vrgb sky_radiance(const sky *s, const vvec3 *wi, vmask active)
{
    return s->type->radiance(s, wi, active);
}

/* The CIE standard general sky (ISO 15469:2004 / CIE S 011), types 1 to 15; 16: the traditional
 * overcast sky (1 + 2 sin h) / 3, Moon and Spencer 1942; 0: uniform. */
enum { SKY_UNIFORM = 0, SKY_TRADITIONAL = 16 };
typedef struct cie_desc {
    int type;
    vec3 to_sun;       /* unit, z >= 0; of types that do not look at the sun: anything */
    double horizontal; /* W/m^2 as luminance, >= 0: what `horizontal` of the sky comes to */
    vec3 color;        /* of luminance 1: {1,1,1} for white */
} cie_desc;
const sky *sky_cie(arena *a, const cie_desc *d, lux_error *err);

/* Luminance at the zenith over the horizontal illuminance, 1/sr, of such a sky: 1 / (E_hz / L_z).
 */
double sky_cie_zenith(int type, double sun_elevation_deg);

/* The all-weather sky of Perez, Seals and Michalsky (Solar Energy 50(3), 1993). */
typedef struct perez_desc {
    vec3 to_sun;               /* unit, z > 0 */
    double direct_normal;      /* W/m^2 of the sun's broadband radiation, square to it, >= 0 */
    double diffuse_horizontal; /* W/m^2 of broadband radiation, > 0 */
    double dew_point_c;        /* of the air at the ground, for its water; NAN: 11 C */
    double distance_au;        /* of the sun: 1 +- 0.017 */
    double altitude_m;         /* not looked at: the paper's mass of air is that at the sea */
    vec3 color;
} perez_desc;
/* What it comes to by the luminous efficacies of Perez, Ineichen, Seals, Michalsky and Stewart
 * (Solar Energy 44(5), 1990). */
typedef struct perez_figures {
    double clearness, brightness; /* epsilon >= 1, delta */
    double diffuse_lx, direct_normal_lx;
    bool clamped; /* outside of what the model was made from: taken at its border */
} perez_figures;
const sky *sky_perez(arena *a, const perez_desc *d, perez_figures *out, lux_error *err);

/* A uniform radiance from all directions below the horizon: ground that nothing shadows. */
const sky *sky_ground(arena *a, vec3 radiance, lux_error *err);

/* ---- how bright, where nobody says (clear_sky.c) --------------------------------------------- */

/* lx, of the sun square to its beam, and of the sky on level ground, by named published formulae;
 * 0 where the sun is below the horizon. turbidity: Linke's, [1, 20]. */
double sky_sun_lx(double sun_elevation_deg, double altitude_m, double turbidity,
                  double distance_au);
double sky_diffuse_lx(int cie_type, double sun_elevation_deg, double altitude_m, double turbidity);
/* What they are called, for reports: "Kasten 1996 ..." */
const char *sky_sun_formula(void);
const char *sky_diffuse_formula(int cie_type);

#endif
