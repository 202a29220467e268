/* tests/block.c -- see block.h. In glTF y is up and z to the south. */
#include "tests/block.h"

#include "tests/gltf_text.h"

#include <string.h>

const char *block_write(arena *a, const char *name, vec3 size)
{
    static const uint16_t corner[36] = { 0, 1, 3, 0, 3, 2, 5, 4, 6, 5, 6, 7, 4, 0, 2, 4, 2, 6,
                                         1, 5, 7, 1, 7, 3, 2, 3, 7, 2, 7, 6, 4, 5, 1, 4, 1, 0 };
    float x = 0.5f * size.x, y = 0.5f * size.y, position[8][3];
    for (int i = 0; i < 8; i++) {
        position[i][0] = i & 1 ? x : -x;
        position[i][1] = i & 2 ? size.z : 0.0f;
        position[i][2] = i & 4 ? -y : y;
    }
    char bytes[sizeof position + sizeof corner];
    memcpy(bytes, position, sizeof position);
    memcpy(bytes + sizeof position, corner, sizeof corner);
    const char *text = text_of(
        a,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.4,0.4,0.4,1],"
        "\"metallicFactor\":0}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,"
        "\"material\":0}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
        "\"min\":[%.9g,0,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},"
        "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],"
        "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}]}",
        (double)-x, (double)-y, (double)x, (double)size.z, (double)y, sizeof position,
        sizeof position, sizeof corner, sizeof bytes, data_uri(a, bytes, sizeof bytes));
    return text_of(a, "%s", scratch_write(name, text, strlen(text)));
}
