/* tests/other_times.c -- see other_times.h. */
#include "tests/other_times.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void other_times(const char *program, int count, double *best)
{
    char command[512];
    snprintf(command, sizeof command, "'%s' --times", program);
    FILE *f = popen(command, "r");
    for (int k = 0; k < count; k++) {
        double ns = 0.0;
        if (!f || fscanf(f, "%lf", &ns) != 1) {
            fprintf(stderr, "%s does not answer\n", program);
            exit(1);
        }
        best[k] = fmin(best[k], ns);
    }
    pclose(f);
}
