/* data/glass/make_glass.c -- makes the room that lux4 ships: make_glass FOLDER writes glass.glb. */
#include "data/glass/glass.h"

int main(int argc, char **argv) { return model_main(argc, argv, "glass.glb", glass_build); }
