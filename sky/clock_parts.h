/* sky/clock_parts.h -- what a zone is, for the files behind clock.h. */
#ifndef SKY_CLOCK_PARTS_H
#define SKY_CLOCK_PARTS_H

#include "sky/clock.h"

typedef struct clock_change {
    double moment; /* from then on; of the first: -infinity */
    int offset;    /* s east of UTC */
} clock_change;

/* Nothing of ICU is kept: what it opens belongs to one thread and must be closed. */
struct clock_zone {
    const clock_change *change; /* ascending */
    int count;                  /* >= 1 */
};

/* "Z", "+03", "+0300", "+03:00", "+02:30:17" at *p, behind which *p then stands; less than 16 h. */
bool clock_read_offset(const char **p, int *offset);

#endif
