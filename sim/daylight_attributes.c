/* sim/daylight_attributes.c -- see daylight_attributes.h. */
#include "sim/daylight_attributes.h"

#include <stdio.h>

int daylight_attributes(image_attribute to[DAYLIGHT_ATTRIBUTES], char date[CAP_DATE],
                        const study *s, const moment *m)
{
    int count      = 0;
    const site *at = &s->site.at;
    if (s->site.given) {
        to[count++] =
            (image_attribute){ "longitude", ATTRIBUTE_FLOAT, NULL, (float)at->longitude_deg };
        to[count++] =
            (image_attribute){ "latitude", ATTRIBUTE_FLOAT, NULL, (float)at->latitude_deg };
        to[count++] = (image_attribute){ "altitude", ATTRIBUTE_FLOAT, NULL, (float)at->altitude_m };
    }
    if (!m || isnan(m->at))
        return count;
    const civil_time *t = &m->local;
    snprintf(date, CAP_DATE, "%04d:%02d:%02d %02d:%02d:%02d", t->year, t->month, t->day, t->hour,
             t->minute, (int)t->second);
    to[count++]   = (image_attribute){ "capDate", ATTRIBUTE_STRING, date, 0 };
    double offset = m->at - clock_from_civil(t);
    to[count++]   = (image_attribute){ "utcOffset", ATTRIBUTE_FLOAT, NULL, (float)offset };
    return count;
}
