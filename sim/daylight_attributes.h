/* sim/daylight_attributes.h -- where and when a picture is of, as OpenEXR names it. */
#ifndef SIM_DAYLIGHT_ATTRIBUTES_H
#define SIM_DAYLIGHT_ATTRIBUTES_H

#include "core/image.h"
#include "sim/moments.h"

enum { DAYLIGHT_ATTRIBUTES = 5, CAP_DATE = 40 };

/* Of a study with a site: longitude, latitude (degrees, east and north positive), altitude (m); of
 * a moment that is known: capDate ("2026:06:21 10:00:00", as clocks show it there) and utcOffset
 * (s: UTC = local + utcOffset). How many of those there are; date holds the text of one. */
int daylight_attributes(image_attribute to[DAYLIGHT_ATTRIBUTES], char date[CAP_DATE],
                        const study *s, const moment *m);

#endif
