/* sim/lux4.h -- liblux4: how much light arrives where, for programs.
 *
 *     lux4_error err = { 0 };
 *     lux4 *study    = lux4_open("office.yaml", &err);
 *     lux4_grid *g   = study ? lux4_run_grid(study, 0, NULL, &err) : NULL;
 *     if (g)
 *         printf("%s: %.1f lx on average\n", g->name, g->average_lx);
 *     else
 *         fprintf(stderr, "%s\n", err.text);
 *     lux4_grid_free(g);
 *     lux4_close(study);
 *
 * Link with what `pkg-config --libs lux4` says. Nothing here prints or ends the program. A study is
 * used by one thread at a time (it runs on as many as the options say); different studies are
 * independent. Numbers are in the units that their names end in; places in metres, x east,
 * y north, z up. Sun and sky of a study light its grids and views as lamps do, at the one moment of
 * its `when`; a series of moments is an error here.
 */
#ifndef LUX4_H
#define LUX4_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lux4_code {
    LUX4_DONE,
    LUX4_RUNTIME, /* no memory, a lost file */
    LUX4_INPUT,   /* the study, or a file that it names, is wrong or asks for what is not built */
    LUX4_INTERRUPTED, /* *stop became true before there was a result */
} lux4_code;

typedef struct lux4_error {
    char text[480]; /* one line: file, line and column, what is wrong, what was expected */
    lux4_code code;
} lux4_error;

/* "0.1.0" */
const char *lux4_version(void);

typedef struct lux4 lux4;

/* Reads the study at path and all that it names. NULL, with *err. */
lux4 *lux4_open(const char *path, lux4_error *err);

/* The same with that one of its variants merged over it; NULL: as it is. */
lux4 *lux4_open_variant(const char *path, const char *variant, lux4_error *err);

void lux4_close(lux4 *study); /* NULL: nothing */

/* What the user should know of the study though nothing failed; index < lux4_warning_count(). */
int lux4_warning_count(const lux4 *study);
const char *lux4_warning(const lux4 *study, int index);

int lux4_grid_count(const lux4 *study);
const char *lux4_grid_name(const lux4 *study, int index);
int lux4_view_count(const lux4 *study);
const char *lux4_view_name(const lux4 *study, int index);

/* How to run; zeros (or NULL for all of it) are the defaults. */
typedef struct lux4_options {
    double accuracy;  /* 0.02 for 2 %; 0: the study's or else 2 % for grids, 10 % for views */
    double seconds;   /* stop after that time with what there is; 0: no limit */
    int threads;      /* 0: as many as there are processors */
    uint32_t seed;    /* another seed, another set of random samples; 0: 1 */
    bool direct_only; /* leave interreflection out */
    const volatile bool *stop; /* NULL, or the run ends early once it is true */

    /* NULL, or called by one thread at a time: share done in [0, 1], accuracy so far or NAN. */
    void (*progress)(void *context, const char *label, double share, double accuracy_percent);
    void *context;
} lux4_options;

/* Sensors in rows along u, or in the order of their file; arrays of sensor_count numbers. */
typedef struct lux4_grid {
    const char *name;
    const char *quantity; /* "illuminance", "cylindrical illuminance", ... */
    int sensor_count, columns, rows;
    int left_out;                                          /* cells whose sensor would lie inside
                                                              furniture: columns * rows less those */
    double *x, *y, *z;                                     /* m */
    double *normal_x, *normal_y, *normal_z;                /* unit */
    double *illuminance_lx, *direct_lx, *indirect_lx;      /* maintained */
    double *half_width_lx;                                 /* of the 95 % confidence interval */
    double average_lx, minimum_lx, maximum_lx, uniformity; /* uniformity: minimum / average */
    int missed;                 /* sensors that are not as accurate as asked for */
    double accuracy_reached;    /* that every sensor has, relative */
    bool enough;                /* the accuracy asked for is reached */
    bool interrupted;           /* by *stop; the numbers are complete, and less accurate */
    const char *left_to_chance; /* why the intervals are not valid; NULL: they are */
    double seconds;
    int64_t rays;
} lux4_grid;

lux4_grid *lux4_run_grid(lux4 *study, int index, const lux4_options *options, lux4_error *err);
void lux4_grid_free(lux4_grid *grid); /* NULL: nothing */

/* Pixels row by row, the top row first; arrays of width * height numbers. */
typedef struct lux4_view {
    const char *name;
    int width, height;
    float *red, *green, *blue; /* radiance, W/(sr m^2); 179 times their luminance: cd/m^2 */
    float *illuminance_lx;     /* on the surface seen */
    float *half_width_cd_m2;   /* of the luminance's 95 % confidence interval */
    float *distance_m;         /* along the ray; 0: nothing is seen */
    float *normal_x, *normal_y, *normal_z; /* unit, toward the eye; 0: nothing is seen */
    float *albedo_red, *albedo_green, *albedo_blue;
    double accuracy_reached;    /* that 98 % of the pixels have, relative */
    bool enough, interrupted;   /* the accuracy asked for is reached; by *stop */
    const char *left_to_chance; /* why the intervals are not valid; NULL: they are */
    double seconds;
    int64_t rays;
} lux4_view;

lux4_view *lux4_run_view(lux4 *study, int index, const lux4_options *options, lux4_error *err);
void lux4_view_free(lux4_view *view); /* NULL: nothing */

#ifdef __cplusplus
}
#endif

#endif
