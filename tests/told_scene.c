/* tests/told_scene.c -- see told_scene.h. */
#include "tests/told_scene.h"

#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;
static char *folder;
static notices told;

int told_prepare(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

int told_forget(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    return 0;
}

const char *told_folder(void) { return folder; }
arena *told_memory(void) { return &memory; }
const notice *told_first(void) { return told.first; }

const scene *told_scene_of(const char *text)
{
    char path[4096], whole[8192];
    lux_error err = { 0 };
    snprintf(whole, sizeof whole, "lux4: 1\n%s", text);
    folder_write(folder, "s.yaml", whole);
    snprintf(path, sizeof path, "%s/s.yaml", folder);
    told           = (notices){ .a = &memory };
    const study *s = study_read(&memory, path, NULL, &told, &err);
    const scene *made =
        s ? scene_new(&memory, s, &(scene_options){ .threads = 1 }, &told, &err) : NULL;
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

bool was_told(const char *what)
{
    for (const notice *n = told.first; n; n = n->next)
        if (strstr(n->text, what))
            return true;
    return false;
}
