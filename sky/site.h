/* sky/site.h -- where on Earth the building stands. */
#ifndef SKY_SITE_H
#define SKY_SITE_H

#include "core/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct site {
    double latitude_deg;  /* [-90, 90], north positive, WGS84 */
    double longitude_deg; /* [-180, 180], east positive, WGS84 */
    double altitude_m;    /* above the ellipsoid, which is taken for the sea; [-500, 9000] */
} site;

/* The place that a text names in any notation GeographicLib reads, at altitude 0: decimal degrees
 * ("55.7558N 37.6173E", "55.7558 37.6173": latitude first), degrees, minutes and seconds
 * ("55d45'21\"N 37d37'2\"E", "55:45:21N 37:37:02E"), UTM or UPS ("37N 413000 6180000"), MGRS
 * ("37UDB1300080000"). False, with *err (what was found, what is expected), for all else. */
bool site_read(site *out, const char *text, lux_error *err);

#ifdef __cplusplus
}
#endif

#endif
