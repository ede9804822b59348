// Vertex stage: where the vertex of a skinned mesh stands in this frame: the weighted sum of its joints' matrices (glTF 2.0, section
// 3.7.3.3). Every stage that draws meshes includes this file, so that all give the same places to the bit. A mesh that
// is not skinned compiles none of it.
#if defined(SKIN_SMALL) || defined(SKIN_LARGE) || defined(SKIN_TEXTURE)
#define SKINNED
#include "common/mesh_vertex_limits.h"

VERTEX_IN vec4 joints;   // whole numbers: places in the palette
VERTEX_IN vec4 weights;  // they sum to 1

// Three rows a joint: x, y and z of a place relative to the surface's own. highp: positions in metres.
#ifdef SKIN_TEXTURE
uniform highp sampler2D joint_map;  // highp: as above
//@stage vertex
//@variant TIER_CONSOLE SKIN_TEXTURE
//@domain joint: 0..16383; row: 0..2; highp sampler2D joint_map: -64..64
//@promise in -64..64
highp vec4 joint_row(int joint, int row) {
    int across = joint - joint / JOINTS_A_ROW * JOINTS_A_ROW;
    return fetch_texel(joint_map, ivec2(3 * across + row, joint / JOINTS_A_ROW));
}
#else
#ifdef SKIN_LARGE
#define JOINT_ROWS (3 * JOINTS_LARGE)
#else
#define JOINT_ROWS (3 * JOINTS_SMALL)
#endif
uniform highp vec4 joint_palette[JOINT_ROWS];
//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@variant TIER_CONSOLE SKIN_LARGE
//@domain joint: 0..1; row: 0..2; highp vec4 joint_palette[6]: -64..64
//@promise in -64..64
highp vec4 joint_row(int joint, int row) { return joint_palette[3 * joint + row]; }
#endif

//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@domain row: 0..2; vec4 joints: 0..1; vec4 weights: 0..1; highp vec4 joint_palette[6]: -64..64
//@jumps floor(joints.x); floor(joints.y); floor(joints.z); floor(joints.w)
//@promise in -256..256; where weights == vec4(0.0): result == vec4(0.0)
highp vec4 blended_row(int row) {
    return joint_row(int(joints.x), row) * weights.x + joint_row(int(joints.y), row) * weights.y +
           joint_row(int(joints.z), row) * weights.z + joint_row(int(joints.w), row) * weights.w;
}

// The rows of the blended matrix; skin_vertex() sets them once a vertex.
highp vec4 bone_x, bone_y, bone_z;

//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@writes highp vec4 bone_x; highp vec4 bone_y; highp vec4 bone_z
//@domain vec4 joints: 0..1; vec4 weights: 0..1; highp vec4 joint_palette[6]: -64..64
//@jumps floor(joints.x); floor(joints.y); floor(joints.z); floor(joints.w)
//@promise in -256..256
void skin_vertex() {
    bone_x = blended_row(0);
    bone_y = blended_row(1);
    bone_z = blended_row(2);
}

//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@domain at: -1000..1000; highp vec4 bone_x, highp vec4 bone_y, highp vec4 bone_z: -16..16
//@promise in -48016..48016
highp vec3 skinned_position(highp vec3 at) {
    highp vec4 from = vec4(at, 1.0);
    return vec3(dot(bone_x, from), dot(bone_y, from), dot(bone_z, from));
}

//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@domain along: unit; highp vec4 bone_x, highp vec4 bone_y, highp vec4 bone_z: -16..16
//@promise in -48..48
highp vec3 skinned_tangent(highp vec3 along) {
    return vec3(dot(bone_x.xyz, along), dot(bone_y.xyz, along), dot(bone_z.xyz, along));
}

// By the cofactors, which are the inverse transpose times the determinant: no division, and a joint that is scaled flat
// still has them. The sign keeps the normals of mirroring joints on the outside.
//@stage vertex
//@variant TIER_CONSOLE SKIN_SMALL
//@domain normal: unit; where abs(dot(bone_x.xyz, cross(bone_y.xyz, bone_z.xyz))) > 1e-9; highp vec4 bone_x, highp vec4 bone_y, highp vec4 bone_z: -16..16
//@promise in -1536..1536
//@jumps sign(dot(bone_x.xyz, cross(bone_y.xyz, bone_z.xyz)))
highp vec3 skinned_normal(highp vec3 normal) {
    highp vec3 x = cross(bone_y.xyz, bone_z.xyz);
    highp vec3 y = cross(bone_z.xyz, bone_x.xyz);
    highp vec3 z = cross(bone_x.xyz, bone_y.xyz);
    highp vec3 turned = vec3(dot(x, normal), dot(y, normal), dot(z, normal));
    return dot(bone_x.xyz, x) < 0.0 ? -turned : turned;
}
#endif
