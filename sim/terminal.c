/* sim/terminal.c -- see terminal.h. */
#define _GNU_SOURCE
#include "sim/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { BAR_LEAST = 8, BAR_MOST = 40, COLUMNS_IF_UNKNOWN = 80, LINE_SIZE = 256 };

static const double FORETOLD_SHARE = 0.02; /* before that, the time left would be a guess */

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void format_time(char *text, size_t size, double seconds)
{
    long s = seconds < 3.6e6 ? lround(seconds) : 3599999;
    if (s < 3600)
        snprintf(text, size, "%ld:%02ld", s / 60, s % 60);
    else
        snprintf(text, size, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

/* What stands right of the bar. */
static void format_tail(char *tail, size_t size, double share, double accuracy_percent,
                        double elapsed_s)
{
    char elapsed[32], left[32];
    format_time(elapsed, sizeof elapsed, elapsed_s);
    format_time(left, sizeof left, share > 0.0 ? elapsed_s * (1.0 - share) / share : 0.0);
    int n = snprintf(tail, size, "%3d%%  %s", (int)floor(100.0 * share), elapsed);
    if (share >= FORETOLD_SHARE)
        n += snprintf(tail + n, size - (size_t)n, ", %s left", left);
    if (isfinite(accuracy_percent))
        snprintf(tail + n, size - (size_t)n, ", accuracy %.2g%%", accuracy_percent);
}

void terminal_line(char *line, size_t size, int columns, const char *label, double share,
                   double accuracy_percent, double elapsed_s)
{
    char tail[128], bar[BAR_MOST + 4] = "";
    share = share > 0.0 ? fmin(share, 1.0) : 0.0;
    format_tail(tail, sizeof tail, share, accuracy_percent, elapsed_s);

    int most = columns - 1 < (int)size - 1 ? columns - 1 : (int)size - 1;
    int room = most - (int)strlen(label) - (int)strlen(tail) - 4; /* brackets and two spaces */
    if (room >= BAR_LEAST) {
        room      = room < BAR_MOST ? room : BAR_MOST;
        int solid = (int)(share * room);
        bar[0]    = '[';
        memset(bar + 1, '-', (size_t)room);
        memset(bar + 1, '#', (size_t)solid);
        memcpy(bar + 1 + room, "] ", 3);
    }
    snprintf(line, most > 0 ? (size_t)most + 1 : 1, "%s %s%s", label, bar, tail);
}

terminal terminal_open(bool quiet)
{
    const char *kind = getenv("TERM");
    bool erases      = kind && *kind && strcmp(kind, "dumb") != 0;
    return (terminal){ .stream = !quiet && erases && isatty(STDERR_FILENO) ? stderr : NULL };
}

static int columns_of(FILE *stream)
{
    struct winsize w;
    bool known = ioctl(fileno(stream), TIOCGWINSZ, &w) == 0 && w.ws_col > 0;
    return known ? w.ws_col : COLUMNS_IF_UNKNOWN;
}

static void draw(void *context, const char *label, double share, double accuracy_percent)
{
    terminal *t = context;
    if (strncmp(t->label, label, sizeof t->label - 1) != 0) {
        snprintf(t->label, sizeof t->label, "%s", label);
        t->began_s = now_s();
    }
    char line[LINE_SIZE];
    terminal_line(line, sizeof line, columns_of(t->stream), t->label, share, accuracy_percent,
                  now_s() - t->began_s);
    fprintf(t->stream, "\r%s\033[K", line);
    fflush(t->stream);
    t->drawn = true;
}

progress terminal_progress(terminal *t, const volatile bool *stop)
{
    return (progress){ .draw = t->stream ? draw : NULL, .context = t, .stop = stop };
}

void terminal_clear(terminal *t)
{
    if (!t->stream || !t->drawn)
        return;
    fputs("\r\033[K", t->stream);
    fflush(t->stream);
    t->drawn = false;
}
