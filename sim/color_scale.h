/* sim/color_scale.h -- false colours: values in bands, each with a colour that prints in grey, too.
 *
 * Lightness grows with the value in every ramp, so that a copy in black and white keeps the order.
 */
#ifndef SIM_COLOR_SCALE_H
#define SIM_COLOR_SCALE_H

#include <stdint.h>

typedef enum color_ramp {
    RAMP_LIGHT, /* indigo, blue, green, yellow: light */
    RAMP_HOURS, /* violet, red, orange, sand: hours of sun */
} color_ramp;

/* Band i holds limit[i] <= x < limit[i + 1]; the first what is less, the last what is more, too. */
enum { MOST_BANDS = 10 };
typedef struct color_scale {
    color_ramp ramp;
    int bands;                    /* >= 1 */
    double limit[MOST_BANDS + 1]; /* ascending */
} color_scale;

/* For values from `least` (>= 0) to `most`: limits in the series 1, 2, 5, the lowest 0 where the
 * bands do not reach down to `least`. */
color_scale color_scale_125(color_ramp ramp, double least, double most);

/* From 0 to `most`: equal steps of 1, 2, 2.5 or 5 times a power of ten. */
color_scale color_scale_even(color_ramp ramp, double most);

int color_scale_band(const color_scale *s, double x);

/* sRGB. */
void color_scale_color(const color_scale *s, int band, uint8_t rgb[3]);

#endif
