// Moves the vertices of materials with a motion of the game. "material_motions.glsl" is generated for the
// game: it includes the motions, and chooses the one of a number. "Material functions" in
// runtime/c/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/specialization.h"
#include "runtime/shaders/scene/material.glsl"

layout(constant_id = kConstantMaterialMotion) const uint kMaterialMotion = 0u;

// Vertex at which a motion is computed. It has a position alone: triangles that share a corner move it to the
// same place, whatever else they have there.
struct MotionPoint
{
    vec3 position; // object space, metres
    vec3 world;    // the same in the world: the instance at rest
    vec4 inputs;   // of the frame: hearth_frame::material_inputs
    vec4 parameters[kMaterialParameters]; // of the material: its extra "hearth_parameters"
};

#include "material_motions.glsl"

// Motion of a vertex in the world, at most material.motion_bound long in object space: culling counts on it.
vec3 vertexMotion(Instance instance, vec3 position)
{
    if (kMaterialMotion == 0u)
        return vec3(0.0);
    MotionPoint point;
    point.position = position;
    point.world = toEyeRelative(instance, vec3(0.0), position);
    point.inputs = view.material_inputs;
    point.parameters = material.parameters;
    vec3 motion = callMaterialMotion(kMaterialMotion, point);
    vec3 x = instance.world_from_object_x.xyz, y = instance.world_from_object_y.xyz, z = instance.world_from_object_z.xyz;
    vec3 across = cross(y, z);
    vec3 object = (across * motion.x + cross(z, x) * motion.y + cross(x, y) * motion.z) / dot(x, across);
    float reach = length(object);
    if (reach <= material.motion_bound)
        return motion;
    // neither NaN nor an instance without volume moves
    float share = material.motion_bound / reach;
    return share > 0.0 && share < 1.0 ? motion * share : vec3(0.0);
}
