/* data/courtyard/make_courtyard.c -- makes what lux4 ships: make_courtyard FOLDER writes
 * courtyard.glb. */
#include "data/courtyard/courtyard.h"

int main(int argc, char **argv) { return model_main(argc, argv, "courtyard.glb", courtyard_build); }
