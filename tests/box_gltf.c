/* tests/box_gltf.c -- see box_gltf.h. */
#include "tests/box_gltf.h"

#include "tests/folder.h"
#include "tests/gltf_text.h"

static const char format[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"name\":\"Box\",\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}]"
    ","
    "\"materials\":[{\"name\":\"Side\",\"emissiveFactor\":[%.9g,%.9g,%.9g],"
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":0}}],"
    "\"buffers\":[{\"byteLength\":132,\"uri\":\"%s\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},"
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":36}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
    "\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
    "{\"bufferView\":1,\"componentType\":5121,\"count\":36,\"type\":\"SCALAR\"}]}";

typedef struct contents {
    float corners[8][3];
    uint8_t sides[36];
} contents;

void box_gltf_write(const char *folder, const char *name, const double low[3], const double high[3],
                    double emission)
{
    /* Corner 4 a + 2 b + c is at the higher x, y, z of glTF (y up) where a, b, c are 1 */
    contents c          = { .sides = { 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3 } };
    const float from[3] = { (float)low[0], (float)low[2], (float)-high[1] };
    const float to[3]   = { (float)high[0], (float)high[2], (float)-low[1] };
    for (int i = 0; i < 8; i++)
        for (int axis = 0; axis < 3; axis++)
            c.corners[i][axis] = i >> (2 - axis) & 1 ? to[axis] : from[axis];

    arena a = { 0 };
    folder_write(folder, name,
                 text_of(&a, format, emission, emission, emission, data_uri(&a, &c, sizeof c),
                         (double)from[0], (double)from[1], (double)from[2], (double)to[0],
                         (double)to[1], (double)to[2]));
    arena_clear(&a);
}
