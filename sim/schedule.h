/* sim/schedule.h -- the luminaire schedule: what is installed, what it draws and what it gives.
 *
 * The load is the connected one: full watts, whatever lamps are dimmed to. That of a dimmed layout
 * stands beside it, taken as proportional to light:
 *
 *     P   = sum of watts                           [W]
 *     P_d = sum of watts * dimming                 [W]
 *
 *     p = P / A,   p_100 = p / (E / 100)           [W/m^2, W/m^2 per 100 lx]
 *
 * with A the floor of the room, or where a study has none the ground that its model covers (its box
 * in plan), or without a model the grid's own area, and E the grid's average, maintained. Lights
 * without known watts count for no power, and are counted themselves.
 */
#ifndef SIM_SCHEDULE_H
#define SIM_SCHEDULE_H

#include "sim/scene.h"

#include <stdio.h>

/* Lights of one entry of the study, or glTF lights that are the same. */
typedef struct schedule_row {
    const scene_light *first;
    int count;
    double lumens; /* lm each, initial, not dimmed: their mean; INFINITY: far away */
} schedule_row;

typedef struct schedule {
    int row_count;
    schedule_row *rows;   /* in the study's order */
    int count, unrated;   /* lights that are not far away; those of unknown watts among them */
    double lumens;        /* lm of all, initial, not dimmed */
    double watts;         /* W, connected; NAN: of none known */
    double efficacy;      /* lm/W, of those with watts; NAN */
    bool dimmed;          /* some light is */
    double dimmed_lumens; /* lm */
    double dimmed_watts;  /* W; NAN */
    double floor;         /* m^2, of room or model; NAN: there is none */
    bool of_model;        /* its box in plan, for want of a room */
} schedule;

/* The schedule of a scene in a. False, with *err, if memory is out. Where `lumens` scales a file's
 * light, and its watts stay as they are, a notice says so. */
bool schedule_make(arena *a, const scene *s, schedule *out, notices *n, lux_error *err);

/* What a load (W) comes to on a grid. */
typedef struct schedule_load {
    double area;        /* m^2 */
    double average;     /* lx */
    double density;     /* W/m^2 */
    double per_100_lux; /* W/m^2 per 100 lx; NAN for a dark grid */
} schedule_load;

/* False for a grid that no load is related to: it is no horizontal plane of illuminance looking
 * up. average: lx. */
bool schedule_load_of(const schedule *c, double watts, const study_grid *g, double average,
                      schedule_load *out);

/* As a table and as a JSON object; averages[i]: lx, of the study's grid i, NAN if it did not run.
 */
void schedule_print(FILE *to, const scene *s, const schedule *c, const double *averages);
void schedule_print_json(FILE *to, const scene *s, const schedule *c, const double *averages);

#endif
