/* materials/brdf_bands.h -- what bands of wavelengths are in three channels. */
#ifndef MATERIALS_BRDF_BANDS_H
#define MATERIALS_BRDF_BANDS_H

/* What each of `count` bands at ascending wavelengths, nm, weighs in linear Rec. 709 RGB under D65;
 * the weights of a channel add up to 1, some may be below 0. */
void bands_to_rgb(const double *nm, int count, double (*weights)[3]);

#endif
