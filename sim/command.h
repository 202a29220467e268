/* sim/command.h -- what the commands of the program share: options, messages, exit codes. */
#ifndef SIM_COMMAND_H
#define SIM_COMMAND_H

#include "core/notice.h"
#include "sim/grid.h"
#include "sim/output.h"
#include "sim/plan.h"
#include "sim/terminal.h"

#include <stdio.h>

typedef enum exit_code {
    EXIT_DONE        = 0,
    EXIT_RUNTIME     = 1, /* disk full, no memory, lost file */
    EXIT_INPUT       = 2, /* bad usage or input */
    EXIT_INACCURATE  = 3, /* accuracy not reached in the time given */
    EXIT_INTERRUPTED = 130,
} exit_code;

/* Of lux4 sun: where and when. */
typedef struct sun_line {
    const char *place, *zone, *time;                /* NULL */
    double altitude_m, pressure_hpa, temperature_c; /* NAN */
    double turbidity;                               /* NAN */
    bool day, year;
} sun_line;

/* What the words of a command line came to. */
typedef struct command_line {
    const char *const *files; /* what is not an option, in order */
    int file_count;
    output_place place; /* -o (of mix: the file), --overwrite */
    int threads;        /* 0: as many as processors */
    uint32_t seed;      /* 1 */
    bool quiet, json, direct_only, half, groups, schedule;
    double accuracy;    /* 0.02 for 2%; NAN */
    double seconds;     /* NAN */
    int width;          /* of sky's panorama; 0: the default */
    double exposure_ev; /* 0: as the picture's average asks */
    transport transport;
    const char *maps;   /* file of --save-maps; NULL */
    uint32_t off, only; /* bits 1 << effect, of --no and --only */
    bool has_only;
    const char *plot, *write, *swatch; /* NULL */
    const char *variant;               /* of the study; NULL */
    sun_line sun;
    bool factor;
    const char *date, *from, *to; /* as written; NULL */
    double step_min;              /* NAN */
} command_line;

/* What a command runs with. */
typedef struct command_context {
    const command_line *line;
    arena *a;
    notices *notices;
    terminal *terminal; /* its line is to be cleared before something is printed */
    progress *progress;
    const volatile bool *stop; /* true once the user pressed Ctrl-C */
    double begun;              /* s, on clock_seconds() */
} command_context;

/* One row of the table of commands: sim/main.c. */
typedef struct command {
    const char *name;
    const char *files;   /* "STUDY.yaml", for the usage line */
    const char *summary; /* one line */
    const char *help;    /* what `lux4 help NAME` says besides usage and options */
    const char *output;  /* what -o takes, and what for, if it is not the usual folder; NULL */
    const char *output_help;
    const char *options; /* the long names of those that count here, each between blanks */
    int (*run)(const command_context *c,
               lux_error *err); /* an exit code; if not 0, *err may say why */
} command;

extern const command command_grid, command_render, command_check, command_photometry,
    command_material, command_mix, command_sun, command_sky, command_daylight, command_plan,
    command_cost;

/* Reads the words behind the command's name. False, with *err, for what cannot be. */
bool command_line_read(arena *a, const command *c, int count, char *const *words, command_line *out,
                       lux_error *err);

/* The options that count for a command, one a line, as help shows them. */
void command_options_print(FILE *to, const command *c);

/* Opens the one study that the line names; and builds its scene. NULL, with *err. */
const study *command_study(const command_context *c, lux_error *err);
const scene *command_scene(const command_context *c, lux_error *err);

/* The same, planned for its grids or its views, and built without what the plan leaves out. */
const scene *command_planned_scene(const command_context *c, bool views, plan *out, lux_error *err);
const scene *command_planned(const command_context *c, const study *s, const scene_options *o,
                             bool views, plan *out, lux_error *err);
plan_options command_plan_options(const command_context *c, bool views);

/* Threads to run on; and the options of a run. */
int command_threads(const command_context *c);
/* `left`: grids or views that are still to run, this one included, among which what is left of
 * --time is shared. */
run_options command_run_options(const command_context *c, int left);

/* Whether --save-maps goes with --transport. False, with *err. */
bool command_transport_fits(const command_context *c, lux_error *err);

/* Of TRANSPORT_MAPS: the map that several runs share, made (or read from the file of --save-maps)
 * once; it lives as long as the command. False, with *err. */
bool command_maps(const command_context *c, const scene *s, int runs, run_options *o,
                  const struct illumination_map **made, lux_error *err);

/* What a table says below a grid of its sensors, of accuracy and of intervals. */
void command_grid_remarks(const grid_result *r, run_end end, int missed, double asked,
                          const char *left_to_chance);

/* The exit code for why a run ended, with *err saying it of `what` ("grid desk"). */
int command_end(run_end end, const char *what, const char *name, lux_error *err);

/* What would stop work on all grids in its midst, found before it begins and before a folder is
 * made: sensors that cannot be, results GRID + extension that may not be written. */
bool command_check_grids(const scene *s, const output_place *o, const char *const *extensions,
                         int count, lux_error *err);

/* EXIT_INPUT or EXIT_RUNTIME (or EXIT_INTERRUPTED), by the kind of error and by whether the input
 * was being read. */
int exit_code_of(const lux_error *err, bool reading);

/* A text in a column of that many characters, of which `most` are shown; what could steer a
 * terminal becomes `?`. */
void print_words(FILE *to, const char *text, int width, int most);

/* How wide a column of names must be for this one, too: 16 characters at least, and 40 at most. */
int print_width(const char *text, int so_far);

/* A string as JSON, quotes included. */
void json_string(FILE *to, const char *text);

/* A number as JSON: null if it is not finite. */
void json_number(FILE *to, double value);

/* One more member of an object on stdout, its comma before it. */
void json_field(const char *name, double value);
void json_field_text(const char *name, const char *value);

#endif
