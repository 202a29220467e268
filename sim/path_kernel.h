/* sim/path_kernel.h -- the kernels of path.h: paths for scenes that call for much or for little.
 *
 * Of one source (path.c and path_*.c, but for path_tracer.c) the Makefile compiles one kernel for
 * each number below KERNELS, PATH_KERNEL. The effects that cost something in the inner loops even
 * where a scene has none of them are constants of a kernel: what asks for one that is left out is
 * no code. (All others, daylight among them, are a branch a packet: as constants they saved less
 * than a thousandth of a grid's instructions.) A tracer takes the kernel that leaves out most of
 * what its scene does not call for. All of them find the same, to the bit.
 */
#ifndef SIM_PATH_KERNEL_H
#define SIM_PATH_KERNEL_H

#include "sim/path.h"

/* What a kernel leaves out: the bits of its number. */
enum {
    KERNEL_GREY = 1, /* two of three channels, which are as the first in a grey scene */
    KERNEL_MATT = 2, /* surfaces that are not plainly matt: mirrors, glass, textures, normals of
                        their own; those that are outside */
    KERNELS = 4
};

/* From now on that kernel follows the paths of t, unless it leaves out what the scene calls for:
 * results are the same. The one that does. */
int path_use_kernel(path_tracer *t, int kernel);

#ifndef PATH_KERNEL /* what all kernels share */
#define PATH_KERNEL 0
#endif

enum { COLOR = !(PATH_KERNEL & KERNEL_GREY), SURFACES = !(PATH_KERNEL & KERNEL_MATT) };

/* The functions that the files of a kernel share are of that kernel: path_add_k0 and so on. */
#define PATH_JOIN(name, kernel) name##_k##kernel
#define PATH_NAME(name, kernel) PATH_JOIN(name, kernel)
#define path_follow             PATH_NAME(path_follow, PATH_KERNEL)
#define path_numbers            PATH_NAME(path_numbers, PATH_KERNEL)
#define path_in_turn            PATH_NAME(path_in_turn, PATH_KERNEL)
#define path_worth              PATH_NAME(path_worth, PATH_KERNEL)
#define path_horizon            PATH_NAME(path_horizon, PATH_KERNEL)
#define path_add                PATH_NAME(path_add, PATH_KERNEL)
#define path_ask_lights         PATH_NAME(path_ask_lights, PATH_KERNEL)
#define path_ask_sky            PATH_NAME(path_ask_sky, PATH_KERNEL)
#define path_ask_suns           PATH_NAME(path_ask_suns, PATH_KERNEL)
#define path_layer_of           PATH_NAME(path_layer_of, PATH_KERNEL)
#define path_ask_images         PATH_NAME(path_ask_images, PATH_KERNEL)
#define path_image_share        PATH_NAME(path_image_share, PATH_KERNEL)
#define path_set_base           PATH_NAME(path_set_base, PATH_KERNEL)
#define path_ask_patches        PATH_NAME(path_ask_patches, PATH_KERNEL)
#define path_patch_share        PATH_NAME(path_patch_share, PATH_KERNEL)
#define path_take_maps          PATH_NAME(path_take_maps, PATH_KERNEL)
#define path_onto               PATH_NAME(path_onto, PATH_KERNEL)
#define path_add_sky            PATH_NAME(path_add_sky, PATH_KERNEL)
#define path_add_lamps_met      PATH_NAME(path_add_lamps_met, PATH_KERNEL)
#define path_add_glow           PATH_NAME(path_add_glow, PATH_KERNEL)
#define path_note_met           PATH_NAME(path_note_met, PATH_KERNEL)

#endif
