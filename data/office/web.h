/* data/office/web.h -- the light of the two kinds of luminaire, from closed forms, as files. */
#ifndef OFFICE_WEB_H
#define OFFICE_WEB_H

#include <stdbool.h>
#include <stdio.h>

#define PANEL_LUMENS     5500.0
#define DOWNLIGHT_LUMENS 2000.0

/* cd per lumen of the luminaire, C and gamma in degrees. */
double panel_web(double c_deg, double gamma_deg);
double downlight_web(double gamma_deg);

/* EULUMDAT and LM-63-2002. False: writing failed. */
bool panel_write(FILE *to);
bool downlight_write(FILE *to);

#endif
