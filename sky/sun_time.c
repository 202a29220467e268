/* sky/sun_time.c -- see sun_time.h.
 *
 * From 1972 terrestrial time is UTC + the leap seconds so far (eraDat) + 10 s + 32.184 s; years to
 * come keep what is known last, as JPL's Horizons has it. Should Earth slow down as Espenak and
 * Meeus expected (203 s by 2100, where it is 69 s now), the sun will be 0.0015 degrees from where
 * this puts it. Before 1972 universal time is what clocks kept, and terrestrial time is ahead of it
 * by delta T as observed: F. Espenak, J. Meeus, Five Millennium Canon of Solar Eclipses,
 * NASA/TP-2006-214141, which fits a polynomial to each span of years.
 */
#include "sky/sun_time.h"

#include "sky/clock.h"

#include <erfa.h>
#include <erfam.h>
#include <math.h>

static const double START = 946684800.0; /* 2000-01-01 */

static double delta_t_before_1972(double year)
{
    double t;
    if (year < 1920.0) {
        t = year - 1900.0;
        return -2.79 + t * (1.494119 + t * (-0.0598939 + t * (0.0061966 - t * 0.000197)));
    }
    if (year < 1941.0) {
        t = year - 1920.0;
        return 21.20 + t * (0.84493 + t * (-0.076100 + t * 0.0020936));
    }
    if (year < 1961.0) {
        t = year - 1950.0;
        return 29.07 + t * (0.407 + t * (-1.0 / 233.0 + t / 2547.0));
    }
    t = year - 1975.0;
    return 45.45 + t * (1.067 + t * (-1.0 / 260.0 - t / 718.0));
}

double sun_universal_days(double moment) { return (moment - START) / ERFA_DAYSEC; }

double sun_terrestrial_days(double moment)
{
    civil_time t = clock_local(NULL, moment);
    double ahead = delta_t_before_1972(2000.0 + sun_universal_days(moment) / 365.25);
    if (t.year >= 1972) {
        double leaps = 37.0; /* of 2017 */
        eraDat(t.year, t.month, t.day, 0.0, &leaps);
        ahead = leaps + 32.184;
    }
    return (moment - START + ahead) / ERFA_DAYSEC;
}
