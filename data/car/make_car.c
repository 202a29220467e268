/* data/car/make_car.c -- makes the car that lux4 ships: make_car FOLDER writes car.glb. */
#include "data/car/car.h"

static bool write_car(FILE *to)
{
    model m = { 0 };
    car_build(&m);
    const bool done = model_write_glb(&m, to);
    fprintf(stderr, "%u triangles, %d shapes, %d nodes\n", model_triangles(&m), m.shape_count,
            m.node_count);
    model_clear(&m);
    return done;
}

int main(int argc, char **argv)
{
    if (argc == 2 && argv[1][0] != '-')
        return model_make_file(argv[1], "car.glb", write_car);
    fprintf(stderr, "make_car FOLDER\n");
    return 2;
}
