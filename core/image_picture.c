/* core/image_picture.c -- pictures that are no EXR, through liblux4_oiio.so.
 *
 * That library, and OpenImageIO with some 260 others behind it, is loaded when the first picture
 * is asked for: at each start it would cost 0.2 s.
 */
#define _GNU_SOURCE
#include "core/file.h"
#include "core/image.h"
#include "core/image_oiio.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PLUGIN "liblux4_oiio.so"

/* ---- finding it ------------------------------------------------------------------------- */

/* Where it may lie, seen from the program's folder: beside it, where `make install` puts it, and
 * for the tests, which lie deeper in the build folder. */
static const char *const PLACES[] = { "/", "/../lib/lux4/", "/../../", "/../../../" };

/* A library is loaded once in a process: the one thing here that outlives a call. */
static struct {
    pthread_once_t once;
    oiio_encode_function *encode;
    oiio_mean_function *mean;
    char reason[200]; /* why there are no functions */
} plugin = { .once = PTHREAD_ONCE_INIT };

static void *open_at(const char *folder, const char *place)
{
    char name[PATH_MAX];
    if (snprintf(name, sizeof name, "%s%s" PLUGIN, folder, place) >= (int)sizeof name)
        return NULL;
    if (access(name, F_OK))
        return NULL;
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        snprintf(plugin.reason, sizeof plugin.reason, "%s", dlerror());
    return library;
}

static void *open_plugin(void)
{
    char program[PATH_MAX] = "";
    ssize_t length         = readlink("/proc/self/exe", program, sizeof program - 1);
    void *library          = NULL;
    if (length > 0) {
        program[length]        = '\0';
        *strrchr(program, '/') = '\0'; /* the link is absolute */
        for (size_t i = 0; !library && i < sizeof PLACES / sizeof *PLACES; i++)
            library = open_at(program, PLACES[i]);
    }
#ifdef LUX4_LIBDIR
    if (!library)
        library = open_at(LUX4_LIBDIR, "/");
#endif
    if (!library && !plugin.reason[0])
        snprintf(plugin.reason, sizeof plugin.reason,
                 "it is neither beside the program (%.60s) nor in ../lib/lux4 from there", program);
    return library;
}

static void load(void)
{
    void *library = open_plugin();
    if (!library)
        return;
    /* POSIX has dlsym() give functions as objects; ISO C has no cast for that. */
    *(void **)&plugin.encode = dlsym(library, "lux4_oiio_encode");
    *(void **)&plugin.mean   = dlsym(library, "lux4_oiio_mean");
    if (!plugin.encode || !plugin.mean)
        snprintf(plugin.reason, sizeof plugin.reason, "it is of another version");
}

static bool plugin_ready(const char *path, lux_error *err)
{
    pthread_once(&plugin.once, load);
    if (plugin.encode && plugin.mean)
        return true;
    return failed(err, ERR_UNSUPPORTED,
                  "%s: pictures need " PLUGIN " and OpenImageIO (package libopenimageio2.4): %s",
                  path, plugin.reason);
}

/* ---- using it --------------------------------------------------------------------------- */

static bool put(void *context, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, context) == size;
}

bool image_write_rgb8(const char *path, int width, int height, const uint8_t *rgb, lux_error *err)
{
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return failed(err, ERR_ARGUMENT, "%s: %d x %d pixels, 1 to 65535 a side expected", path,
                      width, height);
    if (!plugin_ready(path, err))
        return false;
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    const oiio_picture picture = { path, width, height, rgb };
    oiio_message why           = { "" };
    /* Where storing failed, committing says why. */
    if (plugin.encode(&picture, (oiio_sink){ put, f.stream }, &why) || ferror(f.stream))
        return file_commit(&f, err);
    file_discard(&f);
    return failed(err, ERR_ARGUMENT, "%s: cannot be written: %s", path, why.text);
}

/* Nothing that would keep a reader waiting for ever. */
static bool is_regular(const char *path, lux_error *err)
{
    struct stat s;
    if (stat(path, &s))
        return failed(err, ERR_IO, "%s: no such file", path);
    if (!S_ISREG(s.st_mode))
        return failed(err, ERR_IO, "%s: is not a regular file", path);
    return true;
}

bool image_mean(const char *path, const void *bytes, size_t size, bool srgb, float mean[4],
                lux_error *err)
{
    if (!bytes && !is_regular(path, err))
        return false;
    if (!plugin_ready(path, err))
        return false;
    const oiio_source from = { path, bytes, size, srgb };
    oiio_message why       = { "" };
    if (plugin.mean(&from, mean, &why))
        return true;
    return failed(err, ERR_FORMAT, "%s: cannot be read as a picture: %s", path, why.text);
}
