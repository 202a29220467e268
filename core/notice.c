/* core/notice.c -- see notice.h. */
#include "core/notice.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void notice_add(notices *n, const char *format, ...)
{
    if (!n)
        return;
    char text[480];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);

    for (const notice *said = n->first; said; said = said->next)
        if (!strcmp(said->text, text))
            return;

    size_t bytes = strlen(text) + 1;
    notice *line = arena_alloc(n->a, 1, sizeof *line + bytes, alignof(notice), NULL);
    if (!line)
        return;
    memcpy(line->text, text, bytes);
    *(n->last ? &n->last->next : &n->first) = line;
    n->last                                 = line;
    n->count++;
}
