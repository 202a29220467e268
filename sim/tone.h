/* sim/tone.h -- radiances made a picture for the eye: exposure, compression, sRGB.
 *
 * For previews alone: nothing that is written as radiance or luminance passes through here.
 */
#ifndef SIM_TONE_H
#define SIM_TONE_H

#include "core/arena.h"
#include "core/error.h"

#include <stdint.h>

/* Zero in a field means what stands beside it. */
typedef struct tone_options {
    double exposure_ev; /* 0: stops, on top of the exposure that is found */
    double key;         /* 0.18: what the log-average becomes, in (0, 1) */
} tone_options;

/* The global operator of Reinhard, Stark, Shirley and Ferwerda, "Photographic tone reproduction for
 * digital images", SIGGRAPH 2002, equations 1, 2 and 4:
 *
 *     L  = key 2^ev Lw / Lavg                    Lw: luminance, Lavg: its log-average
 *     Ld = L (1 + L / Lwhite^2) / (1 + L)
 *
 * Lavg and Lwhite come from a small copy of the picture, so that single bright pixels do not darken
 * the rest; cells without any light (what lies beside the model) do not count. Lwhite is the
 * luminance that 0.5 % of the cells exceed, at least 1. The colour is kept until a channel is full.
 *
 * r, g, b: width * height radiances each; below zero counts as zero; NaN and infinite are an error.
 * rgb: width * height * 3 bytes of sRGB. o may be NULL. A black picture stays black. */
bool tone_photographic(const float *r, const float *g, const float *b, int width, int height,
                       const tone_options *o, uint8_t *rgb, arena *scratch, lux_error *err);

/* IEC 61966-2-1 (sRGB) in 8 bits: least[k] is the least linear value whose code is k. */
typedef struct srgb_table {
    double least[256];
} srgb_table;

srgb_table srgb_table_make(void);

/* The code nearest to a linear value; below 0 is 0, above 1 is 255. */
uint8_t srgb_code(const srgb_table *t, double linear);

#endif
