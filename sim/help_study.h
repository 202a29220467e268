/* sim/help_study.h -- the study format in short, as `lux4 help study` shows it. */
#ifndef SIM_HELP_STUDY_H
#define SIM_HELP_STUDY_H

#include <stdio.h>

/* Every key that study.c and the files behind it read; STUDY.md says the same at length. */
void help_study(FILE *to);

#endif
