/* data/car/make_car.c -- makes the car that lux4 ships: make_car FOLDER writes car.glb. */
#include "data/car/car.h"

int main(int argc, char **argv) { return model_main(argc, argv, "car.glb", car_build); }
