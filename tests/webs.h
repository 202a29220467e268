/* tests/webs.h -- goniodiagrams of known form, and the means of what luminaires made of them give.
 */
#ifndef TESTS_WEBS_H
#define TESTS_WEBS_H

#include "lights/light.h"
#include "lights/photometry.h"

typedef double web_form(double plane, double gamma); /* rad -> cd */

double web_isotropic(double plane, double gamma);  /* 1 */
double web_lambertian(double plane, double gamma); /* cos gamma, none above the horizon */
double web_both_sides(double plane, double gamma); /* |cos gamma| */
double web_spot(double plane, double gamma);       /* cos^200 */
double web_batwing(double plane, double gamma);    /* most at about 40 deg */
double web_asymmetric(double plane, double gamma); /* a wall washer */
double web_sine(double plane, double gamma);       /* of the angle to C0: a line's along it */

/* A web of so many planes and a ring every `step_deg` from 0 to 180, in a. */
photometry *web_make(arena *a, web_form *form, int planes, double step_deg);

/* The mean of e (2nd channel) max(0, n . wi) over 2^log2_count samples at p; *deviation of one
 * sample, may be NULL. */
double mean_irradiance(const light *l, vec3 p, vec3 n, int log2_count, double *deviation);

#endif
