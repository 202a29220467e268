/* sky/clear_sky.c -- how bright sun and sky are where nobody measured it.
 *
 * Clear skies, of Linke's turbidity T: the irradiances of the European Solar Radiation Atlas
 * (Rigollier, Bauer and Wald, Solar Energy 68(1), 2000),
 *
 *     m     = (p / p0) / (sin h + 0.50572 (h + 6.07995)^-1.6364)         Kasten and Young 1989, h
 * in deg E_sun = E0 exp(-0.8662 T m delta(m))                              square to the beam 1 /
 * delta = 6.6296 + 1.7513 m - 0.1202 m^2 + 0.0065 m^3 - 0.00013 m^4,  m <= 20    Kasten 1996 = 10.4
 * + 0.718 m                                              beyond E_sky = E0 Trd(T) (A0 + A1 sin h +
 * A2 sin^2 h)                    on level ground
 *
 * with p / p0 = exp(-altitude / 8434.5 m); for E_sky, T p / p0 stands for T (Geiger et al. 2002),
 * at most 12, where the fit of the Atlas turns over. E0 is 1367 W/m^2 at 1 au. They are turned into
 * light by the efficacies of Perez et al. 1990 for clear skies (their eighth bin, 2 cm of water),
 * which are smooth in elevation: the sun's falls as it sets and reddens.
 *
 * Other skies, on level ground (IESNA Lighting Handbook, 9th ed., 2000, chapter 8; RP-21):
 *
 *     overcast (types 1 to 5, uniform, traditional)   300 + 21,000 sin h lx
 *     partly cloudy (types 6 to 10)                   300 + 45,000 sin h lx
 *
 * None of these is 0 on the horizon: in the last degree above it all fall to 0 evenly.
 */
#include "sky/sky.h"

#include <math.h>

#define SOLAR_CONSTANT 1367.0 /* W/m^2 */

static double radians(double deg) { return deg * (M_PI / 180.0); }

/* 0 on the horizon and below it, 1 from a degree on */
static double risen(double elevation_deg) { return fmin(fmax(elevation_deg, 0.0), 1.0); }

static double pressure_share(double altitude_m) { return exp(-altitude_m / 8434.5); }

/* Relative, at the sea */
static double air_mass(double elevation_deg)
{
    return 1.0 / (sin(radians(elevation_deg)) + 0.50572 * pow(elevation_deg + 6.07995, -1.6364));
}

/* Kasten's delta. Where his two forms meet they differ by 6e-4: the larger joins them. */
static double rayleigh_depth(double m)
{
    double beyond = 10.4 + 0.718 * m;
    double within = 6.6296 + m * (1.7513 + m * (-0.1202 + m * (0.0065 - 0.00013 * m)));
    return 1.0 / (m <= 20.0 ? within : fmax(within, beyond));
}

/* W/m^2 on level ground, at 1 au */
static double sky_irradiance(double elevation_deg, double turbidity)
{
    double t     = turbidity;
    double s     = sin(radians(elevation_deg));
    double trd   = -1.5843e-2 + t * (3.0543e-2 + t * 3.797e-4);
    double a0    = 2.6463e-1 + t * (-6.1581e-2 + t * 3.1408e-3);
    double a1    = 2.0402 + t * (1.8945e-2 - t * 1.1161e-2);
    double a2    = -1.3025 + t * (3.9231e-2 + t * 8.5079e-3);
    double least = fmax(a0, 2e-3 / trd);
    return SOLAR_CONSTANT * trd * (least + s * (a1 + s * a2));
}

/* The turbidity that the Atlas takes for the sky at that altitude */
static double sky_turbidity(double altitude_m, double turbidity)
{
    return fmin(fmax(turbidity * pressure_share(altitude_m), 1.0), 12.0);
}

static bool is_known(double elevation_deg, double altitude_m, double turbidity)
{
    return elevation_deg > 0.0 && elevation_deg <= 90.0 && isfinite(altitude_m) &&
           turbidity >= 1.0 && turbidity <= 20.0;
}

/* delta of Perez, of such a sky */
static double brightness(double elevation_deg, double irradiance)
{
    return fmin(air_mass(elevation_deg) * irradiance / SOLAR_CONSTANT, 0.6);
}

double sky_sun_lx(double sun_elevation_deg, double altitude_m, double turbidity, double distance_au)
{
    if (!is_known(sun_elevation_deg, altitude_m, turbidity) || !(distance_au > 0.0))
        return 0.0;
    double h     = sun_elevation_deg;
    double m     = air_mass(h) * pressure_share(altitude_m);
    double beam  = SOLAR_CONSTANT * exp(-0.8662 * turbidity * m * rayleigh_depth(m));
    double delta = brightness(h, sky_irradiance(h, sky_turbidity(altitude_m, turbidity)));

    double zenith   = radians(90.0 - h);
    double efficacy = 101.18 + 1.58 * 2.0 - 1.10 * exp(5.73 * zenith - 5.0) - 8.29 * delta;
    return risen(h) * efficacy * beam / (distance_au * distance_au);
}

static bool is_clear(int cie_type) { return cie_type >= 11 && cie_type <= 15; }
static bool is_partly_cloudy(int cie_type) { return cie_type >= 6 && cie_type <= 10; }

double sky_diffuse_lx(int cie_type, double sun_elevation_deg, double altitude_m, double turbidity)
{
    if (!is_known(sun_elevation_deg, altitude_m, turbidity))
        return 0.0;
    double h = sun_elevation_deg, sin_h = sin(radians(h));
    if (!is_clear(cie_type))
        return risen(h) * (300.0 + (is_partly_cloudy(cie_type) ? 45000.0 : 21000.0) * sin_h);

    double diffuse  = sky_irradiance(h, sky_turbidity(altitude_m, turbidity));
    double efficacy = 152.23 + 0.35 * 2.0 - 45.27 * sin_h - 7.98 * log(brightness(h, diffuse));
    return risen(h) * efficacy * diffuse;
}

const char *sky_sun_formula(void)
{
    return "ESRA 2000 (Kasten 1996), luminous efficacy of Perez 1990";
}

const char *sky_diffuse_formula(int cie_type)
{
    return is_clear(cie_type)           ? "ESRA 2000, luminous efficacy of Perez 1990"
           : is_partly_cloudy(cie_type) ? "IESNA 2000, partly cloudy: 300 + 45000 sin h lx"
                                        : "IESNA 2000, overcast: 300 + 21000 sin h lx";
}
