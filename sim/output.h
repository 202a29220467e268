/* sim/output.h -- where results go, and which existing files may make room for them.
 *
 * Results go into the folder that the user names, or else into out/ beside the study. A file
 * that is there already is refused, unless the user says --overwrite or the same study made it in
 * its own default folder: every EXR names its study, and a CSV lies beside its EXR.
 */
#ifndef SIM_OUTPUT_H
#define SIM_OUTPUT_H

#include "core/arena.h"
#include "core/error.h"
#include "core/image.h"
#include "sim/daylight_attributes.h"
#include "sim/study.h"

typedef struct output_place {
    const char *folder; /* NULL: the default */
    bool overwrite;
} output_place;

/* FOLDER/NAME.EXT in a. */
char *output_path(arena *a, const study *s, const output_place *o, const char *name,
                  const char *extension, lux_error *err);

/* Makes the folder, and refuses (ERR_ARGUMENT) if NAME with any of the extensions may not be
 * written: it is there and not ours to replace, or it is no regular file. Call it before the
 * work, so that no result is computed that has no place. */
bool output_check(const study *s, const output_place *o, const char *name,
                  const char *const *extensions, int count, lux_error *err);

/* Whether a file may take the name that the user gave it: one that is there is refused without
 * --overwrite. NULL: there is nothing to write. */
bool output_free(const char *path, bool overwrite, lux_error *err);

/* Adds what only some results say to the attributes of an EXR, behind those that have a name: the
 * place on Earth and the moment `m` (NULL: of none), whose text `date` holds; the study's variant;
 * that they are partial. How many there are then. */
enum { MOST_ATTRIBUTES = 24, MOST_OWN_ATTRIBUTES = MOST_ATTRIBUTES - DAYLIGHT_ATTRIBUTES - 2 };
int output_attributes(image_attribute all[MOST_ATTRIBUTES], char date[CAP_DATE], const study *s,
                      const moment *m, bool partial);

/* The study's file name without its folders: what an EXR says made it. */
const char *output_study_name(const study *s);

#endif
